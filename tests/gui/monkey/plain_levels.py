"""Levels of a design by plain calls of the public library: nothing of the engine, nothing kept.

Each clip is sampled by its own recipe and put where its onset lies; `skinsource.predict` does the
rest.  It knows neither graph, nor memory, nor streaming, nor the splitting into edited and others.
"""

from math import floor

import numpy as np

import skinsource as ss

#: What is so near to a sample, in samples, starts on it.
_NEAR = 1e-6


def plain_levels(design: ss.Design, view: ss.View):
    """Levels of all outputs, (72,), dB re 1 m/s²."""
    limb = ss.load_limb(design.limb)
    rate_hz = limb.sample_rate_hz
    solo = any(track.solo for track in design.inputs)
    audible = [track for track in design.inputs if (track.solo or not solo) and not track.muted]
    drives = [_drive(track, rate_hz) for track in audible]
    n_times = max((drive.size for drive in drives), default=0)
    if not n_times:
        return ss.decibels(np.zeros(limb.n_outputs))
    vibration = ss.predict(
        limb,
        [np.pad(drive, (0, n_times - drive.size)) for drive in drives],
        [track.location for track in audible],
        [view.match_gain(design) * track.amplitude for track in audible],
        design.scaling,
        design.actuated,
    )
    signals = ss.project_axes(vibration, view.axes, view.method)
    return ss.decibels(ss.rms(signals, view.span, rate_hz))


def _drive(track: ss.Input, rate_hz: float):
    """What a track plays, (n_times,), from time 0 on."""
    placed = [(clip.gain, *_placed(clip, rate_hz)) for clip in track.clips if not clip.muted]
    total = np.zeros(max((first + samples.size for _, first, samples in placed), default=0))
    for gain, first, samples in placed:
        total[first : first + samples.size] += gain * samples
    if track.gain_curve:
        times_s, factors = np.array(track.gain_curve).T
        total *= np.interp(np.arange(total.size) / rate_hz, times_s, factors)
    return total


def _placed(clip: ss.Clip, rate_hz: float):
    """Sample at which a clip begins, and its samples from there on, (n_times,)."""
    if any(effect.on for effect in clip.effects):
        return clip.sampled(rate_hz)
    position = clip.onset_s * rate_hz
    first = floor(position + _NEAR)
    late = position - first
    return first, clip.waveform.samples(rate_hz, late / rate_hz if late > _NEAR else 0.0)
