"""A field for texts with a reader, such as formulas and lists of numbers."""

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QMimeData, QSize, Qt, Signal

from skinsource.base.errors import InvalidInputError
from skinsource.signals.formula.reading import column_of
from skinsource.specs.spec import TextSpec
from skinsource_gui.fields.editor import MIXED, Burst, Editor, TextMark
from skinsource_gui.qt.layouts import tooltip

_MOST_LINES = 6
_EDGE_PX = 5
_UNDOING = (QtGui.QKeySequence.StandardKey.Undo, QtGui.QKeySequence.StandardKey.Redo)


class LiveText(Editor, QtWidgets.QPlainTextEdit):
    """Edits a text of ``spec``, whose reader checks it while it is typed.

    Each valid text is signalled at once; quick ones share a gesture, until a pause, Enter, or the
    loss of the focus.  An invalid text stays, underlined where reading stopped; once it is left,
    the value is the one before the typing, which Esc restores.  A long line is wrapped.
    """

    #: The new text; number of the gesture that quick successive texts share.
    edited = Signal(str, object)

    def __init__(self, spec: TextSpec, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._spec = spec
        self._value, self._last_read, self._mixed = "", "", False
        # The value before what is being typed.
        self._start: str | None = None
        self._burst, self._mark = Burst(self), TextMark(self)
        self.problem = ""
        self.setAccessibleName(spec.label)
        self.setToolTip(tooltip(spec.label, spec.hint))
        self.setTabChangesFocus(True)
        # The document has the undo, of each valid text.
        self.setUndoRedoEnabled(False)
        self.setAcceptDrops(False)  # files are dropped on the window
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setSizePolicy(
            QtWidgets.QSizePolicy.Policy.Expanding, QtWidgets.QSizePolicy.Policy.Fixed
        )
        self.setMinimumWidth(72)
        family = QtGui.QFontDatabase.systemFont(QtGui.QFontDatabase.SystemFont.FixedFont).family()
        font = QtGui.QFont(self.font())
        font.setFamily(family)
        self.setFont(font)
        self.document().setDocumentMargin(_EDGE_PX)
        self.textChanged.connect(self._read)
        # Lines are laid out after the text changed.
        self.document().documentLayout().documentSizeChanged.connect(lambda _: self._fit())

    def text(self) -> str:
        """Return the text in the field."""
        return self.toPlainText()

    def set_value(self, value: str) -> None:
        """Show another value without a signal.  A typed text stays if the value is the same."""
        before, self._value = self._value, value
        if value == self.text():
            self._mark.put(None)
            self._set_problem("")
        elif value != before:
            self._restore()

    def mark_error(self, reason: str) -> None:
        """Mark the place that a reason names, and show the reason as long as the text stays."""
        if self.text() != self._value:
            self._mark.put(column_of(reason))
            self._set_problem(reason)

    def show_mixed(self, mixed: bool, otherwise: str = "") -> None:
        """Say "mixed" in an empty field, or show the value; an empty one says ``otherwise``."""
        self.setPlaceholderText(MIXED if mixed else otherwise)
        if mixed and self.text() == self._value:
            self._last_read = ""
            self.setPlainText("")
        elif self._mixed and not mixed and not self.text():
            self._restore()
        self._mixed = mixed

    def cancel(self) -> None:
        """Restore the value."""
        self._start = None
        if self.text() != self._value:
            self._restore()

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            self._mark.put(self._mark.column)

    def sizeHint(self) -> QSize:
        lines = min(max(self._lines(), 1), _MOST_LINES)
        height = lines * self.fontMetrics().lineSpacing() + 2 * _EDGE_PX + 2
        return QSize(160, height)

    def minimumSizeHint(self) -> QSize:
        return QSize(72, self.sizeHint().height())

    def event(self, event: QEvent) -> bool:
        if isinstance(event, QtGui.QKeyEvent) and event.type() == QEvent.Type.ShortcutOverride:
            if any(event.matches(key) for key in _UNDOING):
                event.ignore()
                return False
            if event.key() == Qt.Key.Key_Escape and self.text() != self._value:
                event.accept()
                return True
        return super().event(event)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self._burst.end()
            if not self.problem:
                self._start = None
        elif event.key() == Qt.Key.Key_Escape:
            event.setAccepted(self.text() != self._value)
            self._revert()
            self.cancel()
        else:
            super().keyPressEvent(event)

    def focusOutEvent(self, event: QtGui.QFocusEvent) -> None:
        super().focusOutEvent(event)
        self._revert()
        self._burst.end()

    def insertFromMimeData(self, source: QMimeData) -> None:
        # A pasted text becomes one line.
        self.insertPlainText(" ".join(source.text().split()))

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._fit()

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        super().paintEvent(event)
        if self.problem:
            self._mark.paint_frame()

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
        self._mark.put(column)
        self._set_problem(problem)
        if not problem and text != self._value:
            if self._start is None:
                self._start = self._value
            self.edited.emit(text, self._burst.gesture())

    def _revert(self) -> None:
        """Give up the valid half of a text that became invalid: the value is as before it."""
        start, self._start = self._start, None
        if self.problem and start is not None and start != self._value:
            self._value = start
            self.edited.emit(start, self._burst.gesture())

    def _restore(self) -> None:
        self._start = None
        self._burst.end()
        self._last_read = self._value
        self.setPlainText(self._value)
        self._mark.put(None)
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
