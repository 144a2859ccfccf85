"""A number with its unit, that can be typed, dragged, turned and stepped."""

from PySide6.QtCore import QEvent, QRectF, QSize, Qt, QTimer, Signal
from PySide6.QtGui import (
    QColor,
    QFocusEvent,
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

from skinsource.specs.fields import NumberSpec
from skinsource_gui.theme import current_theme, letter_scale, tabular
from skinsource_gui.widgets.fields.number_gestures import NumberGestures
from skinsource_gui.widgets.fields.number_typing import (
    FINISHERS,
    NumberTyping,
    begins_typing,
    first_text,
)
from skinsource_gui.widgets.fields.round_numbers import clamped
from skinsource_gui.widgets.fields.shown_number import ShownNumber
from skinsource_gui.widgets.fields.unit_beside import UnitBeside
from skinsource_gui.widgets.keys import claims_shortcut
from skinsource_gui.widgets.tooltips import show_tip_below

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
        self._number = ShownNumber(spec=spec, value_si=clamped(0.0, spec))
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
            self._number = ShownNumber(spec=spec, value_si=self.value_si)
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
        self._number = ShownNumber(spec=self.spec, value_si=value_si)
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
