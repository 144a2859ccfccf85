"""The plot: error against run time, a panel for each case."""

from collections.abc import Sequence
from io import BytesIO
from pathlib import Path
from typing import Any

from skinsource.accuracy.measuring import Row, best_of
from skinsource.extras import package_of_extra
from skinsource.files import write_bytes
from skinsource.plot.paper import COLOURS, style

#: Errors beyond these are drawn at the edge.
LEAST_ERROR, MOST_ERROR = 1e-17, 10.0
_EXTRA = "bench"
_COLUMNS, _PANEL_INCHES = 4, 2.4


def write_plots(rows: Sequence[Row], stem: Path) -> None:
    """Write ``stem`` + ".svg" and ".png"; the same rows give the same files.

    Raises
    ------
    MissingExtraError
        matplotlib is not installed; the message holds the line to type.
    StorageError
        A file cannot be written.
    """
    new_figure = package_of_extra("matplotlib.figure", _EXTRA).Figure
    with style():
        names = list(dict.fromkeys(row.case for row in rows))
        lines = -(-len(names) // _COLUMNS)
        size = _COLUMNS * _PANEL_INCHES, (lines + 0.5) * _PANEL_INCHES
        figure = new_figure(figsize=size, layout="constrained")
        panels = figure.subplots(lines, _COLUMNS, squeeze=False, sharey=True).flat
        for panel in panels[len(names) :]:
            panel.remove()
        shown_ms = [1e3 * row.time_s for row in rows]
        for panel, name in zip(panels, names, strict=False):
            _draw(panel, [row for row in rows if row.case == name])
            panel.set_xlim(0.5 * min(shown_ms), 2.0 * max(shown_ms))
        figure.supylabel("largest error over the largest exact value")
        handles = {h.get_label(): h for panel in figure.axes for h in panel.get_lines()[1:]}
        figure.legend(handles=list(handles.values()), loc="outside lower center", ncols=_COLUMNS)
        for kind, metadata in (("svg", {"Date": None}), ("png", {"Software": None})):
            content = BytesIO()
            figure.savefig(content, format=kind, metadata=metadata)
            write_bytes(stem.with_suffix(f".{kind}"), content.getvalue())


def _draw(panel: Any, rows: Sequence[Row]) -> None:
    best = best_of(rows)
    times, errors = [1e3 * row.time_s for row in best], [_shown(row) for row in best]
    panel.plot(times, errors, color="#CCCCCC", linewidth=3.0, drawstyle="steps-post")
    for row, colour in zip(rows, COLOURS, strict=False):
        panel.plot(1e3 * row.time_s, _shown(row), "o", color=colour, label=row.way)
    panel.set(title=rows[0].case, xlabel="fastest run, ms", xscale="log", yscale="log")
    panel.set_ylim(LEAST_ERROR, MOST_ERROR)


def _shown(row: Row) -> float:
    return min(max(row.error, LEAST_ERROR), MOST_ERROR)
