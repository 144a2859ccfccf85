"""New, open, save, recent files, and the question before work is lost."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QEvent, QObject, Signal
from PySide6.QtWidgets import QFileDialog, QWidget

from skinsource.base.errors import SkinSourceError
from skinsource.base.files import is_there, named
from skinsource.design.design import Design
from skinsource.design.design_file import SUFFIX, open_design, save_design
from skinsource.design.view import View
from skinsource.limbs.catalogue import available_limbs, default_limb
from skinsource_gui.files.file_on_disk import FileOnDisk
from skinsource_gui.files.held_file import HeldFile, may_have_ended, who_has
from skinsource_gui.files.recent_files import RecentFiles
from skinsource_gui.files.snapshot_files import SnapshotFiles
from skinsource_gui.state.document import Document
from skinsource_gui.state.preferences import Preferences
from skinsource_gui.widgets.asking import agreed, may_replace, saved_or_given_up

_FILTER = f"SkinSource designs (*{SUFFIX})"
_READ_ONLY = "It is read-only here: saving asks for another name."
_MAYBE_ENDED = "Nobody can say here whether that has ended. Replace the file, and have it here?"
_CHANGED = "was changed by another program, or in another window, since it was opened here"


class FileActions(QObject):
    """Moves designs between the document and files."""

    failed = Signal(str)
    #: What went well, in a few words.
    done = Signal(str)
    #: A file was opened; the bytes are the window's arrangement that it holds.
    opened = Signal(bytes)
    #: What is open is new, as at a start.
    started_over = Signal()
    recent_changed = Signal()
    #: What follows might end the studio: unsaved work is to be kept now.
    risk_ahead = Signal()
    #: The folder in which the next file is expected, `Path`.
    folder_changed = Signal(object)

    def __init__(
        self,
        document: Document,
        preferences: Preferences,
        window: QWidget,
        arrangement: Callable[[], bytes],
    ):
        super().__init__(window)
        self._document, self._preferences, self._window = document, preferences, window
        self.recent = RecentFiles(preferences)
        self._arrangement = arrangement
        self._on_disk, self._told = FileOnDisk(), "same"
        self.held = HeldFile()
        #: Asks for a file whose design is kept as a snapshot.
        self.take_snapshot = SnapshotFiles(
            document, preferences, window, _FILTER, self.failed.emit, self.done.emit
        ).ask
        #: Where a design without a file is expected to go; None: anywhere.
        self.suggested: Path | None = None
        window.installEventFilter(self)

    def new(self) -> None:
        """Start over with an empty design on the person's limb, in the person's panels."""
        if self.may_lose_changes():
            self._document.start_over(Design(limb=_limb_to_start_on(self._document)), View(), None)
            self.leave_file()
            self.started_over.emit()
            self.done.emit("Started a new design")

    def leave_file(self) -> None:
        """No file is open any more: others may have the one that was."""
        self._note_file(None)
        self.held.keep_only(None)

    def ask_and_open(self) -> None:
        """Ask for a file and open it."""
        folder = self._document.path.parent if self._document.path else self._preferences.folder
        name, _ = QFileDialog.getOpenFileName(self._window, "Open a design", str(folder), _FILTER)
        if name:
            self.open(Path(name))

    def open(self, path: Path) -> None:
        """Open ``path``; on any fault say so and keep what is open."""
        self.risk_ahead.emit()
        on_disk = FileOnDisk()
        on_disk.note(path)
        try:
            content = open_design(path)
        except SkinSourceError as error:
            self.recent.forget(path)
            self.recent_changed.emit()
            self.failed.emit(str(error))
            return
        # What cannot be opened is said before anything is asked.
        if not self.may_lose_changes():
            return
        other = self.held.take(path)
        self.held.keep_only(path)
        self._document.start_over(content.design, content.view, path, read_only=other is not None)
        self._on_disk, self._told, self.suggested = on_disk, "same", None
        self.recent.remember(path)
        self._note_folder(path)
        self.recent_changed.emit()
        self.opened.emit(content.layout)
        if other is None:
            self.done.emit(f"Opened {path.name}")
        else:
            self.failed.emit(f"{who_has(path, other)}. {_READ_ONLY}")

    def save(self) -> bool:
        """Save where it was saved before, or ask; whether it is saved now."""
        if self._document.path is None:
            return self.ask_and_save()
        path = self._document.path
        if self._document.read_only and self.held.take(path) is not None:
            return self.ask_and_save()
        return self._may_overwrite(path) and self._save_to(path)

    def ask_and_save(self) -> bool:
        """Ask for a name and save there; whether it is saved now."""
        unnamed = self.suggested or self._preferences.folder / f"design{SUFFIX}"
        start = self._document.path or unnamed
        path = self.ask_where("Save the design", start, _FILTER)
        return path is not None and self._save_to(path)

    def ask_where(
        self,
        title: str,
        start: Path,
        kinds: str,
        endings: tuple[str, ...] = (),
        *,
        ending: str = "",
    ) -> Path | None:
        """Ask for a file to write; None if there shall be none.

        It has one of the ``endings``, or that of ``start``; a name without one gets ``ending``
        where that is longer than a suffix: ``_stim.tsv.gz``.
        """
        name, _ = QFileDialog.getSaveFileName(self._window, title, str(start), kinds)
        if not name:
            return None
        path = Path(name)
        if path.suffix.lower() not in (start.suffix.lower(), *endings):
            # The dialog asked about the name as it was typed.
            for part in Path(ending).suffixes:
                name = name.removesuffix(part)
            path = Path(f"{name}{ending or start.suffix}")
            if is_there(path) and not may_replace(self._window, [path]):
                return None
        return path

    def note_written(self, path: Path, note: str = "") -> None:
        """Remember the folder of a file that was written, and tell that all went well.

        ``note`` is what else is to be said of it.
        """
        self._note_folder(path)
        self.done.emit("; ".join(part for part in (f"Saved {named(path)}", note) if part))

    def _note_folder(self, path: Path) -> None:
        self._preferences.folder = path.absolute().parent
        self.folder_changed.emit(self._preferences.folder)

    def may_lose_changes(self) -> bool:
        """Whether unsaved edits may go: there are none, they are saved now, or the user agrees."""
        self.look_at_disk()
        if not self._document.modified:
            return True
        question = "The design has edits that are not saved. Save them?"
        return saved_or_given_up(self._window, "Unsaved design", question, self.save)

    def look_at_disk(self) -> None:
        """Tell, once, that another program has changed or deleted the open file."""
        state, path = self._on_disk.state(), self._document.path
        if path is None or state == self._told:
            return
        self._told = state
        if state == "gone":
            self._document.mark_lost()
            self.failed.emit(
                f"{path.name} is no longer in {named(path.parent)}. Save the design to keep it."
            )
        elif state == "changed":
            self.failed.emit(f"{path.name} {_CHANGED}. Saving will ask before it is replaced.")

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.WindowActivate:
            self.look_at_disk()
        return super().eventFilter(watched, event)

    def _note_file(self, path: Path | None) -> None:
        self._on_disk.note(path)
        self._told, self.suggested = "same", None

    def _may_overwrite(self, path: Path) -> bool:
        return self._on_disk.state() != "changed" or agreed(
            self._window,
            "Replace what another program saved?",
            f"{path.name} {_CHANGED}. Replace it, and lose what was saved there?",
        )

    def _save_to(self, path: Path) -> bool:
        document, other = self._document, self.held.take(path)
        if other is not None:
            words = who_has(path, other)
            if not may_have_ended(other):
                self.failed.emit(f"{words}. Save the design under another name.")
                return False
            if not agreed(self._window, "Replace the file?", f"{words}. {_MAYBE_ENDED}"):
                return False
            self.held.take(path, from_other=True)
        try:
            save_design(path, document.design, document.view, layout=self._arrangement())
        except SkinSourceError as error:
            self.held.keep_only(None if document.read_only else document.path)
            self.failed.emit(str(error))
            return False
        self.held.keep_only(path)
        self._document.mark_saved(path)
        self._note_file(path)
        self.recent.remember(path)
        self.recent_changed.emit()
        self.note_written(path)
        return True


def _limb_to_start_on(document: Document) -> str:
    """The one that is open, unless a scene brought it, or it is not here."""
    limb = document.design.limb
    return limb if not document.scene and limb in available_limbs() else default_limb()
