"""The figures of the shipped scenes, drawn without a window.

``skinsource figures --out FOLDER`` writes them.  To add one, draw it in one of these modules and
name it in `FIGURES` (`skinsource.figures.every_figure`).
"""

from skinsource.figures.every_figure import FIGURES
from skinsource.figures.writing import draw_figure, write_figures

__all__ = ["FIGURES", "draw_figure", "write_figures"]
