"""The keyboard in a window: the order of Tab, and shortcuts in fields.

Qt follows the order in which widgets were made, and a panel that hands its focus on to its picture
makes it skip what stands between.

Shortcuts of the window work inside number fields and lines of text too. Keys without Ctrl or Alt
that a widget needs stay with it: letters and spaces where a text is typed, Space on what is pressed
with it, and on a drop-down list that was not clicked.
"""

from collections.abc import Iterable, Sequence

import shiboken6
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QObject, QPoint, QRect, QSize, Qt

from skinsource_gui.qt.wheel import scroll_to
from skinsource_gui.qt.windows import application


def tab_stops(
    top: QtWidgets.QWidget, regions: Sequence[QtWidgets.QWidget]
) -> list[QtWidgets.QWidget]:
    """Widgets inside ``top`` that Tab reaches now, region by region.

    Parameters
    ----------
    top
        A window, or a part of one; what floats in a window of its own does not belong to it.
    regions
        Parts of ``top`` in the order of reading.  What lies in none of them comes last.
    """
    stops = [
        widget for widget in _focus_chain(top) if top.isAncestorOf(widget) and _takes_tab(widget)
    ]
    # PySide takes a widget for a child of the one that was asked for it - its neighbour in the
    # chain, what hands its focus on, a group - and takes it for deleted as soon as that one is.
    # What a window finds among its children it takes for a child of the window again.
    top.window().findChildren(QtWidgets.QWidget)

    def region_of(stop: QtWidgets.QWidget) -> int:
        inside = (k for k, part in enumerate(regions) if part is stop or part.isAncestorOf(stop))
        return next(inside, len(regions))

    groups: list[list[QtWidgets.QWidget]] = [[] for _ in range(len(regions) + 1)]
    for stop in stops:
        groups[region_of(stop)].append(stop)
    for part in (top, *regions):
        if getattr(part, "reads_down", False):
            groups = [_as_read(group, part) for group in groups]
    return [stop for group in groups for stop in group]


def move_focus(
    window: QtWidgets.QMainWindow, regions: Sequence[QtWidgets.QWidget], *, forward: bool
) -> bool:
    """Give the keyboard to the next stop, or the one before; return whether there is any."""
    stops = tab_stops(window, regions)
    if not stops:
        return False
    here: QtWidgets.QWidget | None = window.focusWidget()
    while here is not None and here not in stops:
        # A clicked widget may be no stop, such as a number in a row that is not selected.
        here = here.parentWidget()
    if here is None:
        target = stops[0 if forward else -1]
    else:
        target = stops[(stops.index(here) + (1 if forward else -1)) % len(stops)]
    reason = Qt.FocusReason.TabFocusReason if forward else Qt.FocusReason.BacktabFocusReason
    target.setFocus(reason)
    scroll_to(target)
    return True


def focus_into(part: QtWidgets.QWidget, reason: Qt.FocusReason) -> None:
    """Focus the proxy or the first stop of ``part``, or itself where it has no stop."""
    stops, first = tab_stops(part, ()), part.focusProxy() or part
    (first if first in stops or not stops else stops[0]).setFocus(reason)


def _focus_chain(top: QtWidgets.QWidget) -> list[QtWidgets.QWidget]:
    # Within one region, Qt's order is the right one.
    window = top.window()
    last = window.previousInFocusChain()
    ring: list[QtWidgets.QWidget] = [window]
    # Stop at the last: PySide would take the window for a child of it.
    while ring[-1] is not last and (after := ring[-1].nextInFocusChain()) is not None:
        ring.append(after)
    start = ring.index(top)
    return ring[start:] + ring[:start]


def _as_read(
    stops: Sequence[QtWidgets.QWidget], part: QtWidgets.QWidget
) -> list[QtWidgets.QWidget]:
    """Return stops inside ``part`` from top to bottom, and from left to right in a line."""
    if not all(part.isAncestorOf(stop) for stop in stops):
        return list(stops)
    places = {stop: _place(stop, stops, part) for stop in stops}
    lines: list[list[QtWidgets.QWidget]] = []
    for stop in sorted(stops, key=lambda widget: places[widget].center().y()):
        above = places[lines[-1][0]] if lines else None
        if above is not None and places[stop].center().y() <= above.bottom():
            lines[-1].append(stop)
        else:
            lines.append([stop])
    return [stop for line in lines for stop in sorted(line, key=lambda widget: places[widget].x())]


def _place(
    stop: QtWidgets.QWidget, stops: Sequence[QtWidgets.QWidget], part: QtWidgets.QWidget
) -> QRect:
    # A widget that holds other stops comes before them, not half way down.
    holds = any(stop is not other and stop.isAncestorOf(other) for other in stops)
    return QRect(stop.mapTo(part, QPoint()), QSize() if holds else stop.size())


