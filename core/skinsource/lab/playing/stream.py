"""What is played, what is known of it, and playing it on a device, within all limits.

A `PlayQueue` is the state between two threads: one requests mixes and gains, the thread of the
device plays them block by block, within full scale and the limits of a rig.

Samples are never made smaller, which would change the stimulus: instead playing ends with a reason.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import copysign, floor, inf, log10
from threading import Event
from time import perf_counter
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from skinsource.base.arguments import finite_array, real_number
from skinsource.base.conventions import Floats
from skinsource.base.decibels import decibels
from skinsource.base.errors import InvalidInputError, PlaybackError, counted
from skinsource.lab.playing.devices import Device, refusal_text, sound_library
from skinsource.lab.playing.triggers import trigger_of

#: Samples for a device.
Frames = NDArray[np.float32]

#: Duration of the fade from one mix to another.
FADE_S = 0.005
#: A loop has room for two fades.
SHORTEST_LOOP_S = 2 * FADE_S


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Mix:
    """Samples at the rate of a device, which do not change while they are played.

    `mix_of` makes mixes.

    Attributes
    ----------
    samples : (n_outputs, n_times)
        From time 0 of the design on; before and after there is silence.  1 is full scale.
    peak
        Largest absolute sample.
    names
        Label of what each output plays, ``""`` where it is silent.
    loop
        First sample of the repeated part, and the sample after its last; None where nothing is
        repeated.
    seam : (n_outputs, n_seam)
        Last samples of the loop, faded into the samples before its first one, so that the loop
        begins again without a step.
    most_gain, limit
        Highest gain that the rig allows, and the limit that a higher one would pass first.
    trigger, trigger_output
        A mix of one output that tells a code from time 0 on, at full scale whatever the gain, and
        the output, from 1, that plays it; None and 0 without a code.
    """

    samples: Frames
    sample_rate_hz: int
    peak: float
    names: tuple[str, ...]
    loop: tuple[int, int] | None = None
    seam: Frames
    most_gain: float = inf
    limit: str = ""
    trigger: "Mix | None" = None
    trigger_output: int = 0

    @property
    def n_outputs(self) -> int:
        """Number of outputs of the device that the mix needs."""
        return self.samples.shape[0]

    @property
    def n_times(self) -> int:
        """Samples of each output."""
        return self.samples.shape[1]

    @property
    def duration_s(self) -> float:
        """Duration."""
        return self.n_times / self.sample_rate_hz

    def plays_on(self, output: int) -> bool:
        """Return whether an output, from 1, plays something."""
        return output <= len(self.names) and self.names[output - 1] != ""

    def read(self, position: int, out: Floats) -> int:
        """Fill ``out``, (n_outputs, n), with samples from ``position`` on.

        Returns
        -------
        Position of the next sample; at the end of a loop that is its first sample.
        """
        done, n_times = 0, out.shape[1]
        while done < n_times:
            end = position + n_times - done
            loops = self.loop is not None and position < self.loop[1] <= end
            if self.loop is not None and loops:
                end = self.loop[1]
            _copy(self.samples, position, end, out[:, done : done + end - position])
            if self.loop is not None and position < self.loop[1]:
                self._join(self.loop[1], position, end, out[:, done : done + end - position])
            done += end - position
            position = self.loop[0] if self.loop is not None and loops else end
        return position

    def _join(self, loop_end: int, start: int, end: int, out: Floats) -> None:
        """Write the seam over the last samples of the loop."""
        seam_start = loop_end - self.seam.shape[1]
        first = max(start, seam_start)
        if first < end:
            out[:, first - start :] = self.seam[:, first - seam_start : end - seam_start]


def fade_samples(sample_rate_hz: int) -> int:
    """Return the number of samples of a fade."""
    return max(round(FADE_S * sample_rate_hz), 1)


def rise(n: int) -> Floats:
    """Return half a cosine from just above 0 to just below 1, (n,)."""
    return 0.5 - 0.5 * np.cos(np.pi * np.arange(1, n + 1) / (n + 1))


def mix_of(
    rows: Floats | Frames,
    sample_rate_hz: int,
    *,
    outputs: Sequence[int],
    titles: Sequence[str],
    n_outputs: int,
    loop_s: tuple[float, float] | None = None,
) -> Mix:
    """Return a mix of channels.

    Parameters
    ----------
    rows : (n_channels, n_times)
        Samples of each channel, at the rate of the device; 1 is full scale, before the gain.
    sample_rate_hz
        Of the device.
    outputs
        Output of each channel, from 1; channels at one output add up.
    titles
        Label of each channel.
    n_outputs
        Outputs of the device; those without a channel are silent.
    loop_s
        Begin and end of the repeated part.

    Raises
    ------
    InvalidInputError
        A sample is not finite, an output is not among those of the device, or the loop is shorter
        than 10 ms.
    """
    values = finite_array("samples", rows, largest=float(np.finfo(np.float32).max))
    samples = np.zeros((n_outputs, values.shape[1]), np.float32)
    names: list[list[str]] = [[] for _ in range(n_outputs)]
    for row, output, title in zip(values, outputs, titles, strict=True):
        samples[output - 1] += row
        names[output - 1].append(title)
    samples.flags.writeable = False
    loop = _loop_of(loop_s, sample_rate_hz)
    return Mix(
        samples=samples,
        sample_rate_hz=sample_rate_hz,
        peak=float(np.abs(samples).max(initial=0.0)),
        names=tuple(" + ".join(titles_of_output) for titles_of_output in names),
        loop=loop,
        seam=_seam_of(samples, loop, sample_rate_hz),
    )


def with_trigger(mix: Mix, output: int, code: int) -> Mix:
    """Return a mix that tells a code on an output, from 1, that plays nothing else.

    Raises
    ------
    InvalidInputError
        The output plays something, or the code is not from 0 to 255.
    """
    if mix.plays_on(output):
        raise InvalidInputError(
            f"Output {output} plays {mix.names[output - 1]}, so it cannot be the trigger. Choose a "
            "free output for the trigger."
        )
    samples = trigger_of(code, mix.sample_rate_hz)[np.newaxis].astype(np.float32)
    trigger = replace(mix, samples=samples, seam=samples[:, :0], trigger=None)
    return replace(mix, trigger=trigger, trigger_output=output)


def _loop_of(loop_s: tuple[float, float] | None, rate_hz: int) -> tuple[int, int] | None:
    if loop_s is None:
        return None
    first_s, end_s = (real_number("loop_s", time_s, least=0.0) for time_s in loop_s)
    if end_s - first_s < SHORTEST_LOOP_S * (1 - 1e-9):
        raise InvalidInputError(
            f"The loop lasts {(end_s - first_s) * 1e3:.4g} ms, expected at least "
            f"{SHORTEST_LOOP_S * 1e3:g} ms. Drag its ends on the ruler apart."
        )
    return round(first_s * rate_hz), round(end_s * rate_hz)


def _seam_of(samples: Frames, loop: tuple[int, int] | None, rate_hz: int) -> Frames:
    """Return the seam of a loop, (n_outputs, n_seam), see `Mix`."""
    if loop is None:
        return np.zeros((samples.shape[0], 0), np.float32)
    n = fade_samples(rate_hz)
    weight = rise(n)
    ending, before = (_part(samples, at - n, at) for at in (loop[1], loop[0]))
    return ((1.0 - weight) * ending + weight * before).astype(np.float32)


def _part(samples: Frames, start: int, end: int) -> Floats:
    """Return samples ``start`` to ``end``, with silence where there are none."""
    piece = np.empty((samples.shape[0], end - start))
    _copy(samples, start, end, piece)
    return piece


def _copy(samples: Frames, start: int, end: int, out: Floats) -> None:
    """Copy samples ``start`` to ``end``, and silence where there are none."""
    first = min(max(start, 0), end)
    last = max(min(end, samples.shape[1]), first)
    out[:, : first - start] = 0.0
    out[:, first - start : last - start] = samples[:, first:last]
    out[:, last - start :] = 0.0


Reason = Literal["end", "stopped", "panic", "limit", "broken", "rig"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Ending:
    """Why playing has ended.

    Attributes
    ----------
    reason
        ``"end"``: all was played.  ``"stopped"``, ``"panic"``: it was stopped with a fade, or at
        once.  ``"limit"``: a sample would have passed full scale.  ``"broken"``: a sample was no
        finite number.  ``"rig"``: a limit of the rig would have been passed.
    output, name
        Output of the first such sample, from 1, and its label; 0 and "" where no sample is the
        reason.  For ``"rig"`` the name is that of the limit.
    peak
        Absolute value of that sample; 1 is full scale.
    highest_db
        Highest gain at which all samples stay within full scale.
    """

    reason: Reason
    output: int = 0
    name: str = ""
    peak: float = 0.0
    highest_db: float = 0.0

    @property
    def sentence(self) -> str:
        """Message with advice for the user; "" where the end was expected."""
        where = f"output {self.output}{f' ({self.name})' if self.name else ''}"
        if self.reason in ("limit", "rig"):
            what = f"Stopped: {where} would have passed full scale."
            if self.reason == "rig":
                what = f"Stopped: a limit of the rig would have been passed ({self.name})."
            if self.highest_db == -inf:
                return f"{what} Shorten the stimulus, or change the rig."
            # Rounded down, so that the advised gain is low enough.
            most_db = floor(10.0 * self.highest_db) / 10.0
            return (
                f"{what} Turn the gain down to {most_db:.1f} dB or less, or lower the amplitude."
            ).replace("-", "\u2212")
        if self.reason == "broken":
            return f"Stopped: {where} was given a value that is not a number."
        if self.reason == "panic":
            return "Stopped. The gain is back at its start value."
        return ""


#: Gain at the start, and after each change of the device.
START_DB = -20.0
LOWEST_DB, HIGHEST_DB = -60.0, 20.0

# Time from silence to full scale.
_RAMP_S = 0.05


def factor_of(gain_db: float) -> float:
    """Return the factor of a gain from -60 to 20 dB; other values are an error."""
    number_db = real_number(
        "gain_db",
        gain_db,
        f"a number from {LOWEST_DB:g} to {HIGHEST_DB:g}",
        least=LOWEST_DB,
        most=HIGHEST_DB,
    )
    return float(10.0 ** (number_db / 20.0))


class Gain:
    """A gain that approaches its target linearly, by the same step each sample.

    Attributes
    ----------
    target
        Factor that it approaches; may be set from another thread.
    now
        Factor of the last sample.
    """

    def __init__(self, factor: float, sample_rate_hz: int, most_samples: int) -> None:
        self.target = self.now = factor
        self._step = 1.0 / (_RAMP_S * sample_rate_hz)
        self._count = np.arange(1.0, most_samples + 1)
        # Samples count from the start of the ramp, so that it does not depend on blocks.
        self._from, self._to, self._done = factor, factor, 0

    def fill(self, out: Floats) -> None:
        """Fill ``out`` with the factors of the next samples, (n_times,)."""
        target, n = self.target, out.size
        if target != self._to:
            self._from, self._to, self._done = self.now, target, 0
        if self._from == self._to:
            out[:] = target
            return
        step = copysign(self._step, self._to - self._from)
        np.add(self._count[:n], self._done, out=out)
        out *= step
        out += self._from
        (np.minimum if step > 0 else np.maximum)(out, self._to, out=out)
        self._done += n
        self.now = float(out[-1])
        if self.now == self._to:
            self._from = self._to


#: Window of a peak and an RMS.
WINDOW_S = 0.1


@dataclass(frozen=True, slots=True)
class Levels:
    """Levels of the outputs, dB of full scale (dBFS), (n_outputs,) each.

    Attributes
    ----------
    peak_db, rms_db
        Over the last whole window of 0.1 s; a steady tone at full scale has an RMS of -3 dB.
    highest_db
        Highest peak since playing began.
    """

    peak_db: Floats
    rms_db: Floats
    highest_db: Floats


class Meters:
    """Measures peaks and RMS of blocks, without allocating memory."""

    def __init__(self, n_outputs: int, sample_rate_hz: int) -> None:
        self._window = max(round(WINDOW_S * sample_rate_hz), 1)
        self._peak, self._squares, self._counted = np.zeros(n_outputs), np.zeros(n_outputs), 0
        self._of_block = np.zeros(n_outputs)
        self._shown_peak, self._shown_rms = np.zeros(n_outputs), np.zeros(n_outputs)
        self._highest = np.zeros(n_outputs)

    def add(self, samples: Floats, scratch: Floats) -> None:
        """Add played samples, (n_outputs, n_times); ``scratch`` has room for as many."""
        done, n = 0, samples.shape[1]
        while done < n:
            step = min(self._window - self._counted, n - done)
            part = samples[:, done : done + step]
            work = scratch[:, :step]
            np.abs(part, out=work)
            np.max(work, axis=1, out=self._of_block)
            np.maximum(self._peak, self._of_block, out=self._peak)
            np.multiply(part, part, out=work)
            np.sum(work, axis=1, out=self._of_block)
            self._squares += self._of_block
            self._counted += step
            done += step
            if self._counted == self._window:
                self._show()

    def _show(self) -> None:
        np.copyto(self._shown_peak, self._peak)
        np.divide(self._squares, self._window, out=self._shown_rms)
        np.sqrt(self._shown_rms, out=self._shown_rms)
        np.maximum(self._highest, self._peak, out=self._highest)
        self._peak[:] = 0.0
        self._squares[:] = 0.0
        self._counted = 0

    def levels(self) -> Levels:
        """Return the levels for a display; another thread may call it."""
        return Levels(
            decibels(self._shown_peak),
            decibels(self._shown_rms),
            decibels(np.maximum(self._highest, self._peak)),
        )


#: Test tone for finding the actuator of an output: strong in the skin, and audible as rattle.
FREQUENCY_HZ = 100.0
DURATION_S = 0.6
_FADE_S = 0.05


def tone_of(output: int, n_outputs: int, sample_rate_hz: int) -> Mix:
    """Return 0.6 s of 100 Hz on one output, from 1, of amplitude 1; silence on the others."""
    n = round(DURATION_S * sample_rate_hz)
    tone = np.sin(2.0 * np.pi * FREQUENCY_HZ * np.arange(n) / sample_rate_hz)
    fade = rise(round(_FADE_S * sample_rate_hz))
    tone[: fade.size] *= fade
    tone[-fade.size :] *= fade[::-1]
    return mix_of(
        tone[np.newaxis],
        sample_rate_hz,
        outputs=[output],
        titles=["test tone"],
        n_outputs=n_outputs,
    )


# Blocks that are remembered: more than a second.
_REMEMBERED = 512
# A clock has jumped where it differs by more from one block to the next, and goes on after so many.
_JUMP_S, _STEADY = 0.5, 3
# A loop that no position can reach.
_NO_LOOP = (0, -(2**62))


@dataclass(frozen=True, slots=True, kw_only=True)
class Delay:
    """Delay from an edit to the outputs, in parts.

    Attributes
    ----------
    render_s
        Until the edited design was ready to be played.
    wait_s
        Until the device requested the next block.
    device_s
        Until that block reached the outputs, as the device reports.
    """

    render_s: float
    wait_s: float
    device_s: float

    @property
    def total_s(self) -> float:
        """Sum of all parts."""
        return self.render_s + self.wait_s + self.device_s

    @property
    def text(self) -> str:
        """The delay and its parts as text, in ms."""
        parts = ", ".join(
            f"{name} {seconds * 1e3:.0f} ms"
            for name, seconds in (
                ("computing", self.render_s),
                ("waiting for the device", self.wait_s),
                ("inside the device", self.device_s),
            )
        )
        return f"{self.total_s * 1e3:.0f} ms from an edit to the output: {parts}"


class DeviceClock:
    """Tells the time of a device without calling it, as a device that hangs would block the caller.

    The thread of the device notes its time with each block; another thread reads it.
    """

    def __init__(self) -> None:
        self._noted, self._last_s = 0, np.inf
        self._behind_s = np.full(_REMEMBERED, np.inf)

    def note(self, device_s: float, now_s: float) -> bool:
        """Note that the clock of the device was at ``device_s`` when ours was at ``now_s``.

        Returns
        -------
        Whether both have gone alike for three blocks: the first times of some devices are wrong.
        """
        behind_s = now_s - device_s
        if abs(behind_s - self._last_s) > _JUMP_S:
            self._noted = 0
            self._behind_s[:] = np.inf
        self._last_s = self._behind_s[self._noted % _REMEMBERED] = behind_s
        self._noted += 1
        return self._noted >= _STEADY

    def at(self, now_s: float) -> float:
        """Return the time of the device when ours is ``now_s``; minus infinity before any note."""
        # Threads wait for each other, so that the smallest difference is the most exact one.
        return now_s - float(self._behind_s.min())


def ahead_of_ours_s(clock: Callable[[], float]) -> float:
    """Return how far another clock of this machine is ahead of `time.perf_counter`, s."""
    # What else runs between two looks makes all but the closest pair inexact.
    looks = [(perf_counter(), clock(), perf_counter()) for _ in range(5)]
    before_s, other_s, after_s = min(looks, key=lambda look: look[2] - look[0])
    return other_s - 0.5 * (before_s + after_s)


class HeardPosition:
    """Tells which sample is heard now, from the times at which blocks reach the outputs.

    The thread of the device notes blocks; another thread reads the position.
    """

    def __init__(self, sample_rate_hz: int) -> None:
        self._rate_hz = sample_rate_hz
        self._noted = 0
        self._at_s = np.zeros(_REMEMBERED)
        self._position = np.zeros(_REMEMBERED, np.int64)
        self._loop = np.zeros((_REMEMBERED, 2), np.int64)

    def note(self, at_s: float, position: int, mix: Mix | None) -> None:
        """Note that a block that begins with sample ``position`` is heard from ``at_s`` on."""
        slot = self._noted % _REMEMBERED
        self._at_s[slot] = at_s
        self._position[slot] = position
        self._loop[slot] = _NO_LOOP if mix is None or mix.loop is None else mix.loop
        self._noted += 1

    def at(self, now_s: float) -> float | None:
        """Return the time in the design that is heard at ``now_s``, s; None before the first block.

        It is at least 0, also during the fade before the first sample.
        """
        for block in range(self._noted - 1, max(self._noted - _REMEMBERED, 0) - 1, -1):
            slot = block % _REMEMBERED
            since_s = now_s - float(self._at_s[slot])
            if since_s >= 0.0:
                first, end = (int(sample) for sample in self._loop[slot])
                position = int(self._position[slot])
                later = position + since_s * self._rate_hz
                if position < end <= later:
                    later = first + (later - first) % (end - first)
                return max(later / self._rate_hz, 0.0)
        return None


#: Samples that are computed at once; longer blocks are computed in several steps.
MOST_SAMPLES = 2048
# Time of the fall to silence after an immediate stop.
_FALL_S = 0.001


@dataclass(frozen=True, slots=True, eq=False)
class MixChange:
    """A requested change to another mix.

    Attributes
    ----------
    mix
        What to play, with at most as many outputs as the queue; None for silence.
    at
        Sample at which it begins; None for the position of the present mix.
    requested_s
        When it was requested, by `time.perf_counter`.
    """

    mix: Mix | None
    at: int | None
    requested_s: float


@dataclass(frozen=True, slots=True, eq=False)
class Due:
    """A mix that is to begin by itself.

    Attributes
    ----------
    mix
        What to play.
    at_s
        Time at which its first sample is to be heard, in the clock of the device; None: soon.
    began
        Called from the thread of the device with the time at which its first sample is heard.
    """

    mix: Mix
    at_s: float | None
    began: Callable[[float], None]


class PlayQueue:
    """The state behind a stream: one thread requests changes, another plays.

    Each request is one attribute, which `skinsource.lab.playing.stream.next_block` reads once per
    block, so that no thread ever waits for the other.

    Parameters
    ----------
    n_outputs
        Outputs to play on.
    sample_rate_hz
        Of the device and of all mixes.
    gain_db
        Gain at the start.
    rests
        Called from the thread of the device at the end of each mix; silence follows, until the
        next mix.  None: playing ends there.
    """

    def __init__(
        self,
        n_outputs: int,
        sample_rate_hz: int,
        gain_db: float = START_DB,
        rests: Callable[[], None] | None = None,
    ) -> None:
        self.n_outputs, self.sample_rate_hz, self.rests = n_outputs, sample_rate_hz, rests
        # Requests.
        self.swap: MixChange | None = None
        self.due: Due | None = None
        self.panic = False
        self.gain = Gain(factor_of(gain_db), sample_rate_hz, MOST_SAMPLES)
        # What is played: the mix, and the old one that fades into it.
        self.mix: Mix | None = None
        self.old: Mix | None = None
        self.position = self.old_position = 0
        self.fade = rise(fade_samples(sample_rate_hz))
        self.faded = self.fade.size
        # The fall to silence, from the last samples on.
        self.fall = 1.0 - rise(max(round(_FALL_S * sample_rate_hz), 1))
        self.fallen: int | None = None
        self.last = np.zeros(n_outputs)
        # Results.
        self.ending: Ending | None = None
        self.played_samples = 0
        # First position of the last block, and its mix.
        self.began_at = 0
        self.began_in: Mix | None = None
        # Whether a mix is due or plays, and the rest after it has not come yet.
        self.busy = False
        self.changed_s = self.waited_s = 0.0
        self.meters = Meters(n_outputs, sample_rate_hz)
        self.work, self.other, self.scratch = np.zeros((3, n_outputs, MOST_SAMPLES))
        self.factors = np.ones(MOST_SAMPLES)

    def play(self, mix: Mix, at: int | None = None) -> None:
        """Change to ``mix`` at sample ``at``, or at the position of the present mix."""
        if mix.n_outputs > self.n_outputs or mix.sample_rate_hz != self.sample_rate_hz:
            raise ValueError(
                f"the mix has {mix.n_outputs} outputs at {mix.sample_rate_hz} Hz, the queue "
                f"{self.n_outputs} at {self.sample_rate_hz} Hz"
            )
        self.swap = MixChange(mix, at, perf_counter())

    def begin(self, due: Due) -> None:
        """Have a mix begin by itself."""
        # A queue that is busy without anything due would tell that a mix has ended.
        self.due = due
        self.busy = True

    def begin_due(self, heard_s: float, n_times: int) -> None:
        """Begin what is due within the next block, which is heard from ``heard_s`` on."""
        due, fade = self.due, self.fade.size
        if due is None or self.mix is not None or self.swap is not None:
            return
        # A mix fades in before its first sample.
        later = fade if due.at_s is None else round((due.at_s - heard_s) * self.sample_rate_hz)
        if later < n_times + fade:
            later = max(later, fade)
            self.due = None
            _change_mix(self, MixChange(due.mix, fade - later, perf_counter()))
            due.began(heard_s + later / self.sample_rate_hz)

    def seek(self, at: int) -> None:
        """Continue at another sample of the mix."""
        swap = self.swap
        mix = self.mix if swap is None else swap.mix
        if mix is not None:
            self.swap = MixChange(mix, at, perf_counter())

    def stop(self) -> None:
        """Fade out."""
        self.swap = MixChange(None, None, perf_counter())

    def stop_at_once(self) -> None:
        """Fall silent within a millisecond."""
        self.panic = True

    def set_gain(self, gain_db: float) -> None:
        """Change the gain, within 50 ms."""
        self.gain.target = factor_of(gain_db)

    @property
    def silent(self) -> bool:
        """Whether only silence follows."""
        return self.ending is not None and (self.fallen is None or self.fallen >= self.fall.size)

    @property
    def gain_db(self) -> float:
        """Target of the gain."""
        return 20.0 * log10(self.gain.target)

    def levels(self) -> Levels:
        """Return the levels of the outputs."""
        return self.meters.levels()


def _beyond_the_rig(mix: Mix, gain: float) -> Ending | None:
    if gain <= mix.most_gain:
        return None
    most_db = 20.0 * log10(mix.most_gain) if mix.most_gain else -inf
    return Ending(reason="rig", name=mix.limit, highest_db=most_db)


def refused(mix: Mix, gain_db: float) -> Ending | None:
    """Return why a mix would end early at a gain; None where all of it can be played."""
    gain, highest = factor_of(gain_db), np.abs(mix.samples).max(axis=1, initial=0.0)
    if gain * mix.peak <= 1.0:
        return _beyond_the_rig(mix, gain)
    loudest = int(highest.argmax())
    return Ending(
        reason="limit",
        output=loudest + 1,
        name=mix.names[loudest],
        peak=gain * mix.peak,
        highest_db=-20.0 * log10(mix.peak),
    )


def exceeds_the_rig(queue: PlayQueue) -> bool:
    """Return whether the gain is more than the rig allows; sets the ending if so."""
    mix = queue.mix
    ending = mix and _beyond_the_rig(mix, max(queue.gain.target, queue.gain.now))
    queue.ending = ending or queue.ending
    return ending is not None


def playable_samples(queue: PlayQueue, block: Floats) -> int:
    """Return the samples before the first that must not be played; sets the ending if any."""
    magnitude = queue.other[:, : block.shape[1]]
    np.abs(block, out=magnitude)
    # The maximum of samples with NaN is NaN, which fails the comparison.
    if not magnitude.size or magnitude.max() <= 1.0:
        return block.shape[1]
    first = int(np.argmax(~(magnitude <= 1.0).all(axis=0)))
    output = int(np.argmax(~(magnitude[:, first] <= 1.0)))
    peak = float(magnitude[output, first])
    mixes = [mix for mix in (queue.mix, queue.old) if mix is not None]
    names = mixes[0].names if mixes else ()
    largest = max((mix.peak for mix in mixes), default=peak)
    queue.ending = Ending(
        reason="limit" if np.isfinite(peak) else "broken",
        output=output + 1,
        name=names[output] if output < len(names) else "",
        peak=peak,
        highest_db=-20.0 * log10(largest) if 0.0 < largest < inf else 0.0,
    )
    return first


def next_block(queue: PlayQueue, out: Frames) -> None:
    """Fill ``out`` with the samples that are played next, and advance the queue.

    It runs in the thread of the device: nothing in here waits or allocates much.  No sample passes
    full scale: before the first that would, all outputs fall to silence, and ``queue.ending`` tells
    why.

    Parameters
    ----------
    queue
        What to play.
    out : (n_frames, n_outputs)
        Samples for the device, any number of frames.
    """
    n = out.shape[0]
    for start in range(0, n, MOST_SAMPLES):
        end = min(start + MOST_SAMPLES, n)
        block = queue.work[:, : end - start]
        _fill(queue, block, first=start == 0)
        out[start:end] = block.T
        queue.meters.add(block, queue.scratch)
    queue.played_samples += n


def _fill(queue: PlayQueue, block: Floats, *, first: bool) -> None:
    if queue.panic and queue.ending is None:
        queue.ending = Ending(reason="panic")
        queue.fallen = 0
    queue.panic = False
    if queue.ending is None:
        _begin_mix_change(queue)
        if exceeds_the_rig(queue):
            queue.fallen = 0
            _fall(queue, block)
            return
        if first:
            queue.began_at, queue.began_in = queue.position, queue.mix
        mix, position = queue.mix, queue.position
        _render(queue, block)
        factors = queue.factors[: block.shape[1]]
        queue.gain.fill(factors)
        np.multiply(block, factors, out=block)
        if mix is not None and mix.trigger is not None:
            mix.trigger.read(position, block[mix.trigger_output - 1 : mix.trigger_output])
        sound = playable_samples(queue, block)
        if sound < block.shape[1]:
            queue.fallen = 0
            if sound:
                np.copyto(queue.last, block[:, sound - 1])
            _fall(queue, block[:, sound:])
            return
        np.copyto(queue.last, block[:, -1])
        _end_after_last_sample(queue)
    else:
        _fall(queue, block)


def _begin_mix_change(queue: PlayQueue) -> None:
    """Begin to fade to the requested mix, unless another fade is not over yet."""
    swap = queue.swap
    if swap is not None and queue.faded >= queue.fade.size:
        queue.swap = None
        _change_mix(queue, swap)


def _change_mix(queue: PlayQueue, swap: MixChange) -> None:
    """Begin to fade to a mix, or to silence."""
    queue.old, queue.old_position = queue.mix, queue.position
    queue.mix, queue.faded = swap.mix, 0
    if swap.mix is not None:
        queue.position = _position_in(swap.mix, swap, queue)
        queue.changed_s = perf_counter()
        queue.waited_s = queue.changed_s - swap.requested_s


def _position_in(mix: Mix, swap: MixChange, queue: PlayQueue) -> int:
    """Return the position at which a mix begins."""
    first, end = mix.loop or _NO_LOOP
    if swap.at is None and queue.old is not None:
        # It runs on behind a loop that it had passed before.
        stays = mix.loop is None or mix.loop == queue.old.loop
        if stays or queue.old_position < end:
            return queue.old_position
    position = first if swap.at is None else swap.at
    if mix.loop is not None and position >= max(end, mix.n_times):
        position = first
    # Samples before it are faded in, so that the first sample is played in full.
    faded_in = position - queue.fade.size
    return faded_in if position < end else max(faded_in, end)


def _render(queue: PlayQueue, block: Floats) -> None:
    """Fill ``block`` with samples before the gain."""
    if queue.mix is None:
        block[:] = 0.0
    else:
        queue.position = queue.mix.read(queue.position, block[: queue.mix.n_outputs])
        block[queue.mix.n_outputs :] = 0.0
    n = min(queue.fade.size - queue.faded, block.shape[1])
    if n <= 0:
        return
    old = queue.other[:, :n]
    if queue.old is None:
        old[:] = 0.0
    else:
        queue.old_position = queue.old.read(queue.old_position, old[: queue.old.n_outputs])
        old[queue.old.n_outputs :] = 0.0
    passing = block[:, :n]
    passing -= old
    passing *= queue.fade[queue.faded : queue.faded + n]
    passing += old
    queue.faded += n
    if queue.faded == queue.fade.size:
        queue.old = None


def _fall(queue: PlayQueue, block: Floats) -> None:
    """Fill ``block`` with the fall from the last samples to silence."""
    block[:] = 0.0
    if queue.fallen is None or queue.fallen >= queue.fall.size:
        return
    n = min(queue.fall.size - queue.fallen, block.shape[1])
    np.multiply(
        queue.last[:, np.newaxis], queue.fall[queue.fallen : queue.fallen + n], out=block[:, :n]
    )
    queue.fallen += n


def _end_after_last_sample(queue: PlayQueue) -> None:
    if queue.faded < queue.fade.size or queue.swap is not None:
        return
    mix = queue.mix
    if mix is not None:
        lengths = mix.n_times, 0 if mix.trigger is None else mix.trigger.n_times
        if queue.position < max(*lengths, (mix.loop or _NO_LOOP)[1]):
            return
    if queue.rests is None:
        queue.ending = Ending(reason="stopped" if mix is None else "end")
        return
    queue.mix = None
    if queue.busy and queue.due is None:
        queue.busy = False
        queue.rests()


#: Duration of a block that a device requests.
BLOCK_S = 0.005
_GONE_AFTER_S = 2.0
_LONGEST_WAIT_S = 1.0

# The device calls a stream from its own thread, also where nothing else knows the stream any more.
_OPEN: set["Stream"] = set()


class Stream:
    """Plays a queue on a device until the queue ends or the stream is closed.

    Parameters
    ----------
    queue
        What to play.
    device
        Device that is opened, with as many outputs as the queue has.
    latency_s
        Requested delay.
    finished
        Called from another thread when playing has ended, for any reason.

    Attributes
    ----------
    underruns
        How often the device ran out of samples.
    closed
        Whether it was closed, so that ``finished`` need not be handled.
    answered
        Set once the device has asked for samples, and its clock goes.
    inside_s, block_s
        Time from the last block until it is heard, s, and when the device asked for it, in its
        clock.

    Raises
    ------
    PlaybackError
        sounddevice is missing, or the device refuses rate, outputs or delay.
    """

    def __init__(
        self, queue: PlayQueue, device: Device, latency_s: float, finished: Callable[[], None]
    ) -> None:
        self._library = sound_library()
        self.queue, self.device = queue, device
        self.underruns, self.closed = 0, False
        self._silent, self._finished, self.answered = Event(), finished, Event()
        self.inside_s = self.block_s = 0.0
        self._position, self._clock = HeardPosition(queue.sample_rate_hz), DeviceClock()
        self._called_s = perf_counter()
        self._inside_s = 0.0
        self._changed_s = 0.0
        try:
            self._stream = self._library.OutputStream(
                samplerate=queue.sample_rate_hz,
                blocksize=round(BLOCK_S * queue.sample_rate_hz),
                device=device.index,
                channels=queue.n_outputs,
                dtype="float32",
                latency=latency_s,
                # Samples arrive unchanged; full scale is checked before.
                dither_off=True,
                clip_off=True,
                callback=self._fill,
                finished_callback=self._finish,
            )
        except self._library.PortAudioError as error:
            raise self._refusal(error) from error
        _OPEN.add(self)

    def start(self) -> None:
        """Start playing.

        Raises
        ------
        PlaybackError
            The device does not start.
        """
        self._called_s = perf_counter()
        try:
            self._stream.start()
        except self._library.PortAudioError as error:
            self.close()
            raise self._refusal(error) from error

    def close(self) -> None:
        """Fall silent, and close the device."""
        self.closed = True
        if self._stream.active:
            # Closing the stream at once would make a click.
            self.queue.stop_at_once()
            self._silent.wait(_LONGEST_WAIT_S)
        # Closing a device that was unplugged fails, and that does not matter.
        self._stream.close(ignore_errors=True)
        _OPEN.discard(self)

    def ahead_s(self) -> float:
        """Return how far the clock of the device is ahead of `time.perf_counter`, s."""
        return self._clock.at(0.0)

    def time_s(self) -> float:
        """Return the time now, s, in the clock of the device."""
        return self._clock.at(perf_counter())

    @property
    def unresponsive(self) -> bool:
        """Whether the device has not requested a block for two seconds."""
        return perf_counter() - self._called_s > _GONE_AFTER_S

    def position_s(self) -> float | None:
        """Return the time in the design that is heard now; None where nothing is."""
        return None if self.closed else self._position.at(self._clock.at(perf_counter()))

    def delay(self, render_s: float) -> Delay:
        """Return the delay from the last edit to the outputs, after rendering for ``render_s``."""
        return Delay(render_s=render_s, wait_s=self.queue.waited_s, device_s=self._inside_s)

    def _refusal(self, error: Any) -> PlaybackError:
        device, rate_hz = self.device, self.queue.sample_rate_hz
        channels = counted(self.queue.n_outputs, "output")
        text = refusal_text(error, device.name, device.sample_rate_hz, rate_hz, channels)
        return PlaybackError(text)

    def _finish(self) -> None:
        self._silent.set()
        self._finished()

    def _fill(self, out: Frames, frames: int, times: Any, status: Any) -> None:
        self._called_s = perf_counter()
        steady = self._clock.note(times.currentTime, self._called_s)
        self.underruns += bool(status.output_underflow)
        queue = self.queue
        inside_s = times.outputBufferDacTime - times.currentTime
        if inside_s <= 0.0:
            # Some systems do not say when a block is heard.
            inside_s = self._stream.latency
        self.inside_s, self.block_s = inside_s, times.currentTime
        heard_s = times.currentTime + inside_s
        queue.begin_due(heard_s, frames)
        next_block(queue, out)
        self._position.note(heard_s, queue.began_at, queue.began_in)
        if queue.changed_s != self._changed_s:
            self._changed_s, self._inside_s = queue.changed_s, inside_s
        if steady:
            self.answered.set()
        if queue.silent:
            raise self._library.CallbackStop
