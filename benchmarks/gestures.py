"""Drawing with the pen, dragging a clip and dragging a point of an envelope, by mouse events.

Four tracks of 1 s, five outputs; hand, map, traces, spectra and inspector visible, and the clip
editor or, while a clip is dragged, the timeline in its place.  Each move of the mouse waits until
everything that it changes is computed and painted: own waveform, spectrum with its share outside
the band, level, and every panel.  What is promised are frames per second of processor time, of all
threads: what other programs take of a busy machine is not counted.  Frames per second by the clock
are printed beside.  Then the point of the envelope again, moved sixty times a second as by a hand
and waited for by nobody: how often the editor paints it, and how often every panel follows.

    python benchmarks/gestures.py
"""

import sys
from collections.abc import Callable
from statistics import median
from time import perf_counter, process_time

import numpy as np
from PySide6.QtCore import QEvent, QEventLoop, QObject, QPointF, Qt
from PySide6.QtWidgets import QApplication, QWidget
from studio import BARE, MOVE, PRESS, RELEASE, send_mouse, settle, studio
from yardstick import Beside, computing_and_painting

from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input, View
from skinsource.design.effects.level import Envelope
from skinsource.design.waveforms.samples import Drawn
from skinsource.design.waveforms.tones import Tone
from skinsource.limbs.catalog import default_limb
from skinsource.specs.samples import Samples
from skinsource_gui.app.app import manage_garbage_collection
from skinsource_gui.panels.clip_editor.view import EditorView
from skinsource_gui.panels.timeline.lanes import LanesView
from skinsource_gui.shell.window import MainWindow

RATE_HZ, STEPS, POINTS = 1300.0, 60, 150
HAND_HZ, FREE_STEPS = 60.0, 180
#: Frames per second.
PROMISED_DRAWING, PROMISED_ENVELOPE = 30.0, 60.0
_ALT = Qt.KeyboardModifier.AltModifier
_ALL = QEventLoop.ProcessEventsFlag.AllEvents
Place = Callable[[float], QPointF]


def scene() -> Design:
    """Silence to draw on, a tone below an envelope, and two more tones, of 1 s each."""
    blank = Drawn(Samples(values=np.zeros(round(RATE_HZ)), sample_rate_hz=RATE_HZ))
    times = np.linspace(0.0, 1.0, POINTS)
    points = tuple((float(t), 0.6 + 0.3 * float(np.sin(20 * t)), "straight") for t in times)
    clips = (
        Clip(waveform=blank),
        Clip(waveform=Tone(150.0, 0.0, 1.0), effects=(Envelope(points=points),)),
        Clip(waveform=Tone(90.0, 0.0, 1.0)),
        Clip(waveform=Tone(220.0, 0.0, 1.0)),
    )
    tracks = (Input(location=2 + 3 * k, colour=k, clips=(clip,)) for k, clip in enumerate(clips))
    return Design(limb=default_limb(), inputs=tuple(tracks))


