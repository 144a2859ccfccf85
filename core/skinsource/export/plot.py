"""Drawings of designs and of predicted levels, with matplotlib and without a window.

Each function draws into ``ax``, axes of matplotlib, or makes a figure of its own, and returns the
figure: it shows itself in a notebook, and `savefig` writes PNG, SVG and PDF with real text.  They
need the extra ``plot``.

>>> import skinsource as ss
>>> tone = ss.track(7, ss.waveforms.Tone(frequency_hz=100.0))
>>> figure = ss.plot.map(ss.Design(limb="synthetic-1", inputs=(tone,)))
>>> len(figure.axes)
2
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, fields, replace
from functools import cache, reduce
from io import BytesIO
from pathlib import Path
from typing import Any, Literal

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from skinsource.base.arguments import checking, finite_array, one_of, positive_number
from skinsource.base.assets import data_folder
from skinsource.base.conventions import Floats
from skinsource.base.decibels import decibels
from skinsource.base.errors import InvalidInputError, quoted
from skinsource.base.extras import package_of_extra
from skinsource.base.files import FilePath
from skinsource.base.job import Progress, Stop, never, silent
from skinsource.design.comparing import range_sentences
from skinsource.design.design import Design, View, audible_inputs
from skinsource.design.labels import level_label, limb_label, signal_label
from skinsource.engine.evaluation import evaluate
from skinsource.export.video import frames_per_s, video_file
from skinsource.limbs.catalog import limb_of
from skinsource.limbs.extent import Extent
from skinsource.limbs.limb import Limb
from skinsource.limbs.own_limbs import facts_of
from skinsource.limbs.surface.operator import SurfaceOperator
from skinsource.limbs.surface.surface import surface_operator
from skinsource.people import ranges
from skinsource.perception.validity import noisy_outputs
from skinsource.signals.analysis.noise import LEAST_ABOVE_NOISE_DB
from skinsource.signals.analysis.windows import Windows
from skinsource.signals.loudest_window import HOLD_WINDOW_S
from skinsource.signals.map_range import map_range_db
from skinsource.signals.resampling import extremes_between, finer
from skinsource.signals.spectra import mean_of_bins as moving_mean

MM_PER_INCH = 25.4
#: Colours of lines and text, and of secondary text.
INK, DIM = "#222222", "#666666"
#: Colours of curves, which differ with any colour vision (Okabe and Ito).
COLOURS = ("#0072B2", "#D55E00", "#000000", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
SYNTHETIC = "SYNTHETIC LIMB: computed responses, not measured ones"


def module(name: str) -> Any:
    """Import matplotlib, or a module of it.

    Raises
    ------
    MissingExtraError
        It is not installed; the message names the extra.
    """
    return package_of_extra(name, "plot")


@contextmanager
def style() -> Iterator[None]:
    """Draw or save in the common style of this package."""
    library, path = module("matplotlib"), data_folder() / "figures.mplstyle"
    with library.rc_context(library.rc_params_from_file(path, use_default_template=False)):
        yield


def new_figure(width_mm: float, height_mm: float) -> Any:
    """Return an empty figure that shows itself in a notebook."""
    module("matplotlib.backends.backend_agg")
    size = (width_mm / MM_PER_INCH, height_mm / MM_PER_INCH)
    with style():
        return _figure_class()(figsize=size, facecolor="white")


def axes_of(ax: Any, width_mm: float, height_mm: float) -> tuple[Any, bool]:
    """Return axes to draw into, and whether their figure is new."""
    if ax is not None:
        return ax, False
    with style():
        return new_figure(width_mm, height_mm).add_subplot(), True


@cache
def _figure_class() -> Any:
    figure: Any = module("matplotlib.figure").Figure

    class Drawing(figure):  # type: ignore[misc]
        """A figure that is saved with real text, whatever the settings of matplotlib are."""

        def savefig(self, *args: Any, **kwargs: Any) -> None:
            """Save the figure; see matplotlib."""
            with style():
                super().savefig(*args, **kwargs)

        def _repr_png_(self) -> bytes:
            content = BytesIO()
            self.savefig(content, format="png", dpi=110, bbox_inches="tight")
            return content.getvalue()

    return Drawing


#: Resolution of pixels; journals ask for it.
DOTS_PER_INCH = 300
#: Metadata of a file, by its kind.  They hold no date: the same drawing gives the same bytes.
METADATA = {
    "png": {"Software": None},
    "svg": {"Date": None, "Creator": "SkinSource studio"},
    "pdf": {"CreationDate": None, "ModDate": None, "Creator": "SkinSource studio"},
}


def figure_content(figure: Any, kind: str, dots_per_inch: int = DOTS_PER_INCH) -> bytes:
    """Return the bytes of a file that holds a figure of this package.

    Parameters
    ----------
    figure
        What `skinsource.export.plot.map` and the others return.
    kind
        ``"png"``, ``"svg"`` or ``"pdf"``.
    """
    content = BytesIO()
    figure.savefig(content, format=kind, dpi=dots_per_inch, metadata=METADATA[kind])
    return content.getvalue()


Range = tuple[float, float]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Levels:
    """Levels of all outputs of a limb.

    Attributes
    ----------
    limb, surface
        Places of the outputs, and how levels are interpolated between them.
    values : (n_outputs,)
        In dB, or signed accelerations.
    places
        Input places that play.
    noisy
        Outputs that are mostly noise, see `skinsource.perception.validity`; empty where that is
        not known.
    """

    limb: Limb
    surface: SurfaceOperator
    values: Floats
    places: tuple[int, ...] = ()
    noisy: tuple[int, ...] = ()


def levels_of(shown: Design | ArrayLike, limb: Limb | str | None, view: View | None) -> Levels:
    """Return the levels that a map of a design, or of levels of ``limb``, shows.

    Raises
    ------
    InvalidInputError
        Levels come without a limb, or do not fit it.
    """
    if isinstance(shown, Design):
        results = evaluate(shown, "output_levels_db", "limb_data", "surface", "validity", view=view)
        places = sorted({track.location for track in audible_inputs(shown.inputs)})
        return Levels(
            limb=results["limb_data"],
            surface=results["surface"],
            values=results["output_levels_db"],
            places=tuple(places),
            noisy=noisy_outputs(results["validity"]),
        )
    if limb is None:
        raise InvalidInputError(
            "levels need their limb; use map(levels_db, limb=...), or hand over a Design"
        )
    loaded = limb_of(limb)
    values = finite_array("levels", shown)
    if values.shape != (loaded.n_outputs,):
        raise InvalidInputError(
            f"levels have shape {values.shape}, expected one for each of the {loaded.n_outputs} "
            f"outputs of {loaded.name}"
        )
    return Levels(limb=loaded, surface=surface_operator(loaded), values=values)


def common_range(*levels_db: Floats) -> Range:
    """Return the colour range of maps of all levels, see `signals.map_range.map_range_db`."""
    return map_range_db(np.concatenate(levels_db, axis=None))


Bar = Literal["drawn", "room", "none"]
Part = Literal["arm", "hand"]
Colours = Literal["sequential", "diverging"]
_COLOUR_MAPS: dict[Colours, str] = {"sequential": "viridis", "diverging": "RdBu_r"}
# Levels reach far below 0 dB and little above it; where both ends of an array are this much alike,
# it is a difference of levels.
_ENDS_OF_DIFFERENCES = 0.2
# Beside the wrist there is less room than below the arm.
_BAR_MM: dict[Part, float] = {"arm": 50.0, "hand": 20.0}
# Room for what stands below limb and traces.
_BELOW_MM = 14.0
# The hand and a little of the wrist, in hand lengths.
_HAND_PART = 1.06
#: Noise is hatched around an output, half of the way to its neighbours, in hand lengths.
NOISE_REACH = 0.08
# Visible on dark and on light colours.
_STROKES, _STROKE_COLOUR = "//////", "#B0B0B0"
#: What strokes over a map mean.
HATCHED = f"Hatched: less than {LEAST_ABOVE_NOISE_DB:g} dB above the noise of the measurement"
_MAP_FIGURE_MM, _PEOPLE_FIGURE_MM = (75.0, 115.0), (170.0, 115.0)
_LEVEL = "dB re 1 m/s²"


@checking
def map(
    shown: Design | ArrayLike,
    *,
    limb: Limb | str | None = None,
    view: View | None = None,
    range_db: Range | None = None,
    label: str | None = None,
    colours: Colours | None = None,
    outputs: Sequence[int] = (),
    title: str = "",
    ax: Any = None,
) -> Any:
    """Draw levels over the back of hand and arm.

    Of a design, text below the map says whose levels these are, along which axes, over what time.

    Parameters
    ----------
    shown
        A design; or levels of all outputs, (n_outputs,), in dB re 1 m/s²; or differences of levels,
        or any other numbers that ``label`` names.
    limb
        Whose levels these are; a design knows its own.
    view
        Axes, method and span of the levels of a design; ``View()`` where none is given.
    range_db
        Values of the lowest and the highest colour.  Unless given, from the loudest output 50 dB
        down; of diverging colours, as far below 0 as above.
    label
        Label of the colour bar; dB re 1 m/s², or the difference in dB, unless given.
    colours
        ``"sequential"``, or ``"diverging"``, which are white at 0.  Unless given, arrays that reach
        about as far above 0 as below diverge: they are differences.
    outputs
        Outputs that are ringed and numbered.
    title
        Title above it.
    ax
        Axes to draw into, without a colour bar; a figure of its own with one where none is given.

    Returns
    -------
    The figure.

    Raises
    ------
    InvalidInputError
        Levels come without a limb, or do not fit it.
    MissingExtraError
        matplotlib is not installed.

    Examples
    --------
    >>> import numpy as np, skinsource as ss
    >>> figure = ss.plot.map(np.linspace(-60.0, -10.0, 72), limb="synthetic-2", outputs=(19,))
    """
    levels = levels_of(shown, limb, view)
    if colours is None:
        differs = not isinstance(shown, Design) and _is_difference(levels.values)
        colours = "diverging" if differs else "sequential"
    signed = one_of("colours", colours, tuple(_COLOUR_MAPS)) == "diverging"
    if range_db is None:
        range_db = signed_range(levels.values) if signed else common_range(levels.values)
    target, is_new = axes_of(ax, *_MAP_FIGURE_MM)
    with style():
        image = draw_map(
            target, levels, range_db, outputs=tuple(outputs), title=title, signed=signed
        )
        if is_new:
            default = "difference (dB)" if signed else _LEVEL
            notes = _told(shown, view), _map_note(levels.limb, bool(levels.noisy))
            words = "\n".join(filter(None, notes))
            _finish([target], image, default if label is None else label, words)
    return target.figure


@checking
def people(
    design: Design,
    *,
    view: View | None = None,
    limbs: Sequence[Limb | str] | None = None,
    range_db: Range | None = None,
    title: str = "",
) -> Any:
    """Draw the range between people: its low end, mean and high end, all in one colour scale.

    Parameters
    ----------
    design
        What plays; the limbs of its limb's kind are the people unless ``limbs`` names others.
    view, limbs
        As of `skinsource.people.levels`.
    range_db
        Levels of the lowest and the highest colour; from the loudest output of the high end 50 dB
        down unless given.
    title
        Title above it.

    Returns
    -------
    The figure.

    Raises
    ------
    InvalidInputError
        The limb is no published one, or the people are too few or have other places.
    DatasetMissingError
        The measured dataset is needed, and not installed.
    MissingExtraError
        matplotlib is not installed.

    Examples
    --------
    >>> import skinsource as ss
    >>> tone = ss.track(7, ss.waveforms.Tone(frequency_hz=100.0))
    >>> figure = ss.plot.people(ss.Design(limb="synthetic-1", inputs=(tone,)))
    >>> [axes.get_title() for axes in figure.axes[:3]]
    ['Low end', 'Mean of 4', 'High end']
    """
    chosen = ranges.people_like(design.limb) if limbs is None else limbs
    found = ranges.levels(design, view, limbs=chosen)
    limb = limb_of(chosen[0])
    ends = {"Low end": found.low_db, f"Mean of {len(found.names)}": found.mean_db}
    ends["High end"] = found.high_db
    plain = levels_of(found.mean_db, limb, None)
    places = tuple(sorted({track.location for track in audible_inputs(design.inputs)}))
    levels = [replace(plain, values=values, places=places) for values in ends.values()]
    figure = new_figure(*_PEOPLE_FIGURE_MM)
    with style():
        maps = list(figure.subplots(1, len(ends)))
        colours = common_range(found.high_db) if range_db is None else range_db
        image = draw_maps(maps, levels, colours, tuple(ends))
        words = range_sentences(float(found.high_db[0] - found.mean_db[0]))
        _finish(maps, image, _LEVEL, "\n".join(filter(None, (words, _map_note(limb, noisy=False)))))
        figure.suptitle(title, fontsize=9)
    return figure


def _is_difference(values: Floats) -> bool:
    """Return whether values reach about as far above 0 as below."""
    below, above = -float(values.min()), float(values.max())
    return min(below, above) > 0.0 and min(below, above) >= _ENDS_OF_DIFFERENCES * max(below, above)


def signed_range(values: Floats) -> Range:
    """Return a colour range with 0 in its middle."""
    limit = float(np.abs(values).max()) or 1.0
    return -limit, limit


def _finish(maps: list[Any], image: Any, label: str, note: str) -> None:
    """Draw a colour bar, and what has to be known of the maps."""
    figure = maps[0].figure
    bar = figure.colorbar(image, ax=maps, shrink=0.55, aspect=18, pad=0.02)
    bar.set_label(label)
    bar.outline.set_linewidth(0.5)
    if note:
        figure.text(0.5, 0.01, note, ha="center", color=DIM, fontsize=6)


def _told(shown: Design | ArrayLike, view: View | None) -> str:
    """Return whose levels of a design these are, along which axes and over what time."""
    if not isinstance(shown, Design):
        return ""
    view = View() if view is None else view
    whose = f"{limb_label(shown.limb).title}; {signal_label(view.axes, view.method)}"
    return f"{whose}\n{level_label(view.span)}"


def _map_note(limb: Limb, noisy: bool) -> str:
    """Return the note below a map; a synthetic limb has no noise."""
    return SYNTHETIC if limb.synthetic else HATCHED if noisy else ""


def draw_map(
    ax: Any,
    levels: Levels,
    colours: Range,
    *,
    outputs: tuple[int, ...] = (),
    title: str = "",
    signed: bool = False,
    bar: Bar = "drawn",
    part: Part = "arm",
) -> Any:
    """Draw a map into ``ax`` and return its image, for a colour bar.

    Parameters
    ----------
    ax
        Axes of matplotlib.
    levels
        What is shown.
    colours
        Values of the lowest and the highest colour.
    outputs, title
        As of `map`.
    signed
        Whether values have a sign, with 0 in the middle of the colours.
    bar
        Whether a bar beside the limb shows 50 mm, or 20 mm of a hand; ``"room"`` leaves room for
        it, so that maps side by side have the same size.
    part
        ``"arm"``: the whole limb; ``"hand"``: down to the wrist.

    Outputs of ``levels`` that are mostly noise are hatched.
    """
    limb = levels.limb
    table = _COLOUR_MAPS["diverging" if signed else "sequential"]
    image, outline = _draw_field(ax, levels, colours, table)
    reach_mm = NOISE_REACH * limb.hand_length_mm
    _hatch(ax, limb.output_positions_mm, levels.noisy, reach_mm, outline)
    _mark(ax, limb.input_positions_mm, levels.places, "input")
    _mark(ax, limb.output_positions_mm, outputs, "output")
    low, high = bounds_of(limb, part)
    ax.set_xlim(low[0] - 4.0, high[0] + 4.0)
    ax.set_ylim(low[1] - (4.0 if bar == "none" else _BELOW_MM), high[1] + 4.0)
    ax.set_aspect("equal")
    ax.set_axis_off()
    if bar == "drawn":
        x, y = (float(high[0]) - _BAR_MM[part], float(high[0])), float(low[1]) - 0.35 * _BELOW_MM
        ax.plot(x, (y, y), color=INK, lw=1.2)
        ax.text(sum(x) / 2, y - 3.0, f"{_BAR_MM[part]:g} mm", ha="center", va="top", fontsize=6)
    if title:
        ax.set_title(title)
    return image


def draw_maps(
    places: Sequence[Any],
    levels: Sequence[Levels],
    colours: Range,
    titles: Sequence[str],
    *,
    signed: bool = False,
    part: Part = "arm",
) -> Any:
    """Draw maps side by side, the last with a bar of mm, and return an image for a colour bar."""
    image = None
    for ax, level, title in zip(places, levels, titles, strict=True):
        bar: Bar = "drawn" if ax is places[-1] else "room"
        image = draw_map(ax, level, colours, title=title, signed=signed, bar=bar, part=part)
    return image


def _draw_field(ax: Any, levels: Levels, colours: Range, colour_map: str) -> tuple[Any, Any]:
    """Draw the interpolated map, clipped to the outline; return image and outline."""
    surface, limb = levels.surface, levels.limb
    half = (surface.x_mm[1] - surface.x_mm[0]) / 2.0
    x, y = surface.x_mm, surface.y_mm
    # Extended beyond the outline, which clips it, by the pixel inside that is nearest to each.
    inside = surface.interpolate(levels.values)
    image = ax.imshow(
        inside[_nearest_inside(inside)],
        origin="lower",
        extent=(x[0] - half, x[-1] + half, y[0] - half, y[-1] + half),
        cmap=colour_map,
        vmin=colours[0],
        vmax=colours[1],
        interpolation="bilinear",
    )
    outline = module("matplotlib.patches").Polygon(
        limb.map.outline * (limb.hand_length_mm / limb.map.hand_length_px),
        closed=True,
        fill=False,
        edgecolor=INK,
        linewidth=0.6,
    )
    ax.add_patch(outline)
    image.set_clip_path(outline)
    return image, outline


def _hatch(
    ax: Any, positions: Floats, noisy: tuple[int, ...], reach_mm: float, outline: Any
) -> None:
    """Hatch discs around outputs that are mostly noise, clipped to the outline."""
    centres = [positions[number - 1] for number in noisy]
    on_map = [centre for centre in centres if np.isfinite(centre).all()]
    if not on_map:
        return
    path = module("matplotlib.path").Path
    discs = path.make_compound_path(*(path.circle(centre, reach_mm) for centre in on_map))
    strokes = module("matplotlib.patches").PathPatch(
        discs, fill=False, hatch=_STROKES, edgecolor=_STROKE_COLOUR, linewidth=0.0
    )
    ax.add_patch(strokes)
    strokes.set_clip_path(outline)


def bounds_of(limb: Limb, part: Part) -> tuple[Floats, Floats]:
    """Return the lower left and upper right corner of a part of the limb, mm."""
    outline = limb.map.outline * (limb.hand_length_mm / limb.map.hand_length_px)
    if part == "hand":
        wrist = outline[:, 1].max() - _HAND_PART * limb.hand_length_mm
        outline = outline[outline[:, 1] >= wrist]
    return outline.min(axis=0), outline.max(axis=0)


def _nearest_inside(inside: Floats) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return row and column of the pixel inside of the outline that is nearest to each pixel."""
    rows, columns = scipy.ndimage.distance_transform_edt(
        np.isnan(inside), return_distances=False, return_indices=True
    )
    return rows, columns


