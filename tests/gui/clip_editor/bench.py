"""The editor of a clip, without a studio."""

from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input
from skinsource.design.edits.edit import Refusal
from skinsource.design.view import View
from skinsource_gui.panels.clip_editor.panel import ClipEditorPanel

LEFT, RIGHT = Qt.MouseButton.LeftButton, Qt.MouseButton.RightButton
NONE, SHIFT, ALT = (
    Qt.KeyboardModifier.NoModifier,
    Qt.KeyboardModifier.ShiftModifier,
    Qt.KeyboardModifier.AltModifier,
)
RATE_HZ = 1300.0


class Bench:
    """The panel with one clip, and the little of a document that it needs."""

    def __init__(self, qtbot, waveform):
        self.panel = ClipEditorPanel()
        qtbot.addWidget(self.panel)
        self.design = Design(
            limb="synthetic-1", inputs=(Input(location=7, clips=(Clip(waveform=waveform),)),)
        )
        self.view, self.steps, self.refusals = View(), [], []
        self.panel.edited.connect(self._edit)
        self.panel.resize(700, 420)
        self.panel.show()
        qtbot.waitExposed(self.panel)
        self.show()

    @property
    def clip(self):
        return self.design.inputs[0].clips[0]

    @property
    def canvas(self):
        return self.panel._canvas

    @property
    def drawn(self):
        return self.clip.waveform.samples(RATE_HZ)

    def show(self):
        self.panel.show_state(self.design, self.view)
        played = tuple(
            tuple(clip.waveform.samples(RATE_HZ) for clip in track.clips)
            for track in self.design.inputs
        )
        self.panel.show_results(
            {"inputs": self.design.inputs, "clip_waveforms": played, "sample_rate_hz": RATE_HZ}
        )

    def at(self, time_s, value):
        return self.canvas.content.at(time_s, value)

    def drag(self, *places, **more):
        self.drag_px(*(self.at(*place) for place in places), **more)

    def drag_px(self, *points, button=LEFT, held=NONE, release=True):
        self.press(points[0], button, held)
        for point in points[1:]:
            self.canvas.tool.move(self.canvas.content, point, held)
        if release:
            QTest.mouseRelease(self.canvas.viewport(), button, held, whole(points[-1]))

    def press(self, at, button=LEFT, held=NONE):
        QTest.mousePress(self.canvas.viewport(), button, held, whole(at))

    def key(self, key, held=NONE):
        QTest.keyClick(self.canvas, key, held)

    def _edit(self, outcome, gesture):
        if isinstance(outcome, Refusal):
            self.refusals.append(outcome.sentence)
            return
        self.steps.append(gesture)
        self.design, self.view = outcome.design, outcome.view
        self.show()


def whole(at):
    return QPoint(round(at.x()), round(at.y()))
