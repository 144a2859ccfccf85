"""The field of a number with its unit: typed, dragged, stepped by wheel or keys."""

from dataclasses import dataclass
from fractions import Fraction
from math import inf

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QPoint, QRect, QSize, Qt, QTimer, Signal

from skinsource.base.errors import InvalidInputError
from skinsource.design.display_units import SHOWN_DIGITS, display_unit, number_text, with_unit
from skinsource.specs.numbers import NumberSpec
from skinsource_gui.fields.editor import MIXED, TEMPORARY_LOSSES, Burst, Editor, new_gesture
from skinsource_gui.fields.units import (
    COARSE,
    EDITED_DIGITS,
    FINE,
    PLAIN,
    Ladder,
    clamped,
    has_level,
    minus,
    parse_level,
    range_text,
    stepped,
)
from skinsource_gui.qt.frames import paint_problem
from skinsource_gui.qt.keys import claims_shortcut, meaning_of
from skinsource_gui.qt.layouts import named, show_tip_below, tooltip
from skinsource_gui.qt.theme import current_theme, letter_scale, tabular
from skinsource_gui.qt.wheel import NOTCH

#: Marks a number with fewer digits than usual, and replaces a number for which there is no room.
ROUNDED, NO_ROOM = "≈", "…"
# A number rounded to fewer digits is marked.
_ENOUGH_DIGITS = 3


def fitting_text(
    value_si: float, spec: NumberSpec, metrics: QtGui.QFontMetrics, room_px: float
) -> str:
    """Return a number with as many digits as fit; ≈ marks one with only 1 or 2 digits.

    A number must not be cut: if not even one digit fits, "…" replaces it.
    """
    if spec.unset and value_si == 0.0 and metrics.horizontalAdvance(spec.unset) <= room_px:
        return spec.unset
    whole = minus(number_text(value_si, spec.unit))
    for digits in range(SHOWN_DIGITS, 0, -1):
        text = minus(number_text(value_si, spec.unit, digits))
        if digits < _ENOUGH_DIGITS and text != whole:
            text = f"{ROUNDED}{text}"
        if metrics.horizontalAdvance(text) <= room_px:
            return text
    return NO_ROOM


def help_text(spec: NumberSpec) -> str:
    """Return the tooltip of a field: label, allowed values, and how to change the value."""
    level = f"Type −6 dB for a level re 1 {spec.unit}" if has_level(spec) else ""
    return tooltip(
        f"{spec.label}, {range_text(spec)}",
        spec.about,
        "Drag, turn the wheel, or type; Ctrl: finer; Shift: coarser",
        level.rstrip(),
    )


def outside_band_text(spec: NumberSpec) -> str:
    """Return the remark on a frequency outside the measured band."""
    low_hz, high_hz = spec.measured_band_hz or (0.0, inf)
    return f"outside the measured band ({low_hz:g} to {high_hz:g} Hz)"


_STARTERS = frozenset("0123456789.,+-−")
FINISHERS = frozenset({Qt.Key.Key_Return, Qt.Key.Key_Enter})
_OTHERS = (
    Qt.KeyboardModifier.ControlModifier
    | Qt.KeyboardModifier.AltModifier
    | Qt.KeyboardModifier.MetaModifier
)


def begins_typing(event: QtGui.QKeyEvent) -> bool:
    """Return whether a key begins typing."""
    typed = not event.modifiers() & _OTHERS and event.text() in _STARTERS
    return typed or meaning_of("number", event) in ("type", "empty")


def makes_step(event: QtGui.QKeyEvent) -> bool:
    """Return whether a key goes to the next round number."""
    return meaning_of("number", event) in ("step", "page")


#: Movement of the mouse for one step, and movement that turns a press into a drag.
PIXELS_PER_STEP = 4
DRAG_BEGINS_PX = 3

_DIRECTIONS = {
    Qt.Key.Key_Up: 1,
    Qt.Key.Key_Down: -1,
    Qt.Key.Key_PageUp: 1,
    Qt.Key.Key_PageDown: -1,
}


@dataclass(slots=True, kw_only=True)
class _Drag:
    """A press that may become a drag.

    Attributes
    ----------
    last
        Last place of the mouse.
    gesture
        Number shared by all edits; None until the press becomes a drag.
    start_si
        Value before the drag.
    ladder, position
        Values along the drag, and its position among them.
    travel_px
        Movement that is not yet a step.
    """

    last: QPoint
    gesture: int | None = None
    start_si: float
    ladder: Ladder | None = None
    position: int = 0
    travel_px: int = 0


