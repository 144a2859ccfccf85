"""A picture that can be drawn, and how large it usually is."""

from collections.abc import Callable
from dataclasses import dataclass

from skinsource_gui.widgets.pictures.picture_file import Draw

#: In place of the name of a panel: the one in use, and all that are in sight.
IN_USE, ALL_IN_SIGHT = "panel in use", "all panels in sight"

#: Asked for the height of letters, px, in a picture of that width and height.
Letters = Callable[[int, int], float]


@dataclass(frozen=True, slots=True, kw_only=True)
class WholePicture:
    """A picture that can be drawn.

    Attributes
    ----------
    draw
        Draws it, with a ``theme`` for its colours.
    title
        Of the panel that it shows; "" where that is more than one.
    caption
        The words below it, which are a part of what is drawn.
    size_px
        Width and height that it usually has; None: whoever wants it knows.
    seen
        What part of it is in sight, for whoever draws the same by other means; None: all of it.
    letters_px
        Height of its smallest letters where these shrink and grow with it; None: they do not.
    """

    draw: Draw
    title: str = ""
    caption: str = ""
    size_px: tuple[int, int] | None = None
    seen: object | None = None
    letters_px: Letters | None = None