def _mark(ax: Any, positions: Floats, numbers: tuple[int, ...], kind: str) -> None:
    for number in numbers:
        x, y = positions[number - 1]
        if np.isnan(x):
            continue
        if kind == "input":
            ax.plot(x, y, "o", ms=6, mfc="none", mec="white", mew=1.6)
            ax.plot(x, y, "o", ms=6, mfc="none", mec=COLOURS[1], mew=1.0)
        else:
            ax.plot(x, y, "o", ms=4, mfc="white", mec=INK, mew=0.6)
            ax.annotate(
                str(number),
                (x, y),
                xytext=(4, 2),
                textcoords="offset points",
                fontsize=6,
                bbox={"boxstyle": "round,pad=0.12", "fc": "white", "ec": "none", "alpha": 0.75},
            )


# Height of a row in units of its curves: curves of adjacent rows do not touch.
_ROW_HEIGHT = 2.3
# Height of a legend, as a share of a row.
_LEGEND_SHARE = 0.3


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PlotRow:
    """One row of a drawing: curves over each other.

    Attributes
    ----------
    x : (n,)
        Times in ms or frequencies in Hz.
    curves : (n_curves, n)
        Values of each curve.
    unit_size
        Value that fills the row; None: the largest value of its own curves.
    """

    label: str
    x: Floats
    curves: Floats
    unit_size: float | None = None

    @property
    def size(self) -> float:
        """Value that fills the row; 1 where nothing moves."""
        size = float(np.abs(self.curves).max(initial=0.0))
        return (size if self.unit_size is None else self.unit_size) or 1.0


