"""What the selected inputs can play, as actions for the palette."""

from functools import partial

from PySide6.QtGui import QAction

from skinsource.design import edits
from skinsource.design.waveforms import kinds
from skinsource_gui.state.document import Document


def kind_choices(document: Document) -> list[QAction]:
    """Return one new action for each kind of waveform, which lets the selected inputs play it."""
    actions = []
    for kind in kinds():
        action = QAction(f"Waveform: {kind.title}")
        action.setToolTip("Let the selected inputs play this")
        action.setEnabled(bool(document.view.selected_inputs))
        action.triggered.connect(partial(_play, document, kind.__name__))
        actions.append(action)
    return actions


def _play(document: Document, kind: str, _checked: bool = False) -> None:
    design, view = document.design, document.view
    document.apply(edits.change_kind(design, view, view.selected_inputs, kind))
