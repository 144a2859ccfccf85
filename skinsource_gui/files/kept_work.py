"""Copies of unsaved work, kept when the studio is told to end and cannot ask."""

import os
from contextlib import suppress
from pathlib import Path

from skinsource.design_file import SUFFIX, open_design, save_design
from skinsource.files import make_folder
from skinsource_gui.state.document import Document

_FOLDER = "unsaved"


class KeptWork:
    """The copies in a folder.

    Parameters
    ----------
    folder
        The user's data folder; the copies lie below it.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder / _FOLDER

    def keep(self, document: Document) -> Path:
        """Write a copy of ``document``, which stays as it is.

        Raises
        ------
        StorageError
            The folder cannot be written, or the disk is full.
        """
        make_folder(self._folder)
        stem = document.path.stem if document.path else "untitled"
        # Two studios may be told to end at once.
        path = self._folder / f"{stem}-{os.getpid()}{SUFFIX}"
        save_design(path, document.design, document.view)
        return path

    def newest(self) -> Path | None:
        """The copy that was kept last, if there is any."""
        try:
            found = [(path.stat().st_mtime, path) for path in self._folder.glob(f"*{SUFFIX}")]
        except OSError:
            return None
        return max(found)[1] if found else None

    def open(self, path: Path, document: Document) -> None:
        """Take the copy ``path`` over into ``document``, as work that is not saved yet.

        The copy stays until that is saved, or given up.

        Raises
        ------
        SkinSourceError
            The copy cannot be read.
        """
        content = open_design(path)
        empty = type(content.design)(limb=content.design.limb)
        document.start_over(empty, content.view, None)
        document.edit("Open unsaved work", content.design)
        document.look(content.view)

        def forget_when_saved() -> None:
            if not document.modified:
                document.title_changed.disconnect(forget_when_saved)
                self.discard(path)

        document.title_changed.connect(forget_when_saved)

    def discard(self, path: Path) -> None:
        """Delete the copy ``path``; where that is not possible, it is offered again."""
        with suppress(OSError):
            path.unlink()
