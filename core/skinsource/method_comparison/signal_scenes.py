"""Scenes beside convolution: an actuator under a step, and a signal at another sample rate."""

from dataclasses import dataclass

import numpy as np

from skinsource.actuators import VoiceCoil
from skinsource.arrays import Floats
from skinsource.errors import FileFormatError
from skinsource.files.assets import data_folder

FILE_NAME = "bench-actuators.npz"
#: Of actuators: steps of the held voltage, and their rate.
N_STEPS, STEP_RATE_HZ = 400, 1300.0
#: Of the resampled signal: tones under a bell of this width, in the middle of one second.
TONES_HZ, BELL_S, MIDDLE_S = (30.0, 95.0, 210.0, 380.0, 570.0), 0.06, 0.5


@dataclass(frozen=True, slots=True, kw_only=True)
class SignalScene:
    """What is to be computed: one signal from another.

    Attributes
    ----------
    key, title, family, in_quick
        As of `skinsource.method_comparison.scenes.ComparedScene`.
    reference
        Where the exact values come from.
    allowed_error
        Largest error over the peak that the program promises.
    actuator
        Of actuators: what a step of 1 V moves.
    rates_hz
        Of resamplers: from and to.
    most_processes
        In how many fresh processes it is measured at most: run times differ by far more here than
        from one process to the next.
    """

    key: str
    title: str
    family: str
    reference: str
    allowed_error: float
    in_quick: bool = False
    actuator: VoiceCoil | None = None
    rates_hz: tuple[int, int] = (1300, 1300)
    exact_only: bool = False
    allowed_s: float | None = None
    allowed_bytes: float | None = None
    most_processes: int = 1

    @property
    def n_inputs(self) -> int:
        """One signal goes in."""
        return 1

    @property
    def active_inputs(self) -> int:
        """It is computed anew each time."""
        return 1

    @property
    def response_samples(self) -> int:
        """Samples that come out, of each row."""
        return N_STEPS + 1 if self.actuator is not None else self.rates_hz[1]

    @property
    def sample_rate_hz(self) -> float:
        """Rate of what comes out."""
        return STEP_RATE_HZ if self.actuator is not None else float(self.rates_hz[1])

    def exact(self) -> Floats:
        """Exact values, (n_rows, n_times).

        Raises
        ------
        FileFormatError
            The stored ones are missing or damaged.
        """
        if self.actuator is None:
            return burst(self.rates_hz[1])[None]
        path = data_folder() / FILE_NAME
        try:
            with np.load(path, allow_pickle=False) as stored:
                return np.asarray(stored[self.key], np.float64)
        except (OSError, KeyError, ValueError, EOFError) as error:
            raise FileFormatError(
                f"{path}: the reference of {self.key} cannot be read. Install SkinSource studio "
                "again."
            ) from error


def burst(rate_hz: int) -> Floats:
    """The signal that is resampled, by its formula: one second, nothing above 600 Hz."""
    time_s = np.arange(rate_hz) / rate_hz - MIDDLE_S
    tones = sum(np.cos(2.0 * np.pi * tone * time_s + 0.7 * k) for k, tone in enumerate(TONES_HZ))
    found: Floats = np.exp(-0.5 * (time_s / BELL_S) ** 2) * tones
    return found


def _coil(key: str, title: str, coil: VoiceCoil, *, in_quick: bool = False) -> SignalScene:
    # 30 eps |A h| in the largest column, from states scaled by their energies.
    resistive = coil.resistance_ohm / coil.inductance_h
    coupled = coil.force_factor_n_per_a / np.sqrt(coil.inductance_h * coil.moving_mass_kg)
    bound = 30.0 * 2.0**-52 * (resistive + coupled) / STEP_RATE_HZ
    return SignalScene(
        key=key,
        title=title,
        family="actuator",
        reference="mpmath, 50 digits",
        allowed_error=max(1e-12, float(bound)),
        actuator=coil,
        in_quick=in_quick,
    )


def _resampled(key: str, from_hz: int, to_hz: int, *, in_quick: bool = False) -> SignalScene:
    return SignalScene(
        key=key,
        title=f"{from_hz} Hz to {to_hz} Hz, 1 s",
        family="resampling",
        reference="its formula",
        # -115 dB.
        allowed_error=10.0 ** (-115.0 / 20.0),
        rates_hz=(from_hz, to_hz),
        in_quick=in_quick,
    )


SIGNAL_SCENES = (
    _coil(
        "A1",
        "resonant actuator, 175 Hz, Q 15",
        VoiceCoil(8.0, 8e-4, 0.8, 1e-3, 0.0733, 1209.03),
        in_quick=True,
    ),
    _coil("A2", "the same, Q 10 000", VoiceCoil(8.0, 8e-4, 1e-3, 1e-3, 1.0996e-4, 1209.03)),
    _coil("A3", "coil of 1 µs on 5 Hz", VoiceCoil(8.0, 8e-6, 0.8, 1e-3, 0.0628, 0.98696)),
    _coil("A4", "three equal roots", VoiceCoil(8.0, 8.0 / 1000.0, 1e-9, 1e-3, 2.0, 1000.0)),
    _resampled("R1", 1300, 48_000, in_quick=True),
    _resampled("R2", 48_000, 1300),
    _resampled("R3", 44_100, 48_000),
)
