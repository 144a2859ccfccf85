"""What to do about a file that the system refuses, in one sentence."""

import errno
from pathlib import Path

from skinsource.quoting import escaped, printable

_MOST_CHARACTERS = 400
_FULL = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG}
_FORBIDDEN = {errno.EACCES, errno.EPERM, errno.EROFS}
_ABSENT = {errno.ENOENT, errno.ENOTDIR}


def named(path: Path) -> str:
    """Return ``path`` for a message: whatever its name holds, it can be printed."""
    text = str(path)
    whole = len(text) <= _MOST_CHARACTERS
    return escaped(text) if whole else f"{escaped(text[:_MOST_CHARACTERS])}…"


def reason_of(error: OSError | ValueError) -> str:
    """What the system says."""
    if isinstance(error, OSError):
        return printable(error.strerror or str(error))
    return printable(error)  # a path with a NUL in it


def advice_on_writing(error: OSError | ValueError) -> str:
    """What lets the next attempt succeed."""
    code = error.errno if isinstance(error, OSError) else errno.EINVAL
    if code in _FULL:
        return "Free some space or choose another disk, then try again."
    if code in _FORBIDDEN:
        return "Choose a folder you may write to, then try again."
    if code in _ABSENT:
        return "Choose a folder that exists, then try again."
    if code == errno.ENAMETOOLONG:
        return "Choose a shorter name, then try again."
    if code in (errno.EINVAL, errno.ELOOP, errno.EISDIR):
        return "Choose another name, then try again."
    return "Check the disk or choose another one, then try again."


def advice_on_reading(error: OSError | ValueError) -> str:
    """What may help."""
    code = error.errno if isinstance(error, OSError) else errno.EINVAL
    if code in _ABSENT:
        return "It was moved or deleted; look for it elsewhere."
    if code in _FORBIDDEN:
        return "Ask its owner for the right to read it."
    return "Check that it is a file and that you may read it."
