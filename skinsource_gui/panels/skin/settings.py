"""The settings of the skin map: its quantity, its colours, and the range of the colours."""

import math
from dataclasses import dataclass, replace

from skinsource.base.decibels import FLOOR_DB
from skinsource.design.design import Design
from skinsource.design.edits.edit import Edit
from skinsource.design.labels import AXES, label_of, level_label, signal_label, span_label
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.design.view import View
from skinsource.signals.map_range import MAP_HIGHEST_DB, SILENT_MAP_RANGE_DB
from skinsource.specs import fields
from skinsource.specs.numbers import NumberSpec, Range, RangeSpec
from skinsource.specs.spec import ChoiceSpec, SwitchSpec
from skinsource_gui.fields.units import minus
from skinsource_gui.plots.small_map import MAP_RANGE, LevelStyle

#: Levels; acceleration along z, with its sign; its magnitude; its RMS over a sliding window.
LEVELS, Z, MAGNITUDE, RMS = "levels", "z", "magnitude", "rms"
#: Level above the threshold of detection.
SENSATION = "sensation"
#: Quantities that are the same at any time.
STILL = (LEVELS, SENSATION)
_DB, _MPS2 = "dB re 1 m/s²", "m/s²"


@dataclass(frozen=True, slots=True, kw_only=True)
class MapQuantity:
    """What the numbers on a map are.

    Attributes
    ----------
    name
        `LEVELS`, `SENSATION`, `Z`, `MAGNITUDE` or `RMS`.
    span
        What levels are the RMS over.
    signal
        What the sliding RMS is that of, as in `skinsource.design.labels`.
    window_s
        Its length.
    time_s
        The instant that is shown, as the time axis of traces has it.
    matched
        By how much it is louder or softer than it was stored, or "".
    """

    name: str = LEVELS
    span: str = "record"
    signal: str = ""
    window_s: float = 0.0
    time_s: float = 0.0
    matched: str = ""

    @property
    def signed(self) -> bool:
        """Whether zero lies in the middle of the colours."""
        return self.name == Z

    @property
    def moves(self) -> bool:
        """Whether the map changes with the playhead."""
        return self.name not in STILL

    @property
    def titles(self) -> tuple[str, ...]:
        """Titles of the colour scale; the longest that fits is shown."""
        if not self.matched:
            return self._plain_titles
        return (*(f"{title}, {self.matched}" for title in self._plain_titles), self.matched)

    @property
    def _plain_titles(self) -> tuple[str, ...]:
        if self.name == LEVELS:
            return f"{_DB}, {level_label(self.span)}", f"{_DB}, {span_label(self.span)}", _DB
        if self.name == SENSATION:
            above = "above the threshold of detection"
            return f"dB {above}, loudest 100 ms", f"dB {above}", "dB above threshold", "dB"
        if self.name == Z:
            return f"{_MPS2}, acceleration along z", f"{_MPS2}, along z", _MPS2
        if self.name == MAGNITUDE:
            return f"{_DB}, magnitude of acceleration", f"{_DB}, magnitude", _DB
        length = f"RMS over {self.window_s * 1e3:g} ms"
        return f"{_DB}, {length}", _DB

    @property
    def heading(self) -> str:
        """Title of a picture of the map."""
        if self.name == LEVELS:
            return f"Skin acceleration, {level_label(self.span)}"
        if self.name == SENSATION:
            return "Level above the threshold of detection, loudest 100 ms"
        titles = {
            Z: "Skin acceleration along z",
            MAGNITUDE: "Magnitude of skin acceleration",
            RMS: f"Skin acceleration, RMS over {self.window_s * 1e3:g} ms",
        }
        return f"{titles[self.name]}, at {time_text(self.time_s)}"

    def details_on(self, axes: str) -> str:
        """Return how the axes of a limb are combined."""
        if self.name in (Z, SENSATION):
            return "z" if self.name == Z else f"{label_of(AXES, axes).title} together"
        return signal_label(axes, "mag") if self.name == MAGNITUDE else self.signal

    def text(self, value: float) -> str:
        """Return a value as text."""
        if self.name == SENSATION:
            return minus(f"{value:+z.1f} dB re the threshold of detection")
        if self.name == Z:
            return minus(f"{value:+.3g} m/s² along z")
        amount = 10.0 ** (value / 20.0)
        return minus(f"{value:z.1f} dB re 1 m/s²  ({amount:.3g} m/s²)")


def time_text(time_s: float) -> str:
    """Return an instant in ms, from a minute on in s."""
    if abs(time_s) < 60.0:
        return minus(f"{time_s * 1e3:.1f} ms")
    return f"{time_s:.3f} s"


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
class SkinSettings(LevelStyle):
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
    """Return whether levels are shown in these colours."""
    del design
    return settings_of(view, SKIN, SkinSettings).colours == name


def use_colours(name: str, design: Design, view: View) -> Edit:
    """Show levels in other colours."""
    settings = replace(settings_of(view, SKIN, SkinSettings), colours=name)
    return Edit(label="Change colours", design=design, view=with_settings(view, SKIN, settings))


LevelRange = tuple[float, float]

#: Limits of the range, and its smallest span, dB.
LOWEST_DB, HIGHEST_DB = FLOOR_DB, MAP_HIGHEST_DB
SMALLEST_SPAN_DB = 1.0
#: The automatic range in silence.
SILENT_RANGE: LevelRange = SILENT_MAP_RANGE_DB

_TICK_STEPS_DB = (0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0)


def with_low(range_db: LevelRange, low_db: float) -> LevelRange:
    """Return the range with its lower end dragged, as far as the upper one allows."""
    high = range_db[1]
    return min(max(low_db, LOWEST_DB), high - SMALLEST_SPAN_DB), high


def with_high(range_db: LevelRange, high_db: float) -> LevelRange:
    """Return the range with its upper end dragged, as far as the lower one allows."""
    low = range_db[0]
    return low, max(min(high_db, HIGHEST_DB), low + SMALLEST_SPAN_DB)


def pushed_low(range_db: LevelRange, low_db: float) -> LevelRange:
    """Return the range with another lower end; an upper end in its way goes along with it."""
    low, high = range_db
    if low_db > high - SMALLEST_SPAN_DB:
        high = min(low_db + (high - low), HIGHEST_DB)
    return low_db, high


def pushed_high(range_db: LevelRange, high_db: float) -> LevelRange:
    """Return the range with another upper end; a lower end in its way goes along with it."""
    low, high = range_db
    if high_db < low + SMALLEST_SPAN_DB:
        low = max(high_db - (high - low), LOWEST_DB)
    return low, high_db


def moved(range_db: LevelRange, by_db: float) -> LevelRange:
    """Return the range shifted, with its span unchanged."""
    low, high = range_db
    by = min(max(by_db, LOWEST_DB - low), HIGHEST_DB - high)
    return low + by, high + by


def tick_levels(low_db: float, high_db: float, room_px: float, spacing_px: float) -> list[float]:
    """Return round levels from ``low_db`` to ``high_db``, at least ``spacing_px`` apart."""
    span = high_db - low_db
    fitting = (step for step in _TICK_STEPS_DB if step * room_px >= spacing_px * span)
    step = next(fitting, _TICK_STEPS_DB[-1])
    first, last = math.ceil(low_db / step - 1e-9), math.floor(high_db / step + 1e-9)
    return [step * k for k in range(first, last + 1)]