def common_size(rows: Sequence[Floats]) -> float:
    """Return the value that fills every row where all have one scale."""
    return max((float(np.abs(row).max(initial=0.0)) for row in rows), default=0.0)


def draw_rows(
    ax: Any,
    rows: Sequence[PlotRow],
    *,
    labels: Sequence[str] = (),
    colours: Sequence[str] = COLOURS,
    from_zero: bool = False,
    title: str = "",
    legend_above: bool = False,
) -> None:
    """Draw rows into ``ax``, the first one on top.

    Parameters
    ----------
    ax
        Axes of matplotlib.
    rows
        Rows, from top to bottom.
    labels
        Labels of the curves of a row, for a legend; empty: no legend.
    colours
        Colours of the curves of a row.
    from_zero
        Whether curves are never negative, and stand on the line of their row.
    title
        Title of the axes.
    legend_above
        Whether the legend has room above the first row, so that it covers no curve.
    """
    room = 1.15 if from_zero else _ROW_HEIGHT
    for rank, row in enumerate(rows):
        base = -room * rank
        ax.axhline(base, color="#DDDDDD", lw=0.5, zorder=0)
        for k, curve in enumerate(row.curves):
            label = labels[k] if labels and rank == 0 else None
            colour = colours[k % len(colours)]
            ax.plot(row.x, base + curve / row.size, color=colour, label=label, lw=0.8)
    ax.set_yticks([-room * rank for rank in range(len(rows))], [row.label for row in rows])
    ax.tick_params(axis="y", length=0)
    ax.spines["left"].set_visible(False)
    top = 1.15 + (_LEGEND_SHARE * room if labels and legend_above else 0.0)
    ax.set_ylim(-room * (len(rows) - 1) - (0.1 if from_zero else 1.15), top)
    if rows:
        ax.set_xlim(float(rows[0].x[0]), float(rows[0].x[-1]))
    if labels:
        ax.legend(loc="upper right", ncols=len(labels), fontsize=6, borderaxespad=0.0)
    if title:
        ax.set_title(title)


