"""How much memory another process takes, where the system does not limit it for us."""

import ctypes
import subprocess
import sys
from pathlib import Path
from typing import Any

_ASK_S = 2.0
_QUERY = 0x1000  # PROCESS_QUERY_LIMITED_INFORMATION


def resident_bytes(pid: int) -> int | None:
    """Memory that a process has in use; None if the system does not tell."""
    try:
        if sys.platform.startswith("linux"):
            return _of_linux(pid)
        return _of_windows(pid) if sys.platform == "win32" else of_ps(pid)
    except (OSError, ValueError, AttributeError, IndexError, subprocess.SubprocessError):
        return None


def of_ps(pid: int) -> int:
    """What the command of that name says, on macOS and the BSDs."""
    said = subprocess.run(  # noqa: S603  a number
        ["/bin/ps", "-o", "rss=", "-p", str(int(pid))],
        capture_output=True,
        timeout=_ASK_S,
        check=True,
    )
    return int(said.stdout) * 1024


def _of_linux(pid: int) -> int:
    for line in Path(f"/proc/{pid}/status").read_text(encoding="ascii").splitlines():
        if line.startswith("VmRSS:"):
            return int(line.split()[1]) * 1024
    raise ValueError("a process that has ended takes none")


def _of_windows(pid: int) -> int:
    kernel: Any = ctypes.WinDLL("kernel32")  # type: ignore[attr-defined,unused-ignore]
    handle = kernel.OpenProcess(_QUERY, False, pid)
    # cb, PageFaultCount, then sizes: PeakWorkingSetSize, WorkingSetSize, ...
    counters = (ctypes.c_size_t * 10)()
    ctypes.cast(counters, ctypes.POINTER(ctypes.c_uint32))[0] = ctypes.sizeof(counters)
    found = kernel.K32GetProcessMemoryInfo(
        ctypes.c_void_p(handle), ctypes.byref(counters), ctypes.sizeof(counters)
    )
    kernel.CloseHandle(ctypes.c_void_p(handle))
    if not found:
        raise OSError("no answer")
    return int(counters[2])