def _size(modifiers: Qt.KeyboardModifier) -> Fraction:
    if modifiers & Qt.KeyboardModifier.ControlModifier:
        return FINE
    return COARSE if modifiers & Qt.KeyboardModifier.ShiftModifier else PLAIN


#: Fields below each other have the same room for units, so that digits align.
WIDEST_UNIT = "m/s²"
# Minimum width of a field in letters of the usual size.
_LEAST_PX = 72
# Between number and unit; what Qt leaves at each side of the text of a line edit.
_GAP_PX, _TEXT_EDGE_PX = 4, 2
# Events that change the size of letters or of the frame.
_OTHER_SIZES = (QEvent.Type.FontChange, QEvent.Type.StyleChange)


def end_typing() -> None:
    """Take over the number that is being typed, if any is."""
    field = QtWidgets.QApplication.focusWidget()
    if isinstance(field, NumberField):
        field.commit()


class NumberField(Editor, QtWidgets.QLineEdit):
    """Shows and edits a value in its display unit.

    A double click or a digit begins typing; Enter commits, Esc restores.  A text that is not
    allowed has a red outline and a reason, and never becomes the value; when the focus leaves, the
    value comes back and the reason stays visible.  A drag, the wheel and the arrow keys step to
    round numbers; Ctrl makes steps fine, Shift coarse.  All values of one drag share one gesture,
    and so do steps that follow each other quickly.  The wheel acts only while the field has the
    focus, so that scrolling a panel changes nothing.

    Parameters
    ----------
    spec
        Allowed values.
    widest_unit
        Unit for which there is room, so that digits align with those of other fields.
    problem_beside
        Whether the owner shows problems beside the field; else the tooltip does.

    Attributes
    ----------
    spec, value_si
        Allowed values, and the value in SI units.
    problem
        Why the typed text is not allowed, or "".
    burst
        Gives quick steps one gesture.
    """

    #: The new value in SI units; number of its gesture, or None for a step of its own.
    edited = Signal(float, object)

    def __init__(
        self,
        spec: NumberSpec,
        parent: QtWidgets.QWidget | None = None,
        *,
        widest_unit: str = WIDEST_UNIT,
        problem_beside: bool = False,
    ) -> None:
        super().__init__(parent)
        self.spec, self.value_si = spec, clamped(0.0, spec)
        self.problem, self.burst, self._mixed = "", Burst(self), False
        self._widest_unit = widest_unit
        self._problem_beside = problem_beside
        self._drag: _Drag | None = None
        self._wheel_travel = 0.0
        self.textEdited.connect(self._check_again)
        self.setReadOnly(True)
        self.setCursor(Qt.CursorShape.SizeHorCursor)
        self.setMaxLength(40)
        self.setAcceptDrops(False)  # files are dropped on the window
        self.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.setFont(tabular(self.font()))
        self._show_spec()

    def minimumSizeHint(self) -> QSize:
        least_px = round(_LEAST_PX * letter_scale(self.font()))
        return QSize(least_px, super().minimumSizeHint().height())

    @property
    def editing(self) -> bool:
        """Whether the user is typing."""
        return not self.isReadOnly()

    @property
    def unit_text(self) -> str:
        """The unit beside the number; a text in place of a number has none."""
        if (self._mixed or (self.spec.unset and self.value_si == 0.0)) and not self.editing:
            return ""
        return display_unit(self.spec.unit, self.value_si).symbol

    def set_spec(self, spec: NumberSpec) -> None:
        """Change the allowed values or the unit."""
        if spec != self.spec:
            self.spec = spec
            self._show_spec()

    def set_value(self, value_si: float) -> None:
        """Show another value without a signal.  A text that is being typed stays."""
        if value_si != self.value_si:
            # Steps and drags go on from the new value.
            self.burst.end()
            if self._drag is not None:
                self._drag.ladder = None
            if not self.editing or self.window().focusWidget() is not self:
                self._end_typing()
            self._show(float(value_si))

    def show_mixed(self, mixed: bool) -> None:
        """Say "mixed" in place of the number, or show it."""
        if mixed != self._mixed:
            self._mixed = mixed
            self.setPlaceholderText(MIXED if mixed else "")
            self.setAccessibleDescription(MIXED if mixed else "")
            self._show(self.value_si)

    def advice(self) -> str:
        """Warn of a frequency that was not measured."""
        return "" if self.spec.is_known(self.value_si) else outside_band_text(self.spec)

    def begin_editing(self, text: str | None = None) -> None:
        """Let the user type; ``text`` replaces the number, which is selected otherwise."""
        self._set_problem("")
        self.setReadOnly(False)
        self.setCursor(Qt.CursorShape.IBeamCursor)
        self.setText(text if text is not None else "" if self._mixed else self._long_text)
        if text is None:
            self.selectAll()

    def cancel(self) -> None:
        """Forget the typed text and its problem, and end a drag."""
        self._drag = None
        if self.editing or self.problem:
            self._end_typing()
            self._show(self.value_si)

    def commit(self) -> bool:
        """Make the typed text the value; return whether that is possible."""
        if not self.editing:
            return True
        if self._mixed and not self.text():
            self.cancel()
            return True
        try:
            typed_si = self._read(self.text())
        except InvalidInputError as error:
            self._set_problem(str(error))
            return False
        self.cancel()
        # The text may be rounded.
        same = self.value_si, self._parsed(self._long_text), self._parsed(self._number_text())
        if self._mixed or typed_si not in same:
            self._edit(typed_si, None)
        return True

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        if makes_step(event):
            if self.commit():
                size = COARSE if meaning_of("number", event) == "page" else _size(event.modifiers())
                direction = _DIRECTIONS[Qt.Key(event.key())]
                self._step_to(stepped(self.value_si, direction, self.spec, size))
        elif event.key() == Qt.Key.Key_Escape and self._drag is not None:
            self._cancel_drag(self._drag)
        elif self.editing:
            if event.key() in FINISHERS:
                self.commit()
            elif event.key() == Qt.Key.Key_Escape:
                self.cancel()
            else:
                super().keyPressEvent(event)
        elif event.matches(QtGui.QKeySequence.StandardKey.Copy):
            unit = display_unit(self.spec.unit, self.value_si)
            QtGui.QGuiApplication.clipboard().setText(with_unit(self._long_text, unit))
        elif event.matches(QtGui.QKeySequence.StandardKey.Paste):
            self.begin_editing()
            self.paste()
        elif begins_typing(event):
            meaning = meaning_of("number", event)
            typed = "" if meaning == "empty" else event.text()
            self.begin_editing(None if meaning == "type" else typed)
        else:
            event.ignore()

    def event(self, event: QEvent) -> bool:
        if (
            isinstance(event, QtGui.QKeyEvent)
            and event.type() == QEvent.Type.ShortcutOverride
            and event.matches(QtGui.QKeySequence.StandardKey.Undo)
            and self.editing
            and self.text() == self._long_text
        ):
            # Nothing was typed yet: what is taken back is the last edit.
            self.cancel()
            event.ignore()
            return True
        return claims_shortcut(event, self._claims) or super().event(event)

    def _claims(self, event: QtGui.QKeyEvent) -> bool:
        return (
            makes_step(event)
            or event.matches(QtGui.QKeySequence.StandardKey.Paste)
            or (begins_typing(event) and not self.editing)
            or (event.key() == Qt.Key.Key_Escape and (self.editing or self._drag is not None))
        )

    def wheelEvent(self, event: QtGui.QWheelEvent) -> None:
        if not self.hasFocus():
            event.ignore()
            return
        event.accept()
        # Shift and Alt turn a vertical wheel into a horizontal one on some systems.
        self._wheel_travel += event.angleDelta().y() or event.angleDelta().x()
        notches = int(self._wheel_travel / NOTCH)
        self._wheel_travel -= notches * NOTCH
        if notches and self.commit():
            ladder = Ladder(self.value_si, self.spec, _size(event.modifiers()))
            self._step_to(ladder.value_si(notches))

    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        if self.editing or event.button() != Qt.MouseButton.LeftButton:
            super().mousePressEvent(event)
        else:
            position = event.globalPosition().toPoint()
            self._drag = _Drag(last=position, start_si=self.value_si)

    def mouseMoveEvent(self, event: QtGui.QMouseEvent) -> None:
        if self._drag is not None:
            self._move(self._drag, event)
        elif self.editing:
            # Without a press this would only set the cursor of a text.
            super().mouseMoveEvent(event)

    def mouseReleaseEvent(self, event: QtGui.QMouseEvent) -> None:
        if self._drag is None:
            super().mouseReleaseEvent(event)
        self._drag = None

    def mouseDoubleClickEvent(self, event: QtGui.QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self._drag = None
            if not self.editing:
                self.begin_editing()
            # A third click selects all, too, where Qt was told of the second.
            super().mouseDoubleClickEvent(event)
            self.selectAll()

    def focusInEvent(self, event: QtGui.QFocusEvent) -> None:
        super().focusInEvent(event)
        if not self.editing:
            self.deselect()

    def focusOutEvent(self, event: QtGui.QFocusEvent) -> None:
        super().focusOutEvent(event)
        if not self.editing or event.reason() in TEMPORARY_LOSSES:
            return
        if self.commit():
            return
        # The value comes back; the problem stays until the field is used again.
        self._close()
        self._show(self.value_si)
        if not self._problem_beside:
            problem = self.problem
            self._end_typing()
            # The widget that gets the focus now hides tooltips.
            QTimer.singleShot(0, self, lambda: show_tip_below(self, problem))

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() in _OTHER_SIZES:
            self._show_spec()

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._show(self.value_si)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        super().paintEvent(event)
        painter = QtGui.QPainter(self)
        has_own_unit = self.editing and any(c.isalpha() or c in "°×²" for c in self.text())
        if not has_own_unit:
            place = self._inside()
            place.setLeft(place.right() - self.textMargins().right() + _GAP_PX)
            painter.setPen(QtGui.QColor(current_theme().dim))
            middle = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
            painter.drawText(place, middle, self.unit_text)
        if self.problem and self.editing:
            paint_problem(painter, self.rect())

    def _step_to(self, value_si: float) -> None:
        if value_si != self.value_si:
            self._edit(value_si, self.burst.gesture())

    def _move(self, drag: _Drag, event: QtGui.QMouseEvent) -> None:
        """Follow the mouse while the button is held."""
        position, size = event.globalPosition().toPoint(), _size(event.modifiers())
        travel = position - drag.last
        if drag.gesture is None:
            if travel.manhattanLength() < DRAG_BEGINS_PX:
                return
            drag.gesture = new_gesture()
        drag.last = position
        drag.travel_px += travel.x() - travel.y()
        if drag.ladder is None or drag.ladder.size != size:
            drag.ladder, drag.position = Ladder(self.value_si, self.spec, size), 0
        steps = int(drag.travel_px / PIXELS_PER_STEP)
        drag.travel_px -= steps * PIXELS_PER_STEP
        drag.position += steps
        # Counted from the start, so that dragging back leads to the same number.
        value_si = drag.ladder.value_si(drag.position)
        if value_si in (self.spec.minimum, self.spec.maximum):
            # At a bound the number stays; dragging back moves it at once.
            drag.ladder, drag.position = Ladder(value_si, self.spec, size), 0
        if value_si != self.value_si:
            self._edit(value_si, drag.gesture)

    def _cancel_drag(self, drag: _Drag) -> None:
        self._drag = None
        if self.value_si != drag.start_si:
            self._edit(drag.start_si, drag.gesture)

    def _edit(self, value_si: float, gesture: int | None) -> None:
        self._end_typing()
        self._show(value_si)
        self.edited.emit(value_si, gesture)

    def _show(self, value_si: float) -> None:
        self.value_si = value_si
        if not self.editing:
            room_px = self._inside().width() - self.textMargins().right() - 2 * _TEXT_EDGE_PX
            text = fitting_text(value_si, self.spec, self.fontMetrics(), room_px)
            self.setText("" if self._mixed else text)
            self.update()

    def _show_spec(self) -> None:
        symbol = display_unit(self.spec.unit, self.value_si).symbol
        unit_px = max(map(self.fontMetrics().horizontalAdvance, (symbol, self._widest_unit)))
        self.setTextMargins(0, 0, unit_px + _GAP_PX, 0)
        named(self, title=self.spec.label, hint=help_text(self.spec))
        self._show(self.value_si)

    @property
    def _long_text(self) -> str:
        """The number as it is edited."""
        return self._number_text(EDITED_DIGITS)

    def _number_text(self, digits: int = SHOWN_DIGITS) -> str:
        return number_text(self.value_si, self.spec.unit, digits)

    def _read(self, text: str) -> float:
        return parse_level(text, self.spec, self.value_si)

    def _inside(self) -> QRect:
        """Return the area of the number and its unit."""
        option = QtWidgets.QStyleOptionFrame()
        self.initStyleOption(option)
        return self.style().subElementRect(
            QtWidgets.QStyle.SubElement.SE_LineEditContents, option, self
        )

    def _parsed(self, text: str) -> float | None:
        """Return the value of a text, in SI units; None if it is not allowed."""
        try:
            return self._read(text)
        except InvalidInputError:
            return None

    def _check_again(self, text: str) -> None:
        """Clear the problem as soon as the text is allowed."""
        if self.problem and self._parsed(text) is not None:
            self._set_problem("")

    def _end_typing(self) -> None:
        self._close()
        self._set_problem("")

    def _close(self) -> None:
        if self.editing:
            self.setReadOnly(True)
            self.setCursor(Qt.CursorShape.SizeHorCursor)

    def _set_problem(self, problem: str) -> None:
        if problem == self.problem:
            return
        self.problem = problem
        self.update()
        if not self._problem_beside:
            self.setToolTip(problem or help_text(self.spec))
            if problem:
                show_tip_below(self, problem)
        self.problem_changed.emit(problem)
