"""A number with its unit, that can be typed."""

from PySide6.QtCore import QEvent, QPoint, QRect, QRectF, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QGuiApplication,
    QKeyEvent,
    QKeySequence,
    QPainter,
    QPen,
    QResizeEvent,
)
from PySide6.QtWidgets import QLineEdit, QStyle, QStyleOptionFrame, QToolTip, QWidget

from skinsource.errors import InvalidInputError
from skinsource.fields import NumberSpec
from skinsource_gui.theme import LIGHT, Theme, tabular
from skinsource_gui.widgets.fields.level_text import minus
from skinsource_gui.widgets.fields.number_steps import clamped
from skinsource_gui.widgets.fields.units import (
    EDITED_DIGITS,
    SHOWN_DIGITS,
    display_unit,
    number_text,
    parse_number,
    range_text,
    with_unit,
)

_UNIT_GAP_PX = 4
# Qt leaves this at each side of the text of a line edit.
_TEXT_EDGE_PX = 2
#: Fields that stand below each other leave the same room for units, so that digits align.
WIDEST_UNIT = "m/s²"
_STARTERS = frozenset("0123456789.,+-−")
_FINISHERS = frozenset({Qt.Key.Key_Return, Qt.Key.Key_Enter})
_EMPTIERS = frozenset({Qt.Key.Key_Backspace, Qt.Key.Key_Delete})
_TEMPORARY_LOSSES = frozenset(
    {Qt.FocusReason.PopupFocusReason, Qt.FocusReason.ActiveWindowFocusReason}
)


