"""Labelled cells, of a field and a remark under it, in aligned columns."""

from collections.abc import Sequence
from itertools import pairwise

from PySide6 import QtWidgets
from PySide6.QtCore import QEvent, QSize, Qt, Signal

from skinsource.specs.numbers import ListSpec, NumberSpec
from skinsource.specs.spec import Spec
from skinsource_gui.fields.editor import Editor, NewEditor
from skinsource_gui.qt.buttons import page_label, show_or_hide
from skinsource_gui.qt.layouts import Policy, in_column, named
from skinsource_gui.qt.theme import UNIT_PX, set_tone
from skinsource_gui.qt.windows import WindowEvents

#: Height of a label, and of one line of a field.
LABEL_PX = 26
# Space above and below the letters of a line.
_AROUND_LINE_PX = 12

_MIXED = "Inputs differ; typing sets all, dragging shifts all"


class _FieldLabel(QtWidgets.QLabel):
    """A label as high as one line of the field beside it, in letters of any size."""

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self.setSizePolicy(Policy.Fixed, Policy.Fixed)

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

    def __init__(self, text: str) -> None:
        super().__init__()
        self.across = False
        self.label: QtWidgets.QLabel = _FieldLabel(text)
        set_tone(self.label, "dim")
        self.stack = in_column(of=self, margins=0, gap_px=2)


def discard(cells: Sequence[LabelledCell], heir: QtWidgets.QWidget | None) -> None:
    """Delete cells; where one of them has the keyboard, ``heir`` gets it."""
    focused = QtWidgets.QApplication.focusWidget()
    if heir and focused and any(cell.isAncestorOf(focused) for cell in cells):
        heir.setFocus(Qt.FocusReason.OtherFocusReason)
    for part in (widget for cell in cells for widget in (cell.label, cell)):
        part.deleteLater()


def forget_typing(*parents: QtWidgets.QWidget) -> None:
    """Close open editors in widgets without committing: what was typed belongs elsewhere."""
    for parent in parents:
        # PySide would keep what it knows of every other child beyond the end of that child.
        for cell in parent.findChildren(EditedCell):
            cell.forget_typing()
        for editor in parent.findChildren(Editor):
            editor.cancel()


class TextCell(LabelledCell):
    """A label and a text that cannot be edited."""

    def __init__(self, label: str, text: str, name: str = "fixed_length", hint: str = "") -> None:
        super().__init__(label)
        self.text_label = named(page_label(name, text), hint=hint)
        self.text_label.setMinimumHeight(LABEL_PX)
        self.stack.addWidget(self.text_label)


def label_of(spec: Spec) -> str:
    """Return the label of a field: that of a list of numbers has their unit."""
    of = spec.of if isinstance(spec, ListSpec) else None
    unit = of.unit if isinstance(of, NumberSpec) else ""
    return f"{spec.label} ({unit})" if unit else spec.label


class EditedCell(LabelledCell):
    """A cell for a field of a model that ``spec`` describes.

    Attributes
    ----------
    field
        The editor, made by ``new_editor``.
    """

    #: Name of the field, its new value, number of the gesture or None.
    edited = Signal(str, object, object)

    def __init__(self, name: str, spec: Spec, new_editor: NewEditor) -> None:
        super().__init__(label_of(spec))
        self.name, self._label_text = name, label_of(spec)
        self._value: object = None
        self._warns = self._mixed = False
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
        if label_of(spec) != self._label_text:
            self._label_text = label_of(spec)
            self.label.setText(self._label_text)

    def set_value(self, value: object) -> None:
        """Show a value without a signal."""
        self.field.set_value(value)
        if value != self._value:
            self._value, self._reason = value, ""
        self._advise()

    def show_mixed(self, mixed: bool, hint: str = _MIXED) -> None:
        """Say whether the selected inputs have different values: an empty field says "mixed"."""
        self.field.show_mixed(mixed)
        if mixed != self._mixed:
            self._mixed = mixed
            self.label.setToolTip(hint if mixed else "")

    def forget_typing(self) -> None:
        """Close an open editor without committing."""
        self.field.cancel()
        self._forget_reason()

    def forget_problem(self) -> None:
        """Forget what was refused, if anything was."""
        if self._problem or self._reason:
            self.forget_typing()

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
            show_or_hide(self._note, text)
            set_tone(self._note, "warning" if warns else "error")


# Labels of all grids are at least so many letters wide, so that fields stand below each other.
_LABEL_LETTERS = 11
_ANY_HEIGHT_PX = 16_777_215
_Event = QEvent.Type


class FieldGrid(QtWidgets.QWidget):
    """Cells in one column, with their labels beside them; in a narrow grid above them."""

    def __init__(self) -> None:
        super().__init__()
        self._cells: tuple[LabelledCell, ...] = ()
        self._above = False
        self._grid = QtWidgets.QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setHorizontalSpacing(UNIT_PX)
        self._grid.setVerticalSpacing(UNIT_PX // 4)
        self._grid.setColumnStretch(1, 1)
        # It may be wider, or the texts in it may.
        WindowEvents.follow(
            self, self._fold, _Event.Resize, _Event.LayoutRequest, _Event.FontChange
        )

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
        margins = self.contentsMargins()
        least = fields + margins.left() + margins.right()
        return super().minimumSizeHint().boundedTo(QSize(least, _ANY_HEIGHT_PX))

    def _fold(self, _event: QEvent) -> None:
        above = self.width() < self._paired_px
        if above != self._above:
            self._above = above
            self._arrange()

    @property
    def _labels_px(self) -> int:
        return _LABEL_LETTERS * self.fontMetrics().averageCharWidth()

    @property
    def _paired_px(self) -> int:
        """Minimum width of a label with its field beside it."""
        paired = [cell for cell in self._cells if not cell.across]
        labels = max((cell.label.sizeHint().width() for cell in paired), default=0)
        fields = max((cell.minimumSizeHint().width() for cell in paired), default=0)
        margins = self.contentsMargins()
        beside = max(labels, self._labels_px) + self._grid.horizontalSpacing() + fields
        return beside + margins.left() + margins.right()

    def _arrange(self) -> None:
        # A cell that is across contains its label, which is in no layout of the grid.
        for part in (widget for cell in self._cells for widget in (cell.label, cell)):
            self._grid.removeWidget(part)
        for row, cell in enumerate(self._cells):
            if cell.across:
                self._grid.addWidget(cell, 2 * row, 0, 1, 2)
            elif self._above:
                self._grid.addWidget(cell.label, 2 * row, 0, 1, 2)
                self._grid.addWidget(cell, 2 * row + 1, 0, 1, 2)
            else:
                self._grid.addWidget(cell.label, 2 * row, 0, Qt.AlignmentFlag.AlignTop)
                self._grid.addWidget(cell, 2 * row, 1, Qt.AlignmentFlag.AlignTop)
        self._grid.setColumnMinimumWidth(0, 0 if self._above else self._labels_px)
