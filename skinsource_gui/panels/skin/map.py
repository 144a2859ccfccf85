"""The widget of the skin map: what is under the pointer, its texts, and its zoom."""

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QObject, QPoint, QPointF, QRectF, QSize, QSizeF, Qt, Signal

from skinsource.base.errors import counted
from skinsource.design.labels import BACK_SIDE
from skinsource.limbs.limb import LimbMap
from skinsource.limbs.locations import input_name, output_name
from skinsource_gui.fields.editor import new_gesture
from skinsource_gui.fields.units import minus, output_text
from skinsource_gui.panels.skin.content import InputMark, MapContent
from skinsource_gui.panels.skin.layout import (
    HAND,
    MapLayout,
    VisiblePart,
    fitted_beside_card,
    map_layout,
    visible_part,
)
from skinsource_gui.panels.skin.painting import (
    MapPainter,
    letters_for,
    marks_at,
    paint_mark,
    small_font,
)
from skinsource_gui.panels.skin.settings import SENSATION, Z, time_text
from skinsource_gui.plots.curves import fitting
from skinsource_gui.plots.outputs import ADDS, REACH_PX, OutputPicker, is_placed, output_at
from skinsource_gui.plots.small_map import (
    FIXED_MARK,
    bounds_of,
    hand_bounds,
    outline_of,
    paint_band,
    paint_ring,
)
from skinsource_gui.qt.accessible import Told
from skinsource_gui.qt.frames import CachedPicture, Same, paint_focus_frame
from skinsource_gui.qt.keys import KEYS, claims_shortcut, meaning_of
from skinsource_gui.qt.questions import copied_level, copied_number, tab_separated
from skinsource_gui.qt.theme import Theme, current_theme, tabular, translucent
from skinsource_gui.qt.wheel import FREE, WHOLE, PanZoom

#: Number of inputs on top of each other that are named.
_NAMED = 3
_PLACE_RING_PX = 7.0


def input_at(content: MapContent, layout: MapLayout | None, at: QPointF) -> int | None:
    """Return the id of the input whose mark is at a place of the screen."""
    marks = _inputs_at(content, layout, at)
    return marks[0].id if marks else None


def clicked_input(
    content: MapContent, layout: MapLayout | None, at: QPointF, last: str
) -> int | None:
    """Return the id of the input that a click selects; None: the output there, or nothing.

    Marks on top of each other take turns, click by click: an output, then one input after the
    other. ``last`` is what the click before selected: "input" or "outputs".
    """
    if layout is None:
        return None
    inputs = [mark.id for mark in _inputs_at(content, layout, at)]
    output = output_at(layout.points, at)
    candidates = [*([] if output is None else [None]), *inputs]
    chosen = selected_inputs(content)
    if len(chosen) == 1 and chosen[0] in inputs and (output is None or last == "input"):
        turn = candidates.index(chosen[0]) + 1
    else:
        turn = int(output is not None and last == "outputs" and content.outputs == (output,))
    return candidates[turn % len(candidates)] if candidates else None


def inputs_text(content: MapContent, layout: MapLayout | None, at: QPointF) -> str:
    """Return a line for each input at a place of the screen, and how to reach those below."""
    marks = _inputs_at(content, layout, at)
    numbers = {mark.id: number for number, mark in enumerate(content.inputs, 1)}
    names = {mark.id: input_name(mark.location, content.limb).name for mark in marks}
    lines = [
        f"Input {numbers[mark.id]}: {mark.location} · {names[mark.id]}" for mark in marks[:_NAMED]
    ]
    lines += ["…"] * (len(marks) > _NAMED)
    covered = layout is not None and output_at(layout.points, at) is not None
    if len(marks) + covered > 1:
        lines.append("Click again for the next one here")
    return "\n".join(lines)


def _inputs_at(content: MapContent, layout: MapLayout | None, at: QPointF) -> tuple[InputMark, ...]:
    if content.limb_map is None or layout is None:
        return ()
    return marks_at(content.inputs, content.limb_map, layout, at)


def selected_inputs(content: MapContent) -> tuple[int, ...]:
    """Return the ids of the selected inputs."""
    return tuple(mark.id for mark in content.inputs if mark.selected)


def output_readout(content: MapContent, number: int) -> str:
    """Return number and place of an output, and its value."""
    values = content.coloured_values
    text = output_text(number, content.limb)
    return text if values is None else f"{text} · {content.quantity.text(values[number - 1])}"