def annotate_scale(ax: Any, text: str) -> None:
    """Write above ``ax`` what the height of a row means."""
    ax.annotate(
        text,
        (0.0, 1.0),
        xycoords="axes fraction",
        xytext=(0, 3),
        textcoords="offset points",
        fontsize=6,
        color=DIM,
    )


_WIDTH_MM, _ROW_MM, _AROUND_MM = 130.0, 13.0, 26.0
# What spectra of a span are, and are over.
_SPECTRA = {
    "record": ("selected_spectra", "whole record"),
    "loudest": (
        "selected_peak_spectra",
        f"loudest {HOLD_WINDOW_S * 1e3:.0f} ms of each frequency",
    ),
}
_TRACE_QUANTITIES = "response_time_s", "axis_traces", "selected_projection"
# With more samples a page shows no single wave, only how far waves reach: in more columns than a
# page of two columns has dots at 600 dots per inch.
_MOST_JOINED, _N_COLUMNS = 20_000, 4096


@checking
def traces(
    shown: Design | Sequence[Design],
    *,
    view: View | None = None,
    outputs: Sequence[int] | None = None,
    labels: Sequence[str] = (),
    normalised: bool = False,
    title: str = "",
    ax: Any = None,
) -> Any:
    """Draw the signals of outputs over time, a row for each.

    Up to 20 000 samples are joined by the band-limited wave through them, not by straight lines;
    with more samples, the lowest and highest value of that wave are drawn in 4096 columns.

    Parameters
    ----------
    shown
        A design, or several that are drawn over each other.
    view
        Axes, method, range of times, and whether the pre-trigger delay is removed.
    outputs
        Which outputs; those of the view unless given.
    labels
        Of the designs, for a legend.
    normalised
        Whether each row is scaled to its own peak; all have one scale otherwise.
    title
        Title above it.
    ax
        Axes to draw into; a figure of its own where none is given.

    Returns
    -------
    The figure.

    Raises
    ------
    InvalidInputError
        There is nothing to draw, the limb does not have such outputs, or limbs were not sampled at
        the same times.
    MissingExtraError
        matplotlib is not installed.

    Examples
    --------
    >>> import skinsource as ss
    >>> tone = ss.track(7, ss.waveforms.Tone(frequency_hz=100.0))
    >>> design = ss.Design(limb="synthetic-1", inputs=(tone,))
    >>> figure = ss.plot.traces(design, outputs=(19, 29))
    """
    designs, view = _designs(shown, labels), _checked_view(view, outputs)
    limbs = [facts_of(design.limb) for design in designs]
    removed_s = {limb.pre_trigger_delay_s if view.delay_removed else 0.0 for limb in limbs}
    if max(len(removed_s), len({limb.sample_rate_hz for limb in limbs})) > 1:
        raise InvalidInputError(
            "the limbs differ in sample rate or pre-trigger delay, so their samples lie at other "
            "times; draw each in axes of its own"
        )
    results = [evaluate(design, *_TRACE_QUANTITIES, view=view) for design in designs]
    time_s, curves = _waves(results, view.time_range_s)
    rows = _rows(1e3 * time_s, curves, view.outputs, normalised)
    removed = ", pre-trigger delay removed" if view.delay_removed else ""
    words = f"Time (ms){removed}", _scale_label(rows, normalised, view)
    return _signals_figure(ax, rows, designs, words, labels=labels, title=title)


