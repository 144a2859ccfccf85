"""How an actuator is measured."""

from dataclasses import dataclass

from skinsource import fields
from skinsource.errors import InvalidInputError
from skinsource.fields import SMALLEST, NumberSpec, TextSpec
from skinsource.playing import HIGHEST_DB, LOWEST_DB
from skinsource.playing.output import MOST_OUTPUTS

#: Longest delay from output to input that is looked for.
LONGEST_DELAY_S = 0.5

SENSITIVITY = NumberSpec(
    label="Sensitivity",
    unit="V per m/s²",
    minimum=SMALLEST,
    maximum=1e6,
    hint="Of the accelerometer with its amplifier; 100 mV per g is 0.0102 V per m/s²",
)
INPUT_VOLTS = NumberSpec(
    label="Input full scale",
    unit="V",
    minimum=SMALLEST,
    maximum=1e6,
    hint="Volts at the input of the sound card that it records as 1",
)
INPUT = NumberSpec(
    label="Input", minimum=1, maximum=MOST_OUTPUTS, whole=True, hint="Where the accelerometer is"
)
LOOPBACK = NumberSpec(
    label="Loop-back input",
    minimum=0,
    maximum=MOST_OUTPUTS,
    whole=True,
    hint="Wired to the output, it tells the delay; 0: none, the delay is told from the phase",
)
INPUT_DEVICE = TextSpec(
    label="Input device",
    longest=400,
    one_line=True,
    hint="Empty: the one that is played on. Another has a clock of its own, told from the sweeps",
)
LEVEL = NumberSpec(
    label="Level",
    unit="dB",
    minimum=LOWEST_DB,
    maximum=min(HIGHEST_DB, 0.0),
    hint="Of full scale; a sweep that is 20 dB weaker comes before",
)
SWEEP = NumberSpec(label="Sweep", unit="s", minimum=1.0, maximum=60.0, hint="How long each lasts")
REPEATS = NumberSpec(
    label="Repeats", minimum=2, maximum=50, whole=True, hint="Their spread is the error"
)
LOWEST = NumberSpec(label="From", unit="Hz", minimum=2.0, maximum=20_000.0)
HIGHEST = NumberSpec(label="To", unit="Hz", minimum=2.0, maximum=20_000.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class MeasuringSetup:
    """The sensor, where it is wired, and the sweep.

    Attributes
    ----------
    sensitivity_v_per_m_per_s2
        Volts at the input for 1 m/s².
    input_full_scale_v
        Voltage at the input where a recorded sample is 1.
    input_number, loopback_input
        Inputs of the accelerometer, and of a wire from the output that is measured, from 1;
        0: there is no such wire.
    input_device
        What is recorded from; empty: the device that is played on.  Another one, of whatever host,
        has a clock of its own, which the sweeps tell.
    level_db
        Amplitude of the sweep, dB of full scale.
    sweep_s, repeats
        How long a sweep lasts, and how often it is played.
    lowest_hz, highest_hz
        Where the response is wanted.
    """

    sensitivity_v_per_m_per_s2: float = fields.number(0.0102, SENSITIVITY)
    input_full_scale_v: float = fields.number(1.0, INPUT_VOLTS)
    input_number: int = fields.number(1, INPUT)
    loopback_input: int = fields.number(0, LOOPBACK)
    input_device: str = fields.text("", INPUT_DEVICE)
    level_db: float = fields.number(-30.0, LEVEL)
    sweep_s: float = fields.number(5.0, SWEEP)
    repeats: int = fields.number(4, REPEATS)
    lowest_hz: float = fields.number(20.0, LOWEST)
    highest_hz: float = fields.number(1000.0, HIGHEST)

    def __post_init__(self) -> None:
        fields.check(self)
        if not self.lowest_hz * 1.5 <= self.highest_hz:
            raise InvalidInputError(
                f"the response is wanted from {self.lowest_hz:g} to {self.highest_hz:g} Hz, "
                "expected at least half an octave"
            )
        if self.loopback_input == self.input_number:
            raise InvalidInputError(
                f"input {self.input_number} is that of the accelerometer, and the loop-back's; "
                "expected two inputs"
            )

    @property
    def band_hz(self) -> tuple[float, float]:
        """Where the response is wanted."""
        return self.lowest_hz, self.highest_hz

    @property
    def m_per_s2_at_full_scale(self) -> float:
        """What a recorded sample of 1 is."""
        return self.input_full_scale_v / self.sensitivity_v_per_m_per_s2
