"""Keeps large freed blocks in the process, so that the next evaluation finds them warm.

What has been kept for long is given back now and then.
"""

import ctypes
import sys
from collections.abc import Callable
from typing import cast

_TRIM_THRESHOLD, _MMAP_THRESHOLD, _MOST_ARENAS = -1, -3, -8
_LARGEST_BLOCK_BYTES = 8 * 2**20
_KEPT_BYTES = 256 * 2**20


def keep_freed_memory() -> bool:
    """Ask the C library not to give blocks of up to 8 MB back at once; return whether it will.

    Spectra of some megabytes are made and dropped at each edit.  Given back, each costs a
    thousand page faults at the next edit, which takes longer than the computation; of larger ones
    the computation takes longer, and a few of them would be most of what is kept.  Programs call
    it at their start; importing the library changes nothing.  Only glibc (Linux) can do it.
    """
    mallopt = _from_c_library("mallopt")
    settings = (
        (_TRIM_THRESHOLD, _KEPT_BYTES),
        (_MMAP_THRESHOLD, _LARGEST_BLOCK_BYTES),
        # One for all workers, so that each finds what others freed.
        (_MOST_ARENAS, 2),
    )
    return mallopt is not None and all(mallopt(*setting) for setting in settings)


def give_freed_memory_back() -> bool:
    """Return to the system what was freed long ago between blocks in use; whether there was any.

    Without this an hour of edits holds some hundred megabytes that nobody uses.
    """
    malloc_trim = _from_c_library("malloc_trim")
    return malloc_trim is not None and bool(malloc_trim(0))


def _from_c_library(name: str) -> Callable[..., int] | None:
    """Return a function of glibc (Linux), or None."""
    if not sys.platform.startswith("linux"):
        return None
    try:
        return cast("Callable[..., int]", getattr(ctypes.CDLL(None), name))
    except (OSError, AttributeError):
        return None
