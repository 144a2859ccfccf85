"""Trains of wavelets of several frequencies, one after the other, and their frequencies."""

from dataclasses import dataclass
from decimal import Decimal, localcontext
from math import ceil, floor, pi
from typing import ClassVar, Literal

import numpy as np

from skinsource.base.arguments import integer, one_of, positive_number
from skinsource.base.conventions import Floats
from skinsource.base.errors import InvalidInputError, counted
from skinsource.design.waveform import CENTRE, CYCLES, check_waveform_duration, lists_to_tuples
from skinsource.design.waveforms.tones import count_of
from skinsource.signals.synthesis import DIGITS, bent_turns, check_below_half_rate
from skinsource.specs import fields
from skinsource.specs.numbers import ListSpec, NumberSpec
from skinsource.specs.spec import ChoiceSpec

Spacing = Literal["linear", "logarithmic"]
Order = Literal["up", "down"]

#: Most wavelets of a train.
MOST = 1000


def frequency_sweep(
    low_hz: float,
    high_hz: float,
    count: int,
    spacing: Spacing = "logarithmic",
    order: Order = "up",
) -> tuple[float, ...]:
    """Return frequencies from one to another, for `WaveletTrain`.

    >>> frequency_sweep(50.0, 400.0, 4)
    (50.0, 100.0, 200.0, 400.0)
    >>> frequency_sweep(100.0, 300.0, 3, "linear", "down")
    (300.0, 200.0, 100.0)

    Parameters
    ----------
    low_hz, high_hz
        The ends, both included; a single frequency is the lower end.
    count
        Number of frequencies, 1 to 1000.
    spacing
        ``"linear"``: equal steps; ``"logarithmic"``: equal factors.
    order
        ``"up"`` contracts on the skin, because high frequencies die out earlier; ``"down"``
        expands.

    Raises
    ------
    InvalidInputError
        An end is not positive, the ends are not in order, or count, spacing or order is not
        allowed.
    """
    low, high = positive_number("low_hz", low_hz), positive_number("high_hz", high_hz)
    if low > high:
        raise InvalidInputError(
            f"low_hz is {low:g}, expected at most high_hz, {high:g}; order 'down' turns them round"
        )
    count = integer("count", count, 1, MOST)
    one_of("spacing", spacing, ("linear", "logarithmic"))
    one_of("order", order, ("up", "down"))
    part = np.arange(count) / max(count - 1, 1)
    frequencies_hz = (
        low + (high - low) * part if spacing == "linear" else low * (high / low) ** part
    )
    # Twelve digits are readable; the ends stay exact.
    values = (
        low,
        *(float(f"{frequency_hz:.12g}") for frequency_hz in frequencies_hz[1:-1]),
        *(high,) * (count > 1),
    )
    return values[::-1] if order == "down" else values


Family = Literal["gabor", "ricker", "hann"]
Equalise = Literal["none", "energy"]

FREQUENCIES = ListSpec(
    label="Frequencies",
    of=CENTRE,
    fewest=1,
    most=MOST,
    hint="One wavelet each; low ones reach farther, so rising ones contract",
)
SLOT = NumberSpec(
    label="Interval",
    unit="s",
    minimum=0.001,
    maximum=60.0,
    step=0.005,
    hint="Time between wavelet centres; longer wavelets overlap",
)
FAMILY = ChoiceSpec(
    label="Shape",
    options=(("gabor", "Gabor"), ("ricker", "Ricker"), ("hann", "Hann burst")),
    hint="Shape of each wavelet",
)
EQUALISE = ChoiceSpec(
    label="Balance by",
    options=(("none", "None"), ("energy", "Energy")),
    hint="What all wavelets share before their gains; None: equal peaks",
)
#: Least gain of a wavelet.
SOFTEST_DB = -120.0
GAINS = ListSpec(
    label="Gains",
    of=NumberSpec(label="Gain", unit="dB", minimum=SOFTEST_DB, maximum=40.0, step=0.5),
    most=MOST,
    hint="One gain for each frequency, or none",
)


