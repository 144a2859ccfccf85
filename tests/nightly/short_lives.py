"""Studios that end at once: ``make nightly``, or ``python -m tests.nightly.short_lives``.

Some windows are closed within 20 ms of their start, and some renderings are ended by a signal.
Prints the seed and each that crashed, hung, or said something.  Ends with 1 if there was one.
"""

import os
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from tests.nightly.options import read_options

_PATIENCE_S = 120
#: Arguments: milliseconds after which the window is closed.
_CLOSED_SOON = """
import sys
from PySide6.QtCore import QTimer
from skinsource_gui import __main__ as studio
from skinsource_gui.app import app

make_window = app.make_window

def window_closed_soon(path, preferences):
    window = make_window(path, preferences)
    QTimer.singleShot(int(sys.argv[1]), window.close)
    return window

app.make_window = window_closed_soon
studio.has_display = lambda: True
studio.missing_packages = lambda **_: []
sys.exit(studio.main([]))
"""


def closed_window(after_ms: int, folder: Path) -> str:
    """Return what was wrong when a window was closed so soon."""
    studio = _started(["-c", _CLOSED_SOON, str(after_ms)], folder)
    return _fault_of(studio, (0,), f"window closed after {after_ms} ms")


def ended_rendering(after_s: float, number: signal.Signals, folder: Path) -> str:
    """Return what was wrong when a rendering got a signal."""
    studio = _started(["-m", "skinsource_gui", "--render", str(folder / "pictures")], folder)
    try:
        studio.wait(after_s)
    except subprocess.TimeoutExpired:
        studio.send_signal(number)
    return _fault_of(studio, (0, -number), f"rendering, {number.name} after {after_s:.2f} s")


def _started(arguments: list[str], folder: Path) -> "subprocess.Popen[str]":
    environment = os.environ | {"QT_QPA_PLATFORM": "offscreen", "SKINSOURCE_DATA": str(folder)}
    environment |= {"XDG_CONFIG_HOME": str(folder), "PYQTGRAPH_QT_LIB": "PySide6"}
    pipes = {"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE}
    return subprocess.Popen([sys.executable, *arguments], text=True, env=environment, **pipes)


def _fault_of(studio: "subprocess.Popen[str]", expected: tuple[int, ...], text: str) -> str:
    try:
        _, errors = studio.communicate(timeout=_PATIENCE_S)
    except subprocess.TimeoutExpired:
        studio.kill()
        studio.communicate()
        return f"{text}: hangs"
    lines = [line for line in errors.splitlines() if not line.startswith("This plugin does not")]
    if studio.returncode in expected and not lines:
        return ""
    return "\n".join([f"{text}: ended with {studio.returncode}", *lines[-20:]])


def main() -> int:
    options = read_options(__doc__, 40)
    chance, faults = np.random.default_rng(options.seed), []
    for k in range(options.count):
        with tempfile.TemporaryDirectory() as name:
            if k % 2:
                number = (signal.SIGINT, signal.SIGTERM)[chance.integers(2)]
                fault = ended_rendering(chance.uniform(0.0, 4.0), number, Path(name))
            else:
                fault = closed_window(int(chance.integers(21)), Path(name))
        if fault:
            print(fault, flush=True)
            faults.append(fault)
    print(f"{options.count} studios, {len(faults)} faults", flush=True)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