def pixel_readout(content: MapContent, layout: MapLayout, at: QPointF) -> str:
    """Return value of the interpolated map at a screen place, empty outside."""
    field, levels = content.shown_field, content.field_values
    if field is None or levels is None or layout.palmar_card.contains(at):
        return ""
    level = field.level_at(levels, *layout.frame.to_drawing(at))
    return "" if level is None else content.quantity.text(level)


def map_tooltip(content: MapContent, layout: MapLayout | None, at: QPointF) -> str:
    """Return the tooltip at a screen place: of an output, of inputs, or nothing."""
    if layout is None:
        return ""
    number = output_at(layout.points, at)
    lines = [] if number is None else [output_readout(content, number)]
    return "\n".join(filter(None, [*lines, inputs_text(content, layout, at)]))


_COLUMNS = {SENSATION: "above_threshold_db", Z: "acceleration_z_m_per_s2"}


def numbers_text(content: MapContent) -> str:
    """Return the value of each output for a spreadsheet, and what it is as a remark below."""
    quantity, values = content.quantity, content.coloured_values
    copied = copied_number if quantity.signed else copied_level
    levels, half_db = "level_db_re_1_m_per_s2", quantity.half_db
    ends = {f"low_{levels}": -half_db, f"high_{levels}": half_db} if half_db else {}
    lines = [("output", "place", _COLUMNS.get(quantity.name, levels), *ends)]
    for number, value in enumerate(() if values is None else values, 1):
        cells = (copied(value + by_db) for by_db in (0.0, *ends.values()))
        lines.append((str(number), output_name(number, content.limb).name, *cells))
    return f"{tab_separated(lines)}# {' · '.join(filter(None, quantity.words))}\n"


def selection_hint(outputs: tuple[int, ...]) -> str:
    """Return how many outputs are selected, and how to select others."""
    if not outputs:
        return "No output selected · click one, or drag around several"
    return f"{counted(len(outputs), 'output')} selected · Shift+click adds or removes one"


def brush_hint(brush: str) -> str:
    """Return what a brush does, and how to put it away."""
    return f"Brush {brush} · click or drag over outputs · Esc ends"


def strongest_readout(content: MapContent) -> tuple[str, str, str]:
    """Return the strongest output, the same with its value, and its level; "": a wave moves."""
    values = content.coloured_values
    if values is None or content.quantity.moves or not np.isfinite(values).any():
        return "", "", ""
    number = int(np.nanargmax(values)) + 1
    place, level = output_text(number, content.limb), minus(f"{values[number - 1]:z.1f} dB")
    return f"Strongest: {place}", f"Strongest: {output_readout(content, number)}", level


SYNTHETIC_MARK = "SYNTHETIC"
OUTDATED_MARK = "updating…"


def paint_map_texts(
    painter: QtGui.QPainter,
    content: MapContent,
    room: QRectF,
    theme: Theme,
    *,
    outdated: bool = False,
) -> None:
    """Draw side, message, synthetic mark and the mark of something outdated in ``room``."""
    unit = QtGui.QFontMetricsF(painter.font()).height() / 14
    inner = room.adjusted(8 * unit, 2 * unit, -5 * unit, -6 * unit)
    free = QRectF(inner)
    if content.synthetic:
        free.setRight(_paint_synthetic_mark(painter, inner, theme) - 8 * unit)
    painter.save()
    painter.setFont(small_font(painter.font()))
    metrics = QtGui.QFontMetricsF(painter.font())
    label = _side_text(content, free.width(), metrics, outdated=outdated)
    _paint_card(painter, free, label, theme)
    painter.restore()
    if content.message:
        _paint_message(painter, inner, content.message, theme)


def _side_text(
    content: MapContent, room_px: float, metrics: QtGui.QFontMetricsF, *, outdated: bool
) -> str:
    side = "" if content.limb_map is None else BACK_SIDE
    parts = [FIXED_MARK] if content.fixed else []
    if content.quantity.moves and content.values is not None:
        parts.insert(0, time_text(content.quantity.time_s))
    phrasings: tuple[str, ...]
    if outdated:
        phrasings = (f"{side} · {OUTDATED_MARK}", OUTDATED_MARK) if side else (OUTDATED_MARK,)
    elif parts and side:
        phrasings = (" · ".join((side, *parts)), " · ".join(parts), parts[0])
    else:
        phrasings = (side, side.partition(" ")[0])
    return fitting(phrasings, metrics, room_px) or phrasings[-1]


