"""A burst of a wave that is made of its harmonics."""

from collections.abc import Callable
from typing import Protocol

from skinsource.arrays import Complexes, Floats
from skinsource.signals import WindowName
from skinsource.synthesis.burst import burst, refuse_aliases
from skinsource.synthesis.harmonics import sampled_series
from skinsource.waveforms.instants import count_of


class PeriodicBurst(Protocol):
    """The fields that such recipes have in common."""

    @property
    def frequency_hz(self) -> float:
        """How often it repeats in a second."""
        ...

    @property
    def duration_s(self) -> float:
        """Length of the burst."""
        ...

    @property
    def phase_rad(self) -> float:
        """Phase of the first harmonic at onset."""
        ...

    @property
    def window(self) -> WindowName:
        """How the burst fades."""
        ...


def harmonic_burst(
    recipe: PeriodicBurst,
    series: Callable[[Floats], Complexes],
    sample_rate_hz: float,
    shift_s: float,
    *,
    mean: float = 0.0,
) -> Floats:
    """Cut a burst out of a periodic wave, (n_times,).

    Parameters
    ----------
    recipe
        Says how often the wave repeats, where it begins, how long it lasts, and how it fades.
    series, mean
        Coefficients of its harmonics, and what it swings about: see
        `skinsource.synthesis.harmonics.sampled_series`.
    sample_rate_hz, shift_s
        As for each recipe's ``samples``.

    Raises
    ------
    InvalidInputError
        The frequency is not below half the sample rate.
    """
    refuse_aliases("frequency_hz", recipe.frequency_hz, sample_rate_hz)
    found = sampled_series(
        series,
        recipe.frequency_hz,
        recipe.phase_rad,
        count_of(recipe.duration_s, sample_rate_hz, shift_s),
        sample_rate_hz,
        shift_s,
        mean=mean,
    )
    return burst(found, recipe.window, sample_rate_hz, shift_s)
