"""What the maps of the Compare panel show: of snapshots, of limbs or of axes."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import isinf
from typing import Any, ClassVar

import numpy as np
from PySide6.QtCore import QPointF

from skinsource.base.conventions import Axes, Floats
from skinsource.base.decibels import FLOOR_DB, decibels
from skinsource.design.comparing import (
    MOST_SIDE_BY_SIDE,
    NO_RANGE,
    difference_db,
    frequency_of,
    mean_and_spread_over,
    own_parts,
    published_range_db,
    range_sentences,
    same_outputs,
    scale_end_db,
    snapshot_name,
    why_no_comparison,
    with_edited,
)
from skinsource.design.design import EDITED, Design, Snapshot, View, shown_snapshot
from skinsource.design.labels import (
    AXES,
    label_of,
    limb_label,
    short_limb_title,
    signal_label,
    span_label,
)
from skinsource.engine.loops import moving_name
from skinsource.engine.time_rules import Moving
from skinsource.limbs.limb import PUBLISHED
from skinsource.limbs.own_limbs import axes_on
from skinsource.signals.analysis.noise import LEAST_ABOVE_NOISE_DB
from skinsource.signals.loudest_window import Span
from skinsource_gui.fields.units import output_text
from skinsource_gui.panels.compare.card import told_limbs, told_titles
from skinsource_gui.panels.compare.settings import MOTION, RANGE, SHOWN, CompareSettings
from skinsource_gui.plots.colour_maps import DIVERGING
from skinsource_gui.plots.outputs import is_placed
from skinsource_gui.plots.small_map import (
    SILENT,
    USUAL_STYLE,
    ColourScale,
    LevelStyle,
    Range,
    SmallMap,
    level_style,
    scale_of_levels,
    scale_of_own,
    small_map_of,
    with_matched,
)
from skinsource_gui.qt.questions import copied_level
from skinsource_gui.state.compared import (
    ELSEWHERE,
    LEVELS_MATCHED,
    SILENCE,
    Compared,
    display_gain_text,
    gain_db,
    is_silent,
    matched_text,
)
from skinsource_gui.state.compared import SILENT as COMPARED_SILENT
from skinsource_gui.state.engine import Beside


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Cell:
    """One of the maps.

    Attributes
    ----------
    headings
        What the map shows, from the longest to the shortest text.
    limb
        Limb of the outputs and the outline.
    small
        The map, its levels in dB; None: there is none.
    scale
        Colours of the map; None where there is no map.
    maximum_db
        The level that values are relative to, dB re 1 m/s²; None: they are not.
    design
        Design whose inputs are marked; None: none are.
    text
        Why there is no map.
    stale
        Whether the map belongs to the design before.
    synthetic
        Whether responses are computed, not measured.
    reaches
        The texts on the largest value of a motion, the longest first; empty: it follows from the
        values.
    """

    headings: tuple[str, ...]
    limb: str
    small: SmallMap | None = None
    scale: ColourScale | None = None
    maximum_db: float | None = None
    design: Design | None = None
    text: str = ""
    stale: bool = False
    synthetic: bool = False
    reaches: tuple[str, ...] = ()

    @property
    def heading(self) -> str:
        """The longest heading."""
        return self.headings[0]

    def in_range(self, held: Range | None) -> "Cell":
        """Return the map with other ends of its scale; None: with its own."""
        if held is None or self.scale is None:
            return self
        return replace(self, scale=replace(self.scale, range_db=held))

    @property
    def values_db(self) -> Floats | None:
        """The value of each output, (n_outputs,); None where there are none."""
        return None if self.small is None else self.small.levels_db

    def value_text(self, output: int | None) -> str:
        """Return the text of the value of an output; None: of the largest one, and where it is."""
        return self.value_texts(output)[0 if output is None else -2]

    def value_texts(self, output: int | None) -> tuple[str, ...]:
        """Return the texts of that value, from the longest to the shortest."""
        values = self.values_db
        if values is None or self.scale is None:
            return ("",)
        if output is None and self.reaches:
            return self.reaches
        if output is not None and output > values.size:
            return ("no such output", "none")
        if output is not None:
            value = self.scale.text(float(values[output - 1]))
            return f"Output {output}: {value}", value, value.removesuffix(" dB")
        largest = int(np.argmax(np.abs(values) if self.scale.signed else values))
        value = self.scale.text(float(values[largest]))
        if value == SILENT:
            return (SILENT,)
        if self.maximum_db is not None:
            # Relative to itself each maximum is 0 dB, so its level is shown.
            value = f"max {self.scale.text(self.maximum_db)}"
            whole = f"{value} re 1 m/s² at {largest + 1}"
            return whole, f"{value} at {largest + 1}", value, value.removesuffix(" dB")
        return f"{value} at {largest + 1}", value, value.removesuffix(" dB")


@dataclass(frozen=True, kw_only=True, eq=False)
class CompareContent:
    """All maps, or a message in their place.

    Attributes
    ----------
    outputs
        The selected outputs.
    message
        Text in place of the maps; empty: the maps are shown.
    about
        What is shown, as a text below while no output is pointed at.
    hands
        Whether maps show hands without arms, whatever room there is.
    marks_first
        Whether the first selected output alone is marked, in no colour of a curve.
    """

    cells: tuple[Cell, ...] = ()
    outputs: tuple[int, ...] = ()
    message: str = ""
    about: str = ""
    hands: bool = False
    marks_first: bool = False

    @cached_property
    def common_scale(self) -> ColourScale | None:
        """The scale that all maps share; None where they differ."""
        scales = {cell.scale for cell in self.cells if cell.scale is not None}
        return scales.pop() if len(scales) == 1 else None

    @property
    def head_lines(self) -> float:
        """Height of the line above the maps, which says that they are of synthetic limbs."""
        return 1.2 if any(cell.synthetic for cell in self.cells) else 0.0

    @property
    def stale(self) -> bool:
        """Whether any of the maps belongs to the design before."""
        return any(cell.stale for cell in self.cells)

    def is_on_hands(self) -> bool:
        """Return whether all selected outputs are seen on hands without arms."""
        smalls = filter(None, (cell.small for cell in self.cells))
        return all(all(_in_sight(small, self.outputs, hand_only=True)) for small in smalls)

    def is_hatched(self, *, hand_only: bool) -> bool:
        """Return whether an output that is mostly noise is seen in a map of levels."""
        smalls = filter(None, (cell.small for cell in self.cells))
        return any(any(_in_sight(small, small.noisy, hand_only=hand_only)) for small in smalls)

    def readout(self, output: int | None) -> str:
        """Return the values of an output in all maps; None: what the maps show."""
        drawn = [cell for cell in self.cells if cell.small is not None]
        if output is None or not drawn:
            return self.about
        values = " · ".join(cell.value_text(output) for cell in drawn)
        if any(cell.maximum_db is not None for cell in drawn):
            values = f"{values} re each map's maximum"
        return f"{output_text(output, drawn[0].limb)}: {values}"


def _in_sight(small: SmallMap, numbers: tuple[int, ...], *, hand_only: bool) -> list[bool]:
    bounds = replace(small, hand_only=hand_only).bounds
    places = small.limb_map.output_positions
    placed = [number for number in numbers if is_placed(places, number)]
    return [bounds.contains(QPointF(*places[number - 1])) for number in placed]


# Levels that differ by less are shown as the same.
_LEAST_DB = 0.05

#: Names of one thing, from the longest to the shortest.
Names = tuple[str, ...]


def of_levels(
    compared: Sequence[Compared],
    names: Sequence[Names],
    style: LevelStyle = USUAL_STYLE,
    *,
    own: bool = False,
) -> tuple[Cell, ...]:
    """Return a map of the levels of each, in the same colours over the same range.

    ``own``: relative to its own loudest output.
    """
    known = [_levels_db(side) for side in compared if side.values is not None]
    loudest = np.array([levels.max() for levels in known])
    scale = scale_of_own(style) if own else scale_of_levels(loudest, style)
    pairs = zip(compared, names, strict=True)
    return tuple(_levels(side, name, scale, own=own) for side, name in pairs)


def of_differences(
    compared: Sequence[Compared], names: Sequence[Names], reference: int, span: Span
) -> tuple[Cell, ...]:
    """Return a map of how much louder each of the others is than the one at ``reference``.

    Over records of two lengths both levels are taken over the longer one: what is only muted in one
    of them makes all else no louder.
    """
    base, of_base = compared[reference], names[reference]
    cells = [
        _difference(side, of_one, base, of_base, span)
        for k, (side, of_one) in enumerate(zip(compared, names, strict=True))
        if k != reference
    ]
    drawn = [cell.values_db for cell in cells if cell.values_db is not None]
    end, reached = scale_end_db(*drawn), _reached_db(drawn)
    scale = ColourScale(
        range_db=(-end, end), text_below="dB", colours=DIVERGING, signed=True, reached_db=reached
    )
    return tuple(cell if cell.small is None else replace(cell, scale=scale) for cell in cells)


def of_spread(
    compared: Sequence[Compared],
    names: Sequence[Names],
    reference: int,
    span: Span,
    style: LevelStyle = USUAL_STYLE,
    *,
    people: bool = False,
) -> tuple[Cell, ...]:
    """Return mean and standard deviation over all that have the outputs of ``reference``.

    Lengths of records count as in `of_differences`.  ``people``: the range between them instead,
    as of `skinsource.people.levels`.
    """
    base = compared[reference]
    limb = _limb(base)
    pairs = zip(compared, names, strict=True)
    comparable = [(side, name) for side, name in pairs if same_outputs(limb, _limb(side))]
    # Silence is no level that others could lie about.
    audible = [(side, name) for side, name in comparable if side.values and not is_silent(side)]
    known = [side for side, _ in audible]
    # A mean of those that happen to be known already would change by itself.
    computing = any(side.values is None and not side.problem for side, _ in comparable)
    if base.values is None or computing or len(known) < 2:
        too_few = "A mean needs two or more that are not silent and share their output places."
        problem = base.problem or next(
            (side.problem for side, _ in comparable if side.problem), too_few
        )
        return (Cell(headings=("",), limb=limb, text="" if computing else problem),)
    called = [name for _, name in audible]
    what = _of_all(called, len(compared))
    noisy = noisy_outputs(*known)
    plain = Cell(
        headings=("Mean",),
        limb=limb,
        stale=any(side.is_stale for side in known),
        synthetic=any(_synthetic(side) for side in known),
    )
    levels_db = np.stack(_levels_over(span, *known))
    if people:
        return _range(base, plain, levels_db, noisy, what[-1], style)
    mean, spread = mean_and_spread_over(levels_db)
    spread_scale = ColourScale(
        range_db=(0.0, scale_end_db(spread)),
        text_below="dB",
        colours=style.colours,
        reached_db=_reached_db([spread]),
    )
    mean_scale = scale_of_levels(mean, style)
    of_mean = (*(f"Mean {phrase}" for phrase in what), "Mean")
    words = "Standard deviation", "Spread"
    of_both = (*(f"{word} {phrase}" for word in words for phrase in what), "Spread")
    return (
        replace(plain, headings=of_mean, small=_map(base, mean, noisy), scale=mean_scale),
        replace(plain, headings=of_both, small=_map(base, spread, noisy), scale=spread_scale),
    )


def about_range(cells: Sequence[Cell]) -> str:
    """Return what a range between people is, and its half width where it is drawn."""
    values = [cell.values_db for cell in cells if cell.values_db is not None]
    return range_sentences(float(values[1][0] - values[0][0]) if values else None)


def _range(
    base: Compared,
    plain: Cell,
    levels_db: Floats,
    noisy: tuple[int, ...],
    of_whom: str,
    style: LevelStyle,
) -> tuple[Cell, ...]:
    """Return the low end, the mean and the high end of the range between people."""
    if plain.limb not in PUBLISHED:
        return (replace(plain, text=NO_RANGE),)
    mean, half_db = published_range_db(levels_db)
    ends = {"Low": mean - half_db, "Mean": mean, "High": mean + half_db}
    expected = {end: (f"{end}, expected", end) for end in ends}
    expected["Mean"] = f"Mean {of_whom}", "Mean"
    scale = scale_of_levels(ends["High"], style)
    return tuple(
        replace(plain, headings=expected[end], small=_map(base, values, noisy), scale=scale)
        for end, values in ends.items()
    )


def _difference(side: Compared, names: Names, base: Compared, of_base: Names, span: Span) -> Cell:
    headings = _minus(names, of_base)
    cell = Cell(headings=headings, limb=_limb(side), stale=side.is_stale or base.is_stale)
    if problem := side.problem or base.problem:
        return replace(cell, text=problem)
    if not same_outputs(_limb(side), _limb(base)):
        return replace(cell, text=ELSEWHERE)
    if side.values is None or base.values is None:
        return cell
    if is_silent(side) or is_silent(base):
        return replace(cell, text=SILENCE)
    levels = difference_db(*_levels_over(span, side, base))
    both = _synthetic(side) or _synthetic(base)
    small = _map(side, levels, noisy_outputs(side, base))
    if np.abs(levels).max() < _LEAST_DB:
        headings = (f"{names[-1]} equals {of_base[-1]}",)
    return replace(cell, headings=headings, small=small, synthetic=both)


def _levels(side: Compared, names: Names, scale: ColourScale, *, own: bool = False) -> Cell:
    cell = Cell(headings=names, limb=_limb(side), text=side.problem, stale=side.is_stale)
    if side.values is None:
        return cell
    small, maximum_db = _map(side, None, noisy_outputs(side)), None
    if own and not is_silent(side):
        maximum_db = float(_levels_db(side).max())
        small = _relative(small, maximum_db)
    return replace(
        cell,
        small=small,
        scale=scale,
        maximum_db=maximum_db,
        design=side.snapshot.design,
        synthetic=_synthetic(side),
    )


def _map(side: Compared, levels_db: Floats | None, noisy: tuple[int, ...]) -> SmallMap:
    """Return a map on the limb of ``side``: of its levels as they are shown, or of others."""
    values: dict[str, Any] = dict(side.values or {})
    if levels_db is not None:
        values["output_levels_db"] = levels_db
        values["surface_levels_db"] = values["surface"].interpolate(levels_db)
    elif side.gain != 1.0:
        values["output_levels_db"] = _levels_db(side)
        values["surface_levels_db"] = values["surface_levels_db"] + gain_db(side)
    return replace(small_map_of(values), noisy=noisy)


def _relative(small: SmallMap, maximum_db: float) -> SmallMap:
    """Return the same map with its levels re ``maximum_db``; silent outputs stay silent."""
    levels, field = small.levels_db, small.field_levels_db
    if levels is not None:
        levels = np.where(levels > FLOOR_DB, levels - maximum_db, levels)
    if field is not None:
        field = field - maximum_db
    return replace(small, levels_db=levels, field_levels_db=field)


def _of_all(called: Sequence[Names], n_compared: int) -> Names:
    """Return the phrases for how many designs count, and which."""
    number = f"of {len(called)}"
    if len(called) < n_compared:
        number += f" of {n_compared}"
    listed = ", ".join(names[min(1, len(names) - 1)] for names in called)
    return f"{number}: {listed}", number


def _minus(names: Names, other: Names) -> Names:
    """Return the names of a difference, from the longest to the shortest."""
    n = max(len(names), len(other))
    pairs = [(names[min(k, len(names) - 1)], other[min(k, len(other) - 1)]) for k in range(n)]
    return tuple(f"{first} minus {second}" for first, second in pairs)


def _reached_db(drawn: Sequence[Floats]) -> Range | None:
    """Return the smallest and the largest of all values; None where there is none."""
    values = np.concatenate([np.empty(0), *drawn])
    return (float(values.min()), float(values.max())) if values.size else None


def _levels_db(side: Compared) -> Floats:
    """Return the levels as they are shown: matched to the others, if that is chosen."""
    levels: Floats = (side.values or {})["output_levels_db"]
    return levels if side.gain == 1.0 else levels + gain_db(side)


def noisy_outputs(*compared: Compared) -> tuple[int, ...]:
    """Return the numbers of the outputs that are mostly noise in any of them."""
    sounding = [side.values for side in compared if side.values and not is_silent(side)]
    known = [values.get("above_noise_db") for values in sounding]
    noisy = [levels < LEAST_ABOVE_NOISE_DB for levels in known if levels is not None]
    return tuple(int(k) + 1 for k in np.flatnonzero(np.any(noisy, axis=0)))


def _limb(side: Compared) -> str:
    return side.snapshot.design.limb


def _synthetic(side: Compared) -> bool:
    return side.values is not None and bool(side.values["limb_data"].synthetic)


#: Fewer are not compared.
LEAST_COMPARED = 2


#: Quantities of a map of levels.
LEVELS = frozenset(
    {"limb_map", "limb_data", "output_levels_db", "above_noise_db", "surface", "surface_levels_db"}
    | {"record_samples"}
)


#: The motion along all measured axes.
ALL_AXES = "moving_vector"


def along(moving: Moving, k: int) -> Moving:
    """Return the motion along one of its axes."""
    signals = moving.signals[:, [k]]
    return replace(moving, signals=signals, largest=float(np.abs(signals).max(initial=0.0)))


class Kind:
    """One choice of "Of": where the sides come from, and what they are called. It has no state.

    Attributes
    ----------
    fields
        Names of the choices above the maps that apply, beside "Of" itself.
    needs
        As of a panel.
    choices
        What can be shown of the sides.
    own, moves
        Whether the sides come from the results of the design in the window; whether they can be
        shown in motion.
    """

    fields: ClassVar[frozenset[str]] = frozenset()
    needs: ClassVar[frozenset[str]] = LEVELS
    choices: ClassVar[tuple[str, ...]] = tuple(name for name, _ in SHOWN.options if name != RANGE)
    own: ClassVar[bool] = False
    moves: ClassVar[bool] = True

    def moving(self, limb: str, axes: str) -> str:
        """Return the quantity that moves."""
        return moving_name(limb, axes)

    def beside(self, settings: CompareSettings, design: Design) -> tuple[Beside, ...]:
        """Return the limbs or frequencies at which the design is predicted."""
        return ()

    def limbs(self, settings: CompareSettings, design: Design, view: View) -> list[str]:
        """Return the limbs of the sides that do not come from the results of the window."""
        stored = view.snapshots if "snapshots" in self.fields else ()
        beside = self.beside(settings, design)
        return [each.design.limb for each in stored] + [x for x in beside if isinstance(x, str)]

    def is_several(self, settings: CompareSettings, design: Design, view: View) -> bool:
        """Return whether there is more than one side."""
        stored = "snapshots" in self.fields
        sides = with_edited(view.snapshots, design) if stored else self.beside(settings, design)
        return self.own or len(sides) > 1

    def sides(self, design: Design, results: Mapping[str, Any]) -> Sequence[Compared]:
        """Return the sides from results of the design in the window, which hold its ``needs``."""
        return ()

    def names(self, compared: Sequence[Compared], view: View) -> list[Names]:
        """Return the names of the sides, each from the longest to the shortest."""
        raise NotImplementedError

    def reference(self, compared: Sequence[Compared], design: Design, view: View) -> int:
        """Return which of them is in the window; the first where none is."""
        shown = (k for k, side in enumerate(compared) if self.is_shown(side.snapshot, design, view))
        return next(shown, 0)

    def is_shown(self, side: Snapshot, design: Design, view: View) -> bool:
        """Return whether that one of them is in the window."""
        return False

    def hindrance(self, compared: Sequence[Compared], view: View) -> str:
        """Return why nothing can be compared, in a sentence; empty where something can."""
        known = [side for side in compared if side.values is not None]
        return COMPARED_SILENT if known and all(is_silent(side) for side in known) else ""

    def over(self, view: View) -> str:
        """Return the end of a text: what the RMS is over."""
        return f"· {span_label(view.span)}"

    def about(self, compared: Sequence[Compared], design: Design | None, view: View) -> str:
        """Return the text on what the levels are."""
        text = f"RMS of {signal_label(view.axes, view.method)} {self.over(view)}"
        without = "without inputs that cannot be played"
        left_out = without if any(side.left_out for side in compared) else ""
        return " · ".join(filter(None, (text, display_gain_text(design, view), left_out)))

    def shown(self, settings: CompareSettings) -> str:
        """Return what is shown of the sides: the levels where that is no choice."""
        return settings.shown if settings.shown in self.choices else "levels"

    def drawn_as(self, settings: CompareSettings) -> str:
        """Return what is drawn of them where they stand still: the levels of what moves."""
        return shown if (shown := self.shown(settings)) != MOTION else "levels"

    def drawn(
        self, compared: Sequence[Compared], design: Design, view: View, settings: CompareSettings
    ) -> tuple[Cell, ...]:
        """Return the maps of the sides; their scales show by how much levels are matched."""
        shown, style = self.drawn_as(settings), level_style(view)
        names = self.names(compared, view)
        reference = self.reference(compared, design, view)
        if shown == "levels":
            apart = view.span == "record" and "snapshots" in self.fields
            called = _with_lengths(compared, names) if apart else names
            maps = of_levels(compared, called, style, own=settings.own_maximum)
        elif shown == "difference":
            maps = of_differences(compared, names, reference, view.span)
        else:
            people = shown == RANGE
            maps = of_spread(compared, names, reference, view.span, style, people=people)
        matched = matched_text(compared) or display_gain_text(design, view)
        return tuple(
            cell if cell.scale is None else replace(cell, scale=with_matched(cell.scale, matched))
            for cell in maps
        )


#: Quantities for each axis, and the quantities of a map that they stand in for.
_PER_AXIS = {
    "axis_levels_db": "output_levels_db",
    "axis_surface_levels_db": "surface_levels_db",
    "axis_above_noise_db": "above_noise_db",
}
_COMMON = frozenset({"limb_map", "limb_data", "surface"})


class OfAxes(Kind):
    """The present design along each axis of the sensors, whatever axes are chosen in the window.

    Levels or motion are shown: x and y point another way at each sensor, so that a difference or a
    mean of axes has no meaning.
    """

    choices: ClassVar[tuple[str, ...]] = "levels", MOTION
    needs: ClassVar[frozenset[str]] = _COMMON | frozenset(_PER_AXIS)
    own: ClassVar[bool] = True

    def sides(self, design: Design, results: Mapping[str, Any]) -> Sequence[Compared]:
        common = {name: results[name] for name in _COMMON}
        moving: Moving | None = results.get(ALL_AXES)

        def values(k: int) -> dict[str, Any]:
            own = {name: results[quantity][k] for quantity, name in _PER_AXIS.items()}
            if moving is not None:
                own[moving_name(design.limb, axes[k])] = along(moving, k)
            return {**common, **own}

        axes = results["limb_data"].axes
        snapshot = Snapshot(design=design)
        return [
            Compared(snapshot=snapshot, values=values(k), axes=axis) for k, axis in enumerate(axes)
        ]

    def moving(self, limb: str, axes: str) -> str:
        return ALL_AXES

    def names(self, compared: Sequence[Compared], view: View) -> list[Names]:
        return [(f"Along {side.axes}", side.axes) for side in compared]

    def about(self, compared: Sequence[Compared], design: Design | None, view: View) -> str:
        text = f"RMS along each axis of the sensors {self.over(view)}"
        return " · ".join(part for part in (text, display_gain_text(design, view)) if part)


class OfWindow(Kind):
    """The present design alone."""

    choices: ClassVar[tuple[str, ...]] = ("levels",)
    own: ClassVar[bool] = True

    def sides(self, design: Design, results: Mapping[str, Any]) -> Sequence[Compared]:
        return [Compared(snapshot=Snapshot(design=design), values=results)]

    def names(self, compared: Sequence[Compared], view: View) -> list[Names]:
        return [(limb_label(_limb(side)).title,) for side in compared]


_WORKING = "Working design", "Working"
NO_FREQUENCY = "No clip has a single frequency. Add a tone."
ALONE = "There is no other limb with these outputs. Choose some under Limbs."


class OfLimbs(Kind):
    """The present design on several limbs; that in the window is predicted once, for all panels."""

    fields: ClassVar[frozenset[str]] = frozenset({"limbs"})
    choices: ClassVar[tuple[str, ...]] = tuple(name for name, _ in SHOWN.options)

    def beside(self, settings: CompareSettings, design: Design) -> tuple[Beside, ...]:
        return settings.chosen(design.limb)

    def names(self, compared: Sequence[Compared], view: View) -> list[Names]:
        """Return the names of the limbs, with their axes where these are not those of the view."""
        names: list[Names] = []
        for side in compared:
            limb = side.snapshot.design.limb
            title, axes = limb_label(limb).title, side.axes or view.axes
            other = f" ({label_of(AXES, axes).title})" if axes != view.axes else ""
            number = title.split()[1] if limb in PUBLISHED else limb
            names.append((f"{title}{other}", short_limb_title(limb), number))
        return names

    def is_shown(self, side: Snapshot, design: Design, view: View) -> bool:
        return side.design.limb == design.limb

    def hindrance(self, compared: Sequence[Compared], view: View) -> str:
        if len(compared) == 1:
            return compared[0].problem or ALONE
        return super().hindrance(compared, view)


class OfWindows(Kind):
    """The time windows of the present design, at most as many as are seen side by side."""

    needs: ClassVar[frozenset[str]] = frozenset(
        {
            *("limb_map", "limb_data", "surface", "sample_rate_hz", "windows"),
            *("levels_of_windows_db", "surface_of_windows_db", "extents_of_windows"),
            "noise_rms_of_windows",
        }
    )
    choices: ClassVar[tuple[str, ...]] = ("levels",)
    own: ClassVar[bool] = True
    moves: ClassVar[bool] = False

    def sides(self, design: Design, results: Mapping[str, Any]) -> Sequence[Compared]:
        common = {name: results[name] for name in (*_COMMON, "windows")}
        snapshot, sides = Snapshot(design=design), []
        noise = results["noise_rms_of_windows"]
        bounds_s = results["windows"].bounds_s(results["sample_rate_hz"])
        for k, (begin_s, end_s) in enumerate(bounds_s[:MOST_SIDE_BY_SIDE]):
            levels_db = results["levels_of_windows_db"][k]
            values = {
                "output_levels_db": levels_db,
                "surface_levels_db": results["surface_of_windows_db"][k],
                "above_noise_db": None if noise is None else levels_db - decibels(noise[k]),
            }
            extent = results["extents_of_windows"][k]
            name = f"{1e3 * begin_s:.0f} to {1e3 * end_s:.0f} ms"
            if extent is not None:
                # Where there is no room beside the times, all of it is in the next line.
                away = f"({extent.mean_distance_mm:.0f} mm away)"
                name += " " + away.replace(" ", "\N{NO-BREAK SPACE}")
            sides.append(Compared(snapshot=snapshot, values={**common, **values}, axes=name))
        return sides

    def names(self, compared: Sequence[Compared], view: View) -> list[Names]:
        return [(side.axes,) for side in compared]

    def over(self, view: View) -> str:
        return "in windows"

    def about(self, compared: Sequence[Compared], design: Design | None, view: View) -> str:
        text, n_shown = super().about(compared, design, view), len(compared)
        count = max((side.values["windows"].count for side in compared if side.values), default=0)
        part = f"the first {n_shown} of {count}" if count > n_shown else ""
        return " · ".join(filter(None, (text, part, "mean distance from the nearest input")))


class OfFrequencies(Kind):
    """The present design at frequencies, from the lowest to the highest.

    It stands for the frequency that all its tones have; where they have several, it comes last.
    """

    fields: ClassVar[frozenset[str]] = frozenset({"frequencies_hz"})

    def beside(self, settings: CompareSettings, design: Design) -> tuple[Beside, ...]:
        own_hz = frequency_of(design)
        if own_hz is None:
            return ()
        in_order = sorted({own_hz, *settings.frequencies_hz})
        return tuple(design.limb if hz == own_hz else hz for hz in in_order)

    def names(self, compared: Sequence[Compared], view: View) -> list[Names]:
        known = [frequency_of(side.snapshot.design) or 0.0 for side in compared]
        return [_WORKING if isinf(hz) else (f"{hz:g} Hz",) for hz in known]

    def is_shown(self, side: Snapshot, design: Design, view: View) -> bool:
        return frequency_of(side.design) == frequency_of(design)

    def hindrance(self, compared: Sequence[Compared], view: View) -> str:
        return super().hindrance(compared, view) if compared else NO_FREQUENCY


class OfSnapshots(Kind):
    """Snapshots of the present design, and designs of files; their levels can be matched."""

    fields: ClassVar[frozenset[str]] = frozenset({"snapshots"})

    def names(self, compared: Sequence[Compared], view: View) -> list[Names]:
        return snapshot_names(compared, view.axes)

    def is_shown(self, side: Snapshot, design: Design, view: View) -> bool:
        held = shown_snapshot(view.snapshots, design)
        return side.number == (EDITED if held is None else held.number)

    def hindrance(self, compared: Sequence[Compared], view: View) -> str:
        if len(compared) < 2:
            return why_no_comparison(view.snapshots)
        return super().hindrance(compared, view)

    def about(self, compared: Sequence[Compared], design: Design | None, view: View) -> str:
        # Each has its own gain.
        text = super().about(compared, None, view)
        over = lengths_text(compared) if view.span == "record" else ""
        matched = matching_text(compared) if view.levels_matched else ""
        return " · ".join(filter(None, (text, over, matched)))


def lengths_text(compared: Sequence[Compared]) -> str:
    """Return over how long the levels are taken; "" where that is the same for all."""
    lengths_s = sorted({round(length_s, 2) for side in compared if (length_s := record_s(side))})
    if not lengths_s[1:]:
        return ""
    shortest, *_, longest = lengths_s
    return f"{shortest:g} to {longest:g} s long; differences and means over {longest:g} s"


def _with_lengths(compared: Sequence[Compared], names: Sequence[Names]) -> Sequence[Names]:
    """Return names, all but the shortest with the length of the record where these differ."""
    if not lengths_text(compared):
        return names
    return [
        (*(f"{form}, {round(record_s(side), 2):g} s" for form in forms), forms[-1])
        for side, forms in zip(compared, names, strict=True)
    ]


def _levels_over(span: Span, *known: Compared) -> list[Floats]:
    """Return levels over the same time: those of whole records over the longest of them."""
    if span != "record":
        return [_levels_db(side) for side in known]
    longest_s = max(map(record_s, known))
    return [_levels_db(side) + 10.0 * np.log10(record_s(side) / longest_s) for side in known]


def record_s(side: Compared) -> float:
    """Return how long its whole record is; 0 where that is not known."""
    known = side.values
    return known["record_samples"] / float(known["limb_data"].sample_rate_hz) if known else 0.0


def matching_text(compared: Sequence[Compared]) -> str:
    """Return the text on what is as loud in all designs; "" where fewer than two have levels."""
    if sum(side.values is not None for side in compared) < LEAST_COMPARED:
        return ""
    reference = min(compared, key=lambda side: side.snapshot.number)
    if not (is_silent(reference) or reference.problem):
        return f"{LEVELS_MATCHED} in the {span_label('loudest')}"
    why = "cannot be predicted" if reference.problem else "is silent"
    return f"{snapshot_name(reference.snapshot.number)} {why}: levels cannot be matched to it"


def snapshot_names(compared: Sequence[Compared], axes: Axes) -> list[Names]:
    """Return the names of the snapshots, with their limbs where these differ.

    They include their axes where these are not ``axes``.
    """
    names: list[Names] = []
    titles, limbs = told_titles(compared), told_limbs(compared)
    figures = [titles.get(side.snapshot.number, "") for side in compared if not side.snapshot.title]
    own_of = own_parts([each for each in figures if each])
    for side in compared:
        along = axes_on(side.snapshot.design.limb, axes)
        other = f" ({label_of(AXES, along).title})" if along != axes else ""
        on_limb = limbs[side.snapshot.number]
        other += on_limb
        working = side.snapshot.number == EDITED
        called = _WORKING[0] if working else f"Snapshot {side.name}"
        title = titles.get(side.snapshot.number, "")
        own = own_of.get(title, title)
        cut = own if len(own) <= _SHORT else f"{own[: _SHORT - 1].rstrip()}…"
        begun = (called, own), (side.name, own), (side.name, cut)
        longest = (own, own, cut) if working else tuple(" · ".join(parts) for parts in begun)
        # A scene that was not changed is told by its title, as the others are.
        told = title and (not working or title == side.snapshot.design.title)
        wordings = (*longest, called) if told else (called,)
        # What is its own is short enough.
        shortest = cut if working and told and own else side.name
        names.append((*(f"{part}{other}" for part in wordings), f"{shortest}{on_limb}"))
    return names


# A name with more letters is cut where a map has no room for it.
_SHORT = 14


#: The kinds by their names in the settings.
KINDS: dict[str, Kind] = {
    "snapshots": OfSnapshots(),
    "limbs": OfLimbs(),
    "axes": OfAxes(),
    "frequencies": OfFrequencies(),
    "windows": OfWindows(),
}


def tab_separated(content: CompareContent) -> str:
    """Return the numbers for a spreadsheet: a row for each output, a column for each map."""
    cells = [cell for cell in content.cells if cell.values_db is not None]
    titles = [f"{cell.heading} ({_unit(cell)})" for cell in cells]
    lines = ["\t".join(("output", *titles))]
    values = [np.asarray(cell.values_db) for cell in cells]
    for row in range(max((column.size for column in values), default=0)):
        texts = (copied_level(column[row]) if row < column.size else "" for column in values)
        lines.append("\t".join((str(row + 1), *texts)))
    return "\n".join(lines) + "\n"


def _unit(cell: Cell) -> str:
    if cell.maximum_db is not None:
        return f"dB re its maximum of {copied_level(cell.maximum_db)} dB re 1 m/s²"
    return "" if cell.scale is None else cell.scale.text_below
