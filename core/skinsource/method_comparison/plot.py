"""The plot: time against worst-window error, one panel for each scene."""

import importlib
from collections.abc import Iterable, Sequence
from io import BytesIO
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from skinsource.errors import MissingExtraError
from skinsource.extras import extra_line
from skinsource.files import write_bytes
from skinsource.method_comparison.compared_limb import MADE_UP
from skinsource.method_comparison.every_scene import EVERY_ENGINE, any_scene, is_ours
from skinsource.method_comparison.method import Precision
from skinsource.method_comparison.pareto import pareto_front
from skinsource.method_comparison.promises import ANSWER_S, FRAME_S, PEAK_ERROR, WINDOW_ERROR
from skinsource.method_comparison.signal_scenes import SignalScene
from skinsource.method_comparison.table import Row
from skinsource.quoting import printable

# Of Okabe and Ito, then of Tol: one for each engine, as they share a legend.
_COLOURS = (
    "#000000", "#0072B2", "#E69F00", "#009E73", "#CC79A7", "#D55E00", "#56B4E9", "#7F7F7F",
    "#882255", "#44AA99", "#999933", "#332288", "#AA4499", "#661100",
)  # fmt: skip
_MARKERS: dict[Precision, str] = {"float64": "o", "float32": "^"}
_LARGEST_ERROR, _SMALLEST_ERROR = 10.0, 1e-17
#: Above the points there is room for words.
_LIMITS = (0.1 * _SMALLEST_ERROR, 1e3 * _LARGEST_ERROR)
_PANEL_INCHES, _DOTS_PER_INCH = (4.6, 4.1), 110
#: Panels in a row, by how many there are.
_COLUMNS = {1: 1, 2: 2, 3: 3, 4: 2}
_MOST_COLUMNS = 4
_ANSWER_COLOUR, _PROMISE_COLOUR, _FRONT_COLOUR = "#888888", "#B00020", "#BBBBBB"


def write_plots(rows: Sequence[Row], stem: Path) -> tuple[Path, Path]:
    """Write ``stem`` + ".svg" and ".png"; the same rows give the same files.

    Raises
    ------
    MissingExtraError
        matplotlib is not installed; the message holds the line to type.
    StorageError
        A file cannot be written.
    """
    matplotlib = _package("matplotlib")
    # Letters stay letters, and nothing random enters the file.
    style = {"svg.fonttype": "none", "svg.hashsalt": "skinsource", "font.size": 9.0}
    with matplotlib.rc_context(style):
        figure = _figure(rows)
        svg, png = stem.with_suffix(".svg"), stem.with_suffix(".png")
        for path, metadata in ((svg, {"Date": None}), (png, {"Software": None})):
            content = BytesIO()
            figure.savefig(content, format=path.suffix[1:], metadata=metadata)
            write_bytes(path, content.getvalue())
    return svg, png


def _package(name: str) -> ModuleType:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise MissingExtraError(
            f"the plot needs the package matplotlib, which cannot be imported "
            f"({printable(error)}). Install it with: {extra_line('bench')}; "
            "the table and the report were written."
        ) from error


