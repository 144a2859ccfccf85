"""A tone that rises or falls."""

from dataclasses import dataclass, replace
from math import pi
from typing import ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from skinsource import fields
from skinsource.fields import ChoiceSpec
from skinsource.limb import BAND_HZ
from skinsource.signals import WindowName
from skinsource.synthesis.burst import burst, refuse_aliases
from skinsource.synthesis.sweep import linear_sweep_turns, logarithmic_sweep_turns
from skinsource.waveforms.instants import count_of, turns
from skinsource.waveforms.shared_specs import DURATION, WINDOW
from skinsource.waveforms.tone import FREQUENCY, PHASE

Law = Literal["linear", "logarithmic"]

START = replace(FREQUENCY, label="From", hint="Frequency at onset")
END = replace(FREQUENCY, label="To", hint="Frequency at the end; a lower one falls")
LAW = ChoiceSpec(
    label="Law",
    options=(("linear", "Linear"), ("logarithmic", "Logarithmic")),
    hint="Linear: equal steps in Hz in equal times; logarithmic: equal factors",
)


@dataclass(frozen=True, slots=True)
class Chirp:
    """A sine whose frequency goes from f0 to f1 in the time T.

    sin(2 pi p(t) + phase), with p(t) = f0 t + (f1 - f0) t² / 2T (linear: the frequency is
    f0 + (f1 - f0) t / T), or p(t) = f0 T ((f1 / f0)^(t / T) - 1) / ln(f1 / f0) (logarithmic:
    it is f0 (f1 / f0)^(t / T)).  The phase is wrong by less than 1e-12 rad at any time.

    Attributes
    ----------
    start_hz, end_hz
        f0 and f1, 0.01 Hz up to below half the sample rate; the end may be the lower one.
    duration_s
        T, 0.001 to 600 s.
    law
        ``"linear"`` or ``"logarithmic"``.
    phase_rad
        Phase at onset.
    window
        ``"none"``, ``"tukey"`` or ``"hanning"``.  None to begin with: it would take away the
        first and the last frequencies.
    """

    title: ClassVar[str] = "Chirp"

    # Part of the recipe, whatever the limb: so a file means that says no others.
    start_hz: float = fields.number(BAND_HZ[0], START)
    end_hz: float = fields.number(BAND_HZ[1], END)
    duration_s: float = fields.number(1.0, DURATION)
    law: Law = fields.choice("linear", LAW)
    phase_rad: float = fields.number(0.0, PHASE)
    window: WindowName = fields.choice("none", WINDOW)

    def __post_init__(self) -> None:
        fields.check(self)

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> NDArray[np.float64]:
        """Drive, (n_times,), of peak 1."""
        refuse_aliases("start_hz", self.start_hz, sample_rate_hz)
        refuse_aliases("end_hz", self.end_hz, sample_rate_hz)
        n = count_of(self.duration_s, sample_rate_hz, shift_s)
        if self.start_hz == self.end_hz:
            found = turns(self.start_hz, n, sample_rate_hz, shift_s)
        else:
            swept = linear_sweep_turns if self.law == "linear" else logarithmic_sweep_turns
            ends_hz = self.start_hz, self.end_hz
            found = swept(ends_hz, self.duration_s, n, sample_rate_hz, shift_s)
        found *= 2.0 * pi
        found += self.phase_rad
        return burst(np.sin(found, out=found), self.window, sample_rate_hz, shift_s)
