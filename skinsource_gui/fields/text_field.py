"""A field for texts with a reader, such as formulas and lists of numbers."""

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QMimeData, QSize, Qt, QTimer, Signal

from skinsource.base.errors import InvalidInputError
from skinsource.signals.formula.reading import column_of
from skinsource.specs.spec import TextSpec
from skinsource_gui.fields.editor import MIXED, TEMPORARY_LOSSES, Editor, new_gesture
from skinsource_gui.qt.frames import paint_problem
from skinsource_gui.qt.layouts import Policy, named, show_tip_below, tooltip
from skinsource_gui.qt.theme import current_theme

_MOST_LINES = 6
_EDGE_PX = 5
#: Keys that undo or redo.
UNDOING = (QtGui.QKeySequence.StandardKey.Undo, QtGui.QKeySequence.StandardKey.Redo)


class LiveText(Editor, QtWidgets.QPlainTextEdit):
    """Edits a text of ``spec``, whose reader checks it while it is typed.

    Each valid text is signalled at once; all share a gesture, until Enter or the loss of the focus.
    While the text is invalid, it is underlined where reading stopped, and the value is the one
    before the typing, whose text comes back with Esc or the loss of the focus.  A long line is
    wrapped.
    """

    #: The new text; number of the gesture that quick successive texts share.
    edited = Signal(str, object)

    def __init__(self, spec: TextSpec, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._spec = spec
        self._value, self._last_read, self._mixed = "", "", False
        # The value before what is being typed, None where it was mixed; and the gesture of that.
        self._start: str | None = None
        self._gesture: int | None = None
        self._marked: int | None = None
        self.problem = ""
        named(self, title=spec.label, hint=tooltip(spec.label, spec.hint))
        self.setTabChangesFocus(True)
        # The document has the undo, of each valid text.
        self.setUndoRedoEnabled(False)
        self.setAcceptDrops(False)  # files are dropped on the window
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setSizePolicy(Policy.Expanding, Policy.Fixed)
        self.setMinimumWidth(72)
        family = QtGui.QFontDatabase.systemFont(QtGui.QFontDatabase.SystemFont.FixedFont).family()
        font = QtGui.QFont(self.font())
        font.setFamily(family)
        self.setFont(font)
        self.document().setDocumentMargin(_EDGE_PX)
        self.textChanged.connect(self._read)
        # Lines are laid out after the text changed.
        self.document().documentLayout().documentSizeChanged.connect(lambda _: self._fit())
        self.verticalScrollBar().rangeChanged.connect(lambda *_: self._fit())

    def text(self) -> str:
        """Return the text in the field."""
        return self.toPlainText()

    def set_value(self, value: str) -> None:
        """Show another value without a signal.  A typed text stays if the value is the same."""
        before, self._value = self._value, value
        if value == self.text():
            self._mark(None)
            self._set_problem("")
        elif value != before:
            self._restore()

    def mark_error(self, reason: str) -> None:
        """Mark the place that a reason names, and show the reason as long as the text stays."""
        if self.text() != self._value:
            self._mark(column_of(reason))
            self._set_problem(reason)
            self._revert()

    def show_mixed(self, mixed: bool, otherwise: str = "") -> None:
        """Say "mixed" in an empty field, or show the value; an empty one says ``otherwise``."""
        self.setPlaceholderText(MIXED if mixed else otherwise)
        was_mixed, self._mixed = self._mixed, mixed
        if mixed and self.text() == self._value:
            self._last_read = ""
            self.setPlainText("")
        elif was_mixed and not mixed and not self.text():
            self._restore()

    def cancel(self) -> None:
        """Restore the value."""
        self._start = None
        if self.text() != self._value:
            self._restore()

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            self._mark(self._marked)

    def sizeHint(self) -> QSize:
        lines = min(max(self._lines(), 1), _MOST_LINES)
        height = lines * self.fontMetrics().lineSpacing() + 2 * _EDGE_PX + 2
        return QSize(160, height)

    def minimumSizeHint(self) -> QSize:
        return QSize(72, self.sizeHint().height())

    def event(self, event: QEvent) -> bool:
        if isinstance(event, QtGui.QKeyEvent) and event.type() == QEvent.Type.ShortcutOverride:
            if any(event.matches(key) for key in UNDOING):
                event.ignore()
                return False
            if event.key() == Qt.Key.Key_Escape and self.text() != self._value:
                event.accept()
                return True
        return super().event(event)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            if not self.problem:
                self._gesture = None
        elif event.key() == Qt.Key.Key_Escape:
            event.setAccepted(self.text() != self._value)
            self.cancel()
        else:
            super().keyPressEvent(event)

    def focusOutEvent(self, event: QtGui.QFocusEvent) -> None:
        super().focusOutEvent(event)
        if event.reason() not in TEMPORARY_LOSSES:
            self._gesture = None
            if problem := self.problem:
                self._restore()
                # The widget that gets the focus now hides tooltips.
                QTimer.singleShot(0, self, lambda: show_tip_below(self, problem))

    def insertFromMimeData(self, source: QMimeData) -> None:
        # A pasted text becomes one line.
        self.insertPlainText(" ".join(source.text().split()))

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._fit()

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        super().paintEvent(event)
        if self.problem:
            paint_problem(QtGui.QPainter(self.viewport()), self.viewport().rect())

    def _read(self) -> None:
        self._fit()
        text = self.text()
        if text == self._last_read:
            return  # only a mark has changed
        self._last_read = text
        problem, column = "", None
        try:
            self._spec.checked(text)
        except InvalidInputError as error:
            problem, column = str(error), getattr(error, "column", None)
        self._mark(column)
        self._set_problem(problem)
        if problem:
            self._revert()
        elif text != self._value:
            if self._gesture is None:
                self._gesture = new_gesture()
                self._start = None if self._mixed else self._value
            self.edited.emit(text, self._gesture)

    def _mark(self, column: int | None) -> None:
        """Underline a letter, counted from 1, where reading stopped; None: there is no error."""
        self._marked = column
        letters, marks = self.toPlainText(), []
        if column is not None and letters:
            mark = QtWidgets.QTextEdit.ExtraSelection()
            # At the end of the text the last letter is underlined.
            start = min(column, len(letters)) - 1
            mark.cursor = QtGui.QTextCursor(self.document())
            mark.cursor.setPosition(start)
            mark.cursor.setPosition(start + 1, QtGui.QTextCursor.MoveMode.KeepAnchor)
            style = QtGui.QTextCharFormat()
            style.setForeground(QtGui.QColor(current_theme().error))
            style.setUnderlineColor(QtGui.QColor(current_theme().error))
            style.setUnderlineStyle(QtGui.QTextCharFormat.UnderlineStyle.SingleUnderline)
            style.setFontWeight(QtGui.QFont.Weight.Bold)
            mark.format = style
            marks.append(mark)
        self.setExtraSelections(marks)
        self.viewport().update()

    def _revert(self) -> None:
        """Give up the valid half of a text that became invalid: the value is as before it."""
        if self._gesture is not None and self._start not in (None, self._value):
            self._value = self._start
            self.edited.emit(self._value, self._gesture)

    def _restore(self) -> None:
        self._gesture = None
        self._last_read = "" if self._mixed else self._value
        self.setPlainText(self._last_read)
        self._mark(None)
        self._set_problem("")

    def _set_problem(self, problem: str) -> None:
        if problem != self.problem:
            self.problem = problem
            self.problem_changed.emit(problem)

    def _lines(self) -> int:
        return int(self.document().documentLayout().documentSize().height())

    def _fit(self) -> None:
        height = self.sizeHint().height()
        if height != self.height():
            self.setFixedHeight(height)
        more = self._lines() > _MOST_LINES
        policy = Qt.ScrollBarPolicy
        self.setVerticalScrollBarPolicy(
            policy.ScrollBarAsNeeded if more else policy.ScrollBarAlwaysOff
        )
        if not more:
            # Qt would scroll the margin, by a whole line; without a range, the wheel is for others.
            self.verticalScrollBar().setMaximum(0)
