"""What the hand diagram shows."""

from dataclasses import dataclass

from PySide6.QtCore import QPointF
from PySide6.QtGui import QColor


@dataclass(frozen=True, slots=True, kw_only=True)
class Mark:
    """One input as the diagram shows it.

    Attributes
    ----------
    site
        Where it is placed; not all places need be on this hand.
    colour
        Its colour everywhere.
    silent
        Whether it is not heard: muted, or others are solo.
    words
        What it plays, for tooltips.
    chosen
        Whether it is selected.
    """

    site: int
    colour: QColor
    silent: bool = False
    words: str = ""
    chosen: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class HandState:
    """Everything that the picture depends on, besides size and theme.

    Attributes
    ----------
    marks, selected
        The inputs, and the number of the one that was selected last.
    hovered, cursor
        Site under the mouse; site of the keyboard's cursor where it is shown.
    moving, ghost, target
        Number of the input that is being moved, where it floats, and the site that takes it.
    note
        A line that replaces the caption.
    """

    marks: tuple[Mark, ...] = ()
    selected: int | None = None
    hovered: int | None = None
    cursor: int | None = None
    moving: int | None = None
    ghost: QPointF | None = None
    target: int | None = None
    note: str = ""

    @property
    def selected_site(self) -> int | None:
        """Where the input is that was selected last."""
        return None if self.selected is None else self.marks[self.selected].site

    def at(self, site: int) -> tuple[int, ...]:
        """Numbers of the inputs at ``site``."""
        return tuple(k for k, mark in enumerate(self.marks) if mark.site == site)

    def front_at(self, site: int) -> int | None:
        """The input that a click at ``site`` means: the selected one, else the latest."""
        present = self.at(site)
        if self.selected in present:
            return self.selected
        return present[-1] if present else None

    def next_at(self, site: int) -> int | None:
        """The input after the selected one at ``site``, around and around."""
        present = self.at(site)
        if self.selected not in present:
            return self.front_at(site)
        return present[(present.index(self.selected) + 1) % len(present)]
