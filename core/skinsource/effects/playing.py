"""What a waveform plays through a chain of effects."""

from collections.abc import Callable
from typing import Any

from skinsource.arrays import Floats
from skinsource.effects.effect import Effect
from skinsource.waveforms.waveform import Waveform

#: Samples of a waveform at a rate, with a shift.
Draw = Callable[[Waveform, float, float], Floats]


def drawn(waveform: Waveform, sample_rate_hz: float, shift_s: float) -> Floats:
    """What the waveform itself plays, (n_times,)."""
    recipe: Any = waveform
    if shift_s == 0.0:
        return waveform.samples(sample_rate_hz)
    shifted: Floats = recipe.samples(sample_rate_hz, shift_s)
    return shifted


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
    taking_part = [one for one in effects if one.on]
    durations_s = [waveform.duration_s]
    for one in taking_part:
        durations_s.append(one.length(durations_s[-1]))
    shifts_s = [shift_s]
    for one, duration_s in zip(reversed(taking_part), reversed(durations_s[:-1]), strict=True):
        shifts_s.append(one.shift_before(shifts_s[-1], duration_s, sample_rate_hz))
    samples = draw(waveform, sample_rate_hz, shifts_s.pop())
    for one, duration_s in zip(taking_part, durations_s[:-1], strict=True):
        samples = one.applied(samples, sample_rate_hz, shifts_s.pop(), duration_s)
    return samples


def played_s(waveform: Waveform, effects: tuple[Effect, ...]) -> float:
    """How long it plays."""
    duration_s = waveform.duration_s
    for one in effects:
        if one.on:
            duration_s = one.length(duration_s)
    return duration_s
