"""Folders are filled whole or not at all."""

import shutil
import stat
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from skinsource.errors import StorageError
from skinsource.files.leftovers import is_left_over, temporary_beside
from skinsource.files.reasons import named
from skinsource.files.writing import explained, flush_file, flush_folder


@contextmanager
def replacing_folder(path: Path, mark: str, kept: str = "") -> Iterator[Path]:
    """Give a temporary folder beside ``path`` to fill; move it into place at the end.

    All files in it are flushed to disk before the move.  On any error it is deleted, and what
    stood at ``path`` stands there still.  While a folder that stood there is replaced, there is
    none for a moment; never half of one.  What killed writers left long ago is deleted.

    Parameters
    ----------
    path
        The folder.
    mark
        Name of a file that shows that a folder was written by the same writer: others are not
        replaced, unless they are empty.
    kept
        Pattern of names, such as ``log*.csv``, of what was written into the folder since by
        others: it goes over into the new one.

    Raises
    ------
    StorageError
        Something else stands at ``path``, the parent cannot be written, or the disk is full.
    """
    _refuse_foreign(path, mark)
    with explained(path):
        _sweep(path.parent)
        temporary = temporary_beside(path)
        temporary.mkdir()
    try:
        with explained(path):
            yield temporary
            for one in path.glob(kept) if kept else ():
                if one.is_file() and not (temporary / one.name).exists():
                    shutil.copy2(one, temporary / one.name)
            for one in sorted(temporary.rglob("*"), reverse=True):
                if one.is_dir():
                    flush_folder(one)
                else:
                    flush_file(one)
            flush_folder(temporary)
            _refuse_foreign(path, mark)
            if path.exists():
                old = temporary_beside(path)
                path.replace(old)
                temporary.replace(path)
                shutil.rmtree(old, ignore_errors=True)
            else:
                temporary.replace(path)
            flush_folder(path.parent)
    finally:
        shutil.rmtree(temporary, ignore_errors=True)


def _refuse_foreign(path: Path, mark: str) -> None:
    with explained(path):
        if not path.exists() and not path.is_symlink():
            return
        ours = path.is_dir() and not path.is_symlink()
        if ours and ((path / mark).is_file() or not any(path.iterdir())):
            return
    raise StorageError(
        f"{named(path)}: something else stands there, and it is not replaced. Choose another name, "
        "or move it away first."
    )


def _sweep(folder: Path) -> None:
    """Delete one's own temporary folders that nobody has written to for a day."""
    now = time.time()
    with suppress(OSError):
        for one in folder.iterdir():
            with suppress(OSError):
                about = one.lstat()
                if stat.S_ISDIR(about.st_mode) and is_left_over(one.name, about, now):
                    shutil.rmtree(one, ignore_errors=True)
