"""A timeline without a studio, and what mouse and keys do on it."""

from dataclasses import replace
from functools import partial

from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from skinsource import Clip, Design, Input, View, track
from skinsource.design.waveforms import Tap, Tone
from skinsource_gui.panels.timeline.heads import Heads
from skinsource_gui.panels.timeline.panel import TimelinePanel
from tests.gui.menus import lines_of
from tests.gui.panel_host import PanelHost, clip_results

LEFT, NONE = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
HELD = Qt.KeyboardModifier
CONTROL, SHIFT, ALT = HELD.ControlModifier, HELD.ShiftModifier, HELD.AltModifier
TONE = Tone(100.0, 0.0, 0.2)
PLACES = (7, 2, 15)


class Bench(PanelHost):
    """The timeline, whose heads have the keyboard."""

    def __init__(self, qtbot, design):
        super().__init__(TimelinePanel(), design, View(selected_inputs=(1,)))
        self.panel.playhead_requested.connect(self._put_playhead)
        self.appear(qtbot, 760, 300)
        self.activate(qtbot)
        self.rows.setFocus()
        qtbot.waitUntil(self.rows.hasFocus)

    @property
    def rows(self):
        return self.panel.findChild(Heads, "input_rows")

    def head(self, index):
        """What is said and shown of a head."""
        return self.rows.model().index(index)

    def place(self, index, part="swatch"):
        """The middle of a part of a head."""
        return getattr(self.rows.places(index), part).center().toPoint()

    def press(self, index, part="swatch", held=NONE):
        QTest.mouseClick(self.rows.viewport(), LEFT, held, self.place(index, part))

    @property
    def content(self):
        return self.panel.lanes.content

    @property
    def places(self):
        return [track.location for track in self.design.inputs]

    def key(self, key, modifiers=NONE):
        QTest.keyClick(QApplication.focusWidget(), key, modifiers)

    def _put_playhead(self, time_s):
        self.view = replace(self.view, playhead_s=time_s)
        self.panel.show_playhead(self.view)


def design_of(*places, **changes):
    design = Design(limb="synthetic-1")
    for place in places:
        design = design.adding(track(location=place, **changes))
    return design


CLIPS = (
    Clip(onset_s=0.0, waveform=TONE),
    Clip(onset_s=0.3, waveform=TONE),
    Clip(onset_s=0.7, waveform=Tap()),
)
#: Clips 1 to 3 on the first track, 4 on the second.
TWO_TRACKS = Design(
    limb="synthetic-1",
    inputs=(
        Input(location=7, clips=CLIPS),
        Input(location=3, clips=(Clip(onset_s=0.1, waveform=TONE),)),
    ),
)


class LanesBench(Bench):
    """A panel of two tracks with clips; edges snap only where a test lets them."""

    def __init__(self, qtbot, design=TWO_TRACKS):
        super().__init__(qtbot, design)
        self.panel.resize(1000, 260)
        self.panel.show_results(clip_results(self.design))
        self.lanes.setFocus()
        self.lanes.change(snaps=False)

    @property
    def lanes(self):
        return self.panel.lanes

    def box(self, clip):
        return next(box.rect for box in self.content.boxes if box.clip.id == clip)

    def middle(self, clip):
        return self.box(clip).center()

    def onset(self, clip):
        return self.design.clip(clip).onset_s

    def px(self, seconds):
        return QPointF(self.content.scale.px_per_s * seconds, 0)

    def at(self, time_s, lane=0):
        """A place in the middle of a lane."""
        lane_box = self.content.lanes[lane]
        return QPointF(self.content.scale.x(time_s), (lane_box.top_px + lane_box.bottom_px) / 2)

    def on_ruler(self, time_s, y=18):
        """A place on the lower half of the ruler; loop and markers are on the upper one."""
        return QPointF(self.content.scale.x(time_s), y)

    def drag(self, start, end, held=NONE, *, release=True, steps=3):
        """Press, move in some steps, and let go."""
        view = self.lanes.viewport()
        QTest.mousePress(view, LEFT, held, start.toPoint())
        for step in range(1, steps + 1):
            between = start + (end - start) * (step / steps)
            self.lanes.mouse.move(QPointF(between.toPoint()), held)
        if release:
            QTest.mouseRelease(view, LEFT, held, end.toPoint())

    def menu_at(self, place):
        """The lines of the menu of a place, by their words."""
        show = partial(self.lanes.menu.open, QPoint(0, 0), place)
        return lines_of(self.panel, "lanes_menu", show)

    def click(self, at, held=NONE):
        QTest.mouseClick(self.lanes.viewport(), LEFT, held, at.toPoint())

    def double_click(self, at):
        QTest.mouseDClick(self.lanes.viewport(), LEFT, pos=at.toPoint())
