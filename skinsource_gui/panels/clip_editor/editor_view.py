"""The part of the editor in which a clip is drawn."""

from PySide6.QtCore import QEvent, QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QContextMenuEvent, QKeyEvent, QMouseEvent, QWheelEvent
from PySide6.QtWidgets import QMenu, QWidget

from skinsource.base.arrays import Floats
from skinsource.design.clips import Clip
from skinsource_gui.panels.clip_editor.content import EditorContent
from skinsource_gui.panels.clip_editor.editor_item import EditorItem
from skinsource_gui.panels.clip_editor.seen_clip import SeenClip
from skinsource_gui.panels.clip_editor.tools.tool import Tool
from skinsource_gui.theme import scaled, tabular
from skinsource_gui.widgets.plot.canvas import Canvas

_TEXT = 0.9
_LEFT_PX, _RIGHT_PX, _TOP_PX, _BOTTOM_PX = 40.0, 10.0, 6.0, 20.0


class EditorView(Canvas):
    """One clip over its own time; the tool decides what the pointer does.

    Attributes
    ----------
    item
        What paints.
    seen
        The clip, and which part of it is shown.
    content
        What is shown, where there is a clip.
    """

    key_place = "clip_editor"

    #: A key that belongs to the editor, as Qt tells it.
    key_pressed = Signal(object)

    def __init__(self, tool: Tool, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("clip_editor_view")
        self.setAccessibleName("Waveform of the clip")
        self.setMouseTracking(True)
        self.setMinimumSize(160, 80)
        self.item = EditorItem()
        self.addItem(self.item)
        self._tool = tool
        self.content: EditorContent | None = None
        self.seen = SeenClip(lambda: self.content, self)
        self.seen.changed.connect(self.lay_out)
        self.take_look()

    def show_clip(
        self, clip: Clip | None, drawn: Floats | None, played: Floats | None, rate_hz: float
    ) -> None:
        """Show a clip: its samples before its effects, and after them, (n_times,)."""
        self.seen.show(clip, drawn, played, rate_hz)
        self.lay_out()

    def use(self, tool: Tool) -> None:
        """Take another tool."""
        self._tool.cancel()
        self._tool = tool
        self.viewport().setCursor(tool.cursor)
        self.lay_out()

    @property
    def tool(self) -> Tool:
        """The tool that is taken."""
        return self._tool

    def take_look(self) -> None:
        super().take_look()
        self.item.show_font(scaled(tabular(self.font()), _TEXT))

    def cancel(self) -> bool:
        """Give up what the tool has begun; whether anything had."""
        given_up = self._tool.cancel()
        self.seen.let_go()
        self.lay_out()
        return given_up

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self.setFocus(Qt.FocusReason.MouseFocusReason)
        content = self.content
        event.accept()
        if content is None:
            return
        # Nothing moves under the pen, however long or loud the clip becomes.
        self.seen.hold(content)
        self._tool.press(content, event.position(), event.button(), event.modifiers())
        self.lay_out()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        event.accept()
        if self.content is not None:
            self._tool.move(self.content, event.position(), event.modifiers())
            self.item.update()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        event.accept()
        if self.content is not None:
            self._tool.release(self.content)
        self.seen.let_go()
        self.lay_out()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        event.accept()
        if self.content is not None and event.button() == Qt.MouseButton.LeftButton:
            self._tool.double_click(self.content, event.position())
            self.lay_out()

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        event.accept()
        if self.content is None:
            return
        by_key = event.reason() == QContextMenuEvent.Reason.Keyboard
        menu = QMenu(self)
        menu.setObjectName("clip_editor_menu")
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self._tool.fill_menu(menu, self.content, None if by_key else QPointF(event.pos()))
        if menu.isEmpty():
            # The right button belongs to the tool.
            menu.deleteLater()
            return
        # The menu takes the release of the button.
        self.seen.let_go()
        self.lay_out()
        menu.popup(event.globalPos())

    def wheelEvent(self, event: QWheelEvent) -> None:
        event.accept()
        self.seen.turn(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and self.cancel():
            return
        event.ignore()
        self.key_pressed.emit(event)

    def leaveEvent(self, event: QEvent) -> None:
        super().leaveEvent(event)
        if self.content is not None and not self.seen.held:
            self._tool.move(self.content, QPointF(-1, -1), Qt.KeyboardModifier.NoModifier)
            self.item.update()

    def lay_out(self) -> None:
        whole = QRectF(self.rect())
        self.content = self.seen.content_in(
            whole.adjusted(_LEFT_PX, _TOP_PX, -_RIGHT_PX, -_BOTTOM_PX)
        )
        self.item.show_content(self.content, self._tool, whole)
