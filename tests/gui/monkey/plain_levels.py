"""Levels of a design by plain calls of the public library: no graph, and nothing kept.

`skinsource.stimulus_of` samples what tracks play, and `skinsource.predict` does the rest.  They
know neither memory, nor streaming, nor the splitting into edited and others.
"""

from dataclasses import replace

import numpy as np

import skinsource as ss


def plain_levels(design: ss.Design, view: ss.View):
    """Levels of all outputs, (72,), dB re 1 m/s²."""
    limb = ss.load_limb(design.limb)
    by_id = {track.id: track for track in design.inputs}
    as_drawn = tuple(replace(track, amplitude=1.0) for track in design.inputs)
    played = ss.stimulus_of(replace(design, inputs=as_drawn), per="input")
    if not played.channels:
        return ss.decibels(np.zeros(limb.n_outputs))
    tracks = [by_id[channel.inputs[0]] for channel in played.channels]
    vibration = ss.predict(
        limb,
        played.samples,
        [track.location for track in tracks],
        [view.match_gain(design) * track.amplitude for track in tracks],
        design.scaling,
        design.actuated,
    )
    signals = ss.project_axes(vibration, view.axes, view.method)
    return ss.decibels(ss.rms(signals, view.span, limb.sample_rate_hz))
