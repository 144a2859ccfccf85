"""What is drawn in a diagram."""

from dataclasses import dataclass

from skinsource.base.arrays import Floats
from skinsource_gui.widgets.figure.axes import Axis

#: Radius of the dots.
DOT_PX = 3.5


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Curve:
    """A line, or dots.

    Attributes
    ----------
    x, y : (n_points,)
        Where it goes.
    rank
        Of the output in the selection: its colour; None: that of words.
    width_px
        Of the line; 0: dots.
    label
        Written at its end.
    pale
        0 to 1: how much of the colour is left out, so that what lies over it is seen.
    """

    x: Floats
    y: Floats
    rank: int | None
    width_px: float
    pale: float = 0.0
    label: str = ""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Diagram:
    """Curves, the first lowest, over two axes."""

    x: Axis
    y: Axis
    curves: tuple[Curve, ...]
