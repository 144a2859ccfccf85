"""What the skin map shows, made of results, settings and view; nothing is drawn here."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from skinsource.base.conventions import Floats
from skinsource.base.decibels import FLOOR_DB, decibels
from skinsource.base.errors import sentence
from skinsource.design.comparing import match_text, published_range_db, range_sentences
from skinsource.design.design import Design, View, audible_indices
from skinsource.design.panel_settings import brush_of
from skinsource.design.target import target_in
from skinsource.engine.time_rules import Moving, SlidingEnergy
from skinsource.limbs.limb import Limb, LimbMap
from skinsource.limbs.own_limbs import facts_of, own_map
from skinsource.limbs.surface.operator import SurfaceOperator
from skinsource.perception.thresholds import LIMITS
from skinsource.signals.map_range import map_range_db
from skinsource_gui.panels.skin.settings import (
    LEVELS,
    MAGNITUDE,
    PEOPLE,
    RMS,
    SENSATION,
    SILENT_RANGE,
    STILL,
    LevelRange,
    MapQuantity,
    SkinSettings,
    Z,
    chosen_range,
    quantity_of,
)
from skinsource_gui.plots.colour_maps import DIVERGING, VIRIDIS
from skinsource_gui.plots.ranges import SteadyRange
from skinsource_gui.plots.small_map import FieldImage, field_image, px_per_mm_of
from skinsource_gui.qt.overlays import COVERED
from skinsource_gui.state.compared import SILENT, Compared, gain_db


@dataclass(frozen=True, slots=True, kw_only=True)
class InputMark:
    """One input on the map; ``colour`` is a number of the theme's palette."""

    id: int
    location: int
    colour: int
    audible: bool
    selected: bool


def marks_of(design: Design, view: View) -> tuple[InputMark, ...]:
    """Return the marks of all inputs of a design."""
    audible = set(audible_indices(design.inputs))
    return tuple(
        InputMark(
            id=track.id,
            location=track.location,
            colour=track.colour,
            audible=index in audible,
            selected=track.id in view.selected_inputs,
        )
        for index, track in enumerate(design.inputs)
    )


