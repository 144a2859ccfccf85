"""The hand on which inputs are placed, moved and removed."""

from PySide6.QtCore import QEvent, QPoint, QPointF, Qt, Signal
from PySide6.QtGui import QContextMenuEvent, QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QWidget

from skinsource_gui.panels.hand.hand_canvas import HandCanvas
from skinsource_gui.panels.hand.hand_drawing import HandDrawing
from skinsource_gui.panels.hand.hand_picture import Mark
from skinsource_gui.panels.hand.site_keys import SiteKeys
from skinsource_gui.panels.hand.site_mouse import SiteMouse
from skinsource_gui.theme import Theme

# Ways in which focus comes without the keyboard being used here.
_BY_MOUSE = (
    Qt.FocusReason.MouseFocusReason,
    Qt.FocusReason.ActiveWindowFocusReason,
    Qt.FocusReason.PopupFocusReason,
)


class HandDiagram(HandCanvas):
    """A palm with 20 sites; tells by signals what the user wants there.

    Parameters
    ----------
    drawing
        The hand.
    theme
        Its colours until `show_theme`.
    """

    #: Site of a new input.
    add_requested = Signal(int)
    #: Number of an input.
    select_requested = Signal(int)
    #: Number of an input, its new site, gesture.
    move_requested = Signal(int, int, int)
    #: Number of an input.
    remove_requested = Signal(int)
    #: Site, position on the screen.
    menu_requested = Signal(int, QPoint)

    def __init__(self, drawing: HandDrawing, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(drawing, theme, parent)
        self._cursor = 1
        self._mouse = SiteMouse(self)
        self._mouse.pressed.connect(self._follow)
        self._mouse.placed.connect(self.add_requested)
        self._mouse.selected.connect(self.select_requested)
        self._mouse.moved.connect(self.move_requested)
        self._keys = SiteKeys(self)
        self._keys.stepped.connect(self._step)
        self._keys.jumped.connect(self._go_to)
        self._keys.activated.connect(self._activate_cursor)
        self._keys.shifted.connect(self._shift_selected)
        self._keys.removed.connect(self._ask_to_remove)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setObjectName("hand_diagram")
        self.setAccessibleName("Hand, palm side")
        self.describe(self._cursor)

    @property
    def cursor_site(self) -> int:
        """Site of the keyboard's cursor, whether or not it is shown."""
        return self._cursor

    def show_inputs(self, marks: tuple[Mark, ...], selected: int | None) -> None:
        """Show these inputs, of which ``selected`` is the selected one."""
        before = self.state.selected
        self._mouse.check(marks)
        self.change(marks=marks, selected=selected, note="")
        if selected is not None and selected != before and not self.hasFocus():
            self._cursor = marks[selected].site
        self.describe(self._cursor)

    def show_note(self, text: str) -> None:
        """Say something below the hand, until the design or the selection changes."""
        self.change(note=text)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self.change(cursor=None)
        if event.button() == Qt.MouseButton.LeftButton:
            self._mouse.press(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        self._mouse.move(event)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self._mouse.release(event)

    def leaveEvent(self, event: QEvent) -> None:
        super().leaveEvent(event)
        self._mouse.hover(None)

    def hideEvent(self, event) -> None:
        super().hideEvent(event)
        self._mouse.cancel()

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        if event.reason() == QContextMenuEvent.Reason.Keyboard:
            site: int | None = self._cursor
            at = self.mapToGlobal(self.site_centre(self._cursor))
        else:
            site = self.hand.site_at(QPointF(event.pos()))
            at = event.globalPos()
        if site is None or self._mouse.busy:
            return
        self._cursor = site
        front = self.state.front_at(site)
        if front is not None and front != self.state.selected:
            self.select_requested.emit(front)
        self.menu_requested.emit(site, at)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and self._mouse.busy:
            self._mouse.cancel()
        elif self._mouse.busy or not self._keys.press(event):
            super().keyPressEvent(event)

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        self._keys.release(event)
        super().keyReleaseEvent(event)

    def focusInEvent(self, event) -> None:
        super().focusInEvent(event)
        if event.reason() not in _BY_MOUSE:
            self._go_to(self._cursor)

    def focusOutEvent(self, event) -> None:
        super().focusOutEvent(event)
        self._keys.end_gesture()
        if event.reason() != Qt.FocusReason.PopupFocusReason:
            self.change(cursor=None)

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.ShortcutOverride and self._overrides(event):
            event.accept()
            return True
        return super().event(event)

    def _overrides(self, event: QKeyEvent) -> bool:
        """Whether a key is wanted here even if it is a shortcut of the window."""
        if event.key() == Qt.Key.Key_Escape:
            return self._mouse.busy
        # Until keys are used here, Space is left to whom the window gives it.
        if event.key() == Qt.Key.Key_Space and self.state.cursor is None:
            return False
        return self._keys.claims(event)

    def _follow(self, site: int) -> None:
        """The cursor goes where the mouse was used, without showing."""
        self._cursor = site
        self.describe(site)

    def _go_to(self, site: int) -> None:
        self._follow(site)
        self.change(cursor=site)

    def _step(self, x: int, y: int) -> None:
        self._go_to(self.hand.neighbour(self._cursor, (x, y)))

    def _activate_cursor(self, further: bool) -> None:
        self._go_to(self._cursor)
        following = self.state.next_at(self._cursor)
        if further or following is None:
            self.add_requested.emit(self._cursor)
        else:
            self.select_requested.emit(following)

    def _shift_selected(self, x: int, y: int, gesture: int) -> None:
        index = self.state.selected
        if index is None:
            return
        origin = self.state.marks[index].site
        site = self.hand.neighbour(origin, (x, y))
        if site != origin:
            self.move_requested.emit(index, site, gesture)
        self._go_to(site)

    def _ask_to_remove(self) -> None:
        if self.state.selected is not None:
            self.remove_requested.emit(self.state.selected)
