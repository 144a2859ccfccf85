"""Start the studio: ``skinsource-gui`` or ``python -m skinsource_gui``.

Nothing here imports Qt before it is known that Qt can start.
"""

import argparse
import atexit
import gc
import importlib
import importlib.util
import os
import signal
import sys
from collections.abc import Sequence
from pathlib import Path

from skinsource.base.errors import escaped
from skinsource.base.extras import extra_line
from skinsource.version import __version__
from skinsource_gui.qt.lazy_modules import leave_sources_unread, make_lazy
from skinsource_gui.qt.system_libraries import has_display, install_line, missing_packages

_FIRST_RUN = Path("build/first-run")


def main(arguments: Sequence[str] | None = None) -> int:
    """Open the studio; without a display, render what it would show to files instead."""
    for name in ("stdout", "stderr"):
        # Windows gives programs of a window none.
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115  until the end
    options = _parser().parse_args(arguments)
    if importlib.util.find_spec("PySide6") is None or importlib.util.find_spec("pyqtgraph") is None:
        return _stop(f"the window needs its own packages: {extra_line('gui')}")
    on_a_screen = has_display() and options.render is None
    missing = missing_packages(on_a_screen=on_a_screen)
    if missing:
        return _stop(f"Qt cannot start: system libraries are missing.\n{install_line(missing)}")
    if not on_a_screen:
        # Ctrl+C ends it at once.  As an exception it would be lost, or worse, inside Qt.
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    os.environ.setdefault("PYQTGRAPH_QT_LIB", "PySide6")
    # What is made at the start stays; to look for garbage in it takes a tenth of the time.  The
    # studio collects it itself once its window stands, and rendering to files is over by then.
    gc.disable()
    importlib.import_module("PySide6.QtCore")
    leave_sources_unread()
    make_lazy()
    if on_a_screen:
        result = int(importlib.import_module("skinsource_gui.app.app").run(options.design))
        return _ending_at_once(result)
    folder = options.render or _FIRST_RUN
    if options.render is None:
        shown = "the start design" if options.design is None else escaped(str(options.design))
        sys.stdout.write(f"There is no display here. Rendering {shown} to {folder} instead.\n")
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
    headless = importlib.import_module("skinsource_gui.app.headless")
    return _ending_at_once(int(headless.run(folder, options.design)))


def _ending_at_once(result: int) -> int:
    """Have the process end after Python's threads, with windows left to the system.

    PySide would take them apart in any order, and Qt call their event filters meanwhile: that
    crashes where a window was closed right after its start.
    """
    atexit.register(_end, result)
    return result


def _end(result: int) -> None:
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(result)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="skinsource-gui",
        description="Design vibrotactile stimuli and see how they travel across hand and arm.",
    )
    parser.add_argument("design", nargs="?", type=Path, help="a design or a show to open")
    parser.add_argument(
        "--render",
        type=Path,
        metavar="FOLDER",
        help="open no window; write a picture of it, the RMS map and the traces to FOLDER",
    )
    parser.add_argument("--version", action="version", version=f"skinsource {__version__}")
    return parser


def _stop(reason: str) -> int:
    sys.stderr.write(f"skinsource-gui: {reason}\n")
    return 1


if __name__ == "__main__":
    sys.exit(main())
