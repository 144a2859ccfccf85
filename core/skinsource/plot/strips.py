"""Maps of windows that follow each other, and how far the vibration reaches in each."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from skinsource.analysis import Extent, Windows
from skinsource.arrays import Floats
from skinsource.decibels import decibels
from skinsource.design import Design, audible_inputs
from skinsource.errors import InvalidInputError
from skinsource.evaluation import evaluate
from skinsource.limb import Limb
from skinsource.plot.levels import Levels, Range, common_range
from skinsource.plot.maps import HATCHED, draw_map
from skinsource.plot.paper import COLOURS, DIM, SYNTHETIC, new_figure, style
from skinsource.quoting import quoted
from skinsource.view import View

_USUAL_COUNT = 5
_MAP_MM, _LEFT_MM, _RIGHT_MM, _HEIGHT_MM = 28.0, 17.0, 20.0, 95.0
_AROUND_MM = _LEFT_MM + _RIGHT_MM
_QUANTITIES = (
    "limb_data",
    "surface",
    "windows",
    "sample_rate_hz",
    "rms_of_windows",
    "extents_of_windows",
    "noisy_outputs_of_windows",
    "windows_in_noise",
)
#: More maps side by side cannot be read.
MOST_MAPS = 12


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WindowedLevels:
    """RMS of all outputs in each window of a design.

    Attributes
    ----------
    limb, surface
        Where the outputs are.
    places
        Input places that play.
    windows
        Where the windows lie.
    sample_rate_hz
        Of the response.
    rms : (n_windows, n_outputs)
        In m/s².
    extents
        How far each window reaches; None where nothing moves in it.
    noisy, in_noise
        Outputs of each window that are mostly noise, and whether all of it is.
    """

    limb: Limb
    surface: Any
    places: tuple[int, ...]
    windows: Windows
    sample_rate_hz: float
    rms: Floats
    extents: tuple[Extent | None, ...]
    noisy: tuple[tuple[int, ...], ...]
    in_noise: tuple[bool, ...]


def windowed_levels(
    design: Design, view: View | None = None, *, count: int | None, window_s: float | None
) -> WindowedLevels:
    """Return RMS and extent in each window of what ``view`` projects."""
    if not isinstance(design, Design):
        raise InvalidInputError(f"design is {quoted(design)}, expected a Design")
    if (count is None) == (window_s is None):
        raise InvalidInputError(
            f"count is {count} and window_s is {window_s}: expected one of them, and no other"
        )
    looked = View(method="mag") if view is None else view
    if window_s is not None:
        looked = replace(looked, windows_cut="length", window_s=window_s)
    elif count is not None:
        looked = replace(looked, windows_cut="count", window_count=count)
    found = evaluate(design, *_QUANTITIES, view=looked)
    return WindowedLevels(
        limb=found["limb_data"],
        surface=found["surface"],
        places=tuple(sorted({one.location for one in audible_inputs(design.inputs)})),
        windows=found["windows"],
        sample_rate_hz=found["sample_rate_hz"],
        rms=found["rms_of_windows"],
        extents=found["extents_of_windows"],
        noisy=found["noisy_outputs_of_windows"],
        in_noise=found["windows_in_noise"],
    )


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

    Windows begin as late as the pre-trigger delay is long.

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
        Stands above.

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
        count = _USUAL_COUNT
    found = windowed_levels(design, view, count=count, window_s=window_s)
    n = min(found.windows.count, MOST_MAPS)
    if n == 0:
        raise InvalidInputError(
            "no whole window fits into the response; choose a shorter one, or a longer stimulus"
        )
    return _drawn(found, n, range_db, title)


def _drawn(found: WindowedLevels, n: int, range_db: Range | None, title: str) -> Any:
    """A figure of the first ``n`` windows."""
    width_mm = _MAP_MM * n + _AROUND_MM
    figure = new_figure(width_mm, _HEIGHT_MM)
    with style():
        grid = figure.add_gridspec(
            2,
            n,
            height_ratios=(4.0, 1.0),
            # Words beside the axes take as much room in a narrow figure as in a wide one.
            left=_LEFT_MM / width_mm,
            right=1.0 - _RIGHT_MM / width_mm,
            top=0.88,
            bottom=0.1,
            wspace=0.05,
        )
        maps = [figure.add_subplot(grid[0, k]) for k in range(n)]
        draw_strip(figure, maps, found, range_db)
        draw_extent(figure.add_subplot(grid[1, :]), found, n)
        if title:
            figure.suptitle(title, fontsize=9)
        words = SYNTHETIC if found.limb.synthetic else HATCHED if any(found.noisy[:n]) else ""
        if words:
            figure.text(0.99, 0.01, words, ha="right", color=DIM, fontsize=6)
    return figure


def draw_strip(figure: Any, maps: list[Any], found: WindowedLevels, range_db: Range | None) -> None:
    """Draw the first windows into ``maps``, and a colour bar beside the last one."""
    levels_db = decibels(found.rms)
    colours = common_range(levels_db) if range_db is None else range_db
    bounds = found.windows.bounds_s(found.sample_rate_hz)
    image = None
    for k, ax in enumerate(maps):
        levels = Levels(
            limb=found.limb,
            surface=found.surface,
            values=levels_db[k],
            places=found.places,
            noisy=found.noisy[k],
        )
        begin, end = (1e3 * one for one in bounds[k])
        title = f"{begin:.0f} to {end:.0f} ms"
        image = draw_map(
            ax, levels, colours, title=title, bar="room" if k < len(maps) - 1 else "drawn"
        )
    last = maps[-1].get_position()
    bar = figure.add_axes((last.x1 + 0.015, last.y0 + 0.15 * last.height, 0.012, 0.7 * last.height))
    figure.colorbar(image, cax=bar).set_label("dB re 1 m/s²")
    bar.set_frame_on(False)


def draw_extent(ax: Any, found: WindowedLevels, n: int) -> None:
    """Draw mean distance and the distance of 90 % of the energy over the first ``n`` windows."""
    nothing = Extent(
        mean_distance_mm=np.nan,
        share_above_12_db=np.nan,
        share_above_20_db=np.nan,
        d90_mm=np.nan,
        participation=np.nan,
    )
    # How noise is spread says nothing of what is played.
    pairs = zip(found.extents[:n], found.in_noise, strict=False)
    extents = [nothing if one is None or in_noise else one for one, in_noise in pairs]
    middles = np.arange(n) + 0.5
    curves = (
        ("mean distance", [one.mean_distance_mm for one in extents]),
        ("90 % of the energy within", [one.d90_mm for one in extents]),
    )
    for (label, values), colour in zip(curves, COLOURS, strict=False):
        ax.plot(middles, values, "o-", ms=3, color=colour, label=label)
    ax.set_xlim(0.0, n)
    ax.set_ylim(0.0, 1.1 * ax.dataLim.y1 if ax.dataLim.y1 > 0.0 else 1.0)
    ax.set_xticks([])
    ax.set_ylabel("mm from\nthe input")
    # Above, where no curve runs; over few windows there is no room for both side by side.
    columns = 2 if n > 2 else 1
    ax.legend(
        fontsize=6, loc="lower left", bbox_to_anchor=(0.0, 1.0), borderaxespad=0.1, ncols=columns
    )
