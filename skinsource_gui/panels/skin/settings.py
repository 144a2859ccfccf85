"""What only the skin map looks at."""

from dataclasses import dataclass, replace

from skinsource.design.design import Design
from skinsource.design.edits import Edit
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.design.view import View
from skinsource.specs import fields
from skinsource.specs.fields import ChoiceSpec, NumberSpec, Range, RangeSpec, SwitchSpec
from skinsource_gui.panels.skin.map_quantity import LEVELS, MAGNITUDE, RMS, SENSATION, Z
from skinsource_gui.widgets.map.level_look import MAP_RANGE, LevelLook

#: Name of the panel, under which a view keeps its settings.
SKIN = "skin"
QUANTITY = ChoiceSpec(
    label="Shown",
    options=(
        (LEVELS, "RMS level"),
        (SENSATION, "Above threshold"),
        (Z, "In time: along z"),
        (MAGNITUDE, "In time: magnitude"),
        (RMS, "In time: sliding RMS"),
    ),
    hint="The level of the whole response; how far it is above the threshold of detection; or what "
    "the skin does where the playhead is: its acceleration along z with its sign, the length of "
    "the acceleration, or its RMS over a window",
)
RMS_WINDOW = NumberSpec(
    label="Window",
    unit="s",
    minimum=0.001,
    maximum=0.5,
    step=0.001,
    hint="What the sliding RMS is taken over; the playhead is in its middle",
)
Z_LIMITS = RangeSpec(label="Limits", unit="m/s²")
MAP_STYLE = ChoiceSpec(
    label="Style", options=(("interpolated", "Interpolated"), ("sensors", "Sensors only"))
)
SENSORS_SHOWN = SwitchSpec(label="Sensors", hint="Mark the outputs on the interpolated map")


@dataclass(frozen=True, slots=True, kw_only=True)
class SkinSettings(LevelLook):
    """What the map shows, and how.

    Attributes
    ----------
    map_style, sensors_shown
        ``"interpolated"`` or ``"sensors"``; whether sensors are marked on the interpolated map.
    sensation_range_db
        As ``map_range_db``, of levels above threshold.
    quantity
        What is shown: levels, or what the skin does at the playhead.
    rms_window_s
        What the sliding RMS is taken over.
    moving_range_db, z_limits
        The same of magnitude and sliding RMS, dB; and of acceleration along z, m/s².
    """

    map_style: str = fields.choice("interpolated", MAP_STYLE)
    sensors_shown: bool = fields.switch(True, SENSORS_SHOWN)
    sensation_range_db: Range | None = fields.interval(None, MAP_RANGE)
    quantity: str = fields.choice(LEVELS, QUANTITY)
    rms_window_s: float = fields.number(0.02, RMS_WINDOW)
    moving_range_db: Range | None = fields.interval(None, MAP_RANGE)
    z_limits: Range | None = fields.interval(None, Z_LIMITS)


def has_colours(name: str, design: Design, view: View) -> bool:
    """Whether levels are shown in these colours."""
    del design
    return settings_of(view, SKIN, SkinSettings).colours == name


def use_colours(name: str, design: Design, view: View) -> Edit:
    """Show levels in other colours."""
    settings = replace(settings_of(view, SKIN, SkinSettings), colours=name)
    return Edit(label="Change colours", design=design, view=with_settings(view, SKIN, settings))
