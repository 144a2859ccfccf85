"""What the right button offers on a curve of breakpoints, wherever there is one."""

from collections.abc import Callable
from functools import partial

from PySide6.QtWidgets import QMenu

from skinsource.specs.fields import SEGMENTS, Segment

#: How the curve goes on after a point.
SEGMENT_WORDS = {"straight": "straight on", "smooth": "smoothly on", "held": "held"}


def fill_point_menu(
    menu: QMenu,
    remove: Callable[[], object],
    *,
    bend: Callable[[Segment], object] | None = None,
    n_chosen: int = 1,
    n_points: int,
) -> None:
    """Offer to remove a point, and to let the curve go on otherwise after it.

    Parameters
    ----------
    menu
        Gets the lines.
    remove, bend
        What they do; ``bend`` is None where a curve is always straight.
    n_chosen, n_points
        How many points are removed, and of how many; the only one there is stays.
    """
    if bend is not None:
        for segment in SEGMENTS:
            menu.addAction(f"After this point: {SEGMENT_WORDS[segment]}", partial(bend, segment))
        menu.addSeparator()
    words = "Remove point" if n_chosen == 1 else f"Remove {n_chosen} points"
    menu.addAction(words, remove).setEnabled(n_points > 1)


def fill_ground_menu(menu: QMenu, add: Callable[[], object]) -> None:
    """Offer to add a point where the pointer is."""
    menu.addAction("Add point here", add)