class PaintCounter(QObject):
    """Counts the moves that a widget was painted after, once each."""

    def __init__(self) -> None:
        super().__init__()
        self.moves, self.waiting = 0, False

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Note the first painting after a move."""
        if event.type() == QEvent.Type.Paint and self.waiting:
            self.moves, self.waiting = self.moves + 1, False
        return super().eventFilter(watched, event)


class Hand:
    """Moves the mouse over a widget of a window, and counts what that costs."""

    def __init__(self, window: MainWindow, widget: QWidget) -> None:
        self._window, self._widget = window, widget

    def _follow(self) -> None:
        self._window.catch_up()
        QApplication.processEvents()

    def drag(self, place: Place, held: Qt.KeyboardModifier) -> tuple[float, float]:
        """Go along places from 0 to 1; frames per second, by processor time and by the clock."""
        send_mouse(self._widget, PRESS, place(0.0), held)
        self._follow()
        processor_s, clock_s = [], []
        for step in range(1, STEPS + 1):
            began = process_time(), perf_counter()
            send_mouse(self._widget, MOVE, place(step / STEPS), held)
            self._follow()
            processor_s.append(process_time() - began[0])
            clock_s.append(perf_counter() - began[1])
        send_mouse(self._widget, RELEASE, place(1.0), held)
        self._follow()
        return 1 / median(processor_s), 1 / median(clock_s)

    def drag_freely(self, place: Place) -> tuple[float, float]:
        """Move sixty times a second; how often it was painted, and results with it, per second."""
        painted, delivered = PaintCounter(), []
        note = self._window.conductor.delivered.connect(delivered.append)
        send_mouse(self._widget, PRESS, place(0.0))
        self._follow()
        self._widget.installEventFilter(painted)
        delivered.clear()
        began = perf_counter()
        for step in range(1, FREE_STEPS + 1):
            painted.waiting = True
            send_mouse(self._widget, MOVE, place(step / FREE_STEPS))
            QApplication.processEvents()
            while perf_counter() < began + step / HAND_HZ:
                QApplication.processEvents(_ALL, 1)
        seconds = perf_counter() - began
        self._widget.removeEventFilter(painted)
        self._window.conductor.delivered.disconnect(note)
        send_mouse(self._widget, RELEASE, place(1.0))
        self._follow()
        return painted.moves / seconds, len(delivered) / seconds


def main() -> int:
    """Measure, and tell whether the promises are kept."""
    with studio(scene(), View(outputs=(29, 30, 33, 35, 52)), (1920, 1080)) as window:
        window.do("arrange_design")
        manage_garbage_collection(window)
        in_sight(window, "clip_editor")
        visible = [panel.name for panel in window.panels if panel.isVisible()]
        print("visible:", ", ".join(visible))
        beside = Beside(computing_and_painting, "a fixed piece of work", process_time)
        for _ in range(STEPS):
            beside.once()
        print(f"{beside.label} took {1e3 * beside.median_s:.1f} ms of processor time")
        holds = [pen(window), clip(window), envelope(window)]
    return 0 if all(holds) else 1


def pen(window: MainWindow) -> bool:
    """Draw a swinging line with the pen."""
    editor = edited(window, 1, "pen")

    def place(share: float) -> QPointF:
        return editor.content.at(0.1 + 0.8 * share, 0.7 * float(np.sin(40 * share)))

    return report("pen", Hand(window, editor.viewport()).drag(place, _ALT), PROMISED_DRAWING)


def clip(window: MainWindow) -> bool:
    """Drag a clip on its lane."""
    in_sight(window, "timeline")
    lanes = window.findChild(LanesView, "lanes")
    box = next(box for box in lanes.content.boxes if box.clip.id == 3)
    start = box.rect.center()

    def place(share: float) -> QPointF:
        return start + QPointF(6 + 40 * share, 0)

    before = window.document.design.clip(3)
    drag = Hand(window, lanes.viewport()).drag(place, _ALT)
    moved = window.document.design.clip(3).onset_s > before.onset_s
    return report("clip", drag, PROMISED_DRAWING) and moved


def envelope(window: MainWindow) -> bool:
    """Drag a point in the middle of an envelope up and down."""
    editor = edited(window, 2, "envelope")
    effect = window.document.design.clip(2).effects[0]
    time_s, value, _ = effect.points[POINTS // 2]

    def place(share: float) -> QPointF:
        return editor.content.at(time_s, value + 0.3 * float(np.sin(6 * share)))

    hand = Hand(window, editor.viewport())
    drag = hand.drag(place, BARE)
    moved = window.document.design.clip(2).effects[0] != effect
    holds = report(f"envelope of {POINTS} points", drag, PROMISED_ENVELOPE)
    shown, followed = hand.drag_freely(place)
    print(f"moved {HAND_HZ:g} times a second: {shown:.1f} painted, {followed:.1f} computed")
    return holds and moved


def in_sight(window: MainWindow, name: str) -> None:
    """Bring a panel before the others of its place."""
    window.docks[name].bring_forward()
    settle(window)


def edited(window: MainWindow, clip_id: int, tool: str) -> EditorView:
    """The canvas of the editor, with a clip and a tool."""
    in_sight(window, "clip_editor")
    document = window.document
    track = document.design.track_of(clip_id)
    document.look(View(outputs=document.view.outputs, selected_inputs=(track.id,)))
    panel = window.panel("clip_editor")
    panel.use(tool)
    settle(window)
    return panel.findChild(EditorView)


def report(label: str, frames: tuple[float, float], promised: float) -> bool:
    """Print frames per second; whether the promise is kept."""
    processor, clock = frames
    holds = processor >= promised
    print(
        f"{label}: {processor:.0f} frames per second of processor time, {clock:.0f} by the clock, "
        f"promised {promised:g}: {'kept' if holds else 'BROKEN'}"
    )
    return holds


if __name__ == "__main__":
    sys.exit(main())
