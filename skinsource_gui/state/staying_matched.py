"""A snapshot that is shown as loud as another one stays so."""

from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QObject

from skinsource.design.comparing import shown
from skinsource_gui.state.document import Document


class StayingMatched(QObject):
    """Has the snapshot in the window shown anew where what its gain follows from has changed.

    Parameters
    ----------
    document
        Whose snapshots; also the parent.
    show
        Shows a number, as loud as the others.
    """

    def __init__(self, document: Document, show: Callable[[int], None]) -> None:
        super().__init__(document)
        self._document, self._show = document, show
        self._seen = self._follows_from()
        document.settled.connect(self._follow)
        # What is opened is shown with the gain that it was left with.
        document.jumped.connect(self._look)

    def _follows_from(self) -> tuple[Any, ...]:
        view = self._document.view
        kept = {one.number: one.design for one in view.snapshots}
        return view.levels_matched, view.axes, view.method, view.span, kept

    def _look(self) -> None:
        self._seen = self._follows_from()

    def _follow(self) -> None:
        before, self._seen = self._seen, self._follows_from()
        view = self._document.view
        if before == self._seen or not view.levels_matched:
            return
        held = shown(view.snapshots, self._document.design)
        just_switched_on = not before[0]
        # What was stored and not shown since is as it was edited.
        if held is not None and (just_switched_on or held.gain != 1.0):
            self._show(held.number)
