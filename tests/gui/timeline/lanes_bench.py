"""A timeline with clips, and what the mouse does on it."""

from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest

from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input
from skinsource.design.waveforms.pulses import Tap
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.panels.timeline.lanes import LanesView
from tests.gui.timeline.bench import Bench, results_of

LEFT, NONE = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier


def clips_design():
    """Two tracks: three clips on the first, one on the second."""
    tone = Tone(100.0, 0.0, 0.2)
    first = (
        Clip(onset_s=0.0, waveform=tone),
        Clip(onset_s=0.3, waveform=tone),
        Clip(onset_s=0.7, waveform=Tap()),
    )
    return Design(
        limb="synthetic-1",
        inputs=(
            Input(location=7, clips=first),
            Input(location=3, clips=(Clip(onset_s=0.1, waveform=tone),)),
        ),
    )


class LanesBench(Bench):
    """A panel of two tracks, clips 1 to 3 and 4."""

    def __init__(self, qtbot):
        super().__init__(qtbot, clips_design())
        self.panel.resize(1000, 260)
        self.panel.show_results(results_of(self.design))
        self.lanes.setFocus()

    @property
    def lanes(self):
        return self.panel.findChild(LanesView, "lanes")

    @property
    def content(self):
        return self.lanes.content

    def box(self, clip):
        return next(box.rect for box in self.content.boxes if box.clip.id == clip)

    def onset(self, clip):
        return self.design.clip(clip).onset_s

    def at(self, time_s, lane=0):
        """A place in the middle of a lane."""
        lane_box = self.content.lanes[lane]
        return QPointF(self.content.scale.x(time_s), (lane_box.top_px + lane_box.bottom_px) / 2)

    def drag(self, start, end, held=NONE, *, release=True, steps=3):
        """Press, move in some steps, and let go."""
        view = self.lanes.viewport()
        QTest.mousePress(view, LEFT, held, _point(start))
        for step in range(1, steps + 1):
            between = start + (end - start) * (step / steps)
            self.lanes.mouse.move(QPointF(_point(between)), held)
        if release:
            QTest.mouseRelease(view, LEFT, held, _point(end))

    def click(self, at, held=NONE):
        QTest.mouseClick(self.lanes.viewport(), LEFT, held, _point(at))


def _point(at):
    return QPoint(round(at.x()), round(at.y()))
