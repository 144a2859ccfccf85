"""A thousand slider changes at 200 Hz against an evaluation of 40 ms.

Printed: how long after the last change its result arrives, the longest queue, whether results ever
came in the wrong order, and the gaps in which the GUI thread answered nothing.

    QT_QPA_PLATFORM=offscreen python benchmarks/slider_storm.py
"""

import os
import statistics
import sys
from time import perf_counter, sleep

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
os.environ.setdefault("PYQTGRAPH_QT_LIB", "PySide6")

from PySide6.QtCore import QEventLoop, Qt, QTimer
from yardstick import judge

from skinsource.engine.graph import Graph
from skinsource_gui.app.app import make_application
from skinsource_gui.state.conductor import WAIT_FOR_RESULTS_S
from skinsource_gui.state.engine import Engine, Outcome, Request

CHANGES, PERIOD_MS, EVALUATION_S = 1000, 5, 0.04
#: In times an evaluation.
MOST_LATE, LONGEST_GAP = 3.75, 1.25


class Storm:
    """Sends changes on a timer and notes what comes back."""

    def __init__(self) -> None:
        self.evaluated: list[int] = []
        self.computed_s: list[float] = []
        self.evaluated_at_s = self.last_sent_s = 0.0
        self.beats_s: list[float] = []
        self._sent = 0
        self.engine = Engine(lambda: Graph(self._evaluate))
        self.engine.finished.connect(self._note)
        self.loop = QEventLoop()
        self._timer = QTimer(timerType=Qt.TimerType.PreciseTimer, interval=PERIOD_MS)
        self._timer.timeout.connect(self._send)
        self._beat = QTimer(timerType=Qt.TimerType.PreciseTimer, interval=1)
        self._beat.timeout.connect(self._note_beat)

    def run(self) -> None:
        """Send all changes and wait for the last result."""
        self._timer.start()
        self._beat.start()
        self.loop.exec()
        self.engine.close()

    @staticmethod
    def _evaluate(value: int) -> int:
        end = perf_counter() + EVALUATION_S
        while perf_counter() < end:
            sleep(0.001)
        return value

    def _send(self) -> None:
        self._sent += 1
        self.last_sent_s = perf_counter()
        self.engine.request(Request(frozenset({"_evaluate"}), {"value": self._sent}))
        # As the window does.
        self.engine.wait(WAIT_FOR_RESULTS_S)
        if self._sent == CHANGES:
            self._timer.stop()

    def _note(self, outcome: Outcome) -> None:
        self.evaluated.append(outcome.values["_evaluate"])
        self.computed_s.append(outcome.compute_s)
        self.evaluated_at_s = perf_counter()
        if self.evaluated[-1] == CHANGES:
            self.loop.quit()

    def _note_beat(self) -> None:
        self.beats_s.append(perf_counter())


def main() -> int:
    """Print the figures; 1 if a promise is broken."""
    make_application()
    storm = Storm()
    storm.run()
    gaps_ms = sorted((b - a) * 1e3 for a, b in zip(storm.beats_s, storm.beats_s[1:], strict=False))
    late_ms = (storm.evaluated_at_s - storm.last_sent_s) * 1e3
    p99_ms = gaps_ms[int(0.99 * (len(gaps_ms) - 1))]
    ordered = storm.evaluated == sorted(storm.evaluated)
    print(f"{CHANGES} changes at {1000 // PERIOD_MS} Hz, {len(storm.evaluated)} evaluations")
    print(f"order never reversed: {ordered}")
    print(f"longest time in which the GUI answered nothing {gaps_ms[-1]:.1f} ms")
    # On a busy machine an evaluation takes longer than it means to.
    beside = "an evaluation", 1e3 * statistics.median(storm.computed_s)
    soon = judge("last value after release", late_ms, "ms", beside, MOST_LATE)
    fluent = judge("p99 of times without an answer", p99_ms, "ms", beside, LONGEST_GAP)
    return int(not (soon and fluent and ordered))


if __name__ == "__main__":
    sys.exit(main())