@dataclass(frozen=True, slots=True)
class WaveletTrain:
    """Wavelets of several frequencies, each in the middle of a slot of its own.

    x(t) is the sum over j of A_j w(t - c_j, f_j), with c_j = (j + 1/2) slot, j from 0, and w of
    one family:

    - ``"gabor"``: exp(-t² / 2 sigma²) cos(2 pi f t) for |t| <= 4 sigma, sigma = cycles / (2 pi f)
    - ``"ricker"``: (1 - 2 a) exp(-a), a = (pi f t)², for |t| <= 1.5 / f; cycles do not matter
    - ``"hann"``: (1 + cos(2 pi t / T)) / 2 sin(2 pi f t) for |t| <= T / 2, T = cycles / f

    Wavelets that are longer than their slot overlap their neighbours, and add to them.  If the
    first or the last one is longer, the train is longer by as much, and starts at 0 all the same:
    nothing is cut.  Middles need not lie on samples.  The peak of each w is 1 (of a Hann burst a
    little less); gains above 0 dB and overlaps go beyond.

    Attributes
    ----------
    frequencies_hz
        f_j, 1 to 1000 of them, each 0.1 Hz up to below half the sample rate; see
        `frequency_sweep`.  A list or an array is converted.
    cycles
        0.5 to 10 000.
    slot_s
        1 ms to 60 s.
    family
        ``"gabor"``, ``"ricker"`` or ``"hann"``.
    equalise
        ``"none"``: A_j is 1.  ``"energy"``: all wavelets have the same energy; of a shape it is
        proportional to 1 / f, so that A_j = sqrt(f_j / highest f).
    gains_db
        Additional gain of each wavelet, -120 to 40 dB; one for each frequency, or none.

    Notes
    -----
    The default frequencies, five from 50 to 400 Hz in equal factors, and 4 cycles in slots of
    120 ms are our choice, after trains whose frequencies steer how far a single actuator is felt.

    References
    ----------
    Dandu, Shao, Stanley and Visell, Spatiotemporal haptic effects from a single actuator via
    spectral control of cutaneous wave propagation, IEEE World Haptics Conference, 2019.

    Dandu, Shao and Visell, Rendering spatiotemporal haptic effects via the physics of waves in the
    skin, IEEE Transactions on Haptics, 2020.
    """

    title: ClassVar[str] = "Wavelet train"

    frequencies_hz: tuple[float, ...] = fields.field(FREQUENCIES, (50.0, 84.1, 141.4, 237.8, 400.0))
    cycles: float = fields.number(4.0, CYCLES)
    slot_s: float = fields.number(0.12, SLOT)
    family: Family = fields.choice("gabor", FAMILY)
    equalise: Equalise = fields.choice("none", EQUALISE)
    gains_db: tuple[float, ...] = fields.field(GAINS, ())

    def __post_init__(self) -> None:
        lists_to_tuples(self, "frequencies_hz", "gains_db")
        fields.check(self)
        if self.gains_db and len(self.gains_db) != len(self.frequencies_hz):
            raise InvalidInputError(
                f"The wavelet train has {counted(len(self.gains_db), 'gain')}, expected one for "
                f"each of its {len(self.frequencies_hz)} frequencies, or none"
            )
        check_waveform_duration(
            "WaveletTrain", self.duration_s, "Shorten the intervals or the wavelets."
        )

    @property
    def duration_s(self) -> float:
        """Length of all slots, and of the parts of the first and last wavelet beyond them."""
        early_s, late_s = self._beyond_s()
        return len(self.frequencies_hz) * self.slot_s + early_s + late_s

    def middles_s(self) -> tuple[float, ...]:
        """Return the time of the middle of each wavelet, from the start of the train."""
        early_s, _ = self._beyond_s()
        return tuple(early_s + (j + 0.5) * self.slot_s for j in range(len(self.frequencies_hz)))

    def gains(self) -> tuple[float, ...]:
        """Return A_j, the factor of each wavelet."""
        highest_hz = max(self.frequencies_hz)
        equal_factors = [
            (frequency_hz / highest_hz) ** 0.5 if self.equalise == "energy" else 1.0
            for frequency_hz in self.frequencies_hz
        ]
        own_db = self.gains_db or (0.0,) * len(equal_factors)
        return tuple(
            factor * 10.0 ** (db / 20.0) for factor, db in zip(equal_factors, own_db, strict=True)
        )

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> Floats:
        """Drive, (n_times,), of wavelets of peak 1."""
        check_below_half_rate("frequencies_hz", max(self.frequencies_hz), sample_rate_hz)
        n = count_of(self.duration_s, sample_rate_hz, shift_s)
        total = np.zeros(n)
        rate, shift = Decimal(sample_rate_hz), Decimal(shift_s)
        for frequency_hz, middle_s, gain in zip(
            self.frequencies_hz, self.middles_s(), self.gains(), strict=True
        ):
            # A hair more, so that rounding does not cut an end.
            reach = Decimal(self._reach_s(frequency_hz) * (1.0 + 1e-9))
            with localcontext(prec=DIGITS):
                middle = Decimal(middle_s) + shift
                first = max(ceil((middle - reach) * rate), 1 if shift_s else 0)
                after = min(floor((middle + reach) * rate) + 1, n)
                start = first / rate - middle
            if first < after:
                total[first:after] += gain * self._wavelet(
                    frequency_hz, start, after - first, sample_rate_hz
                )
        return total

    def _beyond_s(self) -> tuple[float, float]:
        """Return how far the train reaches before its first slot and after its last one."""
        count, slot_s = len(self.frequencies_hz), self.slot_s
        reach_s = [self._reach_s(frequency_hz) for frequency_hz in self.frequencies_hz]
        early_s = max(reach - (j + 0.5) * slot_s for j, reach in enumerate(reach_s))
        late_s = max(reach - (count - j - 0.5) * slot_s for j, reach in enumerate(reach_s))
        return max(early_s, 0.0), max(late_s, 0.0)

    def _reach_s(self, frequency_hz: float) -> float:
        """Return half the length of a wavelet."""
        periods = {
            "gabor": 4.0 * self.cycles / (2.0 * pi),
            "ricker": 1.5,
            "hann": self.cycles / 2.0,
        }
        return periods[self.family] / frequency_hz

    def _wavelet(self, frequency_hz: float, start: Decimal, n: int, rate_hz: float) -> Floats:
        """Return n samples of one wavelet from the time ``start`` after its middle on."""
        time_s = float(start) + np.arange(n) / rate_hz
        if self.family == "ricker":
            a = np.square(pi * frequency_hz * time_s)
            return (1.0 - 2.0 * a) * np.exp(-a)
        phase = bent_turns(Decimal(0), Decimal(frequency_hz), Decimal(0), start, n, rate_hz)
        phase *= 2.0 * pi
        if self.family == "hann":
            turn = time_s * (frequency_hz / self.cycles)
            return 0.5 * (1.0 + np.cos(2.0 * pi * turn)) * np.sin(phase)
        sigma_s = self.cycles / (2.0 * pi * frequency_hz)
        return np.exp(-0.5 * np.square(time_s / sigma_s)) * np.cos(phase)