def _paint_synthetic_mark(painter: QtGui.QPainter, area: QRectF, theme: Theme) -> float:
    """Draw the word SYNTHETIC into the upper right corner of ``area``; return its left edge."""
    painter.save()
    font = small_font(painter.font())
    font.setBold(True)
    painter.setFont(font)
    metrics = QtGui.QFontMetricsF(font)
    line = metrics.height()
    width = metrics.horizontalAdvance(SYNTHETIC_MARK) + 0.7 * line
    badge = QRectF(area.right() - width, area.top(), width, 1.25 * line)
    painter.setPen(QtGui.QColor(theme.warning))
    painter.setBrush(QtGui.QColor(theme.base))
    painter.drawRoundedRect(badge, 3, 3)
    painter.drawText(badge, Qt.AlignmentFlag.AlignCenter, SYNTHETIC_MARK)
    painter.restore()
    return badge.left()


def _paint_message(painter: QtGui.QPainter, area: QRectF, text: str, theme: Theme) -> None:
    """Draw a message at the lower edge of ``area``, where it hides no finger."""
    flags = int(Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap)
    inside = area.adjusted(10, 7, -10, -7)
    card = QtGui.QFontMetricsF(painter.font()).boundingRect(inside, flags, text)
    card.adjust(-10, -7, 10, 7)
    card.moveBottom(area.bottom())
    painter.setPen(QtGui.QColor(theme.border))
    painter.setBrush(QtGui.QColor(theme.base))
    painter.drawRoundedRect(card, 4, 4)
    painter.setPen(QtGui.QColor(theme.text))
    painter.drawText(card.adjusted(10, 7, -10, -7), flags, text)


def _paint_card(painter: QtGui.QPainter, area: QRectF, text: str, theme: Theme) -> None:
    """Draw text into the upper left corner of ``area``, readable on any ground."""
    if not text:
        return
    # One line: below a second one there could be skin.
    flags, metrics = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop, painter.fontMetrics()
    text = metrics.elidedText(text, Qt.TextElideMode.ElideRight, int(area.width()))
    needed = QtGui.QFontMetricsF(painter.font()).boundingRect(area, int(flags), text)
    ground = translucent(theme.base, 224)
    painter.fillRect(needed.adjusted(-4, -2, 4, 2), ground)
    painter.setPen(QtGui.QColor(theme.dim))
    painter.drawText(needed, int(flags), text)


class MapStage(QObject):
    """Fits the map of a limb into a widget, and lays it out for each pan and zoom.

    Parameters
    ----------
    widget
        The widget; labels have small letters of its font, or smaller ones.

    Attributes
    ----------
    pan_zoom
        Which part of it is visible.
    layout
        Screen places of everything; None before there is a limb.
    """

    #: Everything has moved.
    changed = Signal()

    def __init__(self, widget: QtWidgets.QWidget) -> None:
        super().__init__(widget)
        self._widget = widget
        self._limb_map: LimbMap | None = None
        self.layout: MapLayout | None = None
        self.pan_zoom = PanZoom(widget)
        self.pan_zoom.fit = HAND
        self.pan_zoom.changed.connect(self._lay_out)

    @property
    def letters(self) -> QtGui.QFont:
        """Font of messages; labels have a smaller one."""
        return letters_for(self._widget.font(), self._room)

    @property
    def visible(self) -> VisiblePart:
        """What part of the map is in sight."""
        return visible_part(self.pan_zoom, self._room)

    def place_of(self, number: int) -> QPointF:
        """Return where an output is drawn; a null point before there is a limb."""
        return QPointF() if self.layout is None else QPointF(*self.layout.points[number - 1])

    def show_limb(self, limb_map: LimbMap | None) -> None:
        """Show another limb, which is fitted anew."""
        self._limb_map = limb_map
        if self.pan_zoom.fit == FREE:
            self.pan_zoom.fit = HAND
        self.fit()

    def show_arm(self, *, shown: bool) -> None:
        """Fit hand and arm, or the hand alone."""
        self.pan_zoom.show(WHOLE if shown else HAND)

    def fit(self) -> None:
        """Fit the limb into the widget, which has another size."""
        limb_map, room = self._limb_map, self._room
        if limb_map is None:
            self.pan_zoom.arrange({}, np.zeros((0, 2)), room)
            return
        fits = {
            WHOLE: fitted_beside_card(limb_map, bounds_of(limb_map.outline), room, self._metrics),
            HAND: fitted_beside_card(limb_map, hand_bounds(limb_map), room, self._metrics),
        }
        self.pan_zoom.arrange(fits, limb_map.outline, room)

    def _lay_out(self) -> None:
        frame, self.layout = self.pan_zoom.frame, None
        if frame is not None and self._limb_map is not None:
            self.layout = map_layout(self._limb_map, frame, self._room, self._metrics)
        self.changed.emit()

    @property
    def _room(self) -> QRectF:
        return QRectF(self._widget.rect())

    @property
    def _metrics(self) -> QtGui.QFontMetricsF:
        return QtGui.QFontMetricsF(small_font(self.letters))


