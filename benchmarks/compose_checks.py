"""What the three scenes must come to: numbers of the design, and levels by plain calls."""

from pathlib import Path

import numpy as np
import soundfile
from composer import Composer

import skinsource as ss
from skinsource.design.effects.level import Envelope
from skinsource.design.motions import Sweep
from skinsource.design.waveforms.samples import Recording
from skinsource.design.waveforms.tones import Tone
from skinsource.design.waveforms.wavelet_train import WaveletTrain

#: Of the tip of digit II, pushed into the skin, as in Fig. 2H of the paper.
TRAIN_PLACE, TRAIN_HZ = 7, (50.0, 84.090, 141.421, 237.841, 400.0)
#: Pads of the digits II to V.
PATH, SWEEP_HZ = (7, 8, 9, 10), 150.0
#: Attack, decay and end of the envelope: s and level.
ENVELOPE = ((0.0, 0.0), (0.05, 1.0), (0.4, 1.0), (0.5, 0.0))
_TOLERANCE_DB = 1e-6
# Where a wavelet lies between samples changes its loudest 100 ms a little.
_EQUAL_DB = 0.05
RATE_HZ, RECORDED_S = 8000, 0.5


def write_recording(folder: Path) -> Path:
    """Write half a second of a tone that beats, at 8 kHz."""
    time_s = np.arange(round(RECORDED_S * RATE_HZ)) / RATE_HZ
    beat = np.sin(2.0 * np.pi * 160.0 * time_s) * np.cos(2.0 * np.pi * 3.0 * time_s)
    path = folder / "beat.wav"
    soundfile.write(path, 0.8 * beat, RATE_HZ)
    return path


def check_train(you: Composer) -> None:
    """Frequencies, slots, gains; each wavelet as loud on the skin."""
    (track,) = you.document.design.inputs
    (clip,) = track.clips
    train = clip.waveform
    you.expect(track.location == TRAIN_PLACE, f"the train plays at place {TRAIN_PLACE}")
    you.expect(clip.onset_s == 0.0, "it starts at 0")
    if not isinstance(train, WaveletTrain):
        you.expect(False, f"the clip plays a wavelet train, not {train}")
        return
    near = np.allclose(train.frequencies_hz, TRAIN_HZ, rtol=0.0, atol=0.05)
    you.expect(near, f"frequencies rise from 50 to 400 Hz, not {train.frequencies_hz}")
    you.expect(train.cycles == 4.0 and train.slot_s == 0.12, "4 cycles, one each 120 ms")
    you.expect(train.family == "gabor", "wavelets are Gabor's")
    you.expect(len(train.gains_db) == len(TRAIN_HZ), "each wavelet has a gain of its own")
    levels = [_loudest_db(you, train, k) for k in range(len(train.frequencies_hz))]
    spread_db = max(levels) - min(levels)
    you.expect(
        spread_db < _EQUAL_DB, f"wavelets are alike on the skin, not {spread_db:.3f} dB apart"
    )
    check_levels(you)


def _loudest_db(you: Composer, train: WaveletTrain, k: int) -> float:
    """Loudest 100 ms anywhere on the skin of one wavelet alone."""
    gains = train.gains_db or (0.0,) * len(train.frequencies_hz)
    alone = WaveletTrain(
        (train.frequencies_hz[k],), train.cycles, train.slot_s, train.family, train.equalise
    )
    design = you.document.design
    limb = ss.load_limb(design.limb)
    samples = alone.samples(limb.sample_rate_hz) * 10.0 ** (gains[k] / 20.0)
    vibration = ss.predict(limb, [samples], [TRAIN_PLACE], scaling=design.scaling)
    signals = ss.project_axes(vibration)
    return float(ss.decibels(ss.rms(signals, "loudest", limb.sample_rate_hz)).max())


def check_recording(you: Composer, times_s: float, level: float) -> None:
    """The envelope over the recording, within what the hand can do, s and level."""
    clips = [clip for clip in you.document.design.clips if isinstance(clip.waveform, Recording)]
    you.expect(len(clips) == 1, "the recording plays in one clip")
    if not clips:
        return
    (clip,) = clips
    seconds = clip.waveform.duration_s
    you.expect(abs(seconds - RECORDED_S) < 1e-3, f"it lasts {RECORDED_S} s, not {seconds:g} s")
    envelopes = [effect for effect in clip.effects if isinstance(effect, Envelope)]
    points = np.array([point[:2] for envelope in envelopes for point in envelope.points])
    same = points.shape == (len(ENVELOPE), 2) and bool(
        np.all(np.abs(points - ENVELOPE) <= (times_s, level))
    )
    you.expect(same, f"the envelope rises and falls as drawn: {points.tolist()}")
    first, samples = clip.sampled(1300.0)
    own_s = np.arange(samples.size) / 1300.0
    raw = clip.waveform.samples(1300.0)
    if len(envelopes) == 1 and same:
        drawn = np.interp(own_s, points[:, 0], points[:, 1])
        you.expect(first == 0, "it starts at 0")
        off = np.abs(samples - raw[: samples.size] * drawn).max()
        you.expect(off < 1e-12, f"what plays is the recording times the envelope ({off:.1e} off)")
    check_levels(you)


def check_sweep(you: Composer) -> None:
    """Places, onsets and courses of the sweep."""
    planned = Sweep(path=PATH, waveform=Tone(SWEEP_HZ, duration_s=0.6))
    onsets = [(track.location, track.clips[0].onset_s) for track in you.document.design.inputs]
    expected = [(track.location, track.clips[0].onset_s) for track in planned.tracks()]
    you.expect(onsets == expected, f"the sweep passes {expected}, not {onsets}")
    for track, plan in zip(you.document.design.inputs, planned.tracks(), strict=False):
        same = track.clips[0].sampled(1300.0)[1]
        off = np.abs(same - plan.clips[0].sampled(1300.0)[1]).max(initial=0.0)
        you.expect(off == 0.0, f"place {track.location} plays what the law says")
    check_levels(you)


def check_levels(you: Composer) -> None:
    """What the map shows is what `skinsource.predict` gives for plainly sampled clips."""
    you.settle()
    design, view = you.document.design, you.document.view
    limb = ss.load_limb(design.limb)
    pieces = []
    for track in design.inputs:
        sampled = [clip.sampled(limb.sample_rate_hz) for clip in track.clips]
        end = max(first + samples.size for first, samples in sampled)
        total = np.zeros(end)
        for clip, (first, samples) in zip(track.clips, sampled, strict=True):
            total[first : first + samples.size] += clip.gain * samples
        pieces.append(total)
    longest = max(piece.size for piece in pieces)
    vibration = ss.predict(
        limb,
        [np.pad(piece, (0, longest - piece.size)) for piece in pieces],
        [track.location for track in design.inputs],
        [track.amplitude for track in design.inputs],
        design.scaling,
    )
    signals = ss.project_axes(vibration, view.axes, view.method)
    expected = ss.decibels(ss.rms(signals, view.span, limb.sample_rate_hz))
    shown = you.window.panel("skin").map.content
    off = float(np.abs(np.asarray(shown.values) - expected).max())
    you.expect(not you.window.panel("skin").is_stale, "the map is up to date")
    you.expect(off < _TOLERANCE_DB, f"levels shown are those of predict ({off:.1e} dB off)")
