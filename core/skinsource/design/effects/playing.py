"""Play a waveform through its effects, and place it on the samples of a track.

Own time of a waveform starts at 0 with its onset, which can lie between two samples.
"""

from __future__ import annotations

from collections.abc import Callable
from math import ceil

import numpy as np

from skinsource.base.arguments import checking
from skinsource.base.conventions import Floats
from skinsource.base.errors import InvalidInputError
from skinsource.design.effects.effect import Effect
from skinsource.design.waveform import Waveform
from skinsource.signals.sampling import NEAR, on_grid, sample_and_rest

#: Returns samples of a waveform at a rate, with a shift.
Draw = Callable[[Waveform, float, float], Floats]


def drawn(waveform: Waveform, sample_rate_hz: float, shift_s: float) -> Floats:
    """Return the samples of the waveform itself, (n_times,)."""
    return waveform.samples(sample_rate_hz, shift_s)


@checking
def played(
    waveform: Waveform,
    effects: tuple[Effect, ...],
    sample_rate_hz: float,
    shift_s: float = 0.0,
    *,
    draw: Draw = drawn,
) -> Floats:
    """Return the samples after the last effect, (n_times,); effects that are off are left out.

    Parameters
    ----------
    shift_s
        Time from the sample before own time 0 to own time 0; less than a sample.
    draw
        Returns the samples of the waveform.

    Examples
    --------
    >>> import skinsource as ss
    >>> reversed_tap = ss.effects.played(ss.waveforms.Tap(), (ss.effects.Reverse(),), 1300.0)
    >>> print(reversed_tap.size)
    22
    """
    active, durations_s = _stages(waveform, effects)
    shifts_s = _shifts_s(active, durations_s, sample_rate_hz, shift_s)
    own_shift_s = shifts_s.pop()
    if active:
        own_shift_s = on_grid(own_shift_s * sample_rate_hz)[1] / sample_rate_hz
    samples = draw(waveform, sample_rate_hz, own_shift_s)
    for effect, duration_s in zip(active, durations_s, strict=True):
        samples = effect.applied(samples, sample_rate_hz, shifts_s.pop(), duration_s)
    return samples


@checking
def played_s(waveform: Waveform, effects: tuple[Effect, ...]) -> float:
    """Return the duration after all effects.

    Examples
    --------
    >>> import skinsource as ss
    >>> repeated = (ss.effects.Repeat(times=3),)
    >>> print(f"{ss.effects.played_s(ss.waveforms.Tone(duration_s=0.1), repeated):.1f} s")
    0.3 s
    """
    duration_s = waveform.duration_s
    for effect in effects:
        if effect.on:
            duration_s = effect.length(duration_s)
    return duration_s


@checking
def placed(
    waveform: Waveform, effects: tuple[Effect, ...], onset_s: float, sample_rate_hz: float
) -> tuple[int, float]:
    """Return the sample at or before an onset, and the shift of the signal from there on.

    The start of the waveform, not of a part that a `Trim` leaves, lies on the grid of positions:
    so all parts of a cut waveform are drawn from one array.

    Examples
    --------
    >>> import skinsource as ss
    >>> start, shift_s = ss.effects.placed(ss.waveforms.Tap(), (), 0.1, 1300.0)
    >>> print(start, shift_s)
    130 0.0
    """
    active, durations_s = _stages(waveform, effects)
    position = onset_s * sample_rate_hz
    if not active:
        first, rest = on_grid(position)
        return first, rest / sample_rate_hz
    *_, own_s = _shifts_s(active, durations_s, sample_rate_hz, 0.0)
    start = own_s * sample_rate_hz
    first, rest = on_grid(position + start)
    position = rest - start  # from the sample `first` on; more than one before it, less than one
    if abs(position - round(position)) < NEAR:
        return first + round(position), 0.0
    if position > 0:
        return first, position / sample_rate_hz
    return first - 1, (position + 1.0) / sample_rate_hz


def _stages(
    waveform: Waveform, effects: tuple[Effect, ...]
) -> tuple[tuple[Effect, ...], tuple[float, ...]]:
    """Return the effects that are on, and the duration of the signal before each of them."""
    active = tuple(effect for effect in effects if effect.on)
    durations_s = [waveform.duration_s]
    for effect in active:
        durations_s.append(effect.length(durations_s[-1]))
    return active, tuple(durations_s[:-1])


def _shifts_s(
    effects: tuple[Effect, ...], durations_s: tuple[float, ...], rate_hz: float, shift_s: float
) -> list[float]:
    """Return the shifts after the last effect, before it, …, down to that of the waveform."""
    shifts_s = [shift_s]
    for effect, duration_s in zip(reversed(effects), reversed(durations_s), strict=True):
        shifts_s.append(effect.shift_before(shifts_s[-1], duration_s, rate_hz))
    return shifts_s


#: Longest clip that an effect can make; a longer one would be a mistake or an attack.
LONGEST_S = 3600.0


def check_duration(duration_s: float) -> None:
    """Check that a clip is not longer than an hour, before it is made.

    Raises
    ------
    InvalidInputError
        It is longer.
    """
    if not duration_s <= LONGEST_S:
        raise InvalidInputError(
            f"an effect would make a clip of {duration_s:g} s, expected at most {LONGEST_S:g} s; "
            "repeat it less often, or stretch it less"
        )


def own_times(n: int, sample_rate_hz: float, shift_s: float) -> Floats:
    """Return the own time of the first ``n`` samples, (n,), in s; below 0 before the start."""
    return np.arange(n) / sample_rate_hz - shift_s


def part_of_sample(samples: float) -> float:
    """Return how far a position lies after the sample before it, 0 to less than 1."""
    return sample_and_rest(samples)[1]


def samples_until(samples: float) -> int:
    """Count the samples, from number 0 on, that lie before a position."""
    return max(ceil(samples - NEAR), 0)


def silent_outside(
    samples: Floats, sample_rate_hz: float, shift_s: float, duration_s: float
) -> Floats:
    """Set samples before own time 0 and from ``duration_s`` on to 0, in a copy if needed."""
    end = samples_until((duration_s + shift_s) * sample_rate_hz)
    start = samples_until(shift_s * sample_rate_hz)
    if not samples[:start].any() and not samples[end:].any():
        return samples
    silenced = samples.copy()
    silenced[:start] = 0.0
    silenced[end:] = 0.0
    return silenced
