"""A design of a file, kept beside the present one to be compared with it."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from PySide6.QtWidgets import QFileDialog, QWidget

from skinsource.base.errors import SkinSourceError
from skinsource.base.quoting import printable
from skinsource.design import edits
from skinsource.design.design_file import open_design
from skinsource.design.edits import Refusal
from skinsource_gui.state.document import Document
from skinsource_gui.state.preferences import Preferences

_LONGEST = 60


class SnapshotFiles:
    """Takes designs of files as snapshots; what is open stays open.

    Parameters
    ----------
    document, preferences, window
        Where they are kept, where files were taken from last, and over what is asked.
    kinds
        Which files are offered.
    fail, tell
        Say why one was not taken, and that it was.
    """

    def __init__(
        self,
        document: Document,
        preferences: Preferences,
        window: QWidget,
        kinds: str,
        fail: Callable[[str], object],
        tell: Callable[[str], object],
    ) -> None:
        self._document, self._preferences, self._window = document, preferences, window
        self._kinds, self._fail, self._tell = kinds, fail, tell

    def ask(self) -> None:
        """Ask for a file and take its design."""
        folder = self._document.path.parent if self._document.path else self._preferences.folder
        name, _ = QFileDialog.getOpenFileName(
            self._window, "Compare with a design", str(folder), self._kinds
        )
        if name:
            self.take(Path(name))

    def take(self, path: Path) -> None:
        """Keep the design of ``path`` under the first free number, with its name."""
        try:
            design = open_design(path).design
        except SkinSourceError as error:
            self._fail(str(error))
            return
        if not design.title.strip():
            design = replace(design, title=printable(path.stem)[:_LONGEST])
        document = self._document
        outcome = edits.take_snapshot(document.design, document.view, design)
        document.apply(outcome)
        if not isinstance(outcome, Refusal):
            number = outcome.view.snapshots[-1].number
            self._tell(f"{path.name} is snapshot {number}; X shows it, and this again")
