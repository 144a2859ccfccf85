"""The page of a figure: heading, drawing, and what must be said below it."""

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from skinsource.arrays import Floats
from skinsource.figures.conditions import left_words, setup_words
from skinsource.plot.paper import DIM, INK, MM_PER_INCH, SYNTHETIC, new_figure, style
from skinsource.quoting import sentence
from skinsource.scenes import OpenedScene

#: Two columns of a journal.
WIDTH_MM = 180.0
_EDGE_MM, _HEAD_MM, _LINE_MM, _FOOT_EDGE_MM = 4.0, 9.0, 3.2, 3.0
_CHARACTERS = 128


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Table:
    """Numbers of a drawing.

    Attributes
    ----------
    header
        Names of the columns, with units.
    rows : (n_rows, n_columns)
        The numbers.
    """

    header: Sequence[str]
    rows: Floats


class Sheet:
    """A page for a drawing.

    Parameters
    ----------
    opened
        The scene: its heading stands above, its sentence, source and what is inferred below.
    height_mm
        Of the drawing alone.
    note
        What more is to be said of the drawing; "": nothing.
    maps
        Whether it shows some: conditions of the measurement that are about maps are told.

    Attributes
    ----------
    figure
        Of matplotlib.
    maps
        As given.
    """

    def __init__(
        self, opened: OpenedScene, height_mm: float, note: str = "", *, maps: bool = False
    ) -> None:
        self.maps = maps
        lines = _foot(opened, note, left_words(opened, maps=maps))
        self._foot_mm = _LINE_MM * len(lines) + 2 * _FOOT_EDGE_MM
        self._height_mm = height_mm + _HEAD_MM + self._foot_mm
        self.figure = new_figure(WIDTH_MM, self._height_mm)
        with style():
            self._say(_EDGE_MM, self._height_mm - 6.0, opened.scene.heading, INK, 9.0, "bold")
            for k, (words, colour) in enumerate(lines):
                y_mm = self._foot_mm - _FOOT_EDGE_MM - _LINE_MM * (k + 1)
                self._say(_EDGE_MM, y_mm, words, colour, 6.5)

    def axes(self, x_mm: float, y_mm: float, width_mm: float, height_mm: float) -> Any:
        """Axes at a place of the drawing, measured from its lower left corner."""
        height = self._height_mm
        return self.figure.add_axes(
            (
                x_mm / WIDTH_MM,
                (y_mm + self._foot_mm) / height,
                width_mm / WIDTH_MM,
                height_mm / height,
            )
        )

    def picture_inches(self) -> tuple[float, float, float, float]:
        """Corners of the drawing without heading and words, as `savefig` takes them: inches."""
        low, high = self._foot_mm, self._height_mm - _HEAD_MM + 1.0
        return 0.0, low / MM_PER_INCH, WIDTH_MM / MM_PER_INCH, high / MM_PER_INCH

    def row_of_axes(
        self, n: int, x_mm: float, y_mm: float, width_mm: float, height_mm: float
    ) -> list[Any]:
        """``n`` axes beside each other that fill an area."""
        each = width_mm / n
        return [self.axes(x_mm + k * each, y_mm, each - 1.0, height_mm) for k in range(n)]

    def colour_bar(self, image: Any, x_mm: float, y_mm: float, height_mm: float, words: str) -> Any:
        """A colour bar 2.5 mm wide."""
        bar = self.figure.colorbar(image, cax=self.axes(x_mm, y_mm, 2.5, height_mm))
        bar.set_label(words)
        bar.outline.set_linewidth(0.4)
        return bar

    def _say(
        self, x_mm: float, y_mm: float, words: str, colour: str, size: float, weight: str = "normal"
    ) -> None:
        at = x_mm / WIDTH_MM, y_mm / self._height_mm
        self.figure.text(*at, words, color=colour, fontsize=size, fontweight=weight)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Drawn:
    """A figure and its numbers.

    Attributes
    ----------
    sheet
        What it is drawn on.
    tables
        By what is added to the name of their file; the first one adds nothing.
    """

    sheet: Sheet
    tables: dict[str, Table]

    @property
    def figure(self) -> Any:
        """The figure of matplotlib."""
        return self.sheet.figure


def _foot(opened: OpenedScene, note: str, left: str) -> list[tuple[str, str]]:
    """Lines below a drawing, each with its colour; ``left``: what is not kept."""
    known = opened.scene
    said = [(known.sentence, INK), (f"After {known.source}.", DIM)]
    if known.inferred:
        said.append((sentence(f"Inferred: {'; '.join(known.inferred)}"), DIM))
    said += [(words, DIM) for words in (setup_words(opened), left, note) if words]
    if opened.chosen:
        said.append((opened.chosen, INK))
    if opened.synthetic:
        words = f"{SYNTHETIC}; they need not do what the sentence says."
        said.append((words, "#B00020"))
    return [(line, colour) for words, colour in said for line in textwrap.wrap(words, _CHARACTERS)]
