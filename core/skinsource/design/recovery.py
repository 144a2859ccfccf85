"""Nothing is lost: copies of unsaved work, locks on open files, and a log of crashes."""

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
from skinsource.base.files import is_there, make_folder, read_bytes, write_bytes
from skinsource.base.lock import read_owner, still_runs, this_process, to_bytes
from skinsource.base.work import counted
from skinsource.design.design_file import SUFFIX, DesignFile, save_design

# Copies of the unsaved work of one running studio.
#
# ::
#
#     unsaved/<when>-<pid>-<random>/    one folder for each studio that runs
#         owner                         the process, see `skinsource.base.lock`
#         file                          the file that the work belongs to, if any
#         tap.7.skinsource, tap.7.png   the newest copy and its picture; the four before it

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
    for file in (path, path.with_suffix(PICTURE)):
        with suppress(OSError):
            file.unlink()


# Unsaved work of studios that ended before it was saved.

#: Where copies lie that could not be opened, below the folder of the copies.
ASIDE = "set aside"

_NUMBERED = re.compile(rf"(.+)\.(\d{{1,9}}){re.escape(SUFFIX)}", re.DOTALL)
_OF_PROCESS = re.compile(r"\d{8}-\d{6}-(\d{1,9})-[0-9a-f]+")
_OPENING = ".opening"
_LONGEST_PATH = 2**14
_MINUTE_S, _HOUR_S, _DAY_S = 60, 3600, 86_400


@dataclass(frozen=True, slots=True)
class UnsavedWork:
    """What one studio left.

    Attributes
    ----------
    name
        What the work was called.
    copies
        The newest first; each has a picture beside it, or none.
    file
        Where the work was saved before; None: nowhere.
    kept_s
        When the newest copy was written, in seconds of the epoch.
    """

    name: str
    copies: tuple[Path, ...]
    file: Path | None
    kept_s: float

    def picture(self) -> bytes:
        """PNG of the newest copy; empty where there is none."""
        with suppress(SkinSourceError):
            return read_bytes(self.copies[0].with_suffix(PICTURE), most=2**22)
        return b""

    def age(self) -> str:
        """How old the newest copy is, in words."""
        return age_text(time.time() - self.kept_s)


@dataclass(frozen=True, slots=True)
class Found:
    """What a start finds.

    Attributes
    ----------
    left
        What can be opened, the newest first.
    set_aside
        Where copies lie now whose opening never ended.
    """

    left: tuple[UnsavedWork, ...] = ()
    set_aside: tuple[Path, ...] = ()


def find(folder: Path) -> Found:
    """Look for what ended studios left; no copy is opened.

    What killed writers left is deleted, and a copy whose opening never ended is set aside: it
    would stop this studio too.

    Parameters
    ----------
    folder
        The user's data folder.
    """
    works: list[UnsavedWork] = []
    aside: list[Path] = []
    for place in _places(folder / FOLDER):
        copies = []
        for copy in _copies(place):
            if not _mark(copy).exists():
                copies.append(copy)
            elif not _being_opened(copy):
                moved = set_aside(copy)
                aside += [moved] if moved else []
        if copies:
            works.append(_left_over(place, copies))
        else:
            _remove_empty(place)
    works.sort(key=lambda work: work.kept_s, reverse=True)
    return Found(tuple(works), tuple(aside))


def mark_opening(copy: Path) -> None:
    """Note that ``copy`` is being opened; where that cannot be written, it is opened unnoted."""
    with suppress(SkinSourceError):
        write_bytes(_mark(copy), to_bytes(this_process()))


def mark_opened(copy: Path) -> None:
    """Note that the studio has survived it."""
    with suppress(OSError):
        _mark(copy).unlink()


def set_aside(copy: Path) -> Path | None:
    """Move a copy that is bad to where none is offered; returns where it is, None: it stays."""
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
    """Delete what was left; what cannot be deleted is offered again."""
    for copy in work.copies:
        for path in (copy, copy.with_suffix(PICTURE), _mark(copy)):
            with suppress(OSError):
                path.unlink()
    _remove_empty(work.copies[0].parent)


def age_text(seconds: float) -> str:
    """Words such as "3 minutes ago"."""
    for unit_s, noun in ((_DAY_S, "day"), (_HOUR_S, "hour"), (_MINUTE_S, "minute")):
        count = int(seconds // unit_s)
        if count >= 1:
            return f"{counted(count, noun)} ago"
    return "less than a minute ago"


def _places(root: Path) -> list[Path]:
    """Folders of studios that have ended."""
    try:
        folders = sorted(path for path in root.iterdir() if path.is_dir() and path.name != ASIDE)
    except OSError:
        return []
    ended = [place for place in folders if _has_ended(place)]
    for place in ended:
        for part in place.glob(".*.part"):
            with suppress(OSError):
                part.unlink()
    return ended


def _has_ended(place: Path) -> bool:
    owner = read_owner(place / OWNER)
    if owner is not None:
        return still_runs(owner) is False
    # It ended, or began, before it wrote who it is.
    match = _OF_PROCESS.fullmatch(place.name)
    return match is None or not psutil.pid_exists(int(match[1]))


def _remove_empty(place: Path) -> None:
    if not _copies(place):
        shutil.rmtree(place, ignore_errors=True)


def _copies(place: Path) -> list[Path]:
    """Copies in one folder, the newest first."""
    try:
        copies = [path for path in place.iterdir() if path.name.endswith(SUFFIX)]
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


def _left_over(place: Path, copies: list[Path]) -> UnsavedWork:
    numbered = _NUMBERED.fullmatch(copies[0].name)
    name = numbered[1] if numbered else copies[0].stem
    return UnsavedWork(name, tuple(copies), _file_of(place), _written_s(copies[0]))


def _file_of(place: Path) -> Path | None:
    with suppress(SkinSourceError, ValueError):
        text = os.fsdecode(read_bytes(place / FILE, most=_LONGEST_PATH))
        return Path(text) if text else None
    return None


def _mark(copy: Path) -> Path:
    return copy.with_name(copy.name + _OPENING)


def _being_opened(copy: Path) -> bool:
    opener = read_owner(_mark(copy))
    return opener is not None and still_runs(opener) is not False
