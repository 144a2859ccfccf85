"""Where the docks of a window stand, to tell whether somebody has moved them."""

from collections.abc import Mapping
from dataclasses import dataclass

from PySide6.QtCore import QRect, QSize
from PySide6.QtWidgets import QMainWindow

from skinsource_gui.shell.docks.dock import Dock

# What the sharing of room rounds away, px.
_ROUNDING_PX = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class _One:
    hidden: bool
    floating: bool
    in_sight: bool
    place: QRect

    def is_like(self, other: "_One", *, same_room: bool) -> bool:
        mine = (self.hidden, self.floating, self.in_sight)
        if mine != (other.hidden, other.floating, other.in_sight):
            return False
        if not (same_room and self.in_sight):
            return True
        corners = self.place.topLeft() - other.place.topLeft()
        sizes = self.place.size() - other.place.size()
        apart = (corners.x(), corners.y(), sizes.width(), sizes.height())
        return all(abs(one) <= _ROUNDING_PX for one in apart)


@dataclass(frozen=True, slots=True)
class Standing:
    """Where each dock stands in a window of a size."""

    window: QSize
    docks: Mapping[str, _One]

    @classmethod
    def of(cls, window: QMainWindow, docks: Mapping[str, Dock]) -> "Standing":
        """How it is now."""
        return cls(
            window.size(),
            {
                name: _One(
                    hidden=dock.isHidden(),
                    floating=dock.isFloating(),
                    in_sight=dock.in_sight,
                    place=dock.geometry(),
                )
                for name, dock in docks.items()
            },
        )

    def is_like(self, other: "Standing") -> bool:
        """Whether nobody has moved a dock; in a window of another size, shown or hidden one."""
        same_room = self.window == other.window
        return all(
            one.is_like(other.docks[name], same_room=same_room) for name, one in self.docks.items()
        )