def painted_in(design: Design, view: View) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Return the strong and the quiet outputs of the target, while there is a brush."""
    found = target_in(design) if brush_of(view) else None
    return ((), ()) if found is None else (found[1].strong, found[1].quiet)


_OF_LEVELS = MapQuantity()
# Fields of these types are compared by value.
_COMPARED = (tuple, bool, str, float, MapQuantity)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MapContent:
    """What the skin map shows.

    Attributes
    ----------
    limb_map, limb
        Outline and places, ``None`` before there are any; and whose they are.
    values : (n_outputs,) or None
        Level of each output in dB, or what ``quantity`` says; ``None``: no colours.
    field, field_values
        Interpolated map and its values, (rows, columns); ``None``: sensors carry the colours.
    quantity
        What the values are.
    value_range, fixed
        Values of the lowest and the highest colour; whether they were chosen, and stay.
    exceeded
        Whether something goes beyond the highest, with its colour; signed values beyond both.
    colours
        Name of the colour map.
    outputs
        Selected outputs.
    strong, quiet
        Outputs of a target, while it is painted.
    px_per_mm
        Outline pixels in a millimetre of the limb; 0 before that is known.
    inputs
        Marks of the inputs.
    sensors_shown
        Whether sensors are marked on the interpolated map.
    noisy
        Outputs that are mostly noise; they are hatched.
    synthetic
        Whether the responses are computed, not measured.
    message
        Why there is no map; shown on it, instead of colours.
    note
        What one should know about the map.
    drawn_note
        What of it stands in a picture: the caption below says the rest.
    """

    limb_map: LimbMap | None = None
    limb: str = ""
    values: Floats | None = None
    field: FieldImage | None = None
    field_values: Floats | None = None
    quantity: MapQuantity = _OF_LEVELS
    value_range: LevelRange = SILENT_RANGE
    fixed: bool = False
    exceeded: bool = False
    colours: str = VIRIDIS
    outputs: tuple[int, ...] = ()
    strong: tuple[int, ...] = ()
    quiet: tuple[int, ...] = ()
    px_per_mm: float = 0.0
    inputs: tuple[InputMark, ...] = ()
    sensors_shown: bool = True
    noisy: tuple[int, ...] = ()
    synthetic: bool = False
    message: str = ""
    note: str = ""
    drawn_note: str = ""

    def same_as(self, other: "MapContent") -> bool:
        """Return whether ``other`` looks the same; arrays are compared by identity."""
        pairs = ((getattr(self, field.name), getattr(other, field.name)) for field in fields(self))
        return all(
            mine is theirs or (isinstance(mine, _COMPARED) and mine == theirs)
            for mine, theirs in pairs
        )

    @property
    def texts(self) -> tuple[object, ...]:
        """What the texts over the map say, and depend on besides its layout."""
        moving = self.quantity if self.quantity.moves and self.values is not None else None
        return self.limb_map is None, self.synthetic, self.fixed, self.message, moving

    @property
    def covered(self) -> "MapContent":
        """The content without anything that was computed, for an audience that guesses first."""
        quantity = replace(self.quantity, name=LEVELS)
        return replace(self, values=None, field_values=None, quantity=quantity, message=COVERED)

    @property
    def coloured_values(self) -> Floats | None:
        """Values to show, (n_outputs,); none while a message stands in their place."""
        return None if self.message else self.values

    @property
    def hatched(self) -> tuple[int, ...]:
        """Outputs that are drawn as mostly noise."""
        return () if self.message else self.noisy

    @property
    def shown_field(self) -> FieldImage | None:
        """The interpolated map, where it may be shown."""
        return None if self.message or self.field_values is None else self.field


#: By quantity: names of the results at the outputs and over the skin.
_NAMES = {
    LEVELS: ("output_levels_db", "surface_levels_db"),
    PEOPLE: ("mean_of_people_db", ""),
    SENSATION: ("sensation_db", "surface_sensation_db"),
    Z: ("moving_z", ""),
    MAGNITUDE: ("moving_vector", ""),
    RMS: ("moving_energy", ""),
}
# Along z colours reach their ends at this share of the largest acceleration, which under the
# actuator is far larger than elsewhere.
_SHARE_OF_LARGEST = 0.25


def signals_name(quantity: str) -> str:
    """Return the name of the result from which a quantity at the outputs is made."""
    return _NAMES[quantity][0]


def needs_of(settings: SkinSettings) -> frozenset[str]:
    """Return the results that `content_of` needs."""
    # A mean of people is made of levels on limbs.
    of_limb = LEVELS if settings.quantity == PEOPLE else settings.quantity
    at_outputs, over_skin = _NAMES[of_limb]
    needed = {"limb_map", "limb_data", "match_gain", "record_samples", at_outputs}
    if settings.quantity == SENSATION:
        needed.add("sensation")
    if settings.map_style == "interpolated":
        needed |= {"surface", over_skin} - {""}
    return frozenset(needed)


def of_people(levels_db: Sequence[Floats]) -> dict[str, Any]:
    """Return mean and half width of a range between people, as `content_of` takes them."""
    mean_db, half_db = published_range_db(np.stack(levels_db))
    return {_NAMES[PEOPLE][0]: mean_db, "half_db": half_db}


def content_of(
    results: Mapping[str, Any],
    settings: SkinSettings,
    view: View,
    design: Design,
    *,
    noisy: tuple[int, ...] = (),
    compared: Sequence[Compared] = (),
    problem: str = "",
    steady: SteadyRange | None = None,
) -> MapContent:
    """Return the content of the map.

    Parameters
    ----------
    results
        Quantities by name; what is missing is not shown.
    settings, view, design
        What is looked at, and at which instant; whose inputs are marked.
    noisy
        Outputs that are mostly noise.
    compared
        Snapshots: colours span the levels of all, so that one can be looked at after the other.
    problem
        Why there are no levels; "" where there are.
    steady
        Keeps the automatic range of a moving wave while its peak changes a little.
    """
    limb_map, limb, px_per_mm = _limb_of(results, design, problem)
    facts = facts_of(limb)
    matched = match_text(results.get("match_gain", 1.0))
    quantity = quantity_of(settings, view, facts.axes, matched)
    n_samples, limb_data = results.get("record_samples"), results.get("limb_data")
    if n_samples and limb_data is not None:
        quantity = replace(quantity, record_s=n_samples / limb_data.sample_rate_hz)
    of_range = ""
    if quantity.name == PEOPLE and "half_db" in results:
        quantity = replace(quantity, half_db=results["half_db"])
        of_range = f"{range_sentences(quantity.half_db)}."
    surface, field = results.get("surface"), None
    if settings.map_style == "sensors":
        surface = None
    elif surface is not None:
        field = field_image(surface, results["limb_data"])
    values, field_values, message = _values(results, settings, view, surface)
    if problem:
        values, field_values, message = None, None, problem
    limits = LIMITS if quantity.name == SENSATION else of_range
    drawn_note = " ".join(filter(None, (limits, *(() if surface is None else surface.warnings))))
    source = "" if problem else _source_note(limb_data)
    chosen, known = chosen_range(settings), results.get(_NAMES[settings.quantity][0])
    value_range = chosen or _automatic_range(results, settings, compared, steady or SteadyRange())
    if quantity.signed:
        exceeded = known is not None and known.largest > value_range[1]
    else:
        exceeded = chosen is not None and _loudest_db(results, settings) > value_range[1]
    shown_limbs = {limb, design.limb}
    strong, quiet = painted_in(design, view)
    return MapContent(
        limb_map=limb_map,
        limb=limb,
        px_per_mm=px_per_mm,
        values=values,
        field=field,
        field_values=field_values,
        quantity=quantity,
        value_range=value_range,
        fixed=chosen is not None,
        exceeded=exceeded,
        colours=DIVERGING if quantity.signed else settings.colours,
        outputs=view.outputs,
        strong=strong,
        quiet=quiet,
        inputs=marks_of(design, view),
        sensors_shown=settings.sensors_shown,
        noisy=noisy,
        synthetic=any(facts_of(name).synthetic for name in shown_limbs),
        message=message,
        note="" if problem else " ".join(filter(None, (drawn_note, source))),
        drawn_note="" if problem else drawn_note,
    )


def _limb_of(
    results: Mapping[str, Any], design: Design, problem: str
) -> tuple[LimbMap | None, str, float]:
    """Return outline and places, the name of the limb, and outline pixels in a millimetre.

    Places of an own limb are known where nothing can be computed; a missing limb has none.
    """
    limb_data: Limb | None = results.get("limb_data")
    name = "" if limb_data is None else limb_data.name
    if problem and design.limb != name:
        own, facts = own_map(design.limb), facts_of(design.limb)
        if own is not None:
            return own, design.limb, own.hand_length_px / facts.hand_length_mm
        if facts.missing:
            return None, design.limb, 0.0
    return results.get("limb_map"), name, 0.0 if limb_data is None else px_per_mm_of(limb_data)


def _values(
    results: Mapping[str, Any], settings: SkinSettings, view: View, surface: SurfaceOperator | None
) -> tuple[Floats | None, Floats | None, str]:
    """Return values at the outputs and over the skin, or why there are none."""
    at_outputs, over_skin = _NAMES[settings.quantity]
    known = results.get(at_outputs)
    if known is None:
        return None, None, ""
    if settings.quantity not in STILL:
        values = _at_playhead(known, settings, view)
        message = "" if known.largest > 0.0 else SILENT
        if values is None or surface is None:
            return values, None, message
        return values, surface.interpolate(values), message
    if not known.size:
        return None, None, results["sensation"].problem
    message = SILENT if float(np.max(known)) <= FLOOR_DB else ""
    if settings.quantity == PEOPLE:
        return known, None if surface is None else surface.interpolate(known), message
    return known, None if surface is None else results.get(over_skin), message


def _at_playhead(
    signals: Moving | SlidingEnergy, settings: SkinSettings, view: View
) -> Floats | None:
    """Return the values at the playhead; None where the signals there are not known yet."""
    at_s = response_time_s(view, signals.delay_s)
    at = at_s * signals.sample_rate_hz
    if not (at >= signals.response_samples or signals.first <= at <= max(signals.end, 1)):
        return None
    if isinstance(signals, SlidingEnergy):
        return decibels(signals.rms(at_s, settings.rms_window_s))
    if settings.quantity == Z:
        return signals.acceleration(at_s)[:, 0]
    return decibels(signals.magnitude(at_s))


def _source_note(limb_data: Limb | None) -> str:
    note = "" if limb_data is None else limb_data.note
    return sentence(f"{note[:1].upper()}{note[1:]}") if note else ""


def _automatic_range(
    results: Mapping[str, Any],
    settings: SkinSettings,
    compared: Sequence[Compared],
    steady: SteadyRange,
) -> LevelRange:
    """Return the range that follows the loudest output, of all that is ``compared``."""
    beside = [
        _loudest_db(snapshot.values, settings) + gain_db(snapshot)
        for snapshot in compared
        if snapshot.values is not None
    ]
    loudest_db = max([_loudest_db(results, settings), *beside])
    if loudest_db <= FLOOR_DB:
        return (-1.0, 1.0) if settings.quantity == Z else SILENT_RANGE
    if settings.quantity != Z:
        # By the design alone: the same design has the same colours, whatever was shown before.
        return map_range_db(loudest_db)
    largest = 10.0 ** (loudest_db / 20.0) * _SHARE_OF_LARGEST
    return steady.follow(-largest, largest, "amplitude")


def _loudest_db(results: Mapping[str, Any], settings: SkinSettings) -> float:
    known = results.get(_NAMES[settings.quantity][0])
    if known is None:
        return FLOOR_DB
    levels = known if settings.quantity in STILL else decibels(np.array([known.largest]))
    return float(np.max(levels, initial=FLOOR_DB))


def response_time_s(view: View, delay_s: float) -> float:
    """Return the playhead's time in the response, which contains the pre-trigger delay."""
    return view.playhead_s + (delay_s if view.delay_removed else 0.0)


def end_s(signals: Moving | SlidingEnergy | None, view: View) -> float:
    """Return the end of the response on the time axis of ``view``; 0 where nothing is known."""
    if signals is None:
        return 0.0
    last_s = (signals.response_samples - 1) / signals.sample_rate_hz
    return max(last_s - response_time_s(view, signals.delay_s) + view.playhead_s, 0.0)


def is_whole(signals: Moving | SlidingEnergy | None) -> bool:
    """Return whether the signals hold the whole response, not a part around the playhead."""
    return signals is None or (signals.first <= 0 and signals.end >= signals.response_samples)
