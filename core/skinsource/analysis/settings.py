"""What panels of analysis choose and their quantities depend on."""

from dataclasses import dataclass

from skinsource import fields
from skinsource.fields import ChoiceSpec, NumberSpec

WINDOW = ChoiceSpec(
    label="Window",
    options=(("25", "25 ms"), ("50", "50 ms"), ("100", "100 ms"), ("200", "200 ms")),
    hint="Short windows tell instants apart, long ones frequencies",
)
FLOOR = NumberSpec(label="Floor", unit="Hz", minimum=0.0, maximum=1e5, step=5.0)
CEILING = NumberSpec(label="Ceiling", unit="Hz", minimum=1.0, maximum=1e5, step=5.0)
OUTPUT = NumberSpec(label="Output", minimum=0, maximum=1e6, whole=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class SpectrogramSettings:
    """How a spectrogram is made and drawn.

    Attributes
    ----------
    window_ms
        Length of the window: ``"25"``, ``"50"``, ``"100"`` or ``"200"``.
    output
        Of which of the selected outputs; 0, or one that is not selected: of the last one.
    floor_hz, ceiling_hz
        What is drawn, up to half the rate of the limb; a ceiling that is not above the floor counts
        as that.
    """

    window_ms: str = fields.choice("50", WINDOW)
    output: int = fields.number(0, OUTPUT)
    floor_hz: float = fields.number(0.0, FLOOR)
    ceiling_hz: float = fields.number(CEILING.maximum, CEILING)

    def __post_init__(self) -> None:
        fields.check(self)

    @property
    def window_s(self) -> float:
        """Length of the window."""
        return float(self.window_ms) * 1e-3
