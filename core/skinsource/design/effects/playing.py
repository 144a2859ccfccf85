"""What a waveform plays through a chain of effects."""

from collections.abc import Callable
from math import ceil

import numpy as np

from skinsource.base.arrays import Floats
from skinsource.base.errors import InvalidInputError
from skinsource.design.effects.effect import Effect
from skinsource.design.waveform import Waveform
from skinsource.signals.sampling import NEAR, on_grid, parted

#: Samples of a waveform at a rate, with a shift.
Draw = Callable[[Waveform, float, float], Floats]


def drawn(waveform: Waveform, sample_rate_hz: float, shift_s: float) -> Floats:
    """What the waveform itself plays, (n_times,)."""
    return waveform.samples(sample_rate_hz, shift_s)


def played(
    waveform: Waveform,
    effects: tuple[Effect, ...],
    sample_rate_hz: float,
    shift_s: float = 0.0,
    *,
    draw: Draw = drawn,
) -> Floats:
    """What comes out of the last effect, (n_times,); those that are off are left out.

    Parameters
    ----------
    shift_s
        How long after the sample before it own time 0 lies; less than a sample.
    draw
        Where the samples of the waveform come from.
    """
    taking_part, durations_s = _stages(waveform, effects)
    shifts_s = _shifts_s(taking_part, durations_s, sample_rate_hz, shift_s)
    own_shift_s = shifts_s.pop()
    if taking_part:
        own_shift_s = on_grid(own_shift_s * sample_rate_hz)[1] / sample_rate_hz
    samples = draw(waveform, sample_rate_hz, own_shift_s)
    for effect, duration_s in zip(taking_part, durations_s, strict=True):
        samples = effect.applied(samples, sample_rate_hz, shifts_s.pop(), duration_s)
    return samples


def played_s(waveform: Waveform, effects: tuple[Effect, ...]) -> float:
    """How long it plays."""
    duration_s = waveform.duration_s
    for effect in effects:
        if effect.on:
            duration_s = effect.length(duration_s)
    return duration_s


def placed(
    waveform: Waveform, effects: tuple[Effect, ...], onset_s: float, sample_rate_hz: float
) -> tuple[int, float]:
    """Sample at or before an onset, and the shift of what is played from there on.

    What lies on the grid of positions is the start of the waveform, of which effects may let only
    a part play: the parts of one waveform are drawn from one array, however often it was cut.
    """
    taking_part, durations_s = _stages(waveform, effects)
    position = onset_s * sample_rate_hz
    if not taking_part:
        first, rest = on_grid(position)
        return first, rest / sample_rate_hz
    *_, own_s = _shifts_s(taking_part, durations_s, sample_rate_hz, 0.0)
    start = own_s * sample_rate_hz
    first, rest = on_grid(position + start)
    position = rest - start  # from the sample `first` on; more than one before it, less than one
    if abs(position - round(position)) < NEAR:
        return first + round(position), 0.0
    return (
        (first, position / sample_rate_hz)
        if position > 0
        else (
            first - 1,
            (position + 1.0) / sample_rate_hz,
        )
    )


def _stages(
    waveform: Waveform, effects: tuple[Effect, ...]
) -> tuple[tuple[Effect, ...], tuple[float, ...]]:
    """Effects that take part, and how long plays what each of them takes."""
    taking_part = tuple(effect for effect in effects if effect.on)
    durations_s = [waveform.duration_s]
    for effect in taking_part:
        durations_s.append(effect.length(durations_s[-1]))
    return taking_part, tuple(durations_s[:-1])


def _shifts_s(
    effects: tuple[Effect, ...], durations_s: tuple[float, ...], rate_hz: float, shift_s: float
) -> list[float]:
    """Shift of what comes out of the last effect, of what it takes, …; that of the waveform."""
    shifts_s = [shift_s]
    for effect, duration_s in zip(reversed(effects), reversed(durations_s), strict=True):
        shifts_s.append(effect.shift_before(shifts_s[-1], duration_s, rate_hz))
    return shifts_s


# Where samples of a clip lie, counted in samples.

#: What an effect may make of a clip; who wants more has made a mistake, or means harm.
LONGEST_S = 3600.0


def check_duration(duration_s: float) -> None:
    """Refuse what would play longer than an hour, before it is made.

    Raises
    ------
    InvalidInputError
        It would.
    """
    if not duration_s <= LONGEST_S:
        raise InvalidInputError(
            f"an effect would make a clip of {duration_s:g} s, expected at most {LONGEST_S:g} s; "
            "repeat it less often, or stretch it less"
        )


def own_times(n: int, sample_rate_hz: float, shift_s: float) -> Floats:
    """Own time of the first ``n`` samples, (n,), in s; before the start it is below 0."""
    return np.arange(n) / sample_rate_hz - shift_s


def part_of_sample(samples: float) -> float:
    """How far a place lies after the last sample, 0 to less than 1; 0 where it lies on one."""
    return parted(samples)[1]


def samples_until(samples: float) -> int:
    """How many samples, from number 0 on, lie before a place; one that lies on it does not."""
    return max(ceil(samples - NEAR), 0)


def silent_outside(
    samples: Floats, sample_rate_hz: float, shift_s: float, duration_s: float
) -> Floats:
    """The samples, with 0 before own time 0 and from ``duration_s`` on; the same array if so."""
    end = samples_until((duration_s + shift_s) * sample_rate_hz)
    start = samples_until(shift_s * sample_rate_hz)
    if not samples[:start].any() and not samples[end:].any():
        return samples
    silenced = samples.copy()
    silenced[:start] = 0.0
    silenced[end:] = 0.0
    return silenced
