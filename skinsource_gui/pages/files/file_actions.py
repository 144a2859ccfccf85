"""New, open and save: designs move between the document and files, which this studio locks.

Other programs may change the open file; the user is asked before anything is lost.
"""

import re
from collections.abc import Callable
from dataclasses import replace
from hashlib import sha256
from pathlib import Path
from typing import Literal

from PySide6 import QtWidgets
from PySide6.QtCore import QEvent, QObject, Signal

from skinsource.base.errors import SkinSourceError, StorageError, printable
from skinsource.base.files import path_text, read_bytes
from skinsource.base.lock import Lock, Owner, still_runs
from skinsource.design import edits
from skinsource.design.design import TITLE, Design
from skinsource.design.design_file import (
    SHOW_SUFFIX,
    SUFFIX,
    DesignFile,
    open_design,
    read_design,
    save_design,
)
from skinsource.design.edits.edit import Refusal
from skinsource.design.edits.view import rename_snapshot
from skinsource.limbs.catalog import available_limbs, default_limb
from skinsource.specs.image import MAX_IMAGE_BYTES
from skinsource_gui.qt.questions import ask_name, ask_open, ask_save, ask_to_save, ask_yes
from skinsource_gui.qt.windows import WindowEvents
from skinsource_gui.state.document import NEW_VIEW, Document
from skinsource_gui.state.preferences import Preferences

State = Literal["same", "changed", "gone"]


class FileOnDisk:
    """Remembers what a file held when it was last read or written here."""

    def __init__(self) -> None:
        self._path: Path | None = None
        self._stamp: tuple[int, ...] | None = None
        self._digest = b""

    def note(self, path: Path | None) -> None:
        """Remember what ``path`` holds now; None: no file."""
        self._path = path
        self._stamp = _stamp(path) if path else None
        self._digest = _digest(path) if path else b""

    def open(self, path: Path) -> DesignFile:
        """Read a design file, and remember what it holds."""
        self._path, self._stamp = path, _stamp(path)
        stored, content = read_design(path)
        self._digest = sha256(stored).digest()
        return content

    def state(self) -> State:
        """Return whether the file still holds what it held."""
        if self._path is None:
            return "same"
        stamp = _stamp(self._path)
        if stamp == self._stamp:
            return "same" if stamp else "gone"
        if stamp is None:
            return "gone"
        # Backups and sync programs touch files without changing them.
        if _digest(self._path) != self._digest:
            return "changed"
        self._stamp = stamp
        return "same"


def _stamp(path: Path) -> tuple[int, ...] | None:
    try:
        status = path.stat()
    except (OSError, ValueError):
        return None
    return status.st_ino, status.st_size, status.st_mtime_ns


def _digest(path: Path) -> bytes:
    try:
        return sha256(read_bytes(path, most=MAX_IMAGE_BYTES)).digest()
    except SkinSourceError:
        return b""


class HeldFile:
    """Takes and releases locks on files.

    Where no lock can be written, as in a read-only folder, a file is opened without one.
    """

    def __init__(self) -> None:
        self._locks: dict[Path, Lock] = {}

    def take(self, path: Path, *, from_other: bool = False) -> Owner | None:
        """Lock ``path`` in addition to other files; return who has locked it before, or None."""
        lock = Lock(path)
        try:
            other = lock.take(from_other=from_other)
        except StorageError:
            return None
        if other is None:
            self._locks[lock.file] = lock
        return other

    def keep_only(self, path: Path | None) -> None:
        """Release all locks but that of ``path``; None: all."""
        # A link and its target have one lock.
        remaining = None if path is None else Lock(path).file
        for file in [file for file in self._locks if file != remaining]:
            self._locks.pop(file).release()


def who_has(path: Path, other: Owner) -> str:
    """Return "tap.skinsource is open in another studio (ana on lab-3, since 10:15)"."""
    return f"{path.name} is open in another studio ({other.description})"


