"""Limits that a process sets itself before it reads what others wrote."""

import importlib
import os
import sys
from typing import IO, Any


def own_output() -> IO[bytes]:
    """What answers are written to; libraries that print do not write into it."""
    own = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    return own


def limit_memory(most_bytes: int) -> None:
    """Take no more memory than this, and write no file."""
    system = _system_limits()
    if system is not None:
        for which, most in (
            (system.RLIMIT_AS, most_bytes),
            (system.RLIMIT_CORE, 0),
            (system.RLIMIT_FSIZE, 0),
        ):
            _lower(system, which, most)


def limit_time(most_s: int) -> None:
    """Compute no longer than this from now on."""
    system = _system_limits()
    if system is not None:
        used = system.getrusage(system.RUSAGE_SELF)
        _lower(system, system.RLIMIT_CPU, int(used.ru_utime + used.ru_stime) + most_s)


def child_environment(package_folders: str) -> dict[str, str]:
    """Environment of a process that reads: it finds our packages, and HDF5 loads no plugins."""
    inherited = os.environ.get("PYTHONPATH")
    paths = [package_folders, *([inherited] if inherited else [])]
    return {
        **os.environ,
        "PYTHONPATH": os.pathsep.join(paths),
        "OPENBLAS_NUM_THREADS": "1",
        "HDF5_PLUGIN_PRELOAD": "::",
    }


def child_command(module: str) -> tuple[str, ...]:
    """Starts a module; it takes none from the folder that happens to be the current one."""
    return (sys.executable, "-P", "-m", module)


def _system_limits() -> Any:
    """The module that limits this process; None on Windows, where the parent watches."""
    try:
        return importlib.import_module("resource")
    except ImportError:
        return None


def _lower(system: Any, which: int, most: int) -> None:
    _, hard = system.getrlimit(which)
    if hard != system.RLIM_INFINITY:
        most = min(most, hard)
    try:
        system.setrlimit(which, (most, hard))
    except (ValueError, OSError):  # macOS knows some of them and allows none
        return
