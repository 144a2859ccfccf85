"""Copies of unsaved work, and finding those of studios that ended before the work was saved.

Only the user may read them::

    unsaved/<when>-<pid>-<random>/    one folder for each running studio
        owner                         the process, see `skinsource.base.lock`
        file                          the file that the work belongs to, if any
        tap.7.skinsource, tap.7.png   the newest copy and its picture; the four before it
"""

import os
import re
import secrets
import shutil
import time
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import psutil

from skinsource.base.errors import SkinSourceError
from skinsource.base.files import (
    delete_abandoned,
    make_folder,
    path_exists,
    read_bytes,
    write_bytes,
)
from skinsource.base.lock import read_owner, still_runs, this_process, to_bytes
from skinsource.design import design_file
from skinsource.design.design_file import SUFFIX, DesignFile

#: Name of the folder of copies within the folder of the user's data.
FOLDER = "unsaved"
OWNER, FILE, PICTURE = "owner", "file", ".png"
#: Most copies of one studio at a time.
MOST_COPIES = 5

_LONGEST_STEM = 60


class Session:
    """The copies of this studio.

    Parameters
    ----------
    folder
        The user's data folder, which gets the folder of copies.
    """

    def __init__(self, folder: Path) -> None:
        owner = this_process()
        started = time.strftime("%Y%m%d-%H%M%S")
        self.folder = folder / FOLDER / f"{started}-{owner.pid}-{secrets.token_hex(3)}"
        self._copies: list[Path] = []
        self._number = 0
        self._last: DesignFile | None = None
        self._file_written: bytes | None = None

    def keep(self, content: DesignFile, file: Path | None = None, picture: bytes = b"") -> Path:
        """Write a copy, unless the newest one holds the same; return the newest.

        Parameters
        ----------
        content
            The work.
        file
            The file where the work was saved before, if any.
        picture
            Picture of the work, a PNG.

        Raises
        ------
        StorageError
            The folder cannot be written, or the disk is full.
        InvalidInputError
            The design is larger than any file may be.
        """
        if self._copies and content == self._last and path_exists(self._copies[-1]):
            return self._copies[-1]
        self._write_owner_and_file(b"" if file is None else os.fsencode(file.absolute()))
        self._number += 1
        name = file.stem if file else re.sub(r"[^\w ,-]+", "", content.design.title).strip()
        path = self.folder / f"{name[:_LONGEST_STEM] or 'untitled'}.{self._number}{SUFFIX}"
        write_bytes(path, design_file.to_bytes(content), private=True)
        self._copies.append(path)
        self._last = content
        if picture:
            write_bytes(path.with_suffix(PICTURE), picture, private=True)
        for old in self._copies[:-MOST_COPIES]:
            _delete(old, old.with_suffix(PICTURE))
        del self._copies[:-MOST_COPIES]
        return path

    def forget(self) -> None:
        """Delete all copies, because the work is saved or given up."""
        self._copies, self._last = [], None
        self._file_written = None
        shutil.rmtree(self.folder, ignore_errors=True)

    def _write_owner_and_file(self, file: bytes) -> None:
        """Write which process owns the folder, and which file its copies belong to."""
        # The user may have deleted the folder.
        if self._file_written == file and path_exists(self.folder / OWNER):
            return
        make_folder(self.folder)
        # The owner comes first: a folder without one counts as abandoned.
        write_bytes(self.folder / OWNER, to_bytes(this_process()), private=True)
        write_bytes(self.folder / FILE, file, private=True)
        self._file_written = file


def _delete(*paths: Path) -> None:
    for path in paths:
        with suppress(OSError):
            path.unlink()


#: Name of the folder, within the folder of copies, for copies that could not be opened.
ASIDE = "set aside"

_NUMBERED = re.compile(rf"(.+)\.(\d{{1,9}}){re.escape(SUFFIX)}", re.DOTALL)
_OF_PROCESS = re.compile(r"\d{8}-\d{6}-(\d{1,9})-[0-9a-f]+")
_OPENING = ".opening"
_LONGEST_PATH = 2**14


@dataclass(frozen=True, slots=True)
class UnsavedWork:
    """The unsaved work of one studio that ended.

    Attributes
    ----------
    name
        Name of the work.
    copies
        The newest first; a copy can have a picture next to it.
    file
        The file where the work was saved before, if any.
    saved_s
        When the newest copy was written, in seconds of the epoch.
    """

    name: str
    copies: tuple[Path, ...]
    file: Path | None
    saved_s: float

    def picture(self) -> bytes:
        """Return the PNG of the newest copy; empty where there is none."""
        with suppress(SkinSourceError):
            return read_bytes(self.copies[0].with_suffix(PICTURE), most=2**22)
        return b""

    def clock(self) -> str:
        """Return when the newest copy was written, with its date where that is not today."""
        day, clock = (time.strftime(form, time.localtime(self.saved_s)) for form in ("%F", "%T"))
        return clock if day == time.strftime("%F") else f"{day} {clock}"


