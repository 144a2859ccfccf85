"""New, open, save, recent files, and the question before work is lost."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QFileDialog, QMessageBox, QWidget

from skinsource.design import Design
from skinsource.design_file import SUFFIX, DesignFile, open_design, save_design
from skinsource.errors import SkinSourceError
from skinsource.view import View
from skinsource_gui.document import Document
from skinsource_gui.preferences import Preferences

_FILTER = f"SkinSource designs (*{SUFFIX})"
_Answer = QMessageBox.StandardButton


class FileActions(QObject):
    """Moves designs between the document and files."""

    failed = Signal(str)
    #: A file was opened; the bytes are the window's arrangement that it holds.
    opened = Signal(bytes)
    recent_changed = Signal()

    def __init__(
        self,
        document: Document,
        preferences: Preferences,
        window: QWidget,
        arrangement: Callable[[], bytes],
    ):
        super().__init__(window)
        self._document, self._preferences, self._window = document, preferences, window
        self._arrangement = arrangement

    def new(self) -> None:
        """Start over with an empty design on the same limb."""
        if self.may_lose_changes():
            limb = self._document.design.limb
            self._document.start_over(Design(limb=limb), View(), None)

    def ask_and_open(self) -> None:
        """Ask for a file and open it."""
        folder = str(self._document.path.parent) if self._document.path else ""
        name, _ = QFileDialog.getOpenFileName(self._window, "Open a design", folder, _FILTER)
        if name:
            self.open(Path(name))

    def open(self, path: Path) -> None:
        """Open ``path``; on any fault say so and keep what is open."""
        if not self.may_lose_changes():
            return
        try:
            content = open_design(path)
        except SkinSourceError as error:
            self._preferences.forget_file(path)
            self.recent_changed.emit()
            self.failed.emit(str(error))
            return
        self._document.start_over(content.design, content.view, path)
        self._preferences.remember_file(path)
        self.recent_changed.emit()
        self.opened.emit(content.layout)

    def save(self) -> bool:
        """Save where it was saved before, or ask; whether it is saved now."""
        if self._document.path is None:
            return self.ask_and_save()
        return self._save_to(self._document.path)

    def ask_and_save(self) -> bool:
        """Ask for a name and save there; whether it is saved now."""
        start = str(self._document.path or Path.home() / f"design{SUFFIX}")
        name, _ = QFileDialog.getSaveFileName(self._window, "Save the design", start, _FILTER)
        if not name:
            return False
        path = Path(name)
        return self._save_to(path if path.suffix else path.with_suffix(SUFFIX))

    def may_lose_changes(self) -> bool:
        """Whether unsaved edits may go: there are none, they are saved now, or the user agrees."""
        if not self._document.modified:
            return True
        answer = QMessageBox.question(
            self._window,
            "Unsaved design",
            "The design has edits that are not saved. Save them?",
            _Answer.Save | _Answer.Discard | _Answer.Cancel,
            _Answer.Save,
        )
        if answer == _Answer.Save:
            return self.save()
        return answer == _Answer.Discard

    def _save_to(self, path: Path) -> bool:
        content = DesignFile(
            design=self._document.design, view=self._document.view, layout=self._arrangement()
        )
        try:
            save_design(path, content)
        except SkinSourceError as error:
            self.failed.emit(str(error))
            return False
        self._document.mark_saved(path)
        self._preferences.remember_file(path)
        self.recent_changed.emit()
        return True
