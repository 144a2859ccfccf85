"""Maps of the back of hand and arm."""

from typing import Any, Literal

import numpy as np
import scipy
from numpy.typing import ArrayLike

from skinsource.analysis.noise import LEAST_ABOVE_NOISE_DB
from skinsource.arrays import Floats
from skinsource.design import Design
from skinsource.limb import Limb
from skinsource.plot.levels import Levels, Range, common_range, levels_of
from skinsource.plot.paper import COLOURS, DIM, INK, SYNTHETIC, axes_of, module, style
from skinsource.surface import SurfaceOperator
from skinsource.view import View

Bar = Literal["drawn", "room", "none"]
Part = Literal["arm", "hand"]
_COLOUR_MAP, _SIGNED_COLOUR_MAP = "viridis", "RdBu_r"
# Beside the wrist there is less room than below the arm.
_BAR_MM: dict[Part, float] = {"arm": 50.0, "hand": 20.0}
# Room for it and its words below the limb.
_BELOW_MM = 24.0
# The hand and a little of the wrist, in hand lengths.
_HAND_PART = 1.06
# Around an output, about half of the way to its neighbours, in hand lengths.
_NOISE_REACH = 0.08
# Seen on dark and on light colours.
_STROKES, _STROKE_COLOUR = "//////", "#B0B0B0"
#: What strokes over a map mean.
HATCHED = f"Hatched: less than {LEAST_ABOVE_NOISE_DB:g} dB above the noise of the measurement"
_ALONE_MM = (75.0, 115.0)


def map(
    shown: Design | ArrayLike,
    *,
    limb: Limb | str | None = None,
    view: View | None = None,
    range_db: Range | None = None,
    outputs: tuple[int, ...] = (),
    title: str = "",
    ax: Any = None,
) -> Any:
    """Draw levels over the back of hand and arm.

    Parameters
    ----------
    shown
        A design, or levels of all outputs, (n_outputs,), in dB re 1 m/s².
    limb
        Whose levels these are; a design knows its own.
    view
        Axes, method and span of the levels of a design; ``View()`` where none is given.
    range_db
        Levels of the lowest and the highest colour; from the loudest output 50 dB down unless
        given.
    outputs
        Outputs that are ringed and numbered.
    title
        Stands above it.
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
    colours = common_range(levels.values) if range_db is None else range_db
    on, alone = axes_of(ax, *_ALONE_MM)
    with style():
        image = draw_map(on, levels, colours, outputs=outputs, title=title)
        if alone:
            colour_bar(on.figure, image, [on], "dB re 1 m/s²")
            # A synthetic limb has no noise: there is one of them to be said, or neither.
            words = SYNTHETIC if levels.limb.synthetic else HATCHED if levels.noisy else ""
            if words:
                on.figure.text(0.5, 0.01, words, ha="center", color=DIM, fontsize=6)
    return on.figure


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
        Whether values have a sign, and 0 in the middle of the colours.
    bar
        Whether a bar beside the limb says how long 50 mm are, 20 mm of a hand; ``"room"`` leaves
        room for it, so that maps side by side are alike.
    part
        ``"arm"``: all of it; ``"hand"``: down to the wrist.

    Outputs of ``levels`` that are mostly noise are hatched.
    """
    limb = levels.limb
    scale = limb.hand_length_mm / limb.map.hand_length_px
    table = _SIGNED_COLOUR_MAP if signed else _COLOUR_MAP
    image, outline = _draw_field(ax, levels, colours, table)
    reach_mm = _NOISE_REACH * limb.hand_length_mm
    _hatch(ax, limb.map.output_positions * scale, levels.noisy, reach_mm, outline)
    _mark(ax, limb.map.input_positions * scale, levels.places, "input")
    _mark(ax, limb.map.output_positions * scale, outputs, "output")
    low, high = _bounds(limb, part)
    ax.set_xlim(low[0] - 4.0, high[0] + 4.0)
    ax.set_ylim(low[1] - (4.0 if bar == "none" else _BELOW_MM), high[1] + 4.0)
    ax.set_aspect("equal")
    ax.set_axis_off()
    if bar == "drawn":
        _millimetre_bar(ax, float(high[0]), float(low[1]), _BAR_MM[part])
    if title:
        ax.set_title(title)
    return image


def _draw_field(ax: Any, levels: Levels, colours: Range, colour_map: str) -> tuple[Any, Any]:
    """Draw the interpolated map, cut by the outline; return both."""
    surface, limb = levels.surface, levels.limb
    half = (surface.x_mm[1] - surface.x_mm[0]) / 2.0
    x, y = surface.x_mm, surface.y_mm
    image = ax.imshow(
        _beyond(surface, levels.values),
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
    """Strokes around outputs that are mostly noise, cut by the outline."""
    places = [positions[number - 1] for number in noisy]
    shown = [place for place in places if np.isfinite(place).all()]
    if not shown:
        return
    path = module("matplotlib.path").Path
    discs = path.make_compound_path(*(path.circle(place, reach_mm) for place in shown))
    strokes = module("matplotlib.patches").PathPatch(
        discs, fill=False, hatch=_STROKES, edgecolor=_STROKE_COLOUR, linewidth=0.0
    )
    ax.add_patch(strokes)
    strokes.set_clip_path(outline)


def _bounds(limb: Limb, part: Part) -> tuple[Floats, Floats]:
    """Lower left and upper right corner of what is shown, mm."""
    outline = limb.map.outline * (limb.hand_length_mm / limb.map.hand_length_px)
    if part == "hand":
        wrist = outline[:, 1].max() - _HAND_PART * limb.hand_length_mm
        outline = outline[outline[:, 1] >= wrist]
    return outline.min(axis=0), outline.max(axis=0)


def colour_bar(figure: Any, image: Any, axes: list[Any], label: str) -> Any:
    """Add a colour bar beside ``axes``."""
    bar = figure.colorbar(image, ax=axes, shrink=0.55, aspect=18, pad=0.02)
    bar.set_label(label)
    bar.outline.set_linewidth(0.5)
    return bar


def _beyond(surface: SurfaceOperator, values: Floats) -> Floats:
    """The map, (rows, columns), carried on beyond the outline, which cuts it."""
    inside = surface.interpolate(values)
    outside = np.isnan(inside)
    rows, columns = scipy.ndimage.distance_transform_edt(
        outside, return_distances=False, return_indices=True
    )
    return np.asarray(inside[rows, columns])


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


def _millimetre_bar(ax: Any, right_mm: float, bottom_mm: float, long_mm: float) -> None:
    x, y = (right_mm - long_mm, right_mm), bottom_mm - 0.35 * _BELOW_MM
    ax.plot(x, (y, y), color=INK, lw=1.2)
    ax.text(sum(x) / 2, y - 3.0, f"{long_mm:g} mm", ha="center", va="top", fontsize=6)
