"""The part of the editor in which a clip is drawn."""

from PySide6.QtCore import QEvent, QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QContextMenuEvent, QKeyEvent, QMouseEvent, QWheelEvent
from PySide6.QtWidgets import QMenu, QWidget

from skinsource.arrays import Floats
from skinsource.clips import Clip
from skinsource.own_limbs import facts_of
from skinsource_gui.panels.clip_editor.content import EditorContent, reach_of
from skinsource_gui.panels.clip_editor.editor_item import EditorItem
from skinsource_gui.panels.clip_editor.tools.tool import Tool
from skinsource_gui.theme import Theme, scaled, tabular
from skinsource_gui.widgets.plot.canvas import Canvas
from skinsource_gui.widgets.time.time_scale import Range, TimeScale, panned, within, zoomed
from skinsource_gui.widgets.time.time_wheel import range_by_wheel

_TEXT = 0.9
_LEFT_PX, _RIGHT_PX, _TOP_PX, _BOTTOM_PX = 40.0, 10.0, 6.0, 20.0
# Behind the end there is room to draw on.
_BEHIND = 0.06
_LEAST_S = 0.01


class EditorView(Canvas):
    """One clip over its own time; the tool decides what the pointer does."""

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
        self._clip: Clip | None = None
        self._drawn: Floats | None = None
        self._played: Floats | None = None
        self._rate_hz = facts_of("").sample_rate_hz
        self._shown_s: Range | None = None
        self._held: tuple[Range, float] | None = None
        self.content: EditorContent | None = None

    def show_clip(
        self, clip: Clip | None, drawn: Floats | None, played: Floats | None, rate_hz: float
    ) -> None:
        """Show a clip: its samples before its effects, and after them, (n_times,)."""
        if clip is None or self._clip is None or clip.id != self._clip.id:
            self._shown_s = None
        self._clip, self._drawn, self._played, self._rate_hz = clip, drawn, played, rate_hz
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

    def show_theme(self, theme: Theme) -> None:
        """Take over colours."""
        self.set_ground(theme)
        self.item.show_look(theme, scaled(tabular(self.font()), _TEXT))

    def pan(self, by_s: float) -> None:
        """See what lies so much later."""
        if self.content is not None:
            self._see(panned(self.content.scale.shown_s, by_s, self._whole_s))

    def zoom(self, factor: float) -> None:
        """See so many times less, around the middle."""
        if self.content is not None:
            shown = self.content.scale.shown_s
            self._see(zoomed(shown, sum(shown) / 2, factor, self._whole_s))

    def see_everything(self) -> None:
        """See all of the clip."""
        self._see(None)

    def cancel(self) -> bool:
        """Give up what the tool has begun; whether anything had."""
        given_up = self._tool.cancel()
        self._held = None
        self.lay_out()
        return given_up

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self.setFocus(Qt.FocusReason.MouseFocusReason)
        content = self.content
        event.accept()
        if content is None:
            return
        # Nothing moves under the pen, however long or loud the clip becomes.
        self._held = (content.scale.shown_s, content.reach)
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
        self._held = None
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
        self._held = None
        self.lay_out()
        menu.popup(event.globalPos())

    def wheelEvent(self, event: QWheelEvent) -> None:
        event.accept()
        if self.content is not None:
            self._see(range_by_wheel(event, self.content.scale, self._whole_s))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and self.cancel():
            return
        event.ignore()
        self.key_pressed.emit(event)

    def leaveEvent(self, event: QEvent) -> None:
        super().leaveEvent(event)
        if self.content is not None and self._held is None:
            self._tool.move(self.content, QPointF(-1, -1), Qt.KeyboardModifier.NoModifier)
            self.item.update()

    def lay_out(self) -> None:
        self.content = None if self._clip is None else self._made(self._clip)
        self.item.show_content(self.content, self._tool, QRectF(self.rect()))

    @property
    def _whole_s(self) -> Range:
        counts = [one.size for one in (self._drawn, self._played) if one is not None]
        length = max(max(counts, default=0) / self._rate_hz, _LEAST_S)
        return (0.0, length * (1 + _BEHIND))

    def _see(self, shown_s: Range | None) -> None:
        self._shown_s = shown_s
        self.lay_out()

    def _made(self, clip: Clip) -> EditorContent:
        area = QRectF(self.rect()).adjusted(_LEFT_PX, _TOP_PX, -_RIGHT_PX, -_BOTTOM_PX)
        shown_s = self._whole_s
        if self._shown_s is not None:
            shown_s = within(self._shown_s, shown_s) or shown_s
        if self._held is not None:
            shown_s, reach = self._held
        else:
            reach = reach_of(self._drawn, self._played)
        width = max(area.width(), 1.0)
        return EditorContent(
            clip=clip,
            drawn=self._drawn,
            played=self._played,
            sample_rate_hz=self._rate_hz,
            scale=TimeScale(shown_s=shown_s, left_px=area.left(), width_px=width),
            area=area,
            reach=reach,
        )
