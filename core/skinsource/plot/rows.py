"""Curves in rows under each other."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from skinsource.arrays import Floats
from skinsource.plot.paper import COLOURS, DIM

# A row is so high that curves of neighbours do not touch.
_ROOM = 2.3
# Height of a legend, as a part of a row.
_LEGEND = 0.3


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Row:
    """One row of a drawing.

    Attributes
    ----------
    label
        Beside it.
    x : (n,)
        Times in ms or frequencies in Hz.
    curves : (n_curves, n)
        What is drawn over each other.
    unit_size
        What fills the row; None: the largest of its own curves.
    """

    label: str
    x: Floats
    curves: Floats
    unit_size: float | None = None

    @property
    def size(self) -> float:
        """What fills the row; 1 where nothing moves."""
        size = float(np.abs(self.curves).max(initial=0.0))
        return (size if self.unit_size is None else self.unit_size) or 1.0


def common_size(rows: Sequence[Floats]) -> float:
    """What fills every row where they have one scale."""
    return max((float(np.abs(one).max(initial=0.0)) for one in rows), default=0.0)


def draw_rows(
    ax: Any,
    rows: Sequence[Row],
    *,
    labels: Sequence[str] = (),
    colours: Sequence[str] = COLOURS,
    from_zero: bool = False,
    title: str = "",
    legend_apart: bool = False,
) -> None:
    """Draw rows into ``ax``, the first one on top.

    Parameters
    ----------
    ax
        Axes of matplotlib.
    rows
        What is drawn.
    labels
        Of the curves of a row, for a legend; none: no legend.
    colours
        Of the curves of a row.
    from_zero
        Whether curves are never negative, and stand on the line of their row.
    title
        Stands above.
    legend_apart
        Whether there is room for the legend above the first row, so that it lies on no curve.
    """
    room = 1.15 if from_zero else _ROOM
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
    top = 1.15 + (_LEGEND * room if labels and legend_apart else 0.0)
    ax.set_ylim(-room * (len(rows) - 1) - (0.1 if from_zero else 1.15), top)
    if rows:
        ax.set_xlim(float(rows[0].x[0]), float(rows[0].x[-1]))
    if labels:
        ax.legend(loc="upper right", ncols=len(labels), fontsize=6, borderaxespad=0.0)
    if title:
        ax.set_title(title)


def say_scale(ax: Any, words: str) -> None:
    """Say above ``ax`` what the height of a row means."""
    ax.annotate(
        words,
        (0.0, 1.0),
        xycoords="axes fraction",
        xytext=(0, 3),
        textcoords="offset points",
        fontsize=6,
        color=DIM,
    )
