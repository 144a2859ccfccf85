"""The map of the skin, on which outputs are selected."""

from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QContextMenuEvent,
    QHelpEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QResizeEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QToolTip, QWidget

from skinsource_gui.panels.skin.inputs.pointing import (
    InputPointer,
    input_at,
    input_meant,
    selected_inputs,
)
from skinsource_gui.panels.skin.map_content import MapContent
from skinsource_gui.panels.skin.map_painter import MapPainter, paint_band, paint_mark, small_font
from skinsource_gui.panels.skin.map_readout import hover_words, output_readout, pixel_readout
from skinsource_gui.panels.skin.map_words import paint_words
from skinsource_gui.panels.skin.stage.map_layout import HAND
from skinsource_gui.panels.skin.stage.map_stage import MapStage
from skinsource_gui.theme import current_theme, tabular
from skinsource_gui.widgets.focus_frame import paint_focus_frame
from skinsource_gui.widgets.keys import KEYS, claims_shortcut, meaning_of
from skinsource_gui.widgets.outputs.keys import ADDS
from skinsource_gui.widgets.outputs.picker import OutputPicker
from skinsource_gui.widgets.outputs.picking import output_at
from skinsource_gui.widgets.pan_zoom import WHOLE


class SkinMap(QWidget):
    """Shows `MapContent`, and tells which outputs the user wants selected.

    Attributes
    ----------
    content
        What is shown.
    stage
        What part of it is seen, and where everything lies.
    picker
        Which outputs mouse and keys mean.
    """

    #: The outputs to select, a tuple of numbers.
    outputs_chosen = Signal(object)
    #: What is under the pointer or the keyboard's cursor, in words; empty for nothing.
    readout_changed = Signal(str)
    #: Id of the input that is pointed at, or None; those of the inputs to select, a tuple.
    input_pointed_at = Signal(object)
    inputs_chosen = Signal(object)
    #: Delete was pressed; whether what was selected last are outputs.
    removal_wanted = Signal(bool)
    #: Where on the screen a menu is wanted.
    menu_requested = Signal(QPoint)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.content = MapContent()
        self._painter: MapPainter | None = None
        self._pointer = InputPointer(self)
        self._pointer.pointed_at.connect(self.input_pointed_at)
        # What was selected here last, "input" or "outputs": keys are about that.
        self._last = ""
        # Outputs that were selected here last.
        self._chosen: tuple[int, ...] = ()
        self.stage = MapStage(self)
        self.stage.changed.connect(self.update)
        self.picker = OutputPicker(self)
        self.picker.chosen.connect(self._choose_outputs)
        self.picker.moved.connect(self._follow_cursor)
        self.setMinimumSize(150, 180)
        # All of it is painted: nothing behind needs to be.
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAccessibleName("Map of the skin, back of hand and arm")
        self.setAccessibleDescription(
            "; ".join(KEYS["skin"].sentences("go", "select", "toggle", "remove"))
        )

    def show_content(self, content: MapContent) -> None:
        """Draw ``content``; another limb is fitted anew."""
        if content.same_as(self.content):
            return
        other_limb = content.limb_map is not self.content.limb_map
        if selected_inputs(content) != selected_inputs(self.content) and self._last == "outputs":
            self._last = ""
        if content.outputs not in (self.content.outputs, self._chosen):
            # They were selected elsewhere: nothing is said any more of where keys were before.
            self.picker.keys.cursor_output = None
        self.content, self.picker.selected = content, content.outputs
        if other_limb:
            limb_map = content.limb_map
            self._painter = None if limb_map is None else MapPainter(limb_map)
            self.stage.show_limb(limb_map)
        self.update()
        if self.picker.mouse.pointer is not None or self.hasFocus():
            self.readout_changed.emit(self.readout())

    def readout(self) -> str:
        """What is under the pointer, or else under the keyboard's cursor, in words."""
        number, pointer = self.picker.pointed_at(focused=self.hasFocus()), self.picker.mouse.pointer
        if number is not None:
            return output_readout(self.content, number)
        if self.stage.layout is None or pointer is None:
            return ""
        return pixel_readout(self.content, self.stage.layout, pointer)

    def sizeHint(self) -> QSize:
        return QSize(300, 560)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self.stage.fit()

    def paintEvent(self, event: QPaintEvent) -> None:
        painter, mouse = QPainter(self), self.picker.mouse
        painter.fillRect(self.rect(), QColor(current_theme().base))
        if self.stage.layout is not None and self._painter is not None:
            painter.setFont(tabular(small_font(self.stage.letters)))
            self._painter.paint(painter, self.content, self.stage.layout, current_theme())
            marks = [(mouse.hovered, current_theme().text)]
            if self.hasFocus():
                marks.append((self.picker.keys.cursor_output, current_theme().accent))
            for number, colour in marks:
                if number is not None:
                    paint_mark(
                        painter, number, colour, self.content, self.stage.layout, current_theme()
                    )
            if mouse.band is not None:
                paint_band(painter, mouse.band, current_theme())
        painter.setFont(self.stage.letters)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        paint_words(painter, self.content, self.stage.layout, QRectF(self.rect()), current_theme())
        if self.hasFocus():
            paint_focus_frame(painter, QRectF(self.rect()), current_theme())
        painter.end()

    def event(self, event: QEvent) -> bool:
        if isinstance(event, QHelpEvent) and event.type() == QEvent.Type.ToolTip:
            words = hover_words(self.content, self.stage.layout, QPointF(event.pos()))
            QToolTip.showText(event.globalPos(), words, self)
            return True
        return claims_shortcut(event, self._claims) or super().event(event)

    def _claims(self, event: QKeyEvent) -> bool:
        return self.picker.claims(event)

    def wheelEvent(self, event: QWheelEvent) -> None:
        self.stage.pan_zoom.wheel(event)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self.stage.pan_zoom.press(event)
        self.picker.press(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        self.stage.pan_zoom.move(event)
        if self.stage.layout is not None:
            self.picker.mouse.move(event.position(), self.stage.layout.points)
            self._pointer.follow(input_at(self.content, self.stage.layout, event.position()))
            self.readout_changed.emit(self.readout())
            self.update()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        self.stage.pan_zoom.release(event)
        if event.button() == Qt.MouseButton.LeftButton and self.stage.layout is not None:
            points, mouse = self.stage.layout.points, self.picker.mouse
            on_output = output_at(points, event.position()) is not None
            adds = bool(event.modifiers() & ADDS) and on_output
            meant_input = input_meant(self.content, self.stage.layout, event.position(), self._last)
            if meant_input is not None and mouse.band is None and not adds:
                self._choose_inputs((meant_input,))
                mouse.give_up()
            elif on_output:
                self._last = "outputs"
            self.picker.release(event, points)
            self.update()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton and self.stage.layout is not None:
            at = event.position()
            on_input = input_at(self.content, self.stage.layout, at) is not None
            if on_input or output_at(self.stage.layout.points, at) is not None:
                # The second of two quick clicks.
                self.picker.mouse.press(at)
            else:
                self.stage.pan_zoom.show(WHOLE)

    def leaveEvent(self, event: QEvent) -> None:
        super().leaveEvent(event)
        self.picker.mouse.leave()
        self._pointer.follow(None)
        self.readout_changed.emit(self.readout())
        self.update()

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        by_key = event.reason() == QContextMenuEvent.Reason.Keyboard
        middle = self.mapToGlobal(self.rect().center())
        self.menu_requested.emit(middle if by_key else event.globalPos())

    def keyPressEvent(self, event: QKeyEvent) -> None:
        layout, wanted = self.stage.layout, meaning_of("skin", event)
        middle = QRectF(self.rect()).center()
        if layout is None:
            super().keyPressEvent(event)
        elif wanted == "whole":
            self.stage.pan_zoom.show(WHOLE)
        elif wanted == "hand":
            self.stage.pan_zoom.show(HAND)
        elif wanted == "remove":
            self.removal_wanted.emit(self._last == "outputs")
        elif wanted == "select_none" and self._last == "input" and selected_inputs(self.content):
            if not self.picker.mouse.give_up():
                self._choose_inputs(())
            self.update()
        elif self.stage.pan_zoom.step(wanted) or self.picker.press_key(
            event, layout.points, layout.unplaced, middle
        ):
            self.update()
        else:
            super().keyPressEvent(event)

    def _choose_inputs(self, ids: tuple[int, ...]) -> None:
        self._last = "input"
        self.inputs_chosen.emit(ids)

    def _choose_outputs(self, outputs: tuple[int, ...]) -> None:
        self._last, self._chosen = "outputs", outputs
        self.outputs_chosen.emit(outputs)

    def _follow_cursor(self) -> None:
        if self.picker.keys.cursor_output is not None:
            self.stage.pan_zoom.reveal(self.stage.place_of(self.picker.keys.cursor_output))
        self.readout_changed.emit(self.readout())
        self.update()
