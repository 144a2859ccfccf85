"""What only the spectra look at."""

from dataclasses import dataclass

from skinsource import fields
from skinsource.fields import ChoiceSpec, Range, RangeSpec, SwitchSpec

LAYOUT = ChoiceSpec(
    label="Layout",
    options=(("overlaid", "Overlaid"), ("stacked", "Stacked")),
    hint="All curves over each other, or each in its own row",
)
LOG_FREQUENCY = SwitchSpec(label="Log frequency", hint="Logarithmic frequency axis")
LOG_MAGNITUDE = SwitchSpec(label="dB", hint="Logarithmic magnitude")
FREQUENCY_RANGE = RangeSpec(label="Zoom", unit="Hz")


@dataclass(frozen=True, slots=True, kw_only=True)
class SpectraSettings:
    """How spectra are drawn.

    Attributes
    ----------
    layout
        ``"overlaid"`` or ``"stacked"``.
    log_frequency, log_magnitude
        Logarithmic axes.
    frequency_range_hz
        Zoom; ``None``: everything.
    """

    layout: str = fields.choice("overlaid", LAYOUT)
    log_frequency: bool = fields.switch(False, LOG_FREQUENCY)
    log_magnitude: bool = fields.switch(True, LOG_MAGNITUDE)
    frequency_range_hz: Range | None = fields.interval(None, FREQUENCY_RANGE)

    def __post_init__(self) -> None:
        fields.check(self)