@checking
def spectra(
    shown: Design | Sequence[Design],
    *,
    view: View | None = None,
    outputs: Sequence[int] | None = None,
    labels: Sequence[str] = (),
    normalised: bool = False,
    mean_of_bins: int = 1,
    title: str = "",
    ax: Any = None,
) -> Any:
    """Draw magnitude spectra of outputs in the band of the limb, a row for each.

    They are those of the studio: over the whole record, or where ``view.span`` is ``"loudest"`` of
    the loudest 250 ms of each frequency, see `skinsource.peak_hold_spectrum`.

    Parameters
    ----------
    mean_of_bins
        How many bins of the spectrum are averaged, 1: none.
    shown, view, outputs, labels, normalised, title, ax
        As of `traces`.

    Returns
    -------
    The figure.

    Raises
    ------
    InvalidInputError
        There is nothing to draw, or the limb does not have such outputs.
    MissingExtraError
        matplotlib is not installed.

    Examples
    --------
    >>> import skinsource as ss
    >>> tone = ss.track(7, ss.waveforms.Tone(frequency_hz=100.0))
    >>> design = ss.Design(limb="synthetic-1", inputs=(tone,))
    >>> figure = ss.plot.spectra(design, outputs=(19, 29))
    """
    designs, view = _designs(shown, labels), _checked_view(view, outputs)
    quantity, over = _SPECTRA[view.span]
    results = [evaluate(design, quantity, view=view)[quantity] for design in designs]
    frequency = results[0][0]
    if any(not np.array_equal(other, frequency) for other, _ in results):
        raise InvalidInputError(
            "the designs differ in length or sample rate, so their spectra have other frequencies; "
            "draw each in axes of its own"
        )
    low_hz, high_hz = facts_of(designs[0].limb).band_hz or (0.0, np.inf)
    within = (frequency >= low_hz) & (frequency <= high_hz)
    curves = [moving_mean(magnitude, mean_of_bins)[:, within] for _, magnitude in results]
    rows = _rows(frequency[within], curves, view.outputs, normalised)
    averaged = f"; mean of {mean_of_bins} bins" if mean_of_bins > 1 else ""
    words = "Frequency (Hz)", f"{_scale_label(rows, normalised, view)}; {over}{averaged}"
    return _signals_figure(ax, rows, designs, words, labels=labels, title=title, from_zero=True)


def _designs(shown: Design | Sequence[Design], labels: Sequence[str]) -> list[Design]:
    designs = [shown] if isinstance(shown, Design) else list(shown)
    if not designs or not all(isinstance(design, Design) for design in designs):
        raise InvalidInputError(f"shown is {quoted(shown)}, expected a Design, or several")
    if labels and len(labels) != len(designs):
        raise InvalidInputError(f"{len(labels)} labels, expected {len(designs)}, one a design")
    return designs


def _checked_view(view: View | None, outputs: Sequence[int] | None) -> View:
    view = View() if view is None else view
    view = view if outputs is None else replace(view, outputs=tuple(outputs))
    if not view.outputs:
        raise InvalidInputError("no output is selected; name some: outputs=(19, 21)")
    return view


def _filled(result: Mapping[str, Any], time_s: Floats) -> Floats:
    """Return traces with silence before and after, so that all designs have all times."""
    traces: Floats = result["axis_traces"]
    # Through actuators responses begin before time 0.
    before = int(np.searchsorted(time_s, result["response_time_s"][0]))
    after = time_s.size - before - traces.shape[-1]
    return np.pad(traces, ((0, 0), (0, 0), (before, after)))


