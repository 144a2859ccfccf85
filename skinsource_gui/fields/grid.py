"""Labelled cells, of a field and a remark under it, in aligned columns."""

from collections.abc import Sequence
from itertools import pairwise

from PySide6 import QtWidgets
from PySide6.QtCore import QSize, Qt, Signal

from skinsource.specs.spec import Spec
from skinsource_gui.fields.editor import NewEditor
from skinsource_gui.qt.buttons import page_label
from skinsource_gui.qt.fitting import LayoutWatcher
from skinsource_gui.qt.theme import UNIT_PX, letter_scale, set_tone
from skinsource_gui.qt.tooltips import tooltip

#: Height of a label, and of one line of a field.
LABEL_PX = 26
# Space above and below the letters of a line.
_AROUND_LINE_PX = 12

_DIFFERS = tooltip(
    "The selected inputs differ here; shown is the one that was selected last. Typing sets all, "
    "dragging moves all by as much."
)


class _FieldLabel(QtWidgets.QLabel):
    """A label as high as one line of the field beside it, in letters of any size."""

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Fixed, QtWidgets.QSizePolicy.Policy.Fixed)

    def sizeHint(self) -> QSize:
        height = max(self.fontMetrics().height() + _AROUND_LINE_PX, LABEL_PX)
        return QSize(super().sizeHint().width(), height)

    def minimumSizeHint(self) -> QSize:
        return self.sizeHint()


