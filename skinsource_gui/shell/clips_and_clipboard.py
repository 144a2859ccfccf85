"""Clips and the clipboard, from the menu."""

from PySide6.QtCore import QObject

from skinsource_gui.panels.timeline.timeline_edits import TimelineEdits
from skinsource_gui.state.document import Document


class ClipsAndClipboard(QObject):
    """Does with the selected clips what keys do in the timeline, be that shown or not.

    Parameters
    ----------
    document
        Whose clips.
    parent
        As in Qt.
    """

    def __init__(self, document: Document, parent: QObject) -> None:
        super().__init__(parent)
        self._document, self._edits = document, TimelineEdits(self)
        self._edits.edited.connect(document.apply)

    def cut(self) -> None:
        """Move the selected clips to the clipboard."""
        self._present().cut()

    def copy(self) -> None:
        """Put the selected clips on the clipboard."""
        self._present().copy()

    def paste(self) -> None:
        """Put the clips of the clipboard at the playhead."""
        self._present().paste()

    def _present(self) -> TimelineEdits:
        self._edits.show_state(self._document.design, self._document.view)
        return self._edits
