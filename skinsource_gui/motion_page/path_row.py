"""A path of places as a text, and what can be done to it."""

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QLineEdit, QVBoxLayout, QWidget

from skinsource.base.errors import InvalidInputError
from skinsource.base.quoting import sentence
from skinsource.design.motions import path_of
from skinsource_gui.widgets.page_button import page_button


class PathRow(QWidget):
    """Shows a path, lets it be typed, turned round, shortened and emptied.

    Attributes
    ----------
    field
        Where it is typed.
    """

    #: Another path is wanted.
    path_wanted = Signal(tuple)
    #: What is typed is no path; why.
    misread = Signal(str)
    #: Typing is over.
    finished = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._path: tuple[int, ...] = ()
        self.field = QLineEdit()
        self.field.setObjectName("path_field")
        self.field.setAccessibleName("Path")
        self.field.setToolTip("Numbers of places, in their order: 16, 18, 20")
        self._buttons = (
            page_button("reverse_path", "Reverse", "Pass the places the other way round"),
            page_button("remove_last", "Remove last", "Take the last place off the path"),
            page_button("clear_path", "Clear", "Begin the path anew"),
        )
        self._lay_out()
        self.field.textEdited.connect(self._type)
        self.field.editingFinished.connect(self._finish)
        reverse, remove, clear = self._buttons
        reverse.clicked.connect(lambda: self.path_wanted.emit(self._path[::-1]))
        remove.clicked.connect(self.remove_last)
        clear.clicked.connect(lambda: self.path_wanted.emit(()))

    def show_path(self, path: tuple[int, ...]) -> None:
        """Show a path; what is being typed and means the same is not written anew."""
        self._path = path
        if not self.field.hasFocus() or _typed(self.field.text()) != path:
            self.field.setText(_words(path))
        for button in self._buttons:
            button.setEnabled(bool(path))

    def append(self, place: int) -> None:
        """Go on to a place."""
        self.path_wanted.emit((*self._path, place))

    def remove_last(self) -> None:
        """End one place earlier."""
        self.path_wanted.emit(self._path[:-1])

    def _lay_out(self) -> None:
        label = QLabel("Path")
        label.setBuddy(self.field)
        typed, buttons = QHBoxLayout(), QHBoxLayout()
        typed.addWidget(label)
        typed.addWidget(self.field, 1)
        for button in self._buttons:
            buttons.addWidget(button)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addLayout(typed)
        column.addLayout(buttons)

    def _type(self, text: str) -> None:
        try:
            self.path_wanted.emit(path_of(text))
        except InvalidInputError as error:
            self.misread.emit(sentence(str(error)))

    def _finish(self) -> None:
        self.field.setText(_words(self._path))
        self.finished.emit()


def _words(path: tuple[int, ...]) -> str:
    return ", ".join(map(str, path))


def _typed(text: str) -> tuple[int, ...] | None:
    """The path in a text; None where there is none."""
    try:
        return path_of(text)
    except InvalidInputError:
        return None