class LabelledCell(QtWidgets.QWidget):
    """A widget with a label, which `FieldGrid` puts beside it.

    Attributes
    ----------
    across
        Whether the cell contains its label and takes the whole width.
    """

    def __init__(self, text: str, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.across = False
        self.label: QtWidgets.QLabel = _FieldLabel(text)
        set_tone(self.label, "dim")
        self.stack = QtWidgets.QVBoxLayout(self)
        self.stack.setContentsMargins(0, 0, 0, 0)
        self.stack.setSpacing(2)


class TextCell(LabelledCell):
    """A label and a text that cannot be edited."""

    def __init__(self, label: str, text: str, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(label, parent)
        self.text_label = page_label("fixed_length", text)
        self.text_label.setMinimumHeight(LABEL_PX)
        self.stack.addWidget(self.text_label)


class EditedCell(LabelledCell):
    """A cell for a field of a model that ``spec`` describes.

    Attributes
    ----------
    field
        The editor, made by ``new_editor``.
    """

    #: Name of the field, its new value, number of the gesture or None.
    edited = Signal(str, object, object)

    def __init__(
        self, name: str, spec: Spec, new_editor: NewEditor, parent: QtWidgets.QWidget | None = None
    ) -> None:
        super().__init__(spec.label, parent)
        self.name, self._label_text = name, spec.label
        self._value: object = None
        self._warns = self._differs = False
        self._problem, self._reason = "", ""
        self.field = new_editor(spec, self)
        self.field.edited.connect(self._edit)
        self.field.problem_changed.connect(self._show_problem)
        if self.field.label is not None:
            self.label, self.across = self.field.label, True
            set_tone(self.label, "dim")
        self.field.setObjectName(f"{name}_field")
        if isinstance(self.field, QtWidgets.QLabel | QtWidgets.QCheckBox):
            self.field.setMinimumHeight(LABEL_PX)
        self.label.setBuddy(self.field)
        self.setFocusProxy(self.field)
        self._note = page_label(f"{name}_note")
        self._note.setTextInteractionFlags(Qt.TextInteractionFlag.NoTextInteraction)
        self._note.hide()
        self.stack.addWidget(self.field)
        self.stack.addWidget(self._note)

    @property
    def note(self) -> str:
        """The remark under the field, or ""."""
        return self._note.text()

    def set_spec(self, spec: Spec) -> None:
        """Change unit, range or label."""
        self.field.set_spec(spec)
        if spec.label != self._label_text:
            self._label_text = spec.label
            self._show_label()

    def set_value(self, value: object) -> None:
        """Show a value without a signal."""
        self.field.set_value(value)
        if value != self._value:
            self._value, self._reason = value, ""
        self._advise()

    def show_differs(self, differs: bool) -> None:
        """Say whether the selected inputs have different values."""
        if differs != self._differs:
            self._differs = differs
            self._show_label()

    def _show_label(self) -> None:
        self.label.setText(f"{self._label_text} ≠" if self._differs else self._label_text)
        self.label.setToolTip(_DIFFERS if self._differs else "")

    def forget_typing(self) -> None:
        """Close an open editor without committing."""
        self.field.cancel()
        self._forget_reason()

    def refuse(self, value: object, reason: str) -> None:
        """Show the value again, and why it was not changed."""
        self.set_value(value)
        self.show_reason(reason)

    def show_reason(self, reason: str) -> None:
        """Show in red why the last edit was refused, until the field is used again."""
        self.field.mark_error(reason)
        # Where the typed text stays, its editor already shows the problem.
        if not self._problem:
            self._reason = reason
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
        self._set_note(wrong or self.field.advice(), warns=not wrong)

    def _set_note(self, text: str, *, warns: bool) -> None:
        if (text, warns) != (self.note, self._warns):
            self._warns = warns
            self._note.setText(text)
            self._note.setVisible(bool(text))
            set_tone(self._note, "warning" if warns else "error")


#: From this width on, in letters of the usual size, two fields stand side by side.
WIDE_PX = 440
_MOST_PAIRS = 2
_ANY_HEIGHT_PX = 16_777_215


class FieldGrid(QtWidgets.QWidget):
    """Cells with their labels beside them, in one column or in two where there is room.

    In a narrow grid labels stand above their fields.

    Attributes
    ----------
    pairs
        Number of fields side by side.
    """

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._cells: tuple[LabelledCell, ...] = ()
        self.pairs, self._above = 1, False
        self._grid = QtWidgets.QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setHorizontalSpacing(UNIT_PX)
        self._grid.setVerticalSpacing(UNIT_PX // 4)
        LayoutWatcher(self).changed.connect(self._fold)

    def set_margins(self, left: int, top: int, right: int, bottom: int) -> None:
        """Set the margins around the cells, px."""
        self._grid.setContentsMargins(left, top, right, bottom)

    def show_cells(self, cells: Sequence[LabelledCell]) -> None:
        """Show these cells, in reading order; others are removed but not deleted."""
        for cell in self._cells:
            if cell not in cells:
                for part in (cell.label, cell):
                    self._grid.removeWidget(part)
                    part.hide()
        self._cells = tuple(cells)
        self._above = self.width() < self._paired_px
        self._arrange()
        proxies = (cell.focusProxy() for cell in cells)
        stops = [proxy for proxy in proxies if proxy is not None]
        for before, after in pairwise(stops):
            self.setTabOrder(before, after)
        for cell in cells:
            cell.label.show()
            cell.show()

    def minimumSizeHint(self) -> QSize:
        # The grid must be able to become so narrow that it folds.
        fields = max((cell.minimumSizeHint().width() for cell in self._cells), default=0)
        margins = self._grid.contentsMargins()
        least = fields + margins.left() + margins.right()
        return super().minimumSizeHint().boundedTo(QSize(least, _ANY_HEIGHT_PX))

    def _fold(self) -> None:
        wide_px = WIDE_PX * letter_scale(self.font())
        pairs = _MOST_PAIRS if self.width() >= wide_px else 1
        above = self.width() < self._paired_px
        if (pairs, above) != (self.pairs, self._above):
            self.pairs, self._above = pairs, above
            self._arrange()

    @property
    def _paired_px(self) -> int:
        """Minimum width of a label with its field beside it."""
        paired = [cell for cell in self._cells if not cell.across]
        labels = max((cell.label.sizeHint().width() for cell in paired), default=0)
        fields = max((cell.minimumSizeHint().width() for cell in paired), default=0)
        margins = self._grid.contentsMargins()
        gap = self._grid.horizontalSpacing()
        return labels + gap + fields + margins.left() + margins.right()

    def _arrange(self) -> None:
        # A cell that is across contains its label, which is in no layout of the grid.
        for part in (widget for cell in self._cells for widget in (cell.label, cell)):
            self._grid.removeWidget(part)
        row, pair = 0, 0
        for cell in self._cells:
            if cell.across:
                row += pair > 0
                self._grid.addWidget(cell, row, 0, 1, 2 * self.pairs)
                row, pair = row + 1, 0
                continue
            if self._above:
                self._grid.addWidget(cell.label, row, 0, 1, 2)
                self._grid.addWidget(cell, row + 1, 0, 1, 2)
                row += 2
                continue
            self._grid.addWidget(cell.label, row, 2 * pair, Qt.AlignmentFlag.AlignTop)
            self._grid.addWidget(cell, row, 2 * pair + 1, Qt.AlignmentFlag.AlignTop)
            row, pair = (row, pair + 1) if pair + 1 < self.pairs else (row + 1, 0)
        for pair in range(_MOST_PAIRS):
            self._grid.setColumnStretch(2 * pair + 1, 1 if pair < self.pairs else 0)
