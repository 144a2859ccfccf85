"""The field of a number with its unit: typed, dragged, stepped by wheel or keys.

`NumberDisplay` has the texts of a value, `NumberTyping` edits it as a text, and `NumberGestures`
turns drags, wheel and keys into round numbers.
"""

from dataclasses import dataclass
from fractions import Fraction

from PySide6.QtCore import QEvent, QObject, QPoint, QRectF, QSize, Qt, QTimer, Signal
from PySide6.QtGui import (
    QColor,
    QFocusEvent,
    QFontMetrics,
    QGuiApplication,
    QKeyEvent,
    QKeySequence,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QResizeEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QLineEdit, QWidget

from skinsource.base.errors import InvalidInputError
from skinsource.specs.numbers import NumberSpec
from skinsource_gui.fields.editor import Burst, UnitBeside, new_gesture
from skinsource_gui.fields.units import (
    COARSE,
    EDITED_DIGITS,
    FINE,
    PLAIN,
    SHOWN_DIGITS,
    Ladder,
    clamped,
    display_unit,
    minus,
    number_text,
    parse_number,
    range_text,
    stepped,
    with_unit,
)
from skinsource_gui.qt.keys import claims_shortcut, meaning_of
from skinsource_gui.qt.questions import NextAct
from skinsource_gui.qt.theme import current_theme, letter_scale, tabular
from skinsource_gui.qt.tooltips import show_tip_below, tooltip
from skinsource_gui.qt.wheel import NOTCH

#: Marks a number with fewer digits than usual, and replaces a number for which there is no room.
ROUNDED, NO_ROOM = "≈", "…"
# A number rounded to fewer digits is marked.
_ENOUGH_DIGITS = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class NumberDisplay:
    """The texts of a value in SI units, by its specification."""

    spec: NumberSpec
    value_si: float

    @property
    def symbol(self) -> str:
        """Unit in which the value is shown."""
        return display_unit(self.spec.unit, self.value_si).symbol

    def unit_text(self, *, editing: bool) -> str:
        """Return the unit beside the value; a text in place of a number has none."""
        return "" if self._unset and not editing else self.symbol

    @property
    def _unset(self) -> bool:
        return bool(self.spec.unset) and self.value_si == 0.0

    @property
    def long_text(self) -> str:
        """The number as it is edited."""
        return number_text(self.value_si, self.spec.unit, EDITED_DIGITS)

    @property
    def copied_text(self) -> str:
        """The number with its unit, for the clipboard."""
        return with_unit(self.long_text, display_unit(self.spec.unit, self.value_si))

    def fitting_text(self, metrics: QFontMetrics, room_px: float) -> str:
        """Return the number with as many digits as fit; ≈ marks one with only 1 or 2 digits.

        A number must not be cut: if not even one digit fits, "…" replaces it.
        """
        if self._unset and metrics.horizontalAdvance(self.spec.unset) <= room_px:
            return self.spec.unset
        texts = [
            minus(number_text(self.value_si, self.spec.unit, digits))
            for digits in range(SHOWN_DIGITS, 0, -1)
        ]
        enough = SHOWN_DIGITS - _ENOUGH_DIGITS + 1
        texts[enough:] = [f"{ROUNDED}{text}" for text in texts[enough:] if text != texts[0]]
        fitting = (text for text in texts if metrics.horizontalAdvance(text) <= room_px)
        return next(fitting, NO_ROOM)

    def parsed(self, text: str) -> float | None:
        """Return the value of a text, in SI units; None if it is not allowed."""
        try:
            return parse_number(text, self.spec, self.value_si)
        except InvalidInputError:
            return None

    def is_unchanged_by(self, typed_si: float) -> bool:
        """Return whether typing ``typed_si`` changes nothing: the text may be rounded."""
        short = number_text(self.value_si, self.spec.unit)
        return typed_si in (self.value_si, self.parsed(self.long_text), self.parsed(short))

    def help(self) -> str:
        """Return the tooltip: label, allowed values, and how to change the value."""
        return tooltip(
            f"{self.spec.label}, {range_text(self.spec)}",
            self.spec.about,
            "Drag, turn the wheel or press ↑ ↓: the next round number (Ctrl: finer, Shift or "
            "Page Up, Page Down: ten times as far)",
            "Double-click or type to enter a number",
        )


_STARTERS = frozenset("0123456789.,+-−")
FINISHERS = frozenset({Qt.Key.Key_Return, Qt.Key.Key_Enter})
_OTHERS = (
    Qt.KeyboardModifier.ControlModifier
    | Qt.KeyboardModifier.AltModifier
    | Qt.KeyboardModifier.MetaModifier
)


def begins_typing(event: QKeyEvent) -> bool:
    """Return whether a key begins typing."""
    typed = not event.modifiers() & _OTHERS and event.text() in _STARTERS
    return typed or meaning_of("number", event) in ("type", "empty")


def first_text(event: QKeyEvent) -> str | None:
    """Return the text with which a key begins typing; None: the number itself."""
    meaning = meaning_of("number", event)
    return None if meaning == "type" else "" if meaning == "empty" else event.text()


class NumberTyping(QObject):
    """Lets the user type into ``line``, which is read-only otherwise.

    It tells why a typed text is not allowed.
    """

    #: Why the typed text is not allowed, or "".
    problem_changed = Signal(str)

    def __init__(self, line: QLineEdit) -> None:
        super().__init__(line)
        self._line = line
        self._number: NumberDisplay | None = None
        self.problem = ""
        self._next_act = NextAct(self)
        self._next_act.came.connect(self.end)
        line.setReadOnly(True)
        line.setCursor(Qt.CursorShape.SizeHorCursor)

    @property
    def active(self) -> bool:
        """Whether the user is typing."""
        return not self._line.isReadOnly()

    def begin(self, number: NumberDisplay, text: str | None) -> None:
        """Open the line; ``text`` replaces the number, which is selected otherwise."""
        self._next_act.stop()
        self._set_problem("")
        self._number = number
        self._line.setReadOnly(False)
        self._line.setCursor(Qt.CursorShape.IBeamCursor)
        self._line.setText(number.long_text if text is None else text)
        if text is None:
            self._line.selectAll()

    def end(self) -> None:
        """End typing; its owner sets the text of the line."""
        self._close()
        self._set_problem("")

    def leave(self) -> None:
        """End typing; the problem stays until the next action of the user."""
        self._close()
        self._next_act.wait()

    def result(self, number: NumberDisplay) -> float | None:
        """Return the typed value; None, and a problem, if it is not allowed."""
        try:
            return parse_number(self._line.text(), number.spec, number.value_si)
        except InvalidInputError as error:
            self._set_problem(str(error))
            return None

    def check_again(self, text: str) -> None:
        """Clear the problem as soon as the text is allowed."""
        if self.problem and self._number is not None and self._number.parsed(text) is not None:
            self._set_problem("")

    def _close(self) -> None:
        self._next_act.stop()
        self._line.setReadOnly(True)
        self._line.setCursor(Qt.CursorShape.SizeHorCursor)

    def _set_problem(self, problem: str) -> None:
        if problem != self.problem:
            self.problem = problem
            self.problem_changed.emit(problem)


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


class NumberGestures(QObject):
    """Turns drags, notches of the wheel and arrow keys into round numbers.

    Ctrl makes steps fine, Shift coarse.  All values of one drag share one gesture, and so do
    steps that follow each other quickly.
    """

    #: The new value in SI units, number of its gesture.
    stepped = Signal(float, object)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._drag: _Drag | None = None
        self._burst = Burst(self)
        self._wheel_travel = 0.0

    @property
    def in_burst(self) -> bool:
        """Whether the next step belongs to the same gesture as the last."""
        return self._burst.active

    @property
    def dragging(self) -> bool:
        """Whether the button is held."""
        return self._drag is not None

    @staticmethod
    def knows(event: QKeyEvent) -> bool:
        """Whether a key makes steps."""
        return meaning_of("number", event) in ("step", "page")

    def notches(self, event: QWheelEvent) -> int:
        """Return the whole notches that the wheel has turned since the last one."""
        # Shift and Alt turn a vertical wheel into a horizontal one on some systems.
        self._wheel_travel += event.angleDelta().y() or event.angleDelta().x()
        notches = int(self._wheel_travel / NOTCH)
        self._wheel_travel -= notches * NOTCH
        return notches

    def turn(self, notches: int, number: NumberDisplay, event: QWheelEvent) -> None:
        """Step with the wheel."""
        size = _size(event.modifiers())
        self._step_to(Ladder(number.value_si, number.spec, size).value_si(notches), number)

    def press_key(self, event: QKeyEvent, number: NumberDisplay) -> None:
        """Step with a key."""
        size = COARSE if meaning_of("number", event) == "page" else _size(event.modifiers())
        direction = _DIRECTIONS[Qt.Key(event.key())]
        self._step_to(stepped(number.value_si, direction, number.spec, size), number)

    def restart(self) -> None:
        """Begin a new gesture from the present value, which something else has changed."""
        self._burst.end()
        if self._drag is not None:
            self._drag.ladder = None

    def press(self, event: QMouseEvent, number: NumberDisplay) -> None:
        """Begin a press of the mouse button."""
        position = event.globalPosition().toPoint()
        self._drag = _Drag(last=position, start_si=number.value_si)

    def move(self, event: QMouseEvent, number: NumberDisplay) -> None:
        """Follow the mouse while the button is held."""
        drag, position = self._drag, event.globalPosition().toPoint()
        if drag is None:
            return
        travel = position - drag.last
        if drag.gesture is None:
            if travel.manhattanLength() < DRAG_BEGINS_PX:
                return
            drag.gesture = new_gesture()
        drag.last = position
        drag.travel_px += travel.x() - travel.y()
        self._follow(drag, number, _size(event.modifiers()))

    def release(self) -> None:
        """End the press."""
        self._drag = None

    def cancel(self, number: NumberDisplay) -> None:
        """Cancel the drag and restore the value."""
        drag, self._drag = self._drag, None
        if drag is not None and number.value_si != drag.start_si:
            self.stepped.emit(drag.start_si, drag.gesture)

    def _follow(self, drag: _Drag, number: NumberDisplay, size: Fraction) -> None:
        if drag.ladder is None or drag.ladder.size != size:
            drag.ladder, drag.position = Ladder(number.value_si, number.spec, size), 0
        steps = int(drag.travel_px / PIXELS_PER_STEP)
        drag.travel_px -= steps * PIXELS_PER_STEP
        drag.position += steps
        # Counted from the start, so that dragging back leads to the same number.
        value_si = drag.ladder.value_si(drag.position)
        if value_si in (number.spec.minimum, number.spec.maximum):
            # At a bound the number stays; dragging back moves it at once.
            drag.ladder, drag.position = Ladder(value_si, number.spec, size), 0
        if value_si != number.value_si:
            self.stepped.emit(value_si, drag.gesture)

    def _step_to(self, value_si: float, number: NumberDisplay) -> None:
        if value_si != number.value_si:
            self.stepped.emit(value_si, self._burst.gesture())


def _size(modifiers: Qt.KeyboardModifier) -> Fraction:
    if modifiers & Qt.KeyboardModifier.ControlModifier:
        return FINE
    return COARSE if modifiers & Qt.KeyboardModifier.ShiftModifier else PLAIN


#: Fields below each other have the same room for units, so that digits align.
WIDEST_UNIT = "m/s²"
# Minimum width of a field in letters of the usual size.
_LEAST_PX = 72
# Events that change the size of letters or of the frame.
_OTHER_SIZES = (QEvent.Type.FontChange, QEvent.Type.StyleChange)
_TEMPORARY_LOSSES = frozenset(
    {Qt.FocusReason.PopupFocusReason, Qt.FocusReason.ActiveWindowFocusReason}
)


class NumberField(QLineEdit):
    """Shows and edits a value in its display unit.

    A double click or a digit begins typing; Enter commits, Esc restores.  A text that is not
    allowed has a red outline and a reason, and never becomes the value; when the focus leaves, the
    value comes back and the reason stays visible.  A drag, the wheel and the arrow keys step to
    round numbers, see `NumberGestures`.  The wheel acts only while the field has the focus, so that
    scrolling a panel changes nothing.

    Parameters
    ----------
    spec
        Allowed values.
    widest_unit
        Unit for which there is room, so that digits align with those of other fields.
    problem_beside
        Whether the owner shows problems beside the field; else the tooltip does.
    widest_number
        Number that sets the fixed width of the field; "": the width is free, and a narrow field
        shows fewer digits.
    """

    #: The new value in SI units; number of its gesture, or None for a step of its own.
    edited = Signal(float, object)
    #: Why the typed text is not allowed, or "".
    problem_changed = Signal(str)

    def __init__(
        self,
        spec: NumberSpec,
        parent: QWidget | None = None,
        *,
        widest_unit: str = WIDEST_UNIT,
        problem_beside: bool = False,
        widest_number: str = "",
    ) -> None:
        super().__init__(parent)
        self._number = NumberDisplay(spec=spec, value_si=clamped(0.0, spec))
        self._unit = UnitBeside(self, widest_unit)
        self._problem_beside, self._widest_number = problem_beside, widest_number
        self._typing = NumberTyping(self)
        self.gestures = NumberGestures(self)
        self._typing.problem_changed.connect(self._show_problem)
        self._typing.problem_changed.connect(self.problem_changed)
        self.gestures.stepped.connect(self._edit)
        self.textEdited.connect(self._typing.check_again)
        self.setMaxLength(40)
        self.setAcceptDrops(False)  # files are dropped on the window
        self.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.setFont(tabular(self.font()))
        self._show_spec()

    def minimumSizeHint(self) -> QSize:
        least_px = round(_LEAST_PX * letter_scale(self.font()))
        return QSize(least_px, super().minimumSizeHint().height())

    @property
    def spec(self) -> NumberSpec:
        """Allowed values."""
        return self._number.spec

    @property
    def value_si(self) -> float:
        """The value, in SI units."""
        return self._number.value_si

    @property
    def problem(self) -> str:
        """Why the typed text is not allowed, or ""."""
        return self._typing.problem

    @property
    def editing(self) -> bool:
        """Whether the user is typing."""
        return self._typing.active

    def set_spec(self, spec: NumberSpec) -> None:
        """Change the allowed values or the unit."""
        if spec != self.spec:
            self._number = NumberDisplay(spec=spec, value_si=self.value_si)
            self._show_spec()

    def set_value(self, value_si: float) -> None:
        """Show another value without a signal.  A text that is being typed stays."""
        if value_si != self.value_si:
            self.gestures.restart()
            if not self.editing:
                self._typing.end()
            self._show(float(value_si))

    def begin_editing(self, text: str | None = None) -> None:
        """Let the user type; ``text`` replaces the number, which is selected otherwise."""
        self._typing.begin(self._number, text)

    def cancel_editing(self) -> None:
        """Forget the typed text and its problem, and end a drag."""
        self.gestures.release()
        if self.editing or self.problem:
            self._typing.end()
            self._show(self.value_si)

    def commit(self) -> bool:
        """Make the typed text the value; return whether that is possible."""
        if not self.editing:
            return True
        typed_si = self._typing.result(self._number)
        if typed_si is None:
            return False
        self.cancel_editing()
        if not self._number.is_unchanged_by(typed_si):
            self._edit(typed_si, None)
        return True

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if self.gestures.knows(event):
            if self.commit():
                self.gestures.press_key(event, self._number)
        elif event.key() == Qt.Key.Key_Escape and self.gestures.dragging:
            self.gestures.cancel(self._number)
        elif self.editing:
            if event.key() in FINISHERS:
                self.commit()
            elif event.key() == Qt.Key.Key_Escape:
                self.cancel_editing()
            else:
                super().keyPressEvent(event)
        elif event.matches(QKeySequence.StandardKey.Copy):
            QGuiApplication.clipboard().setText(self._number.copied_text)
        elif event.matches(QKeySequence.StandardKey.Paste):
            self.begin_editing()
            self.paste()
        elif begins_typing(event):
            self.begin_editing(first_text(event))
        else:
            event.ignore()

    def event(self, event: QEvent) -> bool:
        return claims_shortcut(event, self._claims) or super().event(event)

    def _claims(self, event: QKeyEvent) -> bool:
        return (
            self.gestures.knows(event)
            or (begins_typing(event) and not self.editing)
            or (event.key() == Qt.Key.Key_Escape and (self.editing or self.gestures.dragging))
        )

    def wheelEvent(self, event: QWheelEvent) -> None:
        if not self.hasFocus():
            event.ignore()
            return
        event.accept()
        notches = self.gestures.notches(event)
        if notches and self.commit():
            self.gestures.turn(notches, self._number, event)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if self.editing or event.button() != Qt.MouseButton.LeftButton:
            super().mousePressEvent(event)
        else:
            self.gestures.press(event, self._number)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if self.gestures.dragging:
            self.gestures.move(event, self._number)
        elif self.editing:
            # Without a press this would only set the cursor of a text.
            super().mouseMoveEvent(event)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if not self.gestures.dragging:
            super().mouseReleaseEvent(event)
        self.gestures.release()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        if self.editing:
            super().mouseDoubleClickEvent(event)
        elif event.button() == Qt.MouseButton.LeftButton:
            self.gestures.release()
            self.begin_editing()

    def focusInEvent(self, event: QFocusEvent) -> None:
        super().focusInEvent(event)
        if not self.editing:
            self.deselect()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        if not self.editing or event.reason() in _TEMPORARY_LOSSES:
            return
        if self.commit():
            return
        # The value comes back; the problem stays until the next action of the user.
        self._typing.leave()
        self._show(self.value_si)
        if not self._problem_beside:
            problem = self.problem
            self._typing.end()
            # The widget that gets the focus now hides tooltips.
            QTimer.singleShot(0, self, lambda: show_tip_below(self, problem))

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() in _OTHER_SIZES:
            self._show_spec()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._show(self.value_si)

    def paintEvent(self, event: QPaintEvent) -> None:
        super().paintEvent(event)
        painter = QPainter(self)
        has_own_unit = self.editing and any(c.isalpha() or c in "°×²" for c in self.text())
        if not has_own_unit:
            self._unit.paint(painter, self._number.unit_text(editing=self.editing), current_theme())
        if self.problem and self.editing:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setPen(QPen(QColor(current_theme().error), 2))
            painter.drawRoundedRect(QRectF(self.rect()).adjusted(1, 1, -1, -1), 4, 4)

    def _edit(self, value_si: float, gesture: int | None) -> None:
        self._typing.end()
        self._show(value_si)
        self.edited.emit(value_si, gesture)

    def _show(self, value_si: float) -> None:
        self._number = NumberDisplay(spec=self.spec, value_si=value_si)
        if not self.editing:
            self.setText(self._number.fitting_text(self.fontMetrics(), self._unit.room_px))
            self.update()

    def _show_spec(self) -> None:
        self._unit.make_room(self._number.symbol)
        if self._widest_number:
            self.setFixedWidth(self._unit.width_px(self._widest_number))
        self.setAccessibleName(self.spec.label)
        self.setToolTip(self._number.help())
        self._show(self.value_si)

    def _show_problem(self, problem: str) -> None:
        self.update()
        if self._problem_beside:
            return
        self.setToolTip(problem or self._number.help())
        if problem:
            show_tip_below(self, problem)