@dataclass(frozen=True, slots=True)
class Found:
    """Unsaved work at the start of a studio.

    Attributes
    ----------
    left
        Work that can be opened, the newest first.
    set_aside
        New paths of copies whose opening never ended.
    """

    left: tuple[UnsavedWork, ...] = ()
    set_aside: tuple[Path, ...] = ()


def find(folder: Path) -> Found:
    """Find the unsaved work of ended studios, without opening a copy.

    What killed writers left is deleted.  A copy whose opening never ended is set aside,
    because it would crash this studio too.

    Parameters
    ----------
    folder
        The user's data folder.
    """
    delete_abandoned(folder, below=True)
    works: list[UnsavedWork] = []
    aside: list[Path] = []
    for session_folder in _ended_sessions(folder / FOLDER):
        copies = []
        for copy in _copies(session_folder):
            if not _mark(copy).exists():
                copies.append(copy)
            elif not _being_opened(copy):
                moved = set_aside(copy)
                aside += [moved] if moved else []
        if copies:
            numbered = _NUMBERED.fullmatch(copies[0].name)
            name = numbered[1] if numbered else copies[0].stem
            file, saved_s = _file_of(session_folder), _written_s(copies[0])
            works.append(UnsavedWork(name, tuple(copies), file, saved_s))
        else:
            _remove_if_empty(session_folder)
    works.sort(key=lambda work: work.saved_s, reverse=True)
    return Found(tuple(works), tuple(aside))


def mark_opening(copy: Path) -> None:
    """Write a mark that ``copy`` is being opened, if the folder can be written."""
    with suppress(SkinSourceError):
        write_bytes(_mark(copy), to_bytes(this_process()), private=True)


def mark_opened(copy: Path) -> None:
    """Remove the mark, because the studio has survived the opening."""
    _delete(_mark(copy))


def set_aside(copy: Path) -> Path | None:
    """Move a bad copy to a folder whose copies are not offered; return its path, None: it stays."""
    aside = copy.parent.parent / ASIDE
    try:
        make_folder(aside)
        for number in range(1, 1000):
            target = aside / (copy.name if number == 1 else f"{number} {copy.name}")
            if not target.exists():
                copy.rename(target)
                mark_opened(copy)
                return target
    except (SkinSourceError, OSError):
        pass
    return None


def discard(work: UnsavedWork) -> None:
    """Delete unsaved work; what cannot be deleted is offered again."""
    for copy in work.copies:
        _delete(copy, copy.with_suffix(PICTURE), _mark(copy))
    _remove_if_empty(work.copies[0].parent)


def _ended_sessions(root: Path) -> list[Path]:
    """Return the folders of studios that have ended."""
    try:
        folders = sorted(path for path in root.iterdir() if path.is_dir() and path.name != ASIDE)
    except OSError:
        return []
    return [folder for folder in folders if _has_ended(folder)]


def _has_ended(folder: Path) -> bool:
    owner = read_owner(folder / OWNER)
    if owner is not None:
        return still_runs(owner) is False
    # A studio writes its owner only after making the folder, whose name has the process id.
    match = _OF_PROCESS.fullmatch(folder.name)
    return match is None or not psutil.pid_exists(int(match[1]))


def _remove_if_empty(folder: Path) -> None:
    if not _copies(folder):
        shutil.rmtree(folder, ignore_errors=True)


def _copies(folder: Path) -> list[Path]:
    """Return the copies in a folder, the newest first."""
    try:
        copies = [path for path in folder.iterdir() if path.name.endswith(SUFFIX)]
    except OSError:
        return []
    return sorted(copies, key=lambda path: (_number(path), _written_s(path)), reverse=True)


def _number(path: Path) -> int:
    numbered = _NUMBERED.fullmatch(path.name)
    return int(numbered[2]) if numbered else 0


def _written_s(path: Path) -> float:
    try:
        return path.stat().st_mtime
    except OSError:
        return 0.0


def _file_of(folder: Path) -> Path | None:
    with suppress(SkinSourceError, ValueError):
        text = os.fsdecode(read_bytes(folder / FILE, most=_LONGEST_PATH))
        return Path(text) if text else None
    return None


def _mark(copy: Path) -> Path:
    return copy.with_name(copy.name + _OPENING)


def _being_opened(copy: Path) -> bool:
    opener = read_owner(_mark(copy))
    return opener is not None and still_runs(opener) is not False
