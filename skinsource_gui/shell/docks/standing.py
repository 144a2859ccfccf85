"""Where the docks of a window stand, to tell whether somebody has moved them."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import reduce

from PySide6.QtCore import QRect, QSize

from skinsource_gui.shell.docks.dock import Dock

# What the sharing of room rounds away, px.
_ROUNDING_PX = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class _One:
    hidden: bool
    floating: bool
    in_sight: bool
    place: QRect

    def is_like(self, other: "_One", *, as_wide: bool, as_high: bool) -> bool:
        mine = (self.hidden, self.floating, self.in_sight)
        if mine != (other.hidden, other.floating, other.in_sight):
            return False
        if not self.in_sight:
            return True
        corners = self.place.topLeft() - other.place.topLeft()
        sizes = self.place.size() - other.place.size()
        across, down = (corners.x(), sizes.width()), (corners.y(), sizes.height())
        apart = (across if as_wide else ()) + (down if as_high else ())
        return all(abs(one) <= _ROUNDING_PX for one in apart)


@dataclass(frozen=True, slots=True)
class Standing:
    """Where each dock stands in the room of all, which is less where bars of the window grow."""

    room: QSize
    docks: Mapping[str, _One]

    @classmethod
    def of(cls, docks: Mapping[str, Dock]) -> "Standing":
        """How it is now."""
        here = [
            dock.geometry() for dock in docks.values() if dock.in_sight and not dock.isFloating()
        ]
        return cls(
            reduce(QRect.united, here, QRect()).size(),
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
        """Whether nobody has moved a dock; in a room of another size, shown or hidden one."""
        as_wide = self.room.width() == other.room.width()
        as_high = self.room.height() == other.room.height()
        return all(
            one.is_like(other.docks[name], as_wide=as_wide, as_high=as_high)
            for name, one in self.docks.items()
        )
