"""Shows panels the history of a document, and goes where they want."""

from functools import partial

from PySide6.QtCore import QObject

from skinsource.base.quoting import printable
from skinsource_gui.state.document import Document, ReplaceDesign
from skinsource_gui.state.history import MOST_STEPS, History, Step
from skinsource_gui.state.panel import Panel, PanelRegistry

_FORGOTTEN = f"Before the last {MOST_STEPS} steps"


class Historian(QObject):
    """Tells visible panels that list it of each step.

    Parameters
    ----------
    document
        Whose history; also the parent.
    panels
        Of which those hear of it that want to.
    """

    def __init__(self, document: Document, panels: PanelRegistry) -> None:
        super().__init__(document)
        self._document = document
        self._shown: list[Panel] = []
        panels.each(self._meet)

    def history(self) -> History:
        """All that can be taken back or done again now."""
        document, stack = self._document, self._document.undo_stack
        done = (stack.command(k) for k in range(stack.count()))
        steps = tuple(
            Step(entry.text(), entry.at_s) for entry in done if isinstance(entry, ReplaceDesign)
        )
        start = f"Scene: {printable(document.scene)}" if document.scene else "New design"
        if document.opened:
            start = f"Opened {document.opened.name}"
        clean = stack.cleanIndex()
        return History(
            start=_FORGOTTEN if len(steps) >= MOST_STEPS else start,
            steps=steps,
            present=stack.index(),
            saved=clean if clean >= 0 and document.path else None,
        )

    def _meet(self, panel: Panel) -> None:
        if panel.lists_history:
            for changed in (self._document.undo_stack.indexChanged, self._document.title_changed):
                changed.connect(self._show_history)
            panel.visibility_changed.connect(partial(self._note_visibility, panel))
            panel.step_requested.connect(self._document.go_to)

    def _note_visibility(self, panel: Panel) -> None:
        self._shown = [other for other in self._shown if other is not panel]
        if panel.isVisible():
            self._shown.append(panel)
            panel.show_history(self.history())

    def _show_history(self) -> None:
        if self._shown:
            history = self.history()
            for panel in self._shown:
                panel.show_history(history)
