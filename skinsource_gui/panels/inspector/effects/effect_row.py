"""One effect of a chain."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QCheckBox, QHBoxLayout, QVBoxLayout, QWidget

from skinsource.design.effects import ON, Effect
from skinsource.specs.fields import specs_of
from skinsource_gui.theme import UNIT_PX, set_tone
from skinsource_gui.widgets.fields.curve_field import CurveField
from skinsource_gui.widgets.fields.field_cell import FieldCell
from skinsource_gui.widgets.fields.field_grid import FieldGrid
from skinsource_gui.widgets.fields.parts.row_title import RowTitle
from skinsource_gui.widgets.inputs.letter_button import remove_button
from skinsource_gui.widgets.tooltips import tooltip


class EffectRow(QWidget):
    """Switch, name and remove button of an effect, and its fields while it is open.

    Attributes
    ----------
    effect
        What it shows.
    title
        The name; tells of drags and keys.
    """

    switched = Signal(bool)
    removed = Signal()
    #: Name of a field, its new value, number of the gesture or None.
    edited = Signal(str, object, object)

    def __init__(self, effect: Effect, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.effect = effect
        self.title = RowTitle(effect.title, "effects", "in the chain")
        self._switch = QCheckBox()
        self._switch.setObjectName("effect_switch")
        self._switch.setAccessibleName(f"{effect.title} on")
        self._switch.setToolTip(tooltip(ON.label, ON.hint))
        self._remove = remove_button()
        self._remove.setToolTip(tooltip(f"Remove {effect.title.lower()}"))
        self._cells = tuple(self._cell(name) for name in specs_of(effect) if name != "on")
        self._grid = FieldGrid()
        self._grid.show_cells(self._cells)
        self._grid.hide()
        head = QHBoxLayout()
        head.setContentsMargins(0, 0, 0, 0)
        head.setSpacing(UNIT_PX // 2)
        head.addWidget(self._switch)
        head.addWidget(self.title, 1)
        head.addWidget(self._remove)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(UNIT_PX // 4)
        column.addLayout(head)
        column.addWidget(self._grid)
        self.title.opened.connect(self._open)
        self._switch.clicked.connect(self.switched)
        self._remove.clicked.connect(self.removed)
        self.show_effect(effect)

    @property
    def stops(self) -> tuple[QWidget, ...]:
        """Where the Tab key stops first."""
        return (self.title,)

    @property
    def open(self) -> bool:
        """Whether its fields are shown."""
        return self.title.open

    def set_open(self, open_: bool) -> None:
        """Show its fields, or hide them."""
        self.title.set_open(open_)

    def cell(self, name: str) -> FieldCell:
        """The cell of a field."""
        return next(cell for cell in self._cells if cell.name == name)

    def show_effect(self, effect: Effect) -> None:
        """Show another effect of the same kind."""
        self.effect = effect
        self._switch.setChecked(effect.on)
        set_tone(self.title, "" if effect.on else "dim")
        for cell in self._cells:
            cell.set_value(getattr(effect, cell.name))

    def show_end(self, end_s: float) -> None:
        """Take over where the clip ends, for curves over its time."""
        for cell in self._cells:
            if isinstance(cell.field, CurveField):
                cell.field.points.end_x = end_s

    def show_refused(self, name: str, reason: str) -> None:
        """Show again what the effect has in a field, and why it stays so."""
        cell = self.cell(name)
        cell.set_value(getattr(self.effect, name))
        cell.show_reason(reason)

    def forget_typing(self) -> None:
        """Close an open editor without committing."""
        for cell in self._cells:
            cell.forget_typing()

    def toggle(self) -> None:
        """Switch it, as a click does."""
        self._switch.click()

    def _cell(self, name: str) -> FieldCell:
        cell = FieldCell(name, specs_of(self.effect)[name])
        # Waveforms may have a field of that name, too.
        cell.field.setObjectName(f"effect_{name}_field")
        cell.edited.connect(self.edited)
        return cell

    def _open(self, open_: bool) -> None:
        focused = self._grid.isAncestorOf(self.focusWidget()) if self.focusWidget() else False
        if focused and not open_:
            self.title.setFocus(Qt.FocusReason.OtherFocusReason)
        self._grid.setVisible(open_ and bool(self._cells))