class NumberEntry(QLineEdit):
    """Shows a value in its display unit; a double click or a digit begins typing.

    Enter commits, Esc restores.  What is not allowed is outlined in red, with the reason, and
    never becomes the value.

    Parameters
    ----------
    spec
        What is allowed.
    widest_unit
        Unit for which there is room, so that digits align with those of other fields.
    """

    #: The new value in SI units; number of its gesture, or None for a step of its own.
    edited = Signal(float, object)
    #: Why what is typed is not allowed, or "".
    problem_changed = Signal(str)

    def __init__(
        self, spec: NumberSpec, parent: QWidget | None = None, *, widest_unit: str = WIDEST_UNIT
    ) -> None:
        super().__init__(parent)
        self._spec = spec
        self._widest_unit = widest_unit
        self._value_si = clamped(0.0, spec)
        self._problem = ""
        self._theme = LIGHT
        self.setReadOnly(True)
        self.setMaxLength(40)
        self.setAcceptDrops(False)  # files are dropped on the window
        self.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.setFont(tabular(self.font()))
        self.textEdited.connect(self._check_again)
        self._take_spec()

    @property
    def spec(self) -> NumberSpec:
        """What is allowed."""
        return self._spec

    @property
    def value_si(self) -> float:
        """The value, in SI units."""
        return self._value_si

    @property
    def problem(self) -> str:
        """Why what is typed is not allowed, or ""."""
        return self._problem

    @property
    def editing(self) -> bool:
        """Whether a text is being typed."""
        return not self.isReadOnly()

    def set_spec(self, spec: NumberSpec) -> None:
        """Change what is allowed, or the unit."""
        if spec != self._spec:
            self._spec = spec
            self._take_spec()

    def set_value(self, value_si: float) -> None:
        """Show another value, and tell nobody.  A text that is being typed stays."""
        if value_si != self._value_si:
            self._value_si = float(value_si)
            self._show_value()

    def show_theme(self, theme: Theme) -> None:
        """Take over colours."""
        self._theme = theme
        self.update()

    def begin_editing(self, text: str | None = None) -> None:
        """Let the user type; ``text`` replaces the number, which is selected otherwise."""
        self.setReadOnly(False)
        self.setCursor(Qt.CursorShape.IBeamCursor)
        self.setText(self._long_text() if text is None else text)
        if text is None:
            self.selectAll()

    def cancel_editing(self) -> None:
        """Forget what was typed."""
        if self.editing:
            self._end_editing()

    def commit(self) -> bool:
        """Make what was typed the value; return whether that is possible."""
        if not self.editing:
            return True
        try:
            typed_si = parse_number(self.text(), self._spec)
        except InvalidInputError as error:
            self._set_problem(str(error))
            QToolTip.showText(self.mapToGlobal(QPoint(0, self.height())), self._problem, self)
            return False
        # What is shown may be a rounded form of the value: typing it again changes nothing.
        unchanged = typed_si in (self._parsed(self._long_text()), self._parsed(self._short_text()))
        self._end_editing()
        if not unchanged and typed_si != self._value_si:
            self._edit(typed_si, None)
        return True

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if self.editing:
            if event.key() in _FINISHERS:
                self.commit()
            elif event.key() == Qt.Key.Key_Escape:
                self.cancel_editing()
            else:
                super().keyPressEvent(event)
        elif event.matches(QKeySequence.StandardKey.Copy):
            QGuiApplication.clipboard().setText(with_unit(self._long_text(), self._spec.unit))
        elif event.matches(QKeySequence.StandardKey.Paste):
            self.begin_editing()
            self.paste()
        elif self._begins_editing(event):
            keeps_number = event.key() in _FINISHERS or event.key() == Qt.Key.Key_F2
            typed = "" if event.key() in _EMPTIERS else event.text()
            self.begin_editing(None if keeps_number else typed)
        else:
            event.ignore()

    def event(self, event: QEvent) -> bool:
        # Without this, a shortcut of the window would take the key that begins typing.
        if (
            event.type() == QEvent.Type.ShortcutOverride
            and not self.editing
            and self._begins_editing(event)
        ):
            event.accept()
            return True
        return super().event(event)

    def focusInEvent(self, event) -> None:
        super().focusInEvent(event)
        if not self.editing:
            self.deselect()

    def focusOutEvent(self, event) -> None:
        super().focusOutEvent(event)
        if not self.editing or event.reason() in _TEMPORARY_LOSSES:
            return
        if self._parsed(self.text()) is None:
            self.cancel_editing()
        else:
            self.commit()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._show_value()

    def paintEvent(self, event) -> None:
        super().paintEvent(event)
        painter = QPainter(self)
        inside = self._inside()
        has_own_unit = self.editing and any(c.isalpha() or c in "°×²" for c in self.text())
        if not has_own_unit:
            painter.setPen(QColor(self._theme.dim))
            flags = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
            inside.setLeft(inside.right() - self._unit_px())
            painter.drawText(inside, flags, display_unit(self._spec.unit).symbol)
        if self._problem:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setPen(QPen(QColor(self._theme.error), 2))
            painter.drawRoundedRect(QRectF(self.rect()).adjusted(1, 1, -1, -1), 4, 4)

    def _unit_px(self) -> int:
        symbol = display_unit(self._spec.unit).symbol
        return max(
            self.fontMetrics().horizontalAdvance(text) for text in (symbol, self._widest_unit)
        )

    def _begins_editing(self, event: QKeyEvent) -> bool:
        plain = not event.modifiers() & (
            Qt.KeyboardModifier.ControlModifier
            | Qt.KeyboardModifier.AltModifier
            | Qt.KeyboardModifier.MetaModifier
        )
        known = event.key() in _FINISHERS | _EMPTIERS or event.key() == Qt.Key.Key_F2
        return plain and (known or event.text() in _STARTERS)

    def _edit(self, value_si: float, gesture: int | None) -> None:
        self._value_si = value_si
        self._show_value()
        self.edited.emit(value_si, gesture)

    def _end_editing(self) -> None:
        self.setReadOnly(True)
        self.setCursor(Qt.CursorShape.SizeHorCursor)
        self._set_problem("")
        self._show_value()

    def _take_spec(self) -> None:
        self.setTextMargins(0, 0, self._unit_px() + _UNIT_GAP_PX, 0)
        self.setAccessibleName(self._spec.label)
        self.setToolTip(self._plain_tooltip())
        self._show_value()

    def _show_value(self) -> None:
        if not self.editing:
            self.setText(self._fitting_text())
            self.update()

    def _fitting_text(self) -> str:
        # A number whose first digits are out of sight is another number.
        room = self._inside().width() - self.textMargins().right() - 2 * _TEXT_EDGE_PX
        texts = [
            minus(number_text(self._value_si, self._spec.unit, digits))
            for digits in range(SHOWN_DIGITS, 0, -1)
        ]
        widths = map(self.fontMetrics().horizontalAdvance, texts)
        return next((text for text, px in zip(texts, widths, strict=True) if px <= room), texts[-1])

    def _inside(self) -> QRect:
        option = QStyleOptionFrame()
        self.initStyleOption(option)
        return self.style().subElementRect(QStyle.SubElement.SE_LineEditContents, option, self)

    def _short_text(self) -> str:
        return number_text(self._value_si, self._spec.unit)

    def _long_text(self) -> str:
        return number_text(self._value_si, self._spec.unit, EDITED_DIGITS)

    def _parsed(self, text: str) -> float | None:
        try:
            return parse_number(text, self._spec)
        except InvalidInputError:
            return None

    def _check_again(self, text: str) -> None:
        if self._problem and self._parsed(text) is not None:
            self._set_problem("")

    def _set_problem(self, problem: str) -> None:
        if problem != self._problem:
            self._problem = problem
            self.setToolTip(problem or self._plain_tooltip())
            self.update()
            self.problem_changed.emit(problem)

    def _plain_tooltip(self) -> str:
        words = [f"{self._spec.label}, {range_text(self._spec)}", self._spec.hint]
        words.append("Drag, turn the wheel or press ↑ ↓ (Ctrl: fine, Shift: coarse)")
        words.append("Double-click or type to enter a number")
        return "\n".join(word for word in words if word)
