"""How fast a dragged frequency reaches the screen, and how long the window is ever blocked.

Four inputs of 1 s, all panels open, offscreen.  Each step edits the frequency of one input, waits
until the panels have the new results, and paints.  Printed per step: *edit* (the panels take over
the new design), *compute* (in the worker), *set* (results into the panels, with the hop between
threads), *paint*; and the longest time the GUI thread was busy at one stretch.

    make bench
"""

import argparse
import os
import platform
import statistics
import sys
import tempfile
from pathlib import Path
from time import perf_counter

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
os.environ.setdefault("PYQTGRAPH_QT_LIB", "PySide6")

from PySide6.QtCore import QEventLoop, QTimer
from PySide6.QtWidgets import QApplication

from skinsource.catalogue import available_limbs, default_limb
from skinsource.design import Design, Input
from skinsource.view import View
from skinsource.waveforms import Tone
from skinsource_gui.app import exempt_from_collection, make_application
from skinsource_gui.gesture import new_gesture
from skinsource_gui.preferences import Preferences
from skinsource_gui.window import MainWindow


class Drag:
    """Drags the frequency of one input and notes where the time goes."""

    def __init__(self, window: MainWindow) -> None:
        self._window = window
        self._outcome = None
        self._delivered_s = 0.0
        self._waiting = QEventLoop()
        self._beat = QTimer(window)
        self._beat.setInterval(1)
        self._beat.timeout.connect(self._note_beat)
        self._last_beat_s = perf_counter()
        self.longest_block_s = 0.0
        window.conductor.delivered.connect(self._note)

    def start(self) -> None:
        """Begin to watch how long the GUI thread is busy at one stretch."""
        self._last_beat_s = perf_counter()
        self.longest_block_s = 0.0
        self._beat.start()

    def step(self, frequency_hz: float, gesture: int) -> dict[str, float]:
        """Edit, wait, paint; the times in seconds."""
        document = self._window.document
        self._outcome = None
        tone = Tone(frequency_hz=frequency_hz, duration_s=1.0)
        design = document.design.with_input(1, waveform=tone)
        start = perf_counter()
        document.edit("Change frequency", design, gesture)
        edited = perf_counter()
        # The event loop sleeps while the worker computes, as it does in use.
        self._waiting.exec()
        QApplication.processEvents()
        painted = perf_counter()
        compute_s = self._outcome.compute_s
        return {
            "edit": edited - start,
            "compute": compute_s,
            "set": max(0.0, self._delivered_s - edited - compute_s),
            "paint": painted - self._delivered_s,
            "total": painted - start,
        }

    def _note_beat(self) -> None:
        now = perf_counter()
        # The beat itself comes a millisecond after the last.
        self.longest_block_s = max(self.longest_block_s, now - self._last_beat_s - 1e-3)
        self._last_beat_s = now

    def _note(self, outcome: object) -> None:
        self._outcome = outcome
        self._delivered_s = perf_counter()
        self._waiting.quit()


def main() -> int:
    """Print the table; 1 if a promise is broken."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--steps", type=int, default=200)
    parser.add_argument("--inputs", type=int, default=4)
    parser.add_argument("--size", default="1440x900")
    options = parser.parse_args()
    application = make_application()
    width, height = map(int, options.size.split("x"))
    inputs = tuple(
        Input(
            location=1 + (4 + k) % 20,
            waveform=Tone(frequency_hz=80.0 + 5 * k, duration_s=1.0),
            colour=k,
        )
        for k in range(options.inputs)
    )
    with tempfile.TemporaryDirectory() as folder:
        window = MainWindow(
            Design(limb=default_limb(), inputs=inputs),
            view=View(outputs=(29, 30, 33, 35, 38, 52), selected_input=1),
            preferences=Preferences(Path(folder) / "studio.ini"),
            available_limbs=available_limbs(),
        )
        window.resize(width, height)
        window.show()
        window.commands.arrange_design()
        window.catch_up()
        exempt_from_collection()
        drag = Drag(window)
        gesture = new_gesture()
        for k in range(10):
            drag.step(60.0 + k, gesture)
        drag.start()
        start = perf_counter()
        rows = [drag.step(100.0 + 0.5 * k, gesture) for k in range(options.steps)]
        elapsed_s = perf_counter() - start
        window.document.undo_stack.setClean()
        window.close()
        application.processEvents()
    return _report(rows, elapsed_s, drag.longest_block_s, options)


def _report(
    rows: list[dict[str, float]], elapsed_s: float, block_s: float, options: argparse.Namespace
) -> int:
    print(f"{platform.platform()}, Python {platform.python_version()}, {os.cpu_count()} cores")
    print(f"{default_limb()}, {options.inputs} inputs of 1 s, 6 outputs, {options.size}, offscreen")
    print(f"{'ms':>8} {'median':>8} {'p95':>8} {'max':>8}")
    for name in rows[0]:
        times = sorted(row[name] * 1e3 for row in rows)
        p95 = times[int(0.95 * (len(times) - 1))]
        print(f"{name:>8} {statistics.median(times):8.2f} {p95:8.2f} {times[-1]:8.2f}")
    rate = len(rows) / elapsed_s
    print(f"{rate:.0f} frames per second (promised: 30)")
    print(f"GUI thread busy for at most {block_s * 1e3:.1f} ms (promised: 50)")
    return int(rate < 30 or block_s > 0.05)


if __name__ == "__main__":
    sys.exit(main())
