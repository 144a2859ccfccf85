"""How fast a dragged frequency reaches the screen.

The mouse drags the frequency in the inspector; all panels are open, six outputs are selected,
twenty inputs sound, offscreen.  First one edit after another, each waiting until the last is
painted: *compute* in the worker, *set* the results into the panels, *paint*, and *other*: the new
design into all panels, and the way between threads.  Then a free drag, with the mouse moving 250
times a second whatever the window does.

What is promised are ratios to fixed pieces of work, timed in turn with the edits: in processor
time, which does not count how long other programs keep both threads waiting for each other.

    make bench
"""

import argparse
import os
import platform
import statistics
import sys
from itertools import pairwise
from time import perf_counter, process_time
from typing import Any, NamedTuple

from PySide6.QtCore import QEvent, QEventLoop, QObject, QPoint, Qt, QTimer
from PySide6.QtWidgets import QApplication
from studio import FINE, MOVE, PRESS, RELEASE, send_mouse, studio
from yardstick import Beside, computing_and_painting, judge

from skinsource.design.design import Design, View, track
from skinsource.design.waveforms.tones import Tone
from skinsource.limbs.catalog import default_limb
from skinsource_gui.app.app import manage_garbage_collection
from skinsource_gui.fields.number_field import PIXELS_PER_STEP, NumberField
from skinsource_gui.shell.window import MainWindow
from skinsource_gui.state.engine import Outcome

OUTPUTS = (29, 30, 33, 35, 38, 52)
#: Median and 95th percentile that are promised, in times the fixed piece of work beside them, for
#: each length of the inputs in s.
PROMISES = {1.0: (3.5, 5.5), 4.0: (5.0, 9.0)}
MOUSE_MS, FREE_S = 4, 2.0
#: Most that a frame of a free drag takes, in times an edit of the other one.
MOST_EDITS_PER_FRAME = 2.0
_STEPS_BETWEEN = 4


class WatchedWindow(MainWindow):
    """Notes when it painted: pairs of start and end."""

    def __init__(self, *given: Any, **named: Any) -> None:
        self.paints: list[tuple[float, float]] = []
        super().__init__(*given, **named)

    def event(self, event: QEvent) -> bool:
        """Paint, or whatever else is asked."""
        if event.type() != QEvent.Type.UpdateRequest:
            return super().event(event)
        start_s = perf_counter()
        handled = super().event(event)
        self.paints.append((start_s, perf_counter()))
        return handled


class Drag(QObject):
    """Drags the frequency of the selected input and notes where the time goes."""

    def __init__(self, window: WatchedWindow) -> None:
        super().__init__(window)
        self._window = window
        self._field = window.panel("inspector").findChild(NumberField, "frequency_hz_field")
        self._travel_px = 0
        self._outcome: Outcome | None = None
        self._arrived_s = self._delivered_s = 0.0
        self.shown: list[tuple[Outcome, float]] = []
        # Told first, to know when the panels begin to take over results.
        window.engine.finished.disconnect(window.conductor._deliver)
        window.engine.finished.connect(self._arrive)
        window.engine.finished.connect(window.conductor._deliver)
        window.conductor.delivered.connect(self._note)
        self._send(PRESS)

    def step(self) -> dict[str, float]:
        """One edit, until it is painted; the times in seconds."""
        self._outcome = None
        self._window.paints.clear()
        start, processor_s = perf_counter(), process_time()
        self.move()
        while not self._painted():
            QApplication.processEvents(QEventLoop.ProcessEventsFlag.WaitForMoreEvents)
        end = next(end for begin, end in self._window.paints if begin >= self._delivered_s)
        parts = {
            "compute": self._outcome.compute_s,
            "set": self._delivered_s - self._arrived_s,
            "paint": sum(after - before for before, after in self._window.paints if after <= end),
        }
        parts["other"] = end - start - sum(parts.values())
        # What is still to be painted belongs to this edit.
        QApplication.processEvents()
        return {**parts, "total": end - start, "processor": process_time() - processor_s}

    def move(self) -> None:
        """Move the mouse by one fine step of the number."""
        self._travel_px += PIXELS_PER_STEP
        self._send(MOVE)

    def release(self) -> None:
        """Let go."""
        self._send(RELEASE)

    def _arrive(self) -> None:
        self._arrived_s = perf_counter()

    def _painted(self) -> bool:
        paints = self._window.paints
        return self._outcome is not None and bool(paints) and paints[-1][0] >= self._delivered_s

    def _send(self, kind: QEvent.Type) -> None:
        place = self._field.rect().center() + QPoint(round(self._travel_px), 0)
        send_mouse(self._field, kind, place, FINE)

    def _note(self, outcome: Outcome) -> None:
        self._outcome, self._delivered_s = outcome, perf_counter()
        self.shown.append((outcome, self._delivered_s))


class Free(NamedTuple):
    """What came of a free drag: ages of what was painted, s, and the longest block, s.

    ``processor_s`` is the time of all threads for each frame.
    """

    frames_per_s: float
    ages_s: list[float]
    block_s: float
    processor_s: float


