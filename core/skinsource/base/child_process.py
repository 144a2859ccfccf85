"""How child processes are started, and the limits that they set themselves."""

import importlib
import os
import sys
from typing import IO, Any


def own_output() -> IO[bytes]:
    """Return the stream for answers; what libraries print does not get into it."""
    own = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    return own


def limit_memory(most_bytes: int) -> None:
    """Limit the memory of this process, and forbid it to write files."""
    system = _system_limits()
    if system is not None:
        for which, most in (
            (system.RLIMIT_AS, most_bytes),
            (system.RLIMIT_CORE, 0),
            (system.RLIMIT_FSIZE, 0),
        ):
            _lower(system, which, most)


def limit_time(most_s: int) -> None:
    """Limit how long this process computes from now on."""
    system = _system_limits()
    if system is not None:
        used = system.getrusage(system.RUSAGE_SELF)
        _lower(system, system.RLIMIT_CPU, int(used.ru_utime + used.ru_stime) + most_s)


def child_environment(package_folders: str) -> dict[str, str]:
    """Return the environment of a child: it finds our packages, and HDF5 loads no plugins."""
    inherited = os.environ.get("PYTHONPATH")
    paths = [package_folders, *([inherited] if inherited else [])]
    return {
        **os.environ,
        "PYTHONPATH": os.pathsep.join(paths),
        "OPENBLAS_NUM_THREADS": "1",
        "HDF5_PLUGIN_PRELOAD": "::",
    }


def child_command(module: str) -> tuple[str, ...]:
    """Return the command that runs a module; Python ignores modules in the current folder."""
    return (sys.executable, "-P", "-m", module)


def _system_limits() -> Any:
    """Return the module ``resource``; None on Windows, where the parent watches the child."""
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
    except (ValueError, OSError):  # macOS forbids some of them
        return
