"""Keeps large freed blocks in the process, so that the next evaluation finds them warm."""

import ctypes
import sys

_TRIM_THRESHOLD, _MMAP_THRESHOLD = -1, -3
_LARGEST_BLOCK_BYTES = 32 * 2**20
_KEPT_BYTES = 256 * 2**20


def keep_freed_memory() -> bool:
    """Ask the C library not to give blocks of up to 32 MB back at once; return whether it will.

    Spectra of some megabytes are made and dropped at each edit.  Given back, each costs a
    thousand page faults at the next edit, which takes longer than the computation.  Programs
    call it at their start; importing the library changes nothing.  Only glibc (Linux) can do it.
    """
    if not sys.platform.startswith("linux"):
        return False
    try:
        mallopt = ctypes.CDLL(None).mallopt
    except (OSError, AttributeError):
        return False
    accepted = mallopt(_TRIM_THRESHOLD, _KEPT_BYTES)
    return bool(accepted and mallopt(_MMAP_THRESHOLD, _LARGEST_BLOCK_BYTES))
