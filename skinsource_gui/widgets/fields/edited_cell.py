"""A labelled field with room for a remark under it."""

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtWidgets import QCheckBox, QLabel, QSizePolicy, QVBoxLayout, QWidget

from skinsource.specs.fields import Spec
from skinsource_gui.theme import set_tone
from skinsource_gui.widgets.fields.editor import NewEditor
from skinsource_gui.widgets.next_act import NextAct
from skinsource_gui.widgets.tooltips import tooltip

#: Height of a label, and of one line of a field.
LABEL_PX = 26
# Above and below its letters.
_AROUND_LINE_PX = 12

_DIFFERS = tooltip(
    "The selected inputs differ here; shown is the one that was selected last. Typing sets all, "
    "dragging moves all by as much."
)


class _FieldLabel(QLabel):
    """As high as one line of the field beside it, in letters of any size."""

    def __init__(self, words: str) -> None:
        super().__init__(words)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)

    def sizeHint(self) -> QSize:
        height = max(self.fontMetrics().height() + _AROUND_LINE_PX, LABEL_PX)
        return QSize(super().sizeHint().width(), height)

    def minimumSizeHint(self) -> QSize:
        return self.sizeHint()


class LabelledCell(QWidget):
    """Something with a label; `FieldGrid` puts the label beside it.

    Attributes
    ----------
    label
        The label.
    across
        Whether it holds its label itself, and takes the whole width.
    """

    def __init__(self, words: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.across = False
        self.label: QLabel = _FieldLabel(words)
        set_tone(self.label, "dim")
        self.stack = QVBoxLayout(self)
        self.stack.setContentsMargins(0, 0, 0, 0)
        self.stack.setSpacing(2)


class WordsCell(LabelledCell):
    """A label and words that cannot be edited."""

    def __init__(self, label: str, words: str, parent: QWidget | None = None) -> None:
        super().__init__(label, parent)
        self.words = QLabel(words)
        self.words.setObjectName("fixed_length")
        self.words.setWordWrap(True)
        self.words.setMinimumHeight(LABEL_PX)
        self.stack.addWidget(self.words)


class EditedCell(LabelledCell):
    """The field of a recipe that ``spec`` describes.

    Attributes
    ----------
    name
        Name of the field.
    editor, field
        What edits it, made by ``new_editor``, and the widget of that.
    """

    #: Name of the field, its new value, number of the gesture or None.
    edited = Signal(str, object, object)

    def __init__(
        self, name: str, spec: Spec, new_editor: NewEditor, parent: QWidget | None = None
    ) -> None:
        super().__init__(spec.label, parent)
        self.name, self._words = name, spec.label
        self._value: object = None
        self._warns = self._differs = False
        self._problem, self._reason = "", ""
        self._next_act = NextAct(self)
        self._next_act.came.connect(self._forget_reason)
        self.editor = new_editor(spec, self)
        self.editor.edited.connect(self._edit)
        self.editor.problem_changed.connect(self._show_problem)
        if self.editor.label is not None:
            self.label, self.across = self.editor.label, True
            set_tone(self.label, "dim")
        self.field = self.editor.field
        self.field.setObjectName(f"{name}_field")
        if isinstance(self.field, QLabel | QCheckBox):
            self.field.setMinimumHeight(LABEL_PX)
        self.label.setBuddy(self.field)
        self.setFocusProxy(self.field)
        self._note = QLabel()
        self._note.setObjectName(f"{name}_note")
        self._note.setWordWrap(True)
        self._note.setTextInteractionFlags(Qt.TextInteractionFlag.NoTextInteraction)
        self._note.hide()
        self.stack.addWidget(self.field)
        self.stack.addWidget(self._note)

    @property
    def note(self) -> str:
        """The remark under the field, or ""."""
        return self._note.text()

    def set_spec(self, spec: Spec) -> None:
        """Change the unit or range, or what it is called."""
        self.editor.set_spec(spec)
        if spec.label != self._words:
            self._words = spec.label
            self._show_label()

    def set_value(self, value: object) -> None:
        """Show a value, and tell nobody."""
        self.editor.set_value(value)
        if value != self._value:
            self._value, self._reason = value, ""
        self._advise()

    def show_differs(self, differs: bool) -> None:
        """Say whether the value shown is only that of one of several inputs."""
        if differs != self._differs:
            self._differs = differs
            self._show_label()

    def _show_label(self) -> None:
        self.label.setText(f"{self._words} ≠" if self._differs else self._words)
        self.label.setToolTip(_DIFFERS if self._differs else "")

    def forget_typing(self) -> None:
        """Close an open editor without committing."""
        self.editor.cancel()
        self._forget_reason()

    def show_reason(self, reason: str) -> None:
        """Say in red why the last edit was refused, until somebody goes on."""
        self.editor.refuse(reason)
        # What is typed and stays as it is, its editor says what is wrong with.
        if not self._problem:
            self._reason = reason
            self._next_act.wait()
        self._advise()

    def _edit(self, value: object, gesture: int | None) -> None:
        self._forget_reason()
        self.edited.emit(self.name, value, gesture)

    def _show_problem(self, problem: str) -> None:
        self._problem = problem
        self._advise()

    def _forget_reason(self) -> None:
        self._reason = ""
        self._advise()

    def _advise(self) -> None:
        wrong = self._problem or self._reason
        self._set_note(wrong or self.editor.advice(), warns=not wrong)

    def _set_note(self, words: str, *, warns: bool) -> None:
        if (words, warns) != (self.note, self._warns):
            self._warns = warns
            self._note.setText(words)
            self._note.setVisible(bool(words))
            set_tone(self._note, "warning" if warns else "error")
