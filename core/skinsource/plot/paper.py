"""What is drawn on: figures of matplotlib that know neither a window nor Qt."""

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from io import BytesIO
from typing import Any

from skinsource.extras import package_of_extra

EXTRA = "plot"
MM_PER_INCH = 25.4
#: Ink for lines and words, and for what stands back.
INK, DIM = "#222222", "#666666"
#: Colours of curves; told apart with any colour vision (Okabe and Ito).
COLOURS = ("#0072B2", "#D55E00", "#000000", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
SYNTHETIC = "SYNTHETIC LIMB: computed responses, not measured ones"

_STYLE = {
    "axes.edgecolor": INK,
    "axes.labelcolor": INK,
    "axes.linewidth": 0.6,
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.titlesize": 8.0,
    "figure.dpi": 110.0,
    "font.family": "DejaVu Sans",
    "font.size": 7.0,
    "legend.frameon": False,
    "lines.linewidth": 0.8,
    # Letters stay letters, and nothing random enters the file.
    "pdf.fonttype": 42,
    "svg.fonttype": "none",
    "svg.hashsalt": "skinsource",
    "text.color": INK,
    "xtick.color": INK,
    "ytick.color": INK,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
}


def module(name: str) -> Any:
    """Import matplotlib, or a module of it.

    Raises
    ------
    MissingExtraError
        It is not installed; the message names the extra.
    """
    return package_of_extra(name, EXTRA)


@contextmanager
def style() -> Iterator[None]:
    """Draw, or save, as all drawings of this package look."""
    with module("matplotlib").rc_context(_STYLE):
        yield


def new_figure(width_mm: float, height_mm: float) -> Any:
    """An empty figure that shows itself in a notebook."""
    module("matplotlib.backends.backend_agg")
    size = (width_mm / MM_PER_INCH, height_mm / MM_PER_INCH)
    with style():
        return _figure_class()(figsize=size, facecolor="white")


def axes_of(ax: Any, width_mm: float, height_mm: float) -> tuple[Any, bool]:
    """Axes to draw into, and whether they are alone in a figure of their own."""
    if ax is not None:
        return ax, False
    with style():
        return new_figure(width_mm, height_mm).add_subplot(), True


@cache
def _figure_class() -> Any:
    figure: Any = module("matplotlib.figure").Figure

    class Drawing(figure):  # type: ignore[misc]
        """A figure that is saved with real text, whatever else is set."""

        def savefig(self, *args: Any, **kwargs: Any) -> None:
            """Save it; see matplotlib."""
            with style():
                super().savefig(*args, **kwargs)

        def _repr_png_(self) -> bytes:
            content = BytesIO()
            self.savefig(content, format="png", dpi=110, bbox_inches="tight")
            return content.getvalue()

    return Drawing
