"""A button with the menu of what can be added to a list."""

from functools import partial

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QMenu, QToolButton, QWidget

from skinsource.design.edits.edit import KindSpec
from skinsource.design.edits.effects import choices_of
from skinsource.specs.fields import ListSpec, RecipeSpec
from skinsource_gui.widgets.inputs.kind_menu import fill_kind_menu
from skinsource_gui.widgets.tooltips import tooltip


class AddButton(QToolButton):
    """Opens a menu of the kinds of recipes that a list of ``spec`` may hold."""

    #: Name of a kind.
    chosen = Signal(str)

    def __init__(self, spec: ListSpec, of: RecipeSpec, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._spec, self._of = spec, of
        self.setObjectName("add_part")
        self.setText("Add…")
        self.setAccessibleName(f"{spec.label}: add")
        self.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.setMenu(QMenu(self))
        # The dots say that there is more to choose.
        self.setStyleSheet("QToolButton::menu-indicator { image: none; width: 0; }")
        self.menu().aboutToShow.connect(self._fill)

    def show_count(self, count: int) -> None:
        """Offer more, unless there are as many as there may be."""
        full = count >= self._spec.most
        self.setEnabled(not full)
        most = f"There are at most {self._spec.most}; remove one first"
        self.setToolTip(tooltip(most if full else "Add one at the end"))

    def _fill(self) -> None:
        menu, choices = self.menu(), choices_of(self._of)
        menu.clear()
        if isinstance(choices, KindSpec):
            fill_kind_menu(menu, self.chosen.emit)
            return
        for name, title in choices.options:
            menu.addAction(title).triggered.connect(partial(self._tell, name))

    def _tell(self, name: str, _checked: bool = False) -> None:
        self.chosen.emit(name)