def _waves(
    results: Sequence[Mapping[str, Any]], range_s: tuple[float, float] | None
) -> tuple[Floats, list[Floats]]:
    """Return times in a range, all unless given, and the projected signals of designs at them."""
    time_s = reduce(np.union1d, [result["response_time_s"] for result in results])
    low, high = range_s or (float(time_s[0]), float(time_s[-1]))
    within = np.flatnonzero((time_s >= low) & (time_s <= high))
    if not within.size:
        raise _beside(range_s, time_s)
    first, end = int(within[0]), int(within[-1]) + 1
    points_of = _wave_points if end - first <= _MOST_JOINED else _wave_extremes
    points = [points_of(result, time_s, first, end) for result in results]
    return points[0][0], [curves for _, curves in points]


def _beside(range_s: Range | None, time_s: Floats) -> InvalidInputError:
    """Return what is raised for a range of times without any of a response."""
    return InvalidInputError(
        f"view.time_range_s is {quoted(range_s)}, expected times between {time_s[0]:g} and "
        f"{time_s[-1]:g} s"
    )


def _wave_points(
    result: Mapping[str, Any], time_s: Floats, first: int, end: int
) -> tuple[Floats, Floats]:
    """Return times and points of the waves between samples.

    The wave runs along the axes, and the projection follows: a magnitude is its length.
    """
    axes = _filled(result, time_s)
    instants, axes = finer(time_s, axes, first, end)
    return instants, result["selected_projection"].signals(axes)


def _wave_extremes(
    result: Mapping[str, Any], time_s: Floats, first: int, end: int
) -> tuple[Floats, Floats]:
    """Return times and the lowest and highest value of the waves in columns, in turn."""
    axes, projection = _filled(result, time_s), result["selected_projection"]
    # A magnitude is the length of the wave along the axes.
    waves = axes if projection.directions is None else projection.signals(axes)
    starts = np.arange(_N_COLUMNS) * (end - first) // _N_COLUMNS
    low, high = extremes_between(waves, first, end).of_columns(starts)
    curves = np.stack((low, high), axis=-1).reshape(len(low), -1)
    return np.repeat(time_s[first + starts], 2), curves


def _rows(
    x: Floats, curves: Sequence[Floats], outputs: Sequence[int], normalised: bool
) -> list[PlotRow]:
    size = None if normalised else common_size(curves)
    return [
        PlotRow(
            label=f"Output {number}",
            x=x,
            curves=np.stack([curve[rank] for curve in curves]),
            unit_size=size,
        )
        for rank, number in enumerate(outputs)
    ]


def _scale_label(rows: Sequence[PlotRow], normalised: bool, view: View) -> str:
    label = signal_label(view.axes, view.method)
    if normalised:
        return f"{label}; each row relative to its peak"
    return f"{label}; a row is {rows[0].size:.3g} m/s² high"


def _signals_figure(
    ax: Any, rows: Sequence[PlotRow], designs: Sequence[Design], words: tuple[str, str], **how: Any
) -> Any:
    """Draw rows into ``ax``, or a figure of their own; ``words``: label of x, and of the scale."""
    height_mm = _ROW_MM * len(rows) + _AROUND_MM
    target, is_new = axes_of(ax, _WIDTH_MM, height_mm)
    figure, (label, scale) = target.figure, words
    with style():
        draw_rows(target, rows, legend_above=True, **how)
        target.set_xlabel(label)
        annotate_scale(target, scale)
        if is_new and any(facts_of(design.limb).synthetic for design in designs):
            figure.text(0.99, 0.01, SYNTHETIC, ha="right", color=DIM, fontsize=6)
        if is_new:
            figure.subplots_adjust(left=0.14, right=0.97, bottom=_BELOW_MM / height_mm, top=0.88)
    return figure


_DEFAULT_COUNT = 5
_MAP_MM, _LEFT_MM, _RIGHT_MM, _HEIGHT_MM = 28.0, 17.0, 20.0, 95.0
_STRIPS_AROUND_MM = _LEFT_MM + _RIGHT_MM
#: More maps side by side are too small to read.
MOST_MAPS = 12


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WindowedLevels:
    """RMS of all outputs in each window of a design.

    Attributes
    ----------
    places
        Input places that play.
    limb_data, surface
        Places of the outputs, and how levels are interpolated between them.
    windows
        Samples of the windows.
    sample_rate_hz
        Rate of the response.
    rms_of_windows : (n_windows, n_outputs)
        In m/s².
    extents_of_windows
        How far each window reaches; None where nothing moves in it.
    noisy_outputs_of_windows, windows_in_noise
        Outputs of each window that are mostly noise, and whether all of it is.
    """

    places: tuple[int, ...]
    limb_data: Limb
    surface: SurfaceOperator
    windows: Windows
    sample_rate_hz: float
    rms_of_windows: Floats
    extents_of_windows: tuple[Extent | None, ...]
    noisy_outputs_of_windows: tuple[tuple[int, ...], ...]
    windows_in_noise: tuple[bool, ...]

    def maps(self, n: int) -> tuple[list[Levels], list[str]]:
        """Return the levels of the first ``n`` windows, and their titles."""
        levels = [
            Levels(
                limb=self.limb_data,
                surface=self.surface,
                values=values,
                places=self.places,
                noisy=noisy,
            )
            for values, noisy in zip(
                decibels(self.rms_of_windows[:n]), self.noisy_outputs_of_windows, strict=False
            )
        ]
        bounds_ms = 1e3 * np.asarray(self.windows.bounds_s(self.sample_rate_hz)[:n])
        return levels, [f"{begin:.0f} to {end:.0f} ms" for begin, end in bounds_ms]


