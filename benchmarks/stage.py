"""What a frame of the stage costs, of one map and of several that move together.

    python benchmarks/stage.py

Prints processor time a frame at 1920x1080, and how many times that of one map it is; four people,
four frequencies and six maps should stay below 4.  Then it lets them move by themselves, and counts
the frames that were painted later than in their slot, or never: fewer than 1 % on two quiet cores.
"""

import time
from collections.abc import Callable, Sequence

import numpy as np
from PySide6.QtCore import QEvent, QEventLoop, QObject, QTimer
from PySide6.QtWidgets import QApplication, QWidget
from studio import studio

import skinsource as ss
from skinsource.design.panel_settings import StageSettings, with_settings
from skinsource_gui.panels.compare.settings import CompareSettings

FRAMES, FRAME_S = 60, 1 / 24
MOVES_S = 5.0
OTHERS_HZ = (50.0, 150.0, 200.0, 300.0, 400.0)
CASES = {
    "one map": None,
    "four people": CompareSettings(of="limbs"),
    "four frequencies": CompareSettings(of="frequencies"),
    "six maps": CompareSettings(
        of="frequencies", frequencies_hz=(50.0, 150.0, 200.0, 300.0, 400.0)
    ),
}


class Paints(QObject):
    """Notes when a widget was painted, s."""

    def __init__(self, widget: QWidget) -> None:
        super().__init__(widget)
        self.at_s: list[float] = []
        widget.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Note the end of a paint."""
        if event.type() == QEvent.Type.Paint:
            # Comes once it is painted.
            QTimer.singleShot(0, lambda: self.at_s.append(time.monotonic()))
        return super().eventFilter(watched, event)


def wait(seconds: float, busy: Callable[[], bool] = bool) -> None:
    """Let the window run for a time, and while it is busy."""
    end_s = time.monotonic() + seconds
    while time.monotonic() < end_s or busy():
        QApplication.processEvents(QEventLoop.ProcessEventsFlag.AllEvents, 20)
        time.sleep(1e-3)


def dropped(painted_s: Sequence[float]) -> float:
    """Return the share of slots in which nothing was painted."""
    slots = np.round(np.diff(painted_s) / FRAME_S)
    return float(np.maximum(slots - 1.0, 0.0).sum() / slots.sum())


def main() -> None:
    """Measure each case."""
    tone = ss.track(7, ss.waveforms.Tone(frequency_hz=100.0))
    design = ss.Design(limb="synthetic-1", inputs=(tone,), title="A tone")
    with studio(design, limbs=("synthetic-1",)) as window:
        # Nothing is computed before it was painted once.
        wait(0.5)
        window.do("present")
        window.showNormal()
        window.resize(1920, 1080)
        stage, one_s = window.panel("stage"), 0.0
        paints = Paints(stage.maps)
        for name, compared in CASES.items():
            view = with_settings(
                window.document.view, "stage", StageSettings(compared=compared is not None)
            )
            window.document.look(with_settings(view, "compare", compared or CompareSettings()))
            wait(1.0, lambda: window.engine.busy)
            stage.clock.run(False, 1 / FRAME_S)
            began_s = time.process_time()
            for _ in range(FRAMES):
                stage.clock.ticked.emit(FRAME_S)
                QApplication.processEvents()
            frame_s = (time.process_time() - began_s) / FRAMES
            one_s = one_s or frame_s
            maps = len(stage.maps.content.cells)
            paints.at_s.clear()
            stage.clock.run(True, 1 / FRAME_S)
            wait(MOVES_S)
            print(
                f"{name:18} {maps} maps {1e3 * frame_s:6.1f} ms {frame_s / one_s:5.2f} x; "
                f"{len(paints.at_s)} frames in {MOVES_S:g} s, {dropped(paints.at_s):.1%} dropped"
            )


if __name__ == "__main__":
    main()
