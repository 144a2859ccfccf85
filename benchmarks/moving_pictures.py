"""Ten seconds of a drag and of the moving wave, for the README: of a synthetic limb.

python benchmarks/moving_pictures.py     (writes docs/drag.webp and docs/wave.webp; look at them)
"""

import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
from PIL import Image
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPolygonF
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from studio import MOVE, PRESS, RELEASE, send_mouse, studio

from skinsource.design.design import Design, View, track
from skinsource.design.panel_settings import with_settings
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.panels.skin.settings import SkinSettings, Z
from skinsource_gui.shell.window import MainWindow

FOLDER = Path("docs")
SIZE, LASTS_S, PER_S = (1100, 660), 10.0, 10
DESIGN = Design(
    limb="synthetic-1",
    inputs=(track(location=7, waveform=Tone(frequency_hz=100.0, duration_s=0.2)),),
    title="A tone",
)
VIEW = View(outputs=(29, 33, 52), axes="z", selected_inputs=(1,), delay_removed=True)
#: Where the mouse is, in pixels from where it was pressed, by the share of the time.
DRAG = ((0.0, 0.05, 0.4, 0.55, 0.95, 1.0), (0, 0, 190, 190, -45, -45))
#: When Space is pressed, as a share of the time, and how slowly the wave runs.
BEGIN, SLOW_MOTION = 0.05, 50.0
LIMITS = (-0.2, 0.2)
POINTER = ((0, 0), (0, 17), (4, 13), (7, 20), (10, 19), (7, 12), (12, 12))


class Mouse:
    """Presses, moves and releases the left button on a field."""

    def __init__(self, field: NumberField) -> None:
        self.field, self.at = field, field.rect().center() + QPoint(20, 0)
        self._begun = self.at

    def send(self, kind: QEvent.Type) -> None:
        """Send an event where the mouse is."""
        send_mouse(self.field, kind, self.at)

    def move(self, away_px: float) -> None:
        """Move to so many pixels right of where it was pressed."""
        self.at = self._begun + QPoint(round(away_px), 0)
        self.send(MOVE)


def frame_of(window: MainWindow, pointer: QPoint | None) -> Image.Image:
    """Return what the window shows, with the pointer of the mouse, if there is one."""
    image = window.grab().toImage().convertToFormat(QImage.Format.Format_RGB888)
    if pointer is not None:
        painter = QPainter(image)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QColor("white"))
        painter.setBrush(QColor("black"))
        painter.drawPolygon(QPolygonF([QPointF(pointer + QPoint(*at)) for at in POINTER]))
        painter.end()
    row = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), -1)
    return Image.fromarray(row[:, : 3 * image.width()].reshape(image.height(), -1, 3).copy())


def filmed(window: MainWindow, act: Callable[[float], QPoint | None]) -> list[Image.Image]:
    """Return frames of the window; ``act`` takes the share of the time, and returns the pointer."""
    frames: list[Image.Image] = []
    begun_s = time.monotonic()
    for k in range(round(LASTS_S * PER_S)):
        pointer = act(k / (LASTS_S * PER_S))
        while time.monotonic() < begun_s + k / PER_S or window.engine.busy:
            QApplication.processEvents()
            time.sleep(1e-3)
        window.catch_up()
        frames.append(frame_of(window, pointer))
    return frames


def main() -> int:
    """Write both."""
    with studio(DESIGN, VIEW, SIZE, theme="light", limbs=("synthetic-1",)) as window:
        window.activateWindow()
        # Conditions are judged a moment later.
        QTest.qWait(2000)
        field = window.panel("inspector").findChild(NumberField, "frequency_hz_field")
        mouse = Mouse(field)

        def drag(share: float) -> QPoint:
            if share == 0.0:
                mouse.send(PRESS)
            mouse.move(float(np.interp(share, *DRAG)))
            return field.mapTo(window, mouse.at)

        write("drag", filmed(window, drag))
        mouse.send(RELEASE)
        window.document.edit("A tone", DESIGN)
        moving = with_settings(VIEW, "skin", SkinSettings(quantity=Z, z_limits=LIMITS))
        window.document.look(replace(moving, slow_motion=SLOW_MOTION))
        window.panel("timeline").setFocus()
        QTest.qWait(1000)

        def play(share: float) -> None:
            if share == BEGIN:
                QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_Space)

        write("wave", filmed(window, play))
    return 0


def write(name: str, frames: list[Image.Image]) -> None:
    """Write an animation."""
    path = FOLDER / f"{name}.webp"
    frames[0].save(
        path,
        save_all=True,
        append_images=frames[1:],
        duration=round(1e3 / PER_S),
        loop=0,
        quality=45,
        method=4,
        allow_mixed=True,
    )
    print(path, f"{path.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    sys.exit(main())
