"""What only the spectra look at."""

from dataclasses import dataclass

from skinsource.signals.spectra import MEAN_OF_BINS
from skinsource.specs import fields
from skinsource.specs.fields import ChoiceSpec, Range, RangeSpec, SwitchSpec

LAYOUT = ChoiceSpec(
    label="Layout",
    options=(("overlaid", "Overlaid"), ("stacked", "Stacked"), ("axes", "Axes")),
    hint="All curves over each other, or each in its own row",
)
AXES_HINT = "Each output in its own row, with a curve for each axis of its sensor"
LOG_FREQUENCY = SwitchSpec(label="Log frequency", hint="Logarithmic frequency axis")
LOG_MAGNITUDE = SwitchSpec(label="dB", hint="Logarithmic magnitude")
RELATIVE = SwitchSpec(
    label="Each to its peak",
    hint="Draw each output relative to its largest magnitude in the measured band: shapes are seen "
    "where all others would be flat",
)
AVERAGED = SwitchSpec(
    label=f"Mean of {MEAN_OF_BINS} bins",
    hint=f"Draw the mean of {MEAN_OF_BINS} neighbouring frequencies: the course of noise is seen "
    "where single ones jump up and down",
)
FREQUENCY_RANGE = RangeSpec(label="Zoom", unit="Hz")


@dataclass(frozen=True, slots=True, kw_only=True)
class SpectraSettings:
    """How spectra are drawn.

    Attributes
    ----------
    layout
        ``"overlaid"``, ``"stacked"``, or ``"axes"``: along each axis of the sensors, whatever
        axes are chosen.
    log_frequency, log_magnitude
        Logarithmic axes.
    relative
        Whether each output is drawn relative to its own peak.
    averaged
        Whether each magnitude is the mean over some bins around it.
    frequency_range_hz
        Zoom; ``None``: everything.
    """

    layout: str = fields.choice("overlaid", LAYOUT)
    log_frequency: bool = fields.switch(False, LOG_FREQUENCY)
    log_magnitude: bool = fields.switch(True, LOG_MAGNITUDE)
    relative: bool = fields.switch(False, RELATIVE)
    averaged: bool = fields.switch(False, AVERAGED)
    frequency_range_hz: Range | None = fields.interval(None, FREQUENCY_RANGE)

    def __post_init__(self) -> None:
        fields.check(self)
