"""Memory that a process occupies."""

import ctypes
import gc
import sys
from pathlib import Path

_STATUS = Path("/proc/self/status")


def resident_mb() -> float:
    """Resident memory of this process now, in MB (10⁶ bytes).

    Raises
    ------
    SystemExit
        Not on Linux: elsewhere the standard library knows the peak only.
    """
    if not _STATUS.is_file():
        sys.exit("memory can be measured on Linux only")
    lines = _STATUS.read_text(encoding="ascii").splitlines()
    return next(int(line.split()[1]) * 1024 / 1e6 for line in lines if line.startswith("VmRSS"))


def held_mb() -> float:
    """Resident memory after all that is free is given back to the system, in MB.

    What the C library keeps for the next evaluation, and the gaps between blocks, do not count.
    """
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)
    return resident_mb()