def _figure(rows: Sequence[Row]) -> Any:
    keys = list(dict.fromkeys(row.scene for row in rows))
    columns = _COLUMNS.get(len(keys) + 1, _MOST_COLUMNS)
    lines = -(-(len(keys) + 1) // columns)
    size = columns * _PANEL_INCHES[0], lines * _PANEL_INCHES[1]
    figure = _package("matplotlib.figure").Figure(
        figsize=size, dpi=_DOTS_PER_INCH, layout="constrained"
    )
    axes = figure.subplots(lines, columns, squeeze=False).ravel()
    for panel, key in zip(axes, keys, strict=False):
        _draw_scene(panel, [row for row in rows if row.scene == key])
    for panel in axes[len(keys) :]:
        panel.set_axis_off()
    for limb in dict.fromkeys(row.limb for row in rows if row.limb != MADE_UP):
        figure.suptitle(f"{limb.name}: {limb.size}", fontsize=10)
    _draw_legend(axes[-1], rows)
    return figure


def _draw_scene(panel: Any, rows: Sequence[Row]) -> None:
    scene = any_scene(rows[0].scene, rows[0].limb)
    panel.set(xscale="log", yscale="log", ylim=_LIMITS)
    panel.set_title(f"{scene.key}: {scene.title}", fontsize=10, loc="left")
    panel.set_xlabel("fastest run, ms")
    panel.set_ylabel("worst error of a 100 ms window, re its peak")
    panel.xaxis.set_major_formatter(_package("matplotlib.ticker").FormatStrFormatter("%g"))
    panel.grid(visible=True, which="major", color="#EEEEEE", linewidth=0.7)
    panel.set_axisbelow(True)
    promised: Sequence[tuple[float, str]] = _PROMISED
    if isinstance(scene, SignalScene):
        promised = ((scene.allowed_error, "of the peak"),)
    _draw_lines(panel, scene.allowed_s, promised)
    front = pareto_front(rows)
    times = [float(row.t_min_ms or 0.0) for row in front]
    errors = [_shown(row) for row in front]
    panel.plot(times, errors, color=_FRONT_COLOUR, linewidth=4, drawstyle="steps-post", zorder=1)
    for row in rows:
        if not row.failure:
            panel.plot(row.t_min_ms, _shown(row), zorder=3, **_look(row))
    ours = 0
    for row in _noted(rows):
        # This program's own points crowd on one line, also with those of other exact engines.
        own = is_ours(row.engine)
        _note(panel, row, below=ours % 2 == 1 if own else row.promise != "none")
        ours += own
    low, high = panel.get_xlim()
    panel.set_xlim(low, 2.0 * high)
    failed = sum(bool(row.failure) for row in rows)
    if failed:
        text = f"{failed} could not: see the report"
        panel.text(0.02, 0.02, text, transform=panel.transAxes, fontsize=7, color="#666666")


def _noted(rows: Sequence[Row]) -> list[Row]:
    """Rows whose settings are written beside them: of each setting the slowest.

    The same setting of several engines makes nearly the same error.
    """
    measured = sorted((row for row in rows if not row.failure), key=lambda row: row.t_min_ms or 0.0)
    return list({row.setting: row for row in measured if row.setting != "exact"}.values())


def _note(panel: Any, row: Row, *, below: bool) -> None:
    panel.annotate(
        row.setting.replace("-", "\N{MINUS SIGN}"),
        (row.t_min_ms, _shown(row)),
        xytext=(3, -4 if below else 4),
        textcoords="offset points",
        va="top" if below else "bottom",
        fontsize=6,
        rotation=-30 if below else 30,
        color="#444444",
        zorder=4,
    )


_PROMISED = (
    (WINDOW_ERROR, "window, float64"),
    (PEAK_ERROR["float32"], "of the peak, float32"),
    (PEAK_ERROR["float64"], "of the peak, float64"),
)


def _draw_lines(panel: Any, allowed_s: float | None, promised: Sequence[tuple[float, str]]) -> None:
    """Draw promised errors, a frame, an answer, and what the scene may take."""
    for error, words in promised:
        panel.axhline(error, color=_PROMISE_COLOUR, linewidth=0.8, linestyle="--", zorder=1)
        panel.annotate(
            f"{np.format_float_scientific(error, 1, exp_digits=1, trim='-')} {words}",
            (1.0, error),
            xycoords=("axes fraction", "data"),
            xytext=(-3, 2),
            textcoords="offset points",
            ha="right",
            fontsize=6.5,
            color=_PROMISE_COLOUR,
        )
    for time_s in (FRAME_S, ANSWER_S) if allowed_s is None else (FRAME_S, ANSWER_S, allowed_s):
        panel.axvline(1e3 * time_s, color=_ANSWER_COLOUR, linewidth=0.8, linestyle=":", zorder=1)
        panel.annotate(
            f"{1e3 * time_s:g} ms" if time_s < 1.0 else f"{time_s:g} s",
            (1e3 * time_s, 1.0),
            xycoords=("data", "axes fraction"),
            xytext=(2, -9),
            textcoords="offset points",
            fontsize=7,
            color=_ANSWER_COLOUR,
        )


def _draw_legend(panel: Any, rows: Sequence[Row]) -> None:
    lines = _package("matplotlib.lines")

    def handle(label: str, look: dict[str, Any]) -> Any:
        return lines.Line2D([], [], label=label, **look)

    handles = [
        handle(name, {"color": colour, "marker": "s", "linestyle": "none"})
        for name, colour in _colours(row.engine for row in rows).items()
    ]
    handles += [
        handle(
            precision,
            {"color": "#555555", "marker": marker, "linestyle": "none", "markerfacecolor": "none"},
        )
        for precision, marker in _MARKERS.items()
    ]
    handles += [
        handle("makes no error but rounding", {"color": "#555555", "marker": "o", "linestyle": ""}),
        handle(
            "trades error for time",
            {"color": "#555555", "marker": "o", "linestyle": "", "markerfacecolor": "white"},
        ),
        handle("nothing is both faster and better", {"color": _FRONT_COLOUR, "linewidth": 4}),
        handle("promised error", {"color": _PROMISE_COLOUR, "linestyle": "--"}),
        handle("a frame, an answer", {"color": _ANSWER_COLOUR, "linestyle": ":"}),
    ]
    panel.legend(handles=handles, loc="center", frameon=False, title="lower left is better")


def _look(row: Row) -> dict[str, Any]:
    colour = _colours([row.engine])[row.engine]
    return {
        "color": colour,
        "marker": next(mark for name, mark in _MARKERS.items() if name == row.precision),
        "markersize": 6,
        "markerfacecolor": "white" if row.promise == "none" else colour,
        "linestyle": "none",
    }


def _colours(names: Iterable[str]) -> dict[str, str]:
    """Colour of each engine: always the same, whichever of them are drawn."""
    places = list(dict.fromkeys(engine.name for engine in EVERY_ENGINE))
    return {name: _COLOURS[places.index(name)] for name in dict.fromkeys(names)}


def _shown(row: Row) -> float:
    """Error, kept within the panel; what is not a number is at its top."""
    error = row.err_window
    if error is None or not error <= _LARGEST_ERROR:
        return _LARGEST_ERROR
    return max(error, _SMALLEST_ERROR)
