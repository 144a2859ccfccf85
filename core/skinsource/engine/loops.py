"""Loops: which part of a motion is shown again and again, without a seam, and how slowly."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import ceil

import numpy as np
import scipy

from skinsource.base.conventions import Complexes, Floats
from skinsource.base.decibels import decibels
from skinsource.design.clips import Clip
from skinsource.design.design import Design, View, audible_inputs, played_clips
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.evaluation import evaluate
from skinsource.engine.time_rules import Moving
from skinsource.limbs.own_limbs import facts_of
from skinsource.signals.resampling import finer

#: The fastest strong component is shown at this frequency at most, in so many pictures a period.
SHOWN_HZ, PICTURES_PER_PERIOD = 2.0, 12
# Components of at least this share of the power of the strongest one are strong.
_STRONG = 0.1
# Outputs are louder that reach this share of the largest acceleration; a motion that passes ends
# where no more than this share of them moves by more than this share of their own.
_REST = 0.1
# Parts are nearly as loud whose RMS differ by less than this share of the loudest one.
_NEARLY = 0.05
# It begins so long before the stimulus: the filter of the measurement rings before it.
_BEFORE_S = 0.005
_POINTS_PER_PERIOD = 48
# A tone of so many periods is steady in its middle.
_STEADY_PERIODS = 8


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Loop:
    """A motion of all outputs that is shown again and again.

    Attributes
    ----------
    moving
        The response.
    begin_s, duration_s
        The part of it that is shown; of a steady tone, which has no beginning, one period.
    fastest_hz
        Its fastest strong component.
    phasors : (n_outputs, n_axes) or None
        Complex amplitudes of a steady tone, m/s²; None: the motion passes.
    """

    moving: Moving
    begin_s: float
    duration_s: float
    fastest_hz: float
    phasors: Complexes | None = None

    @property
    def slow_motion(self) -> float:
        """How many times slower than it happens its fastest strong component can be followed."""
        return max(self.fastest_hz / SHOWN_HZ, 1.0)

    @property
    def signed(self) -> bool:
        """Whether values are along one axis; else they are lengths of vectors."""
        return self.moving.signals.shape[1] == 1

    @property
    def largest(self) -> float:
        """The largest acceleration at any output and time, m/s²."""
        if self.phasors is None:
            return self.moving.largest
        return float(np.linalg.norm(self.phasors, axis=1).max())

    def values(self, share: float) -> Floats:
        """Return the acceleration of all outputs at a ``share`` of the loop, (n_outputs,), m/s²."""
        if self.phasors is None:
            vectors = self.moving.acceleration(self.begin_s + share * self.duration_s)
        else:
            vectors = (self.phasors * np.exp(2j * np.pi * share)).real
        return vectors[:, 0] if self.signed else np.linalg.norm(vectors, axis=1)

    def traces(
        self, outputs: tuple[int, ...], length_s: float, since_s: float = 0.0
    ) -> tuple[Floats, Floats]:
        """Return times from the beginning on, (n_times,), and outputs then, (n_outputs, n_times).

        They end after ``length_s``, or with the response.  Those of a steady tone begin
        ``since_s`` after its beginning, where 0 stands.
        """
        rows = np.array(outputs, dtype=int) - 1
        if self.phasors is None:
            times_s = self.times_s[:-1]
            first, end = np.searchsorted(times_s, (0.0, length_s))
            signals = self.moving.signals[rows]
            times_s, vectors = finer(times_s, signals, int(first), int(end))
        else:
            n_times = ceil(_POINTS_PER_PERIOD * length_s / self.duration_s) + 1
            times_s = np.linspace(0.0, length_s, n_times)
            turns = np.exp(2j * np.pi * (since_s + times_s) / self.duration_s)
            vectors = (self.phasors[rows, :, None] * turns).real
        return times_s, vectors[:, 0] if self.signed else np.linalg.norm(vectors, axis=1)

    def spectra(self, outputs: tuple[int, ...]) -> tuple[Floats, Floats]:
        """Return frequencies, (n_bins,), in Hz, and levels of outputs, (n_outputs, n_bins), dB.

        They are over the same time, 1 s, however long designs are that are compared.
        """
        signals = self.moving.signals[np.array(outputs, dtype=int) - 1]
        rate_hz = self.moving.sample_rate_hz
        magnitude = np.linalg.norm(np.abs(scipy.fft.rfft(signals)), axis=1) / rate_hz
        return scipy.fft.rfftfreq(signals.shape[-1], 1.0 / rate_hz), decibels(magnitude)

    @property
    def times_s(self) -> Floats:
        """When samples that are held begin, and the last one ends, since the beginning."""
        samples = self.moving.first + np.arange(self.moving.signals.shape[-1] + 1)
        return samples / self.moving.sample_rate_hz - self.begin_s

    def rms_of_parts(self, after_s: Floats, part_s: float) -> Floats:
        """Return the RMS of all outputs together, up to a factor, in parts that begin then."""
        sums = np.pad(np.cumsum(np.square(self.moving.signals).sum(axis=(0, 1))), (1, 0))
        before, after = (np.interp(at, self.times_s, sums) for at in (after_s, after_s + part_s))
        return np.sqrt(np.maximum(after - before, 0.0))

    def part(self, after_s: float, part_s: float) -> "Loop":
        """Return a part of a motion that passes; of a steady tone all of it."""
        if self.phasors is not None:
            return self
        return replace(self, begin_s=self.begin_s + after_s, duration_s=part_s)


def shown_part(loops: Sequence[Loop], part_s: float) -> tuple[float, list[float]]:
    """Return when the part begins, after the beginning, in which most of some motions are seen.

    It is the loudest part of one motion, and of several the first of those parts that are nearly
    as loud on average, so that what is short is seen from its beginning.  All of them pass, and
    last equally long.  With it come the times from there to the loudest part of each, which are 0
    where it is seen.
    """
    longest = max(loops, key=lambda loop: loop.moving.signals.shape[-1])
    starts_s = np.clip(longest.times_s, 0.0, longest.duration_s - part_s)
    levels = np.stack([loop.rms_of_parts(starts_s, part_s) for loop in loops])
    highest = levels.max(axis=1, keepdims=True)
    seen = levels >= _REST * highest
    shares = levels / np.maximum(highest, np.finfo(float).tiny)
    score = seen.sum(axis=0) + shares.mean(axis=0)
    best = int(np.argmax(score >= score.max() - (_NEARLY if len(loops) > 1 else 0.0)))
    away_s = np.where(seen[:, best], 0.0, starts_s[levels.argmax(axis=1)] - starts_s[best])
    return float(starts_s[best]), away_s.tolist()


def loop_of(design: Design, moving: Moving, *, passes: bool = False) -> Loop:
    """Return what is shown of the response to a design: one period of a tone, else what moves.

    A design whose inputs all play the same tone at the same time is taken for steady: its loop is
    the response to tones without beginning and end.  Not so where it ``passes``.
    """
    tone = None if passes else _only_tone(design)
    if not moving.is_whole:
        # No more of it is seen.
        largest = float(np.linalg.norm(moving.signals, axis=1).max(initial=0.0))
        moving = replace(moving, largest=largest or moving.largest)
    if tone is not None and moving.is_whole and moving.largest > 0.0:
        hz = tone[1].frequency_hz
        return Loop(
            moving=moving,
            begin_s=0.0,
            duration_s=1.0 / hz,
            fastest_hz=hz if moving.signals.shape[1] == 1 else 2.0 * hz,
            phasors=_steady(*tone, moving),
        )
    return _passing(design, moving)


def common_turns(durations_s: Sequence[float], most: int) -> tuple[int, bool]:
    """Return after how many turns of the longest loop all loops begin again, and whether they do.

    They do where none is more than half a hundredth of itself from its beginning; else the turns,
    at most ``most``, are those after which they come closest.
    """
    turns = np.arange(1, most + 1)[:, None] * max(durations_s) / np.array(durations_s)
    missed = np.abs(turns - np.round(turns)).max(axis=1).round(2)
    nearest = int(np.argmin(missed))
    return nearest + 1, bool(missed[nearest] == 0.0)


def animation_of(
    design: Design, view: View, moving: Moving | None = None
) -> tuple[float, float, float]:
    """Return begin and end of what an animation repeats, and how many times slower it runs.

    Times are those of the playhead, s.  At a chosen speed it is all that moves; else a steady tone
    is shown in its middle, for one period.  ``moving`` is `moving_name` of the design, if known.
    """
    if moving is None:
        onset_s = first_onset_s(design)
        name = moving_name(design.limb)
        moving = evaluate(design, name, view=View(playhead_s=onset_s))[name]
    loop, tone = loop_of(design, moving), _only_tone(design)
    slow_motion = view.slow_motion or loop.slow_motion
    if tone is not None and not view.slow_motion and loop.phasors is not None:
        clip, period_s = tone[0], loop.duration_s
        if clip.duration_s >= _STEADY_PERIODS * period_s:
            middle_s = clip.onset_s + clip.duration_s / 2
            return middle_s, middle_s + period_s, slow_motion
    passing = _passing(design, moving)
    removed_s = moving.delay_s if view.delay_removed else 0.0
    begin_s = max(passing.begin_s - removed_s, 0.0)
    return begin_s, passing.begin_s + passing.duration_s - removed_s, slow_motion


def moving_axis(limb: str, axes: str = "") -> str:
    """Return along which axis a limb moves in a view of ``axes``; all where z was not measured.

    It is the one axis of the view, and of several z, which alone means the same everywhere.
    """
    measured = facts_of(limb).axes
    return next((axis for axis in (axes, "z") if axis in tuple(measured)), measured)


def moving_name(limb: str, axes: str = "") -> str:
    """Return the quantity that moves on a limb in a view of ``axes``."""
    return "moving_z" if moving_axis(limb, axes) == "z" else "moving_vector"


def _passing(design: Design, moving: Moving) -> Loop:
    rate_hz = moving.sample_rate_hz
    last_s = max((part.onset_s for part in played_clips(design)), default=0.0)
    begin_s = max(first_onset_s(design) + moving.delay_s - _BEFORE_S, moving.first / rate_hz)
    # The last clip may be far softer than those before.
    since = max(round((last_s + moving.delay_s) * rate_hz) - moving.first, 0)
    size = np.linalg.norm(moving.signals[..., since:], axis=1)
    peaks = size.max(axis=1, initial=0.0)
    louder = peaks > _REST * peaks.max(initial=0.0)
    n_moving = (size > _REST * peaks[:, None])[louder].sum(axis=0)
    moves = np.flatnonzero(n_moving > _REST * louder.sum())
    last = moving.first + since + int(moves.max(initial=0))
    # Of a long response only a part is known.
    end_s = (last if moving.end == moving.response_samples else moving.response_samples) / rate_hz
    return Loop(
        moving=moving,
        begin_s=begin_s,
        duration_s=max(end_s - begin_s, _BEFORE_S),
        fastest_hz=_fastest_hz(moving),
    )


def first_onset_s(design: Design) -> float:
    """Return when the first clip that is played begins, s; 0 where none is."""
    return min((clip.onset_s for clip in played_clips(design)), default=0.0)


def is_sequence(design: Design) -> bool:
    """Return whether clips begin one after another."""
    return len({clip.onset_s for clip in played_clips(design)}) > 1


def _only_tone(design: Design) -> tuple[Clip, Tone] | None:
    """Return the tone that all audible inputs play, in any phase, and a clip of it; or None."""
    clips = played_clips(design)
    curved = any(track.gain_curve for track in audible_inputs(design.inputs))
    tones = [
        (clip, clip.waveform)
        for clip in clips
        if isinstance(clip.waveform, Tone) and not clip.effects
    ]
    alike = {(clip.onset_s, replace(tone, phase_rad=0.0)) for clip, tone in tones}
    return tones[0] if len(tones) == len(clips) and len(alike) == 1 and not curved else None


def _steady(clip: Clip, tone: Tone, moving: Moving) -> Complexes:
    """Return the response to an endless tone, from that to the ``clip``, at its frequency."""
    rate_hz, hz = moving.sample_rate_hz, tone.frequency_hz
    first, samples = clip.sampled(rate_hz)
    played = samples @ np.exp(-2j * np.pi * hz * (first + np.arange(samples.size)) / rate_hz)
    # sin(ωt + φ) is the real part of -i e^iφ e^iωt.
    endless = -1j * np.exp(1j * (tone.phase_rad - 2 * np.pi * hz * clip.onset_s))
    times_s = (moving.first + np.arange(moving.signals.shape[-1])) / rate_hz
    turns = np.exp(-2j * np.pi * hz * times_s)
    phasors: Complexes = (moving.signals @ turns) * (endless / played)
    return phasors


def _fastest_hz(moving: Moving) -> float:
    power = np.square(np.abs(scipy.fft.rfft(moving.signals))).sum(axis=(0, 1))
    strong = np.flatnonzero(power >= _STRONG * power.max())
    n_times = moving.signals.shape[-1]
    hz = float(strong[-1]) * moving.sample_rate_hz / n_times if strong.size else SHOWN_HZ
    # The length of a vector moves twice as fast.
    return hz if moving.signals.shape[1] == 1 else 2.0 * hz