class SkinMap(QtWidgets.QWidget):
    """Shows `MapContent`, and emits which outputs or inputs the user selects.

    Attributes
    ----------
    content
        What is shown.
    stage
        Which part of it is visible, and where everything lies.
    picker
        Which outputs mouse and keys select.
    ring
        The place of the limb under the pointer, here or on the hand, in outline pixels.
    paints
        Whether clicks and drags paint outputs, and select none.
    """

    #: The outputs to paint, a tuple of numbers; number of the gesture.
    painted = Signal(object, object)
    #: The outputs to select, a tuple of numbers.
    outputs_chosen = Signal(object)
    #: Text on what is under the pointer or the keyboard's cursor; empty for nothing.
    readout_changed = Signal(str)
    #: Id of the input that is pointed at, or None; ids of the inputs to select, a tuple.
    input_pointed_at = Signal(object)
    #: The place of the limb under the pointer, outline pixels (x, y), or None.
    place_pointed_at = Signal(object)
    inputs_chosen = Signal(object)
    #: Delete was pressed; whether what was selected last are outputs.
    removal_requested = Signal(bool)
    #: Point of the screen at which the menu shall open.
    menu_requested = Signal(QPoint)

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.content = MapContent()
        self._painter: MapPainter | None = None
        self._outdated = False
        self._texts = CachedPicture()
        self.ring: tuple[float, float] | None = None
        self.paints = False
        # The outputs that were painted since the button went down, and the gesture.
        self._stroke: set[int] | None = None
        self._gesture = 0
        self._input_under_pointer: int | None = None
        # The same, or that under the pointer in another panel.
        self._input_marked: int | None = None
        # What was selected here last, "input" or "outputs": keys act on that.
        self._last = ""
        # Outputs that were selected here last.
        self._chosen: tuple[int, ...] = ()
        self.stage = MapStage(self)
        self.picker = OutputPicker(self)
        self.stage.changed.connect(self._rest)
        self.picker.chosen.connect(self._choose_outputs)
        self.picker.moved.connect(self._follow_cursor)
        self.setMinimumSize(150, 180)
        # It paints all of its area, so that nothing behind it has to be painted.
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
        if content.outputs not in (self.content.outputs, self._chosen):
            # They were selected elsewhere: the old place of the cursor means nothing any more.
            self.picker.cursor_output = None
        self.content, self.picker.selected = content, content.outputs
        if other_limb:
            limb_map = content.limb_map
            self._painter = None if limb_map is None else MapPainter(limb_map)
            self.stage.show_limb(limb_map)
        self.update()
        if self.picker.pointer is not None or self.hasFocus():
            self.readout_changed.emit(self.readout())

    def leave_outputs(self) -> None:
        """Let keys act on inputs and clips, of which others were selected."""
        if self._last == "outputs":
            self._last = ""

    def show_brush(self, paints: bool) -> None:
        """Paint outputs, or select them."""
        if paints != self.paints:
            self.paints, self._stroke = paints, None
            shape = Qt.CursorShape.CrossCursor if paints else Qt.CursorShape.ArrowCursor
            self.setCursor(shape)

    def show_outdated(self, outdated: bool) -> None:
        """Say whether something newer is being computed."""
        self._outdated = outdated
        self.update()

    def show_pointed_input(self, input_id: int | None) -> None:
        """Mark an input that is under the pointer somewhere."""
        if input_id != self._input_marked:
            self._input_marked = input_id
            self.update()

    def show_pointed_place(self, at: tuple[float, float] | None) -> None:
        """Mark the place of the limb that is under the pointer somewhere, and tell of it."""
        if at != self.ring:
            self.ring = at
            self.readout_changed.emit(self.readout())
            self.update()

    def told_count(self) -> int:
        """Return the number of outputs."""
        return 0 if self.stage.layout is None else len(self.stage.layout.points)

    def told(self, k: int) -> Told:
        """Return what a screen reader says of an output."""
        layout, area = self.stage.layout, QRectF()
        if layout is not None and is_placed(layout.points, k + 1):
            area.setSize(QSizeF(2 * REACH_PX, 2 * REACH_PX))
            area.moveCenter(self.stage.place_of(k + 1))
        return Told(output_readout(self.content, k + 1), area, k + 1 in self.content.outputs)

    def readout(self) -> str:
        """Return a text on what is under the pointer, else under the keyboard's cursor."""
        number, pointer = self.picker.pointed_at(focused=self.hasFocus()), self.picker.pointer
        if number is not None:
            return output_readout(self.content, number)
        layout = self.stage.layout
        if layout is None or self.ring is None:
            return ""
        [ring] = layout.frame.to_screen(np.array([self.ring]))
        return pixel_readout(self.content, layout, pointer or QPointF(*ring))

    def sizeHint(self) -> QSize:
        return QSize(300, 560)

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self.stage.fit()

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        theme = current_theme()
        painter, picker = QtGui.QPainter(self), self.picker
        if self.content.shown_field is None:  # it comes with the ground around it
            painter.fillRect(self.rect(), QtGui.QColor(theme.base))
        if self.stage.layout is not None and self._painter is not None:
            painter.setFont(tabular(small_font(self.stage.letters)))
            layout = self.stage.layout
            self._painter.paint(painter, self.content, layout, theme, self._input_marked)
            if self.ring is not None:
                [ring] = layout.frame.to_screen(np.array([self.ring]))
                pen = QtGui.QPen(QtGui.QColor(theme.text), 1.5 * layout.unit)
                paint_ring(painter, QPointF(*ring), _PLACE_RING_PX * layout.unit, pen, theme)
            marks = [(picker.hovered, theme.text)]
            if self.hasFocus():
                marks.append((picker.cursor_output, theme.accent))
            for number, colour in marks:
                if number is not None:
                    paint_mark(painter, number, colour, self.content, layout, theme)
            if picker.band is not None:
                paint_band(painter, picker.band, theme)
        painter.setFont(self.stage.letters)
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        content, room, outdated = self.content, QRectF(self.rect()), self._outdated
        key = theme.name, Same(self.stage.layout), outdated, *content.texts
        self._texts.paint(
            painter,
            room,
            key,
            lambda on_image: paint_map_texts(on_image, content, room, theme, outdated=outdated),
        )
        if self.hasFocus():
            paint_focus_frame(painter, QRectF(self.rect()), theme)

    def event(self, event: QEvent) -> bool:
        if isinstance(event, QtGui.QHelpEvent) and event.type() == QEvent.Type.ToolTip:
            text = map_tooltip(self.content, self.stage.layout, QPointF(event.pos()))
            QtWidgets.QToolTip.showText(event.globalPos(), text, self)
            return True
        return claims_shortcut(event, self._claims) or super().event(event)

    def _claims(self, event: QtGui.QKeyEvent) -> bool:
        # Some events come before there is a picker: it is looked up for a key alone.
        return self.picker.claims(event)

    def wheelEvent(self, event: QtGui.QWheelEvent) -> None:
        self.stage.pan_zoom.wheel(event)

    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        self.stage.pan_zoom.press(event)
        if not self.paints:
            self.picker.press(event)
        elif event.button() == Qt.MouseButton.LeftButton:
            self._stroke, self._gesture = set(), new_gesture()
            self._paint_at(event.position())

    def mouseMoveEvent(self, event: QtGui.QMouseEvent) -> None:
        self.stage.pan_zoom.move(event)
        self._follow(event.position())
        self._paint_at(event.position())

    def mouseReleaseEvent(self, event: QtGui.QMouseEvent) -> None:
        self.stage.pan_zoom.release(event)
        if self.paints:
            self._stroke = None
        elif event.button() == Qt.MouseButton.LeftButton and self.stage.layout is not None:
            points, picker = self.stage.layout.points, self.picker
            on_output = output_at(points, event.position()) is not None
            adds = bool(event.modifiers() & ADDS) and on_output
            input_id = clicked_input(self.content, self.stage.layout, event.position(), self._last)
            if input_id is not None and picker.band is None and not adds:
                self._choose_inputs((input_id,))
                picker.give_up()
            elif on_output:
                self._last = "outputs"
            picker.release(event, points)
            self.update()

    def mouseDoubleClickEvent(self, event: QtGui.QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton and self.stage.layout is not None:
            at = event.position()
            on_input = input_at(self.content, self.stage.layout, at) is not None
            if self.paints:
                self.mousePressEvent(event)
            elif on_input or output_at(self.stage.layout.points, at) is not None:
                # The second of two quick clicks.
                self.picker.press(event)
            else:
                self.stage.show_arm(shown=self.stage.pan_zoom.fit == HAND)

    def leaveEvent(self, event: QEvent) -> None:
        super().leaveEvent(event)
        self.picker.leave()
        self._point_at(None)
        self._point_at_place(None)
        self.readout_changed.emit(self.readout())
        self.update()

    def contextMenuEvent(self, event: QtGui.QContextMenuEvent) -> None:
        by_key = event.reason() == QtGui.QContextMenuEvent.Reason.Keyboard
        middle = self.mapToGlobal(self.rect().center())
        self.menu_requested.emit(middle if by_key else event.globalPos())

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        layout, meaning = self.stage.layout, meaning_of("skin", event)
        middle = QRectF(self.rect()).center()
        if layout is None:
            super().keyPressEvent(event)
        elif meaning == "whole":
            self.stage.pan_zoom.show(WHOLE)
        elif meaning == "arm":
            self.stage.show_arm(shown=self.stage.pan_zoom.fit == HAND)
        elif self.paints and meaning == "select_none":
            event.ignore()  # it puts the brush away in the whole window
        elif self.paints and meaning == "select" and self.picker.cursor_output is not None:
            self.painted.emit((self.picker.cursor_output,), new_gesture())
        elif meaning == "remove":
            self.removal_requested.emit(self._last == "outputs")
        elif meaning == "select_none" and self._last == "input" and selected_inputs(self.content):
            if not self.picker.give_up():
                self._choose_inputs(())
            self.update()
        elif self.stage.pan_zoom.step(meaning) or self.picker.press_key(
            event, layout.points, layout.unplaced, middle
        ):
            self.update()
        else:
            super().keyPressEvent(event)

    def _follow(self, at: QPointF) -> None:
        if self.stage.layout is not None:
            self.picker.move(at, self.stage.layout.points)
            self._point_at(input_at(self.content, self.stage.layout, at))
            self._point_at_place(self._place_at(at))
            self.readout_changed.emit(self.readout())
            self.update()

    def _paint_at(self, at: QPointF) -> None:
        if self._stroke is None or self.stage.layout is None:
            return
        number = output_at(self.stage.layout.points, at)
        if number is not None and number not in self._stroke:
            self._stroke.add(number)
            self.painted.emit((number,), self._gesture)

    def _rest(self) -> None:
        """Look anew at what lies under a pointer that rests, below which all has moved."""
        if (at := self.picker.pointer) is not None:
            self._follow(at)
        self.update()

    def _point_at(self, input_id: int | None) -> None:
        if input_id != self._input_under_pointer:
            self._input_under_pointer = input_id
            self.show_pointed_input(input_id)
            self.input_pointed_at.emit(input_id)

    def _place_at(self, at: QPointF) -> tuple[float, float] | None:
        """Return the place of the limb at a screen place; None beside it."""
        layout, limb_map = self.stage.layout, self.content.limb_map
        if layout is None or limb_map is None or layout.palmar_card.contains(at):
            return None
        place = layout.frame.to_drawing(at)
        return place if outline_of(limb_map).contains(QPointF(*place)) else None

    def _point_at_place(self, place: tuple[float, float] | None) -> None:
        self.show_pointed_place(place)
        self.place_pointed_at.emit(place)

    def _choose_inputs(self, ids: tuple[int, ...]) -> None:
        self._last = "input"
        self.inputs_chosen.emit(ids)

    def _choose_outputs(self, outputs: tuple[int, ...]) -> None:
        self._last, self._chosen = "outputs", outputs
        self.outputs_chosen.emit(outputs)

    def _follow_cursor(self) -> None:
        if self.picker.cursor_output is not None:
            self.stage.pan_zoom.reveal(self.stage.place_of(self.picker.cursor_output))
        self.readout_changed.emit(self.readout())
        self.update()