def windowed_levels(
    design: Design, view: View | None = None, *, count: int | None, window_s: float | None
) -> WindowedLevels:
    """Return RMS and extent in each window of the signals that ``view`` projects."""
    if (count is None) == (window_s is None):
        raise InvalidInputError(
            f"count is {count} and window_s is {window_s}: expected one of them, and no other"
        )
    view = View(method="mag") if view is None else view
    if window_s is not None:
        view = replace(view, windows_cut="length", window_s=window_s)
    elif count is not None:
        view = replace(view, windows_cut="count", window_count=count)
    places = sorted({track.location for track in audible_inputs(design.inputs)})
    quantities = [field.name for field in fields(WindowedLevels) if field.name != "places"]
    results = evaluate(design, *quantities, view=view)
    return WindowedLevels(places=tuple(places), **results)


@checking
def strip(
    design: Design,
    *,
    view: View | None = None,
    count: int | None = None,
    window_s: float | None = None,
    range_db: Range | None = None,
    title: str = "",
) -> Any:
    """Draw a map for each of consecutive windows, all in one colour scale, and their extent.

    The first window begins after the pre-trigger delay.

    Parameters
    ----------
    design
        What is played.
    view
        Axes and method of the levels; the magnitude of all axes unless given.
    count, window_s
        Into how many windows the stimulus is cut, or how long each is; 5 windows unless given.
        At most 12 are drawn.
    range_db
        Levels of the lowest and the highest colour; from the loudest output 50 dB down unless
        given.
    title
        Title above it.

    Returns
    -------
    The figure.

    Raises
    ------
    InvalidInputError
        Nothing is played long enough for a window, or both ``count`` and ``window_s`` are given.
    MissingExtraError
        matplotlib is not installed.

    Examples
    --------
    >>> import skinsource as ss
    >>> train = ss.track(7, ss.waveforms.WaveletTrain())
    >>> figure = ss.plot.strip(ss.Design(limb="synthetic-4", inputs=(train,)), window_s=0.12)
    """
    if count is None and window_s is None:
        count = _DEFAULT_COUNT
    windowed = windowed_levels(design, view, count=count, window_s=window_s)
    n = min(windowed.windows.count, MOST_MAPS)
    if n == 0:
        raise InvalidInputError(
            "no whole window fits into the response; choose a shorter window, or a longer stimulus"
        )
    width_mm = _MAP_MM * n + _STRIPS_AROUND_MM
    figure = new_figure(width_mm, _HEIGHT_MM)
    with style():
        grid = figure.add_gridspec(
            2,
            n,
            height_ratios=(4.0, 1.0),
            # Text beside the axes takes as much room in a narrow figure as in a wide one.
            left=_LEFT_MM / width_mm,
            right=1.0 - _RIGHT_MM / width_mm,
            top=0.88,
            bottom=0.1,
            wspace=0.05,
        )
        maps = [figure.add_subplot(grid[0, k]) for k in range(n)]
        draw_strip(figure, maps, windowed, range_db)
        draw_extent(figure.add_subplot(grid[1, :]), windowed, n)
        if title:
            figure.suptitle(title, fontsize=9)
        note = _map_note(windowed.limb_data, any(windowed.noisy_outputs_of_windows[:n]))
        if note:
            figure.text(0.99, 0.01, note, ha="right", color=DIM, fontsize=6)
    return figure


def draw_strip(
    figure: Any, maps: list[Any], windowed: WindowedLevels, range_db: Range | None
) -> None:
    """Draw the first windows into ``maps``, and a colour bar beside the last one."""
    levels, titles = windowed.maps(len(maps))
    if range_db is None:
        range_db = common_range(decibels(windowed.rms_of_windows))
    image = draw_maps(maps, levels, range_db, titles)
    last = maps[-1].get_position()
    bar = figure.add_axes((last.x1 + 0.015, last.y0 + 0.15 * last.height, 0.012, 0.7 * last.height))
    figure.colorbar(image, cax=bar).set_label(_LEVEL)
    bar.set_frame_on(False)


def draw_extent(ax: Any, windowed: WindowedLevels, n: int) -> None:
    """Draw mean distance and the distance of 90 % of the energy over the first ``n`` windows."""
    # How noise is spread says nothing of what is played.
    pairs = zip(windowed.extents_of_windows[:n], windowed.windows_in_noise, strict=False)
    distances_mm = np.array(
        [
            (np.nan, np.nan)
            if extent is None or in_noise
            else (extent.mean_distance_mm, extent.d90_mm)
            for extent, in_noise in pairs
        ]
    )
    labels = ("mean distance", "90 % of the energy within")
    for values, label, colour in zip(distances_mm.T, labels, COLOURS, strict=False):
        ax.plot(np.arange(n) + 0.5, values, "o-", ms=3, color=colour, label=label)
    ax.set_xlim(0.0, n)
    ax.set_ylim(0.0, 1.1 * ax.dataLim.y1 if ax.dataLim.y1 > 0.0 else 1.0)
    ax.set_xticks([])
    ax.set_ylabel("mm from\nthe input")
    # The legend stands above the curves; over few windows its entries have no room side by side.
    columns = 2 if n > 2 else 1
    ax.legend(
        fontsize=6, loc="lower left", bbox_to_anchor=(0.0, 1.0), borderaxespad=0.1, ncols=columns
    )


#: Along z colours end at this share of the largest acceleration, which is near the input.
SHARE_OF_LARGEST = 0.25
_FILM_DPI = 220
#: Ten minutes.
MOST_FRAMES = 36_000


