"""What painted widgets tell a screen reader: a list of items with names, places and states.

They are asked for only while assistive technology is active.
"""

from functools import partial
from typing import NamedTuple, Protocol, cast

import shiboken6
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QObject, QRect, QRectF


class Told(NamedTuple):
    """What is told of an item.

    Attributes
    ----------
    name
        What it is, and its values.
    rect
        Where it is painted on its widget.
    selected
        Whether it is selected.
    """

    name: str
    rect: QRectF
    selected: bool


class Telling(Protocol):
    """A widget that paints items."""

    def told_count(self) -> int:
        """Return how many items there are."""
        ...

    def told(self, k: int) -> Told:
        """Return what is told of an item, counted from 0."""
        ...


class _Item(QtGui.QAccessibleInterface):
    """An item, whatever it is now; none where there are fewer by now."""

    def __init__(self, of: "_Items", k: int) -> None:
        super().__init__()
        self._of, self._k = of, k

    def isValid(self) -> bool:
        return shiboken6.isValid(self._of) and self._k < self._of.childCount()

    def object(self) -> QObject | None:  # type: ignore[override]
        return None

    def window(self) -> QtGui.QWindow:
        return self._of.window()

    def parent(self) -> QtGui.QAccessibleInterface:
        return self._of

    def child(self, index: int) -> QtGui.QAccessibleInterface | None:  # type: ignore[override]
        return None

    def childAt(self, x: int, y: int) -> QtGui.QAccessibleInterface | None:  # type: ignore[override]
        return None

    def childCount(self) -> int:
        return 0

    def indexOfChild(self, child: QtGui.QAccessibleInterface) -> int:
        return -1

    def role(self) -> QtGui.QAccessible.Role:
        return QtGui.QAccessible.Role.ListItem

    def rect(self) -> QRect:
        area = self._told.rect.toAlignedRect()
        return area.translated(self._of.rect().topLeft())

    def state(self) -> QtGui.QAccessible.State:
        state = QtGui.QAccessible.State()
        state.selectable, state.selected = True, self._told.selected
        return state

    def text(self, t: QtGui.QAccessible.Text) -> str:
        return self._told.name if t == QtGui.QAccessible.Text.Name else ""

    def setText(self, t: QtGui.QAccessible.Text, text: str) -> None:
        """Change nothing: what is told follows the design."""

    @property
    def _told(self) -> Told:
        return self._of.teller.told(self._k) if self.isValid() else Told("", QRectF(), False)


class _Items(QtWidgets.QAccessibleWidget):
    """A widget as a list of its items."""

    def __init__(self, widget: QtWidgets.QWidget) -> None:
        super().__init__(widget, QtGui.QAccessible.Role.List)
        self.made: list[_Item] = []

    @property
    def teller(self) -> Telling:
        """The widget."""
        return cast("Telling", self.object())

    def childCount(self) -> int:
        return self.teller.told_count()

    def child(self, index: int) -> QtGui.QAccessibleInterface | None:  # type: ignore[override]
        if not 0 <= index < self.childCount():
            return None
        self.made += [_Item(self, k) for k in range(len(self.made), index + 1)]
        return self.made[index]

    def childAt(self, x: int, y: int) -> QtGui.QAccessibleInterface | None:  # type: ignore[override]
        items = map(self.child, range(self.childCount()))
        return next((item for item in items if item and item.rect().contains(x, y)), None)

    def indexOfChild(self, child: QtGui.QAccessibleInterface) -> int:
        return self.made.index(child) if child in self.made else -1


# Qt deletes them with their widgets, Python never: Qt has pointers to them.
_MADE: list[_Items] = []


def _forget(made: list[_Item]) -> None:
    for item in made:
        QtGui.QAccessible.deleteAccessibleInterface(QtGui.QAccessible.uniqueId(item))


def _items_of(_class: str, asked: QObject) -> QtGui.QAccessibleInterface | None:
    if not isinstance(asked, QtWidgets.QWidget) or not hasattr(asked, "told_count"):
        return None
    items = _Items(asked)
    _MADE.append(items)
    asked.destroyed.connect(partial(_forget, items.made))
    return items


def tell_items() -> None:
    """Tell assistive technology the items of all widgets that are `Telling`."""
    QtGui.QAccessible.installFactory(_items_of)
