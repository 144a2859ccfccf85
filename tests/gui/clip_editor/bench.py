"""The editor of a clip, without a studio."""

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from skinsource import Clip, Design, Input
from skinsource_gui.panels.clip_editor.panel import ClipEditorPanel
from tests.gui.panel_host import PanelHost, clip_results

LEFT, RIGHT = Qt.MouseButton.LeftButton, Qt.MouseButton.RightButton
NONE, SHIFT, ALT = (
    Qt.KeyboardModifier.NoModifier,
    Qt.KeyboardModifier.ShiftModifier,
    Qt.KeyboardModifier.AltModifier,
)
RATE_HZ = 1300.0


class Bench(PanelHost):
    """The editor with one clip, and what that plays."""

    def __init__(self, qtbot, waveform):
        inputs = (Input(location=7, clips=(Clip(waveform=waveform),)),)
        super().__init__(ClipEditorPanel(), Design(limb="synthetic-1", inputs=inputs))
        self.appear(qtbot, 700, 420)

    @property
    def clip(self):
        return self.design.inputs[0].clips[0]

    @property
    def canvas(self):
        return self.panel._canvas

    @property
    def drawn(self):
        return self.clip.waveform.samples(RATE_HZ)

    def show(self, design=None, **looking):
        super().show(design, **looking)
        self.panel.show_results(clip_results(self.design))

    def at(self, time_s, value):
        return self.canvas.content.at(time_s, value)

    def drag(self, *places, **more):
        self.drag_px(*(self.at(*place) for place in places), **more)

    def drag_px(self, *points, button=LEFT, held=NONE, release=True):
        self.press(points[0], button, held)
        for point in points[1:]:
            self.canvas.tool.move(self.canvas.content, point, held)
        if release:
            QTest.mouseRelease(self.canvas.viewport(), button, held, points[-1].toPoint())

    def press(self, at, button=LEFT, held=NONE):
        QTest.mousePress(self.canvas.viewport(), button, held, at.toPoint())

    def key(self, key, held=NONE):
        QTest.keyClick(self.canvas, key, held)
