"""What panels want of the document."""

from dataclasses import replace

from PySide6.QtCore import QObject

from skinsource.design import edits
from skinsource.design.edits import Edit, Refusal
from skinsource.design.view import View
from skinsource_gui.made_panels import MadePanels
from skinsource_gui.panel import Panel
from skinsource_gui.state.document import Document


class PanelWishes(QObject):
    """Has the document do what panels want, and tells each where another one points.

    Parameters
    ----------
    document
        Whose design is edited; also the parent.
    panels
        Those who want something.
    """

    def __init__(self, document: Document, panels: MadePanels) -> None:
        super().__init__(document)
        self._document, self._panels = document, panels
        panels.each(self._meet)

    def _meet(self, panel: Panel) -> None:
        panel.edited.connect(self._apply)
        panel.view_changed.connect(self._look)
        panel.playhead_wanted.connect(self._put_playhead)
        panel.input_pointed_at.connect(self._point_at)

    def _apply(self, outcome: Edit | Refusal, gesture: int | None) -> None:
        if isinstance(outcome, Edit):
            outcome = replace(outcome, view=self._with_playhead(outcome.view))
        self._document.apply(outcome, gesture)

    def _look(self, view: View) -> None:
        self._document.look(self._with_playhead(view))

    def _put_playhead(self, time_s: float) -> None:
        outcome = edits.move_playhead(self._document.design, self._document.view, time_s)
        self._document.apply(outcome)

    def _point_at(self, input_id: int | None) -> None:
        for panel in self._panels:
            if panel is not self.sender():
                panel.show_pointed_input(input_id)

    def _with_playhead(self, view: View) -> View:
        # While it moves, most panels know where it was, not where it is.
        playhead_s = self._document.view.playhead_s
        return view if view.playhead_s == playhead_s else replace(view, playhead_s=playhead_s)
