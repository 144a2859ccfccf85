"""First statements of the programs of the self-contained folder, which `freeze.py` builds.

There are three, told apart by their names: ``skinsource``, ``skinsource-gui`` and
``skinsource-process``.  What the first two run in a process of its own, such as readers of foreign
files and measurements of a sweep, is asked for as ``python -m MODULE`` or ``python -c CODE``; there
is no Python on the machine, so the third program answers in its place.
"""

import ctypes.util
import multiprocessing
import os
import runpy
import sys
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path

_PROCESS = "skinsource-process"


def main() -> None:
    """Be the program that was started."""
    program = Path(sys.executable)
    be_without_python(program.with_name(_PROCESS + program.suffix))
    find_libraries_in(program.with_name("_internal"))
    if program.stem == _PROCESS:
        answer_for_python(sys.argv[1:])
    else:
        package = "skinsource_gui" if program.stem == "skinsource-gui" else "skinsource"
        sys.exit(import_module(f"{package}.__main__").main())


def be_without_python(process: Path) -> None:
    """Have ``process`` started instead of Python; other programs find the system's libraries."""
    sys.executable = str(process)
    multiprocessing.set_executable(sys.executable)
    if "LD_LIBRARY_PATH" in os.environ:
        os.environ["LD_LIBRARY_PATH"] = os.environ.pop("LD_LIBRARY_PATH_ORIG", "")


def find_libraries_in(folder: Path) -> None:
    """Have packages that ask for a library of the system find that of the folder in its absence."""
    of_system = ctypes.util.find_library

    def find_library(name: str) -> str | None:
        own = map(str, folder.glob(f"lib{name}.so*"))
        return of_system(name) or next(own, None)

    ctypes.util.find_library = find_library


def answer_for_python(arguments: Sequence[str]) -> None:
    """Do what ``python`` would do with these arguments: ``-c CODE ...`` or ``-m MODULE ...``."""
    if arguments[0] == "--multiprocessing-fork":
        # loky on Windows; it does not say whose handle this is.
        windows = import_module("loky.backend.popen_loky_win32")
        windows.main(int(arguments[1]), os.getppid())
    how = next(number for number, argument in enumerate(arguments) if argument in ("-c", "-m"))
    what, *others = arguments[how + 1 :]
    sys.argv = ["-c", *others]
    if arguments[how] == "-c":
        exec(what, {"__name__": "__main__"})  # noqa: S102  our own code
    else:
        runpy.run_module(what, run_name="__main__", alter_sys=True)


if __name__ == "__main__":
    main()