#: Longest title of a design that is named after its file.
_LONGEST = 60
_FILTER = f"SkinSource designs (*{SUFFIX})"
_SHOWS = f"Designs and shows (*{SUFFIX} *{SHOW_SUFFIX});;{_FILTER}"
_READ_ONLY = "It is read-only here; save it under another name."
_MAYBE_ENDED = "It may still be open there. Replace the file?"
_CHANGED = "was changed by another program, or in another window, since it was opened here"


class FileActions(QObject):
    """Moves designs between the document and files."""

    failed = Signal(str)
    #: What went well, as a short text.
    done = Signal(str)
    #: A file was opened; the bytes are the window's arrangement that it holds.
    opened = Signal(bytes)
    #: The `Path` of a show that is to be opened.
    show_wanted = Signal(object)
    #: A new design was started.
    started_over = Signal()
    #: The design is about to be written.
    saving = Signal()
    #: The next step might end the studio, so unsaved work is to be saved now.
    risk_ahead = Signal()
    #: The folder in which the next file is expected, `Path`.
    folder_changed = Signal(object)

    def __init__(
        self,
        document: Document,
        preferences: Preferences,
        window: QtWidgets.QWidget,
        arrangement: Callable[[], bytes],
    ):
        super().__init__(window)
        self._document, self._preferences, self._window = document, preferences, window
        self._arrangement = arrangement
        self._on_disk, self._reported = FileOnDisk(), "same"
        self.held = HeldFile()
        #: Suggested path for a design without a file; None: a usual one.
        self.suggested: Path | None = None
        WindowEvents.follow(window, lambda _: self.look_at_disk(), QEvent.Type.WindowActivate)

    def new(self) -> None:
        """Start over with an empty design on the person's limb, in the person's panels."""
        if self.may_lose_changes():
            self._document.start_over(
                Design(limb=_limb_to_start_on(self._document)), NEW_VIEW, None
            )
            self.leave_file()
            self.started_over.emit()
            self.done.emit("Started a new design")

    def leave_file(self, path: Path | None = None) -> Owner | None:
        """Close the open file, and open another one, if any; return who has it open already."""
        other = None if path is None else self.held.take(path)
        self.held.keep_only(path)
        self._note_file(path)
        return other

    def ask_and_open(self) -> None:
        """Ask for a file and open it."""
        path = self._ask_which("Open design or show", _SHOWS)
        if path is not None:
            self.open(path)

    def _ask_which(self, title: str, kinds: str = _FILTER) -> Path | None:
        folder = self._document.path.parent if self._document.path else self._preferences.folder
        return ask_open(self._window, title, kinds, folder)

    def take_snapshot(self) -> None:
        """Ask for a file whose design becomes the snapshot of the first free number."""
        path = self._ask_which("Compare with a design")
        if path is None:
            return
        try:
            design = open_design(path).design
        except SkinSourceError as error:
            self.failed.emit(str(error))
            return
        if not design.title.strip():
            design = replace(design, title=printable(path.stem)[:_LONGEST])
        outcome = edits.take_snapshot(self._document.design, self._document.view, design)
        self._document.apply(outcome)
        if not isinstance(outcome, Refusal):
            number = outcome.view.snapshots[-1].number
            self.done.emit(f"{path.name} is snapshot {number}; X switches between the two")

    def rename_snapshot(self, number: str) -> None:
        """Ask for the title of the snapshot with a number."""
        design, view = self._document.design, self._document.view
        (before,) = (each.title for each in view.snapshots if each.number == int(number))
        title = ask_name(self._window, f"Rename snapshot {number}", before, TITLE.longest)
        if title is not None:
            self._document.apply(rename_snapshot(design, view, int(number), title))

    def open(self, path: Path) -> None:
        """Open ``path``; on a failure report it, and keep what is open."""
        if path.suffix == SHOW_SUFFIX:
            self.show_wanted.emit(path)
            return
        self.risk_ahead.emit()
        on_disk = FileOnDisk()
        try:
            content = on_disk.open(path)
        except SkinSourceError as error:
            self._preferences.note_recent(path, there=False)
            self.failed.emit(str(error))
            return
        # A file that cannot be opened is reported before the question about unsaved edits.
        if not self.may_lose_changes():
            return
        other = self.held.take(path)
        self.held.keep_only(path)
        self._document.start_over(content.design, content.view, path, read_only=other is not None)
        self._on_disk, self._reported, self.suggested = on_disk, "same", None
        self.note_used(path)
        self.opened.emit(content.layout)
        if other is None:
            self.done.emit(f"Opened {path.name}")
        else:
            self.failed.emit(f"{who_has(path, other)}. {_READ_ONLY}")

    def save(self) -> bool:
        """Save where it was saved before, or ask; return whether it is saved now."""
        if self._document.path is None:
            return self.ask_and_save()
        path = self._document.path
        if self._document.read_only and self.held.take(path) is not None:
            return self.ask_and_save()
        return self._may_overwrite(path) and self._save_to(path)

    def ask_and_save(self) -> bool:
        """Ask for a name and save there; return whether it is saved now."""
        # Files have letters that all systems take.
        words = re.sub(r"[^\w.,+()-]+", " ", self._document.design.title)[:_LONGEST].strip(" .")
        unnamed = self.suggested or self._preferences.folder / f"{words or 'design'}{SUFFIX}"
        start = self._document.path or unnamed
        path = ask_save(self._window, "Save the design", start, _FILTER)
        return path is not None and self._save_to(path)

    def note_written(self, path: Path, note: str = "") -> None:
        """Remember the folder of a file that was written, and report the file and ``note``."""
        self._note_folder(path)
        self.done.emit("; ".join(part for part in (f"Saved {path_text(path)}", note) if part))

    def note_used(self, path: Path) -> None:
        """Remember a file that was opened or saved elsewhere."""
        self._preferences.note_recent(path)
        self._note_folder(path)

    def _note_folder(self, path: Path) -> None:
        self._preferences.folder = path.absolute().parent
        self.folder_changed.emit(self._preferences.folder)

    def may_lose_changes(self) -> bool:
        """Return whether no edits are unsaved, or they are saved now, or the user gives them up."""
        self.look_at_disk()
        if not self._document.modified:
            return True
        path = self._document.path
        name = f"“{path.name}”" if path else "This design"
        question = f"{name} has edits that are not saved. If you discard them, they are lost."
        return ask_to_save(self._window, "Unsaved design", question, self.save)

    def look_at_disk(self) -> None:
        """Report, once, that another program has changed or deleted the open file."""
        state, path = self._on_disk.state(), self._document.path
        if path is None or state == self._reported:
            return
        self._reported = state
        if state == "gone":
            self._document.mark_lost()
            self.failed.emit(
                f"{path.name} is no longer in {path_text(path.parent)}. Save the design to keep it."
            )
        elif state == "changed":
            self.failed.emit(f"{path.name} {_CHANGED}. Saving will ask before it is replaced.")

    def _note_file(self, path: Path | None) -> None:
        self._on_disk.note(path)
        self._reported, self.suggested = "same", None

    def _may_overwrite(self, path: Path) -> bool:
        return self._on_disk.state() != "changed" or ask_yes(
            self._window,
            "Replace the changed file?",
            f"{path.name} {_CHANGED}. Replace it? What was saved there is lost.",
        )

    def _save_to(self, path: Path) -> bool:
        document, other = self._document, self.held.take(path)
        if other is not None:
            reason = who_has(path, other)
            if still_runs(other) is not None:
                self.failed.emit(f"{reason}. Save the design under another name.")
                return False
            if not ask_yes(self._window, "Replace the file?", f"{reason}. {_MAYBE_ENDED}"):
                return False
            self.held.take(path, from_other=True)
        self.saving.emit()
        try:
            save_design(path, document.design, document.view, layout=self._arrangement())
        except SkinSourceError as error:
            self.held.keep_only(None if document.read_only else document.path)
            self.failed.emit(str(error))
            return False
        self.held.keep_only(path)
        self._document.mark_saved(path)
        self._note_file(path)
        self._preferences.note_recent(path)
        self.note_written(path)
        return True


def _limb_to_start_on(document: Document) -> str:
    """Return the open limb unless it belongs to a scene or is not installed, else the default."""
    limb = document.design.limb
    return limb if not document.scene and limb in available_limbs() else default_limb()