def drag_freely(window: WatchedWindow, drag: Drag) -> Free:
    """Drag for a while, and watch."""
    window.paints.clear()
    drag.shown.clear()
    beats: list[float] = []
    mouse = QTimer(timerType=Qt.TimerType.PreciseTimer, interval=MOUSE_MS)
    mouse.timeout.connect(drag.move)
    beat = QTimer(timerType=Qt.TimerType.PreciseTimer, interval=1)
    beat.timeout.connect(lambda: beats.append(perf_counter()))
    loop = QEventLoop()
    processor_s = process_time()
    mouse.start()
    beat.start()
    QTimer.singleShot(int(FREE_S * 1e3), loop.quit)
    loop.exec()
    mouse.stop()
    beat.stop()
    processor_s = process_time() - processor_s
    ages = []
    for outcome, delivered_s in drag.shown:
        painted_s = next((end for begin, end in window.paints if begin >= delivered_s), None)
        if painted_s is not None:
            ages.append(painted_s - outcome.request.since_s)
    gaps = (after - before for before, after in pairwise(beats))
    return Free(len(ages) / FREE_S, ages, max(gaps) - 1e-3, processor_s / max(len(ages), 1))


def measure(options: argparse.Namespace, seconds: float) -> bool:
    """Print the figures for inputs of ``seconds``; whether all promises are kept."""
    inputs = tuple(
        track(
            location=1 + (4 + k) % 20,
            waveform=Tone(frequency_hz=80.0 + 5 * k, duration_s=seconds),
            colour=k,
        )
        for k in range(options.inputs)
    )
    design = Design(limb=default_limb(), inputs=inputs, scaling="upstream")
    view, size = View(outputs=OUTPUTS, selected_inputs=(2,)), map(int, options.size.split("x"))
    with studio(design, view, tuple(size), kind=WatchedWindow) as window:
        window.do("arrange_design")
        window.catch_up()
        manage_garbage_collection(window)
        drag = Drag(window)
        for _ in range(20):
            drag.step()
        beside = Beside(computing_and_painting, "a fixed piece of work", process_time)
        rows = []
        for k in range(options.steps):
            if k % _STEPS_BETWEEN == 0 and not options.alone:
                beside.once()
            rows.append(drag.step())
        free = drag_freely(window, drag)
        drag.release()
        window.catch_up()
    print(f"\n{default_limb()}, {options.inputs} inputs of {seconds:g} s, {len(OUTPUTS)} outputs,")
    print(f"{options.size}, offscreen; one edit after another:")
    edit_s = statistics.median(row["processor"] for row in rows)
    promises = None if options.alone else PROMISES.get(seconds)
    return _report_steps(rows, promises, beside) & _report_free(free, edit_s)


def _report_steps(
    rows: list[dict[str, float]], promises: tuple[float, float] | None, beside: Beside
) -> bool:
    print(f"{'ms':>8} {'median':>8} {'p95':>8} {'max':>8}")
    for name in rows[0]:
        times = [row[name] for row in rows]
        print(f"{name:>8} {_median(times):8.2f} {_p95(times):8.2f} {max(times) * 1e3:8.2f}")
    if promises is None:
        return True
    used = [row["processor"] for row in rows]
    holds = beside.judge("median of processor time", _median(used) / 1e3, promises[0])
    return beside.judge("p95 of processor time", _p95(used) / 1e3, promises[1]) and holds


def _report_free(free: Free, edit_s: float) -> bool:
    print(f"free drag, mouse at {1000 // MOUSE_MS} Hz: {free.frames_per_s:.0f} frames per second,")
    print(f"edit to painted: median {_median(free.ages_s):.1f} ms, p95 {_p95(free.ages_s):.1f} ms,")
    print(f"GUI thread busy for at most {free.block_s * 1e3:.1f} ms")
    beside = "one edit after another", edit_s * 1e3
    label = "processor time of a frame"
    return judge(label, 1e3 * free.processor_s, "ms", beside, MOST_EDITS_PER_FRAME)


def _median(times_s: list[float]) -> float:
    return statistics.median(times_s) * 1e3


def _p95(times_s: list[float]) -> float:
    return sorted(times_s)[int(0.95 * (len(times_s) - 1))] * 1e3


def main() -> int:
    """Print all figures; 1 if a promise is broken."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--steps", type=int, default=200)
    parser.add_argument("--inputs", type=int, default=20)
    parser.add_argument("--seconds", type=float, nargs="+", default=list(PROMISES))
    parser.add_argument("--size", default="1440x900")
    parser.add_argument("--alone", action="store_true", help="no fixed piece of work between edits")
    options = parser.parse_args()
    print(f"{platform.platform()}, Python {platform.python_version()}, {os.cpu_count()} cores")
    holds = [measure(options, seconds) for seconds in options.seconds]
    return int(not all(holds))


if __name__ == "__main__":
    sys.exit(main())