def _takes_tab(widget: QtWidgets.QWidget) -> bool:
    tab = Qt.FocusPolicy.TabFocus
    if widget.focusPolicy() & tab != tab or widget.focusProxy() is not None:
        return False
    if (
        isinstance(widget, QtWidgets.QAbstractButton)
        and widget.isCheckable()
        and not widget.isChecked()
    ):
        # Of buttons that exclude each other Tab reaches the one that is on; arrows do the rest.
        group = widget.group()
        if group is not None and group.exclusive() and group.checkedButton() is not None:
            return False
    return widget.isVisible() and widget.isEnabled()


class KeyboardFilter(QObject):
    """Filters the events of the widget that has the keyboard.

    One widget at a time: a filter on all widgets would see each event of the studio.
    """

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._watched: QtWidgets.QWidget | None = None

    def follow(self, on: bool) -> None:
        """Begin or end to filter."""
        if on:
            application().focusChanged.connect(self._note_focus)
            self._note_focus(None, QtWidgets.QApplication.focusWidget())
        else:
            application().focusChanged.disconnect(self._note_focus)
            self.watch(None)

    def wanted(self, focused: QtWidgets.QWidget | None) -> QtWidgets.QWidget | None:
        """Return the widget to be filtered while one has the keyboard; by default that one."""
        return focused

    def watch(self, widget: QtWidgets.QWidget | None) -> None:
        """Filter the events of another widget."""
        # While a widget with the keyboard is deleted, the next one gets it before that is told.
        if self._watched is not None and shiboken6.isValid(self._watched):
            self._watched.removeEventFilter(self)
        self._watched = widget
        if widget is not None:
            widget.installEventFilter(self)

    def _note_focus(self, _old: QtWidgets.QWidget | None, new: QtWidgets.QWidget | None) -> None:
        self.watch(self.wanted(new))


_Standard = QtGui.QKeySequence.StandardKey
#: Keys that edit a text while it is typed.
_WHILE_TYPING = (
    _Standard.Copy,
    _Standard.Cut,
    _Standard.Paste,
    _Standard.Undo,
    _Standard.Redo,
    _Standard.SelectAll,
    _Standard.DeleteStartOfWord,
    _Standard.DeleteEndOfWord,
)
#: Keys that work on a text that is only shown.
_WHILE_RESTING = (_Standard.Copy, _Standard.Paste)
_TEXTS = (QtWidgets.QLineEdit, QtWidgets.QPlainTextEdit)
_HELD = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.AltModifier


class ShortcutsInFields(KeyboardFilter):
    """Keeps lines of text from taking shortcuts for keys of their own.

    On some desktops Ctrl+E goes to the end of a line, Ctrl+K deletes to it, and so on: nobody
    expects that of a number, and everybody that a shortcut does the same everywhere.

    Parameters
    ----------
    actions
        Whose shortcuts these are.
    window
        In which they work; also the parent.
    """

    def __init__(self, actions: Iterable[QtGui.QAction], window: QtWidgets.QWidget) -> None:
        super().__init__(window)
        self._window = window
        self._shortcuts = [key for action in actions for key in action.shortcuts()]
        # The list that was clicked, and still has the keyboard.
        self._used: QtWidgets.QComboBox | None = None
        self.follow(True)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        kind = event.type()
        if kind == QEvent.Type.MouseButtonPress and isinstance(watched, QtWidgets.QComboBox):
            self._used = watched
        if kind != QEvent.Type.ShortcutOverride or not isinstance(event, QtGui.QKeyEvent):
            return super().eventFilter(watched, event)
        if isinstance(watched, _TEXTS):
            own = _WHILE_RESTING if watched.isReadOnly() else _WHILE_TYPING
            typed = not watched.isReadOnly() and _is_typed(event)
            kept = typed or any(event.matches(key) for key in own)
            if not kept and QtGui.QKeySequence(event.keyCombination()) in self._shortcuts:
                event.ignore()
                return True
        elif event.key() == Qt.Key.Key_Space and not event.modifiers() & _HELD:
            # After a click Space plays what was chosen; the arrow keys choose again.
            event.setAccepted(watched is not self._used)
            return True
        return super().eventFilter(watched, event)

    def wanted(self, focused: QtWidgets.QWidget | None) -> QtWidgets.QWidget | None:
        # While its list is open, that has the keyboard.
        is_open = QtWidgets.QApplication.activePopupWidget() is not None
        if focused is not None and focused is not self._used and not is_open:
            self._used = None
        # A clicked button has the keyboard too, but the next key is not meant for it.
        pressed = () if QtWidgets.QApplication.mouseButtons() else QtWidgets.QAbstractButton
        kinds = (*_TEXTS, QtWidgets.QComboBox, pressed)
        watches = isinstance(focused, kinds) and self._window.isAncestorOf(focused)
        return focused if watches else None


def _is_typed(event: QtGui.QKeyEvent) -> bool:
    """Return whether a key types into a text."""
    return event.text().isprintable() and event.text() != "" and not event.modifiers() & _HELD
