"""A labelled field with the editor that goes with its kind."""

from PySide6.QtWidgets import QWidget

from skinsource.specs.fields import Spec
from skinsource_gui.widgets.fields.edited_cell import EditedCell
from skinsource_gui.widgets.fields.editors import new_editor


class FieldCell(EditedCell):
    """The field of a recipe that ``spec`` describes."""

    def __init__(self, name: str, spec: Spec, parent: QWidget | None = None) -> None:
        super().__init__(name, spec, new_editor, parent)
