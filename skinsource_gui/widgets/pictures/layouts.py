"""Sizes of pictures for print and for the screen."""

from collections.abc import Callable
from dataclasses import dataclass

#: Pixels in an inch of a page or a drawing, as in CSS.
PER_INCH = 96

#: Told width and height of a picture, px: how much higher a page is that has words below it.
Below = Callable[[int, int], int]


@dataclass(frozen=True, slots=True, kw_only=True)
class Layout:
    """A size for a purpose.

    Attributes
    ----------
    name, title
        Short name; what the page says.
    width_in, height_in
        Inches; a height of 0 follows from the picture.
    dpi
        Dots in an inch of a PNG.
    """

    name: str
    title: str
    width_in: float
    height_in: float = 0.0
    dpi: int = 300

    def size_px(self, usual: tuple[int, int], below: Below | None = None) -> tuple[int, int]:
        """Width and height, px, of a picture that usually has the size ``usual``.

        Where the height follows from the picture, what stands ``below`` comes to it.
        """
        width = round(self.width_in * PER_INCH)
        if self.height_in:
            return width, round(self.height_in * PER_INCH)
        height = max(round(width * usual[1] / usual[0]), 100)
        return width, height + (0 if below is None else below(width, height))


#: Columns are those of IEEE's journals; a poster's figure is as wide as a sheet of A3.
LAYOUTS = (
    Layout(name="column", title="One column (89 mm)", width_in=3.5),
    Layout(name="two_columns", title="Two columns (182 mm)", width_in=7.16),
    Layout(name="slide", title="Slide (16 : 9)", width_in=13.333, height_in=7.5, dpi=144),
    Layout(name="poster", title="Poster (420 mm)", width_in=16.54),
)
#: What has none of these sizes.
OWN = "own"


def layout_of(name: str) -> Layout | None:
    """The layout of that name; None for a size of one's own."""
    return next((one for one in LAYOUTS if one.name == name), None)
