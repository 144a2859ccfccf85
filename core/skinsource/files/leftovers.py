"""Temporary files of writers that were killed."""

import os
import re
import secrets
import stat
import time
from contextlib import suppress
from pathlib import Path

_NAME = re.compile(r"\..+\.[0-9a-f]{8}\.part", re.DOTALL)
_A_DAY_S = 24 * 3600.0


def temporary_beside(path: Path) -> Path:
    """Return a new name beside ``path`` for what shall replace it."""
    return path.parent / f".{path.name}.{secrets.token_hex(4)}.part"


def sweep(folder: Path) -> None:
    """Delete one's own temporary files in ``folder`` that nobody has written to for a day.

    What cannot be looked at or deleted stays: the writing that follows is what matters.
    """
    now = time.time()
    with suppress(OSError), os.scandir(folder) as entries:
        for entry in entries:
            if _NAME.fullmatch(entry.name):
                with suppress(OSError):
                    about = entry.stat(follow_symlinks=False)
                    if stat.S_ISREG(about.st_mode) and is_left_over(entry.name, about, now):
                        Path(entry.path).unlink()


def is_left_over(name: str, about: os.stat_result, now_s: float) -> bool:
    """Whether something is one's own temporary one, and nobody has written to it for a day."""
    owner = getattr(os, "getuid", lambda: about.st_uid)()
    own = _NAME.fullmatch(name) is not None and about.st_uid == owner
    return own and about.st_mtime < now_s - _A_DAY_S
