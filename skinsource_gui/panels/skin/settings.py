"""What only the skin map looks at."""

from dataclasses import dataclass

from skinsource import fields
from skinsource.fields import ChoiceSpec, Range, RangeSpec, SwitchSpec

MAP_STYLE = ChoiceSpec(
    label="Style", options=(("interpolated", "Interpolated"), ("sensors", "Sensors only"))
)
SENSORS_SHOWN = SwitchSpec(label="Sensors", hint="Mark the outputs on the interpolated map")
MAP_RANGE = RangeSpec(label="Range", unit="dB")


@dataclass(frozen=True, slots=True, kw_only=True)
class SkinSettings:
    """How the map is drawn.

    Attributes
    ----------
    map_style, sensors_shown
        ``"interpolated"`` or ``"sensors"``; whether sensors are marked on the interpolated map.
    map_range_db
        Levels of the ends of the colour bar; ``None``: they follow the loudest output
        (`automatic_range`).
    """

    map_style: str = fields.choice("interpolated", MAP_STYLE)
    sensors_shown: bool = fields.switch(True, SENSORS_SHOWN)
    map_range_db: Range | None = fields.interval(None, MAP_RANGE)

    def __post_init__(self) -> None:
        fields.check(self)