@checking
def film(
    design: Design,
    path: FilePath,
    *,
    view: View | None = None,
    quantity: Literal["z", "magnitude"] = "z",
    slow_motion: float | None = None,
    limit: float | None = None,
    title: str = "",
    progress: Progress = silent,
    stop: Stop = never,
) -> Path:
    """Write how the vibration travels over hand and arm, as MP4, WebM or GIF.

    It needs the extras ``plot`` and ``video``.  Rings mark active inputs.

    Parameters
    ----------
    design
        What is played.
    path
        The film; its name ends in ``.mp4``, ``.webm`` or ``.gif``.
    view
        Range of times, and whether the pre-trigger delay is removed; it is unless a view is given.
    quantity
        ``"z"``: acceleration normal to the skin; ``"magnitude"``: length of the acceleration.
    slow_motion
        How many times slower it runs than it happens; 20, or the least at which the fastest waves
        are visible, unless given.
    limit
        Acceleration of the last colour, m/s²; a quarter of the largest unless given.
    title
        Title above it.
    progress, stop
        Called with the progress; asked whether to stop.

    Returns
    -------
    The path.

    Raises
    ------
    InvalidInputError
        The ending is unknown, the film is too fast or too long, it shows no time of the response,
        or the limb has no z axis.
    MissingExtraError
        matplotlib or imageio-ffmpeg is not installed.
    StorageError, Stopped
        It cannot be written; ``stop`` said so.  Nothing is left then.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import skinsource as ss
    >>> tap = ss.Design(limb="synthetic-1", inputs=(ss.track(7, ss.waveforms.Tap()),))
    >>> moment = ss.View(time_range_s=(0.06, 0.061))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     print(ss.plot.film(tap, Path(folder) / "tap.gif", view=moment).name)
    tap.gif
    """
    target = Path(path)
    per_s = frames_per_s(target)
    one_of("quantity", quantity, ("z", "magnitude"))
    view = View(delay_removed=True) if view is None else view
    values = evaluate(design, "response_time_s", "limb_data", view=view)
    time_s, limb = values["response_time_s"], values["limb_data"]
    slower = _slow_motion(limb, quantity, per_s, slow_motion)
    first_s, last_s = view.time_range_s or (0.0, float(time_s[-1]))
    if last_s < time_s[0] or first_s > time_s[-1]:
        raise _beside(view.time_range_s, time_s)
    # The last instant belongs to the film, however its seconds are rounded.
    count = int((last_s - first_s) * per_s * slower + 1e-6) + 1
    if count > MOST_FRAMES:
        raise InvalidInputError(
            f"the film from {first_s:g} s to {last_s:g} s has {count} frames, expected at most "
            f"{MOST_FRAMES}. Choose a shorter time_range_s, or another slow_motion."
        )
    shot = _Shot(design, view, quantity, limit, f"{title}\n" if title else "", slower)
    height, width, _ = shot.frame(first_s).shape
    with video_file(
        target, (width, height), f"SkinSource, {limb_label(design.limb).title}", stop
    ) as add:
        for number in range(count):
            add(shot.frame(first_s + number / (per_s * slower)))
            progress(number + 1, count, "Drawing frames")
    return target


def _slow_motion(limb: Limb, quantity: str, per_s: int, chosen: float | None) -> float:
    """Return how many times slower a film runs; with fewer frames, waves seem to stand or go back.

    Raises
    ------
    InvalidInputError
        The chosen one has fewer than two frames in a period of the fastest waves.
    """
    least = least_slow_motion(limb, quantity, per_s)
    if chosen is None:
        return max(20.0, float(np.ceil(least)))
    if positive_number("slow_motion", chosen) < least:
        raise InvalidInputError(
            f"slow_motion is {chosen:g}, expected at least {least:g}: a faster film has fewer than "
            "two frames in a period of the fastest waves"
        )
    return chosen


def least_slow_motion(limb: Limb, quantity: str, per_s: int) -> float:
    """Return in how slow motion there are two frames in a period of the fastest waves."""
    highest_hz = limb.band_hz[1] if limb.band_hz else limb.sample_rate_hz / 2.0
    # The length of a vector moves twice as fast.
    return 2.0 * highest_hz * (2.0 if quantity == "magnitude" else 1.0) / per_s


class _Shot:
    """Draws one instant after another into the same figure."""

    def __init__(
        self,
        design: Design,
        view: View,
        quantity: str,
        limit: float | None,
        title: str,
        slower: float,
    ) -> None:
        self._design, self._view, self._title, self._slower = design, view, title, slower
        self._signed = quantity == "z"
        self._name = "moving_z" if self._signed else "moving_vector"
        levels = levels_of(design, None, view)
        self._surface = levels.surface
        largest = self._moving(0.0).largest * SHARE_OF_LARGEST
        end = (largest or 1.0) if limit is None else positive_number("limit", limit)
        self._figure = new_figure(*_MAP_FIGURE_MM)
        self._figure.set_dpi(_FILM_DPI)
        self._canvas = module("matplotlib.backends.backend_agg").FigureCanvasAgg(self._figure)
        self._ax = self._figure.add_subplot()
        with style():
            still = replace(levels, values=np.zeros_like(levels.values))
            colours = (-end if self._signed else 0.0, end)
            self._image = draw_map(self._ax, still, colours, title="\n", signed=self._signed)
            label = "z (m/s²)" if self._signed else "magnitude (m/s²)"
            note = _map_note(levels.limb, bool(levels.noisy))
            _finish([self._ax], self._image, label, note)
            # Colour bar and note are drawn once.
            self._ax.set_animated(True)
            self._canvas.draw()
        self._background = self._canvas.copy_from_bbox(self._figure.bbox)
        self._nearest = _nearest_inside(self._surface.interpolate(still.values))

    def _moving(self, time_s: float) -> Any:
        """Return the part of the response that holds an instant; before 0 s, the first."""
        view = replace(self._view, playhead_s=max(time_s, 0.0))
        return evaluate(self._design, self._name, view=view)[self._name]

    def frame(self, time_s: float) -> NDArray[np.uint8]:
        """Return an instant of the time axis, (rows, columns, 3), with even numbers of both."""
        moving = self._moving(time_s)
        at_s = time_s + (moving.delay_s if self._view.delay_removed else 0.0)
        values = moving.acceleration(at_s)[:, 0] if self._signed else moving.magnitude(at_s)
        self._image.set_data(self._surface.interpolate(values)[self._nearest])
        self._ax.title.set_text(
            f"{self._title}{1e3 * time_s:.1f} ms, 1/{self._slower:g} of real time"
        )
        self._canvas.restore_region(self._background)
        with style():
            self._figure.draw_artist(self._ax)
        pixels = np.asarray(self._canvas.buffer_rgba())[..., :3]
        rows, columns = (side // 2 * 2 for side in pixels.shape[:2])
        return pixels[:rows, :columns]


__all__ = ["film", "map", "spectra", "strip", "traces"]
