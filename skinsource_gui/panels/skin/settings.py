"""The settings of the skin map: its quantity, its colours, and the range of the colours."""

from dataclasses import dataclass, replace

from skinsource.base.decibels import FLOOR_DB
from skinsource.design.design import Design, View
from skinsource.design.edits.edit import Edit
from skinsource.design.labels import AXES, label_of, level_label, signal_label, span_label
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.signals.map_range import MAP_HIGHEST_DB, SILENT_MAP_RANGE_DB
from skinsource.specs import fields
from skinsource.specs.numbers import Range, RangeSpec
from skinsource.specs.spec import ChoiceSpec, SwitchSpec
from skinsource_gui.fields.units import level_text, minus
from skinsource_gui.plots.small_map import MAP_RANGE, LevelStyle
from skinsource_gui.qt.resources import choice_of, number_named

#: Levels; acceleration along z, with its sign; its magnitude; its RMS over a sliding window.
LEVELS, Z, MAGNITUDE, RMS = "levels", "z", "magnitude", "rms"
#: Level above the detection threshold.
SENSATION = "sensation"
#: What to expect of people who were not measured: mean and range of their levels.
PEOPLE = "people"
#: Quantities that are the same at any time.
STILL = (LEVELS, PEOPLE, SENSATION)


@dataclass(frozen=True, slots=True, kw_only=True)
class MapQuantity:
    """What the numbers on a map are.

    Attributes
    ----------
    name
        `LEVELS`, `PEOPLE`, `SENSATION`, `Z`, `MAGNITUDE` or `RMS`.
    span
        What levels are the RMS over.
    signal
        Which axes they are of, and how these are combined.
    window_s
        Length of a sliding RMS.
    time_s
        The instant that is shown, as the time axis of traces has it.
    matched
        By how much it is louder or softer than it was stored, or "".
    record_s
        Length of the whole record, s; 0 where it is not known.
    half_db
        Half the width of the range between people, dB; 0: these values have none.
    """

    name: str = LEVELS
    span: str = "record"
    signal: str = ""
    window_s: float = 0.0
    time_s: float = 0.0
    matched: str = ""
    record_s: float = 0.0
    half_db: float = 0.0

    @property
    def signed(self) -> bool:
        """Whether zero lies in the middle of the colours."""
        return self.name == Z

    @property
    def moves(self) -> bool:
        """Whether the map changes with the playhead."""
        return self.name not in STILL

    @property
    def unit(self) -> str:
        """Unit of the values, and by how much they differ from what is stored."""
        units = {Z: "m/s²", SENSATION: "dB above threshold"}
        return ", ".join(filter(None, (units.get(self.name, "dB re 1 m/s²"), self.matched)))

    @property
    def words(self) -> tuple[str, str, str, str]:
        """The words of the measure line: what it is, of which axes, over what, in which unit."""
        if self.name in (LEVELS, PEOPLE):
            what = "RMS" if self.name == LEVELS else "Mean of people"
            return what, self.signal, f"{span_label(self.span)}{self._length}", self.unit
        if self.name == SENSATION:
            return "Sensation level", self.signal, "loudest 100 ms", self.unit
        over = f"RMS over {self.window_s * 1e3:g} ms" if self.name == RMS else ""
        return "Animation", self.signal, over, self.unit

    @property
    def _length(self) -> str:
        """Length of the record after its name: silence that follows lowers the RMS over it."""
        known = self.span == "record" and self.record_s
        return f", {round(self.record_s, 2):g} s" if known else ""

    @property
    def heading(self) -> str:
        """Title of a picture of the map."""
        if self.name == LEVELS:
            return f"Skin acceleration, {level_label(self.span)}{self._length}"
        if self.name == PEOPLE:
            return f"Mean of people, {level_label(self.span)}{self._length}"
        if self.name == SENSATION:
            return "Sensation level, loudest 100 ms"
        titles = {
            Z: "Skin acceleration along z",
            MAGNITUDE: "Magnitude of skin acceleration",
            RMS: f"Skin acceleration, RMS over {self.window_s * 1e3:g} ms",
        }
        return f"{titles[self.name]}, at {time_text(self.time_s)}"

    def text(self, value: float) -> str:
        """Return a value as text."""
        if self.name == LEVELS:
            return level_text(value, self.span)
        if self.name == PEOPLE:
            low, high = value - self.half_db, value + self.half_db
            return minus(f"{value:z.1f} dB re 1 m/s²  ({low:z.1f} to {high:z.1f} between people)")
        if self.name == SENSATION:
            return minus(f"{value:+z.1f} dB above the detection threshold")
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
QUANTITY = choice_of("quantity")
RMS_WINDOW = number_named("rms_window")
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
        As ``map_range_db``, of sensation levels.
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


def quantity_of(settings: SkinSettings, view: View, axes: str, matched: str = "") -> MapQuantity:
    """Return what is shown, on a limb that was measured along ``axes``."""
    name = settings.quantity
    signals = {
        Z: Z,
        SENSATION: f"{label_of(AXES, axes).title} together",
        MAGNITUDE: signal_label(axes, "mag"),
    }
    return MapQuantity(
        name=name,
        span=view.span,
        signal=signals.get(name, signal_label(view.axes, view.method)),
        window_s=settings.rms_window_s,
        time_s=0.0 if name in STILL else view.playhead_s,
        matched=matched,
    )


def in_motion(settings: SkinSettings, axes: str) -> SkinSettings:
    """Return settings that show the wave where they show its level, on a limb with these axes."""
    wave = Z if Z in axes else MAGNITUDE
    return replace(settings, quantity=wave) if settings.quantity in STILL else settings


def chosen_range(settings: SkinSettings) -> Range | None:
    """Return the chosen range of the colours; None: they follow what is shown."""
    if settings.quantity in (LEVELS, PEOPLE):
        return settings.map_range_db
    own = {SENSATION: settings.sensation_range_db, Z: settings.z_limits}
    return own.get(settings.quantity, settings.moving_range_db)


def with_range(settings: SkinSettings, chosen: Range | None) -> SkinSettings:
    """Return settings in which the colours have this range, or follow what is shown."""
    if settings.quantity in (LEVELS, PEOPLE):
        return replace(settings, map_range_db=chosen)
    if settings.quantity == SENSATION:
        return replace(settings, sensation_range_db=chosen)
    if settings.quantity == Z:
        return replace(settings, z_limits=chosen)
    return replace(settings, moving_range_db=chosen)


def has_colours(name: str, design: Design, view: View) -> bool:
    """Return whether levels are shown in these colours."""
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
