"""A number that is being typed."""

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QLineEdit

from skinsource.base.errors import InvalidInputError
from skinsource_gui.widgets.fields.shown_number import ShownNumber
from skinsource_gui.widgets.fields.units import parse_number
from skinsource_gui.widgets.keys import meaning_of
from skinsource_gui.widgets.next_act import NextAct

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
    wanted = meaning_of("number", event)
    return None if wanted == "type" else "" if wanted == "empty" else event.text()


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
        self._number: ShownNumber | None = None
        self.problem = ""
        self._next_act = NextAct(self)
        self._next_act.came.connect(self.end)
        line.setReadOnly(True)
        line.setCursor(Qt.CursorShape.SizeHorCursor)

    @property
    def active(self) -> bool:
        """Whether a text is being typed."""
        return not self._line.isReadOnly()

    def begin(self, number: ShownNumber, text: str | None) -> None:
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

    def result(self, number: ShownNumber) -> float | None:
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
