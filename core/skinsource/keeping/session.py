"""Copies of the unsaved work of one running studio.

::

    unsaved/<when>-<pid>-<random>/    one folder for each studio that runs
        owner                         the process, see `skinsource.keeping.owner`
        file                          the file that the work belongs to, if any
        tap.7.skinsource, tap.7.png   the newest copy and its picture; the four before it
"""

import os
import secrets
import shutil
import time
from contextlib import suppress
from pathlib import Path

from skinsource.design_file import SUFFIX, DesignFile, save_design
from skinsource.files import is_there, make_folder, write_bytes
from skinsource.keeping.owner import this_process, to_bytes

#: Below the folder of the user's data.
FOLDER = "unsaved"
OWNER, FILE, PICTURE = "owner", "file", ".png"
#: Copies of one studio that are kept at a time.
MOST_COPIES = 5

_LONGEST_STEM = 60


class Session:
    """The copies of this studio.

    Parameters
    ----------
    folder
        The user's data folder; the copies lie below it.
    most
        Copies that are kept at a time; older ones go.
    """

    def __init__(self, folder: Path, most: int = MOST_COPIES) -> None:
        owner = this_process()
        started = time.strftime("%Y%m%d-%H%M%S")
        self.folder = folder / FOLDER / f"{started}-{owner.pid}-{secrets.token_hex(3)}"
        self._most = most
        self._kept: list[Path] = []
        self._number = 0
        self._last: DesignFile | None = None
        self._noted: bytes | None = None

    def keep(self, content: DesignFile, file: Path | None = None, picture: bytes = b"") -> Path:
        """Write a copy, unless the newest one holds the same; returns the newest.

        Parameters
        ----------
        content
            The work.
        file
            Where it was saved before; None: nowhere.
        picture
            What it looks like, a PNG.

        Raises
        ------
        StorageError
            The folder cannot be written, or the disk is full.
        InvalidInputError
            The design is larger than any file may be.
        """
        if self._kept and content == self._last and is_there(self._kept[-1]):
            return self._kept[-1]
        self._note(b"" if file is None else os.fsencode(file.absolute()))
        self._number += 1
        stem = file.stem[:_LONGEST_STEM] if file else "untitled"
        path = self.folder / f"{stem}.{self._number}{SUFFIX}"
        save_design(path, content.design, content.view, layout=content.layout)
        self._kept.append(path)
        self._last = content
        if picture:
            write_bytes(path.with_suffix(PICTURE), picture)
        for old in self._kept[: -self._most]:
            _discard(old)
        del self._kept[: -self._most]
        return path

    def forget(self) -> None:
        """Delete all copies: the work is saved, or given up."""
        self._kept, self._last = [], None
        self._noted = None
        shutil.rmtree(self.folder, ignore_errors=True)

    def _note(self, file: bytes) -> None:
        """Say whose the folder is, and what the copies in it are of."""
        # Somebody who tidies up may have deleted all of it.
        if self._noted == file and is_there(self.folder / OWNER):
            return
        make_folder(self.folder)
        # First of all: a folder without an owner is nobody's.
        write_bytes(self.folder / OWNER, to_bytes(this_process()))
        write_bytes(self.folder / FILE, file)
        self._noted = file


def _discard(path: Path) -> None:
    for one in (path, path.with_suffix(PICTURE)):
        with suppress(OSError):
            one.unlink()
