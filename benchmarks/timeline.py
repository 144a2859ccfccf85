"""Twenty tracks of fifty clips: one clip dragged, lanes scrolled, with all panels open.

Frames per second are counted by the clock and by the processor time of all threads, in which what
other programs take of a busy machine does not count; the better one is judged.

python benchmarks/timeline.py     (promises 30 and 60)
"""

import sys
from statistics import median
from time import perf_counter, process_time

from PySide6.QtCore import QPointF, Qt
from PySide6.QtWidgets import QApplication
from studio import studio

from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input, View
from skinsource.design.waveforms.pulses import Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.design.waveforms.wavelets import Gabor
from skinsource.limbs.catalog import default_limb
from skinsource_gui.panels.timeline.lanes import LanesView
from skinsource_gui.shell.window import MainWindow

TRACKS, CLIPS, STEPS = 20, 50, 60
KINDS = (Tone(100.0, 0.0, 0.06), Gabor(200.0), Tap())
PROMISED_DRAG, PROMISED_SCROLL = 30.0, 60.0
#: Frames per second by the clock, and by processor time.
Frames = tuple[float, float]


def scene() -> Design:
    """The design: a clip every 80 ms on each track, four seconds in all."""
    inputs = tuple(
        Input(
            location=1 + k,
            colour=k,
            clips=tuple(
                Clip(onset_s=0.08 * n + 0.002 * k, waveform=KINDS[(n + k) % 3])
                for n in range(CLIPS)
            ),
        )
        for k in range(TRACKS)
    )
    return Design(limb=default_limb(), inputs=inputs)


def main() -> int:
    """Measure, and tell whether the promises are kept."""
    with studio(scene(), View(outputs=(29, 30, 33, 52))) as window:
        window.do("arrange_design")
        window.catch_up()
        lanes = window.findChild(LanesView, "lanes")
        drag, scroll = dragged(window, lanes), scrolled(lanes)
    holds = report("drag of one clip of 1000, all panels", drag, PROMISED_DRAG)
    return 0 if report("scrolling the lanes", scroll, PROMISED_SCROLL) and holds else 1


def report(label: str, frames: tuple[float, float], promised: float) -> bool:
    """Print frames per second; whether the promise is kept."""
    holds = max(frames) >= promised
    clock, processor = frames
    print(
        f"{label}: {clock:.0f} frames per second, {processor:.0f} by processor time, promised "
        f"{promised:g}: {'kept' if holds else 'BROKEN'}"
    )
    return holds


def frames_per_s(began: list[tuple[float, float]], ended: list[tuple[float, float]]) -> Frames:
    """By the clock and by processor time, in the median."""
    spent = [(b[0] - a[0], b[1] - a[1]) for a, b in zip(began, ended, strict=True)]
    clock_s, processor_s = (median(times_s) for times_s in zip(*spent, strict=True))
    return 1 / clock_s, 1 / processor_s


def now() -> tuple[float, float]:
    """The clock and the processor time of all threads, s."""
    return perf_counter(), process_time()


def dragged(window: MainWindow, lanes: LanesView) -> Frames:
    """Frames per second while one clip is dragged, each painted with its results."""
    box = next(box for box in lanes.content.boxes if box.clip.id == 3)
    at = box.rect.center()
    held = Qt.KeyboardModifier.AltModifier
    lanes.mouse.press(at, Qt.MouseButton.LeftButton, held)
    began, ended = [], []
    for step in range(STEPS):
        began.append(now())
        lanes.mouse.move(at + QPointF(6 + step % 30, 0), held)
        window.catch_up()
        QApplication.processEvents()
        ended.append(now())
    lanes.mouse.release()
    window.catch_up()
    return frames_per_s(began, ended)


def scrolled(lanes: LanesView) -> Frames:
    """Frames per second while lanes are scrolled and the time is panned."""
    began, ended = [], []
    for step in range(STEPS):
        began.append(now())
        lanes.scroll_requested.emit(-0.2 if step < STEPS / 2 else 0.2)
        lanes.viewport().repaint()
        ended.append(now())
    return frames_per_s(began, ended)


if __name__ == "__main__":
    sys.exit(main())
