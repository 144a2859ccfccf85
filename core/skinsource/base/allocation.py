"""Keeps large freed blocks in the process, so that the next evaluation finds them warm."""

import ctypes
import sys
from collections.abc import Callable

_TRIM_THRESHOLD, _MMAP_THRESHOLD = -1, -3
_LARGEST_BLOCK_BYTES = 32 * 2**20
_KEPT_BYTES = 256 * 2**20


def keep_freed_memory() -> bool:
    """Ask the C library not to give blocks of up to 32 MB back at once; return whether it will.

    Spectra of some megabytes are made and dropped at each edit.  Given back, each costs a
    thousand page faults at the next edit, which takes longer than the computation.  Programs
    call it at their start; importing the library changes nothing.  Only glibc (Linux) can do it.
    """
    mallopt = _of_the_c_library("mallopt")
    if mallopt is None:
        return False
    accepted = mallopt(_TRIM_THRESHOLD, _KEPT_BYTES)
    return bool(accepted and mallopt(_MMAP_THRESHOLD, _LARGEST_BLOCK_BYTES))


def give_back_freed_memory() -> None:
    """Give the system what `keep_freed_memory` kept; now and then, so that it does not add up."""
    malloc_trim = _of_the_c_library("malloc_trim")
    if malloc_trim is not None:
        malloc_trim(0)


def _of_the_c_library(name: str) -> Callable[..., int] | None:
    """Return a function of glibc; None elsewhere."""
    if not sys.platform.startswith("linux"):
        return None
    try:
        function: Callable[..., int] = ctypes.CDLL(None)[name]
    except (OSError, AttributeError):
        return None
    return function
