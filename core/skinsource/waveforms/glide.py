"""A tone whose frequency and amplitude are drawn."""

from dataclasses import dataclass, replace
from decimal import Decimal, localcontext
from itertools import pairwise
from math import ceil, pi
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from skinsource import fields
from skinsource.errors import InvalidInputError
from skinsource.fields import NumberSpec, PointsSpec
from skinsource.synthesis.bent_turns import DIGITS, bent_turns
from skinsource.synthesis.burst import refuse_aliases
from skinsource.waveforms.instants import count_of
from skinsource.waveforms.shared_specs import LONGEST_S, take_lists
from skinsource.waveforms.tone import FREQUENCY

#: Time, frequency, amplitude.
Point = tuple[float, float, float]

POINTS = PointsSpec(
    label="Points",
    columns=(
        NumberSpec(label="Time", unit="s", minimum=0.0, maximum=LONGEST_S, step=0.01),
        replace(FREQUENCY, minimum=0.0),
        NumberSpec(label="Amplitude", minimum=0.0, maximum=1.0, step=0.05),
    ),
    most=2000,
    hint="Frequency and amplitude go straight from each point to the next",
)
_SHORTEST_S = 0.001


@dataclass(frozen=True, slots=True)
class Glide:
    """A sine whose frequency f(t) and amplitude a(t) go straight from point to point.

    a(t) sin(2 pi p(t)), with p(t) the integral of f from 0 to t: piecewise a parabola, whose
    turns are added up exactly, so that the phase is wrong by less than 1e-12 rad at any time.
    Two points at one time are a step of frequency or amplitude; the phase never jumps.

    Attributes
    ----------
    points
        ((time in s, frequency in Hz, amplitude from 0 to 1), …), 2 to 2000 of them, times never
        falling.  Before the first point its values hold; the last one, between 1 ms and 600 s,
        ends the tone.  Frequencies are 0 Hz up to below half the sample rate.
    """

    title: ClassVar[str] = "Glide"

    points: tuple[Point, ...] = fields.field(
        POINTS, ((0.0, 60.0, 0.0), (0.1, 60.0, 1.0), (0.4, 240.0, 1.0), (0.5, 240.0, 0.0))
    )

    def __post_init__(self) -> None:
        take_lists(self, "points")
        fields.check(self)
        if self.duration_s < _SHORTEST_S:
            raise InvalidInputError(
                f"Glide.points end at {self.duration_s:g} s, expected a last time of at least "
                f"{_SHORTEST_S:g} s"
            )

    @property
    def duration_s(self) -> float:
        """Time of the last point."""
        return self.points[-1][0]

    @classmethod
    def like(cls, waveform: Any) -> "Glide":
        """A glide with the frequency of a waveform that has one, or two, and with its length."""
        low_hz: Any = getattr(waveform, "start_hz", getattr(waveform, "frequency_hz", None))
        high_hz: Any = getattr(waveform, "end_hz", low_hz)
        if low_hz is None or waveform.duration_s < _SHORTEST_S:
            return cls()
        return cls(((0.0, low_hz, 1.0), (waveform.duration_s, high_hz, 1.0)))

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,), within the drawn amplitude of peak 1 or less."""
        refuse_aliases("frequency_hz", max(hz for _, hz, _ in self.points), sample_rate_hz)
        n = count_of(self.duration_s, sample_rate_hz, shift_s)
        found = np.zeros(n)
        rate, shift = Decimal(sample_rate_hz), Decimal(shift_s)
        turned = Decimal(0)
        first = 1 if shift_s else 0
        for before, after in pairwise(((0.0, *self.points[0][1:]), *self.points)):
            with localcontext(prec=DIGITS):
                (start, low, _), (end, high, _) = (map(Decimal, one) for one in (before, after))
                began, until = turned, min(ceil((end + shift) * rate), n)
                turned = (turned + (low + high) / 2 * (end - start)) % 1
                if until <= first:
                    continue
                course = low, (high - low) / (end - start), first / rate - shift - start
            found[first:until] = _stretch(
                began, course, (before, after), until - first, sample_rate_hz
            )
            first = until
        return found


def _stretch(
    turned: Decimal,
    course: tuple[Decimal, Decimal, Decimal],
    ends: tuple[Point, Point],
    n: int,
    rate_hz: float,
) -> NDArray[np.float64]:
    """Samples between two points, from the time ``course[2]`` after the first on, (n,)."""
    low, slope, since = course
    (start_s, _, low_level), (end_s, _, high_level) = ends
    part = (float(since) + np.arange(n) / rate_hz) / (end_s - start_s)
    level = low_level + (high_level - low_level) * np.clip(part, 0.0, 1.0)
    return level * np.sin(2.0 * pi * bent_turns(turned, low, slope, since, n, rate_hz))
