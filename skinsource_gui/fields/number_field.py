"""A number as a field shows it."""

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
from skinsource_gui.qt.asking import NextAct
from skinsource_gui.qt.keys import claims_shortcut, meaning_of
from skinsource_gui.qt.theme import current_theme, letter_scale, tabular
from skinsource_gui.qt.tooltips import show_tip_below, tooltip
from skinsource_gui.qt.wheel import NOTCH

#: Before a number that has more digits than are shown, and in place of one that has no room.
ROUNDED, NO_ROOM = "≈", "…"
# So many digits are rounded to without a mark.
_ENOUGH_DIGITS = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class NumberDisplay:
    """A value and what it may be.

    Attributes
    ----------
    spec
        What is allowed.
    value_si
        The value, in SI units.
    """

    spec: NumberSpec
    value_si: float

    @property
    def symbol(self) -> str:
        """Unit in which it is shown."""
        return display_unit(self.spec.unit, self.value_si).symbol

    def beside(self, *, editing: bool) -> str:
        """What stands beside it: words for what is no number have no unit."""
        return "" if self._unset and not editing else self.symbol

    @property
    def _unset(self) -> bool:
        return bool(self.spec.unset) and self.value_si == 0.0

    @property
    def long_text(self) -> str:
        """As it is edited."""
        return number_text(self.value_si, self.spec.unit, EDITED_DIGITS)

    @property
    def copied_text(self) -> str:
        """As it goes to the clipboard, with its unit."""
        return with_unit(self.long_text, display_unit(self.spec.unit, self.value_si))

    def fitting_text(self, metrics: QFontMetrics, room_px: float) -> str:
        """With as many digits as there is room for; ≈ marks one that was rounded to 1 or 2 digits.

        A number whose first digits are out of sight is another number: rather none is shown.
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
        """Value of a text, in SI units; None if it is not allowed."""
        try:
            return parse_number(text, self.spec, self.value_si)
        except InvalidInputError:
            return None

    def is_meant_by(self, typed_si: float) -> bool:
        """Whether typing ``typed_si`` changes nothing: what is shown may be rounded."""
        short = number_text(self.value_si, self.spec.unit)
        return typed_si in (self.value_si, self.parsed(self.long_text), self.parsed(short))

    def help(self) -> str:
        """What it is, what is allowed, and how it is changed."""
        return tooltip(
            f"{self.spec.label}, {range_text(self.spec)}",
            self.spec.about,
            "Drag, turn the wheel or press ↑ ↓: the next round number (Ctrl: finer, Shift or "
            "Page Up, Page Down: ten times as far)",
            "Double-click or type to enter a number",
        )


# A number that is being typed.

_STARTERS = frozenset("0123456789.,+-−")
FINISHERS = frozenset({Qt.Key.Key_Return, Qt.Key.Key_Enter})
_OTHERS = (
    Qt.KeyboardModifier.ControlModifier
    | Qt.KeyboardModifier.AltModifier
    | Qt.KeyboardModifier.MetaModifier
)


def begins_typing(event: QKeyEvent) -> bool:
    """Whether a key opens the editor."""
    typed = not event.modifiers() & _OTHERS and event.text() in _STARTERS
    return typed or meaning_of("number", event) in ("type", "empty")


def first_text(event: QKeyEvent) -> str | None:
    """What stands in the editor that a key opened; None: the number itself."""
    meaning = meaning_of("number", event)
    return None if meaning == "type" else "" if meaning == "empty" else event.text()


class NumberTyping(QObject):
    """Opens a line for typing, and says why what is typed is not allowed.

    Parameters
    ----------
    line
        Where it is typed; read-only as long as nothing is.
    """

    #: Why what is typed is not allowed, or "".
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
        """Whether a text is being typed."""
        return not self._line.isReadOnly()

    def begin(self, number: NumberDisplay, text: str | None) -> None:
        """Open the line; ``text`` replaces the number, which is selected otherwise."""
        self._next_act.stop()
        self._say("")
        self._number = number
        self._line.setReadOnly(False)
        self._line.setCursor(Qt.CursorShape.IBeamCursor)
        self._line.setText(number.long_text if text is None else text)
        if text is None:
            self._line.selectAll()

    def end(self) -> None:
        """Close the line; what it shows then is up to its owner."""
        self._close()
        self._say("")

    def leave(self) -> None:
        """Close the line; why what was typed is not allowed stays told until somebody goes on."""
        self._close()
        self._next_act.wait()

    def result(self, number: NumberDisplay) -> float | None:
        """Value of what is typed; None, with the reason told, if it is not allowed."""
        try:
            return parse_number(self._line.text(), number.spec, number.value_si)
        except InvalidInputError as error:
            self._say(str(error))
            return None

    def check_again(self, text: str) -> None:
        """Take the problem back as soon as the text is allowed."""
        if self.problem and self._number is not None and self._number.parsed(text) is not None:
            self._say("")

    def _close(self) -> None:
        self._next_act.stop()
        self._line.setReadOnly(True)
        self._line.setCursor(Qt.CursorShape.SizeHorCursor)

    def _say(self, problem: str) -> None:
        if problem != self.problem:
            self.problem = problem
            self.problem_changed.emit(problem)


# Numbers made by dragging, by the wheel and by keys.

#: Way of the mouse that makes one step, and way after which a press is a drag.
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
        Where the mouse was.
    gesture
        Number shared by all edits, or None as long as the press is no drag yet.
    start_si
        Value before the drag.
    ladder, position
        Values that the drag goes through, and where on it the drag is.
    travel_px
        The way that is not yet a step.
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
        """Whole notches that the wheel has turned since the last one."""
        # Shift and Alt turn a vertical wheel into a horizontal one on some systems.
        self._wheel_travel += event.angleDelta().y() or event.angleDelta().x()
        notches = int(self._wheel_travel / NOTCH)
        self._wheel_travel -= notches * NOTCH
        return notches

    def turn(self, notches: int, number: NumberDisplay, event: QWheelEvent) -> None:
        """Go some steps with the wheel."""
        size = _size(event.modifiers())
        self._go(Ladder(number.value_si, number.spec, size).value_si(notches), number)

    def press_key(self, event: QKeyEvent, number: NumberDisplay) -> None:
        """Go one step with a key."""
        size = COARSE if meaning_of("number", event) == "page" else _size(event.modifiers())
        direction = _DIRECTIONS[Qt.Key(event.key())]
        self._go(stepped(number.value_si, direction, number.spec, size), number)

    def start_anew(self) -> None:
        """Somebody else changed the value: what follows starts from there, as a new gesture."""
        self._burst.end()
        if self._drag is not None:
            self._drag.ladder = None

    def press(self, event: QMouseEvent, number: NumberDisplay) -> None:
        """The button goes down on the number."""
        position = event.globalPosition().toPoint()
        self._drag = _Drag(last=position, start_si=number.value_si)

    def move(self, event: QMouseEvent, number: NumberDisplay) -> None:
        """The mouse moves while the button is held."""
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
        """The button goes up, or the press became something else."""
        self._drag = None

    def give_up(self, number: NumberDisplay) -> None:
        """End the drag as if it had not begun."""
        drag, self._drag = self._drag, None
        if drag is not None and number.value_si != drag.start_si:
            self.stepped.emit(drag.start_si, drag.gesture)

    def _follow(self, drag: _Drag, number: NumberDisplay, size: Fraction) -> None:
        if drag.ladder is None or drag.ladder.size != size:
            drag.ladder, drag.position = Ladder(number.value_si, number.spec, size), 0
        steps = int(drag.travel_px / PIXELS_PER_STEP)
        drag.travel_px -= steps * PIXELS_PER_STEP
        drag.position += steps
        # Counted from the start, so that the way back leads to the same number.
        value_si = drag.ladder.value_si(drag.position)
        if value_si in (number.spec.minimum, number.spec.maximum):
            # At its end the number waits; turning back moves it at once.
            drag.ladder, drag.position = Ladder(value_si, number.spec, size), 0
        if value_si != number.value_si:
            self.stepped.emit(value_si, drag.gesture)

    def _go(self, value_si: float, number: NumberDisplay) -> None:
        if value_si != number.value_si:
            self.stepped.emit(value_si, self._burst.gesture())


def _size(modifiers: Qt.KeyboardModifier) -> Fraction:
    if modifiers & Qt.KeyboardModifier.ControlModifier:
        return FINE
    return COARSE if modifiers & Qt.KeyboardModifier.ShiftModifier else PLAIN


# A number with its unit, that can be typed, dragged, turned and stepped.

#: Fields that stand below each other leave the same room for units, so that digits align.
WIDEST_UNIT = "m/s²"
# Width that it needs in letters of the usual size.
_LEAST_PX = 72
# Of letters, and of what the style leaves around them.
_OTHER_SIZES = (QEvent.Type.FontChange, QEvent.Type.StyleChange)
_TEMPORARY_LOSSES = frozenset(
    {Qt.FocusReason.PopupFocusReason, Qt.FocusReason.ActiveWindowFocusReason}
)


class NumberField(QLineEdit):
    """Shows a value in its display unit.

    A double click or a digit begins typing; Enter commits, Esc restores.  What is not allowed
    is outlined in red, with the reason, and never becomes the value; left by Tab or a click, the
    reason is said all the same and the value is back.  A drag, the wheel and the
    arrow keys go to the next round numbers, as `NumberGestures` has it.  The wheel acts only while
    the field has the focus, so that scrolling a panel changes nothing.

    Parameters
    ----------
    spec
        What is allowed.
    widest_unit
        Unit for which there is room, so that digits align with those of other fields.
    problem_beside
        Whether its owner shows problems beside the field; else they are in its tooltip.
    widest_number
        Number for which it is just wide enough, in letters of any size; "": it takes what room it
        gets, and shows fewer digits where that is little.
    """

    #: The new value in SI units; number of its gesture, or None for a step of its own.
    edited = Signal(float, object)
    #: Why what is typed is not allowed, or "".
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
        self._take_spec()

    def minimumSizeHint(self) -> QSize:
        least_px = round(_LEAST_PX * letter_scale(self.font()))
        return QSize(least_px, super().minimumSizeHint().height())

    @property
    def spec(self) -> NumberSpec:
        """What is allowed."""
        return self._number.spec

    @property
    def value_si(self) -> float:
        """The value, in SI units."""
        return self._number.value_si

    @property
    def problem(self) -> str:
        """Why what is typed is not allowed, or ""."""
        return self._typing.problem

    @property
    def editing(self) -> bool:
        """Whether a text is being typed."""
        return self._typing.active

    def set_spec(self, spec: NumberSpec) -> None:
        """Change what is allowed, or the unit."""
        if spec != self.spec:
            self._number = NumberDisplay(spec=spec, value_si=self.value_si)
            self._take_spec()

    def set_value(self, value_si: float) -> None:
        """Show another value, and tell nobody.  A text that is being typed stays."""
        if value_si != self.value_si:
            self.gestures.start_anew()
            if not self.editing:
                self._typing.end()
            self._show(float(value_si))

    def begin_editing(self, text: str | None = None) -> None:
        """Let the user type; ``text`` replaces the number, which is selected otherwise."""
        self._typing.begin(self._number, text)

    def cancel_editing(self) -> None:
        """Forget what was typed and what was wrong with it, and let go of a drag."""
        self.gestures.release()
        if self.editing or self.problem:
            self._typing.end()
            self._show(self.value_si)

    def commit(self) -> bool:
        """Make what was typed the value; return whether that is possible."""
        if not self.editing:
            return True
        typed_si = self._typing.result(self._number)
        if typed_si is None:
            return False
        self.cancel_editing()
        if not self._number.is_meant_by(typed_si):
            self._edit(typed_si, None)
        return True

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if self.gestures.knows(event):
            if self.commit():
                self.gestures.press_key(event, self._number)
        elif event.key() == Qt.Key.Key_Escape and self.gestures.dragging:
            self.gestures.give_up(self._number)
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
        return claims_shortcut(event, self._wants) or super().event(event)

    def _wants(self, event: QKeyEvent) -> bool:
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
        # The value is back; what was wrong stays said until somebody goes on.
        self._typing.leave()
        self._show(self.value_si)
        if not self._problem_beside:
            problem = self.problem
            self._typing.end()
            # The widget that has the focus next takes tooltips away.
            QTimer.singleShot(0, self, lambda: show_tip_below(self, problem))

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() in _OTHER_SIZES:
            self._take_spec()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._show(self.value_si)

    def paintEvent(self, event: QPaintEvent) -> None:
        super().paintEvent(event)
        painter = QPainter(self)
        has_own_unit = self.editing and any(c.isalpha() or c in "°×²" for c in self.text())
        if not has_own_unit:
            self._unit.paint(painter, self._number.beside(editing=self.editing), current_theme())
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

    def _take_spec(self) -> None:
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
