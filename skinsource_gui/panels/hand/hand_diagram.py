"""The hand on which inputs are placed, moved and removed."""

from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QContextMenuEvent,
    QFocusEvent,
    QHelpEvent,
    QHideEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QResizeEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QToolTip, QWidget

from skinsource_gui.panels.hand.hand_drawing import HandDrawing
from skinsource_gui.panels.hand.hand_stage import HandStage
from skinsource_gui.panels.hand.hand_state import HandState, Mark
from skinsource_gui.panels.hand.site_cursor import SiteCursor
from skinsource_gui.panels.hand.site_mouse import SiteMouse
from skinsource_gui.theme import current_theme
from skinsource_gui.widgets.focus_frame import paint_focus_frame
from skinsource_gui.widgets.keys import claims_shortcut
from skinsource_gui.widgets.pan_zoom import WHOLE

# Ways in which focus comes without the keyboard being used here.
_BY_MOUSE = (
    Qt.FocusReason.MouseFocusReason,
    Qt.FocusReason.ActiveWindowFocusReason,
    Qt.FocusReason.PopupFocusReason,
)


class HandDiagram(QWidget):
    """A palm with its sites; tells by signals what the user wants there.

    Parameters
    ----------
    drawing
        The hand.

    Attributes
    ----------
    stage
        What is shown, and where.
    """

    #: Site of a new input.
    add_requested = Signal(int)
    #: The same, where what is selected stays so besides.
    add_besides_requested = Signal(int)
    #: Number of an input.
    select_requested = Signal(int)
    #: Number of an input that is to be added to the selected ones, or taken out.
    toggle_requested = Signal(int)
    all_requested = Signal()
    #: Number of an input, its new site, gesture.
    move_requested = Signal(int, int, int)
    #: Those that are selected.
    remove_requested = Signal()
    #: Site, position on the screen.
    menu_requested = Signal(int, QPoint)

    def __init__(self, drawing: HandDrawing, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.stage = HandStage(drawing, self)
        self.stage.changed.connect(self.update)
        self._mouse, self._cursor = SiteMouse(self.stage, self), SiteCursor(self.stage)
        self._mouse.pressed.connect(self._cursor.follow)
        for source in (self._mouse, self._cursor):
            source.placed.connect(self.add_requested)
            source.selected.connect(self.select_requested)
        self._mouse.placed_besides.connect(self.add_besides_requested)
        self._mouse.toggled.connect(self.toggle_requested)
        self._mouse.moved.connect(self.move_requested)
        self._cursor.shifted.connect(self.move_requested)
        self._cursor.keys.removed.connect(self.remove_requested)
        self._cursor.keys.all_selected.connect(self.all_requested)
        self._cursor.moved.connect(self._describe)
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setObjectName("hand_diagram")
        self.setAccessibleName("Hand, palm side")
        self._describe(self._cursor.site)

    @property
    def state(self) -> HandState:
        """What is shown."""
        return self.stage.state

    @property
    def cursor_site(self) -> int:
        """Site of the keyboard's cursor, whether or not it is shown."""
        return self._cursor.site

    def site_centre(self, site: int) -> QPoint:
        """Middle of a site's marker, in pixels of this widget."""
        return self.stage.layout.centre(site).toPoint()

    def show_drawing(self, drawing: HandDrawing) -> None:
        """Take another hand."""
        if drawing is not self.stage.drawing:
            self._mouse.cancel()
            self.stage.show_drawing(drawing, self)
            self._cursor.show_hand()

    def show_inputs(
        self, marks: tuple[Mark, ...], selected: int | None, *, anew: bool = False
    ) -> None:
        """Show these inputs, of which ``selected`` is the selected one.

        ``anew`` says that none of them is as one was before.
        """
        before = self.state
        self._mouse.check(marks)
        self.stage.change(marks=marks, selected=selected, note="")
        self._cursor.keep_up(before, anew=anew, focused=self.hasFocus())

    def show_note(self, text: str) -> None:
        """Say something below the hand, until the design or the selection changes."""
        self.stage.change(note=text)

    def minimumSizeHint(self) -> QSize:
        return QSize(200, 258)

    def sizeHint(self) -> QSize:
        return QSize(320, 400)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self.stage.fit(self)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self.stage.fit(self)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        self.stage.paint(painter, self.devicePixelRatioF())
        if self.hasFocus():
            # The ring shows where keys act once they are used here; this, that they would be.
            paint_focus_frame(painter, QRectF(self.rect()), current_theme())
        painter.end()

    def wheelEvent(self, event: QWheelEvent) -> None:
        self.stage.pan_zoom.wheel(event)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self.stage.change(cursor=None)
        self.stage.pan_zoom.press(event)
        if event.button() == Qt.MouseButton.LeftButton:
            self._mouse.press(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        self.stage.pan_zoom.move(event)
        self._mouse.move(event)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        self.stage.pan_zoom.release(event)
        if event.button() == Qt.MouseButton.LeftButton:
            self._mouse.release(event)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        if self.stage.site_at(event.position()) is None:
            self.stage.pan_zoom.show(WHOLE)
        else:
            self.mousePressEvent(event)

    def leaveEvent(self, event: QEvent) -> None:
        super().leaveEvent(event)
        self._mouse.hover(None)

    def hideEvent(self, event: QHideEvent) -> None:
        super().hideEvent(event)
        self._mouse.cancel()

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        if event.reason() == QContextMenuEvent.Reason.Keyboard:
            site: int | None = self.cursor_site
            at = self.mapToGlobal(self.site_centre(self.cursor_site))
        else:
            site = self.stage.site_at(QPointF(event.pos()))
            at = event.globalPos()
        if site is None or self._mouse.busy:
            return
        self._cursor.site = site
        front = self.state.front_at(site)
        if front is not None and not self.state.marks[front].chosen:
            self.select_requested.emit(front)
        self.menu_requested.emit(site, at)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and self._mouse.busy:
            self._mouse.cancel()
        elif self._mouse.busy or not self._cursor.keys.press(event):
            super().keyPressEvent(event)

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        self._cursor.keys.release(event)
        super().keyReleaseEvent(event)

    def focusInEvent(self, event: QFocusEvent) -> None:
        super().focusInEvent(event)
        self.update()
        if event.reason() not in _BY_MOUSE:
            self._cursor.go_to(self._cursor.site)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        self.update()
        self._cursor.keys.end_gesture()
        if event.reason() != Qt.FocusReason.PopupFocusReason:
            self.stage.change(cursor=None)

    def event(self, event: QEvent) -> bool:
        if isinstance(event, QHelpEvent) and event.type() == QEvent.Type.ToolTip:
            self._show_tooltip(event)
            return True
        return claims_shortcut(event, self._overrides) or super().event(event)

    def _overrides(self, event: QKeyEvent) -> bool:
        """Whether a key is wanted here even if it is a shortcut of the window."""
        if event.key() == Qt.Key.Key_Escape:
            return self._mouse.busy
        # Until keys are used here, Space is left to whom the window gives it.
        if event.key() == Qt.Key.Key_Space and self.state.cursor is None:
            return False
        return self._cursor.keys.claims(event)

    def _show_tooltip(self, event: QHelpEvent) -> None:
        site = self.stage.site_at(QPointF(event.pos()))
        if site is None or self.state.moving is not None:
            QToolTip.hideText()
        else:
            area = self.stage.marker_area(site).toAlignedRect()
            QToolTip.showText(event.globalPos(), self.stage.words(site), self, area)

    def _describe(self, site: int) -> None:
        words = self.stage.description(site)
        if words != self.accessibleDescription():
            self.setAccessibleDescription(words)
