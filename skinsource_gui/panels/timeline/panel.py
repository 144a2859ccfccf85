"""Tracks and their clips over time."""

from collections.abc import Mapping
from typing import Any

from PySide6.QtCore import QPoint, QPointF, QRectF, QSize, Qt
from PySide6.QtWidgets import QLabel, QStackedLayout, QVBoxLayout, QWidget

from skinsource.base.arrays import Floats
from skinsource.design.clips import Clip
from skinsource.design.design import Design
from skinsource.design.signal_path import UnplayableInput
from skinsource.design.view import View
from skinsource_gui.panel import Panel
from skinsource_gui.panels.timeline.gestures.gesture import Shown
from skinsource_gui.panels.timeline.heads.heads import Heads
from skinsource_gui.panels.timeline.heads.row_places import heads_px, row_places
from skinsource_gui.panels.timeline.lanes_menu import LanesMenu
from skinsource_gui.panels.timeline.timeline_edits import TimelineEdits
from skinsource_gui.panels.timeline.track_table import TrackTable
from skinsource_gui.theme import UNIT_PX, set_tone
from skinsource_gui.widgets.drop_place import DropPlace
from skinsource_gui.widgets.empty_words import add_words
from skinsource_gui.widgets.inputs.clip_waveforms import waveforms_of

_LEAST_LANES_PX, _BARS_PX = 140, 12


class TimelinePanel(Panel):
    """A head for each track, its clips on one ruler, and a playhead."""

    title = "Timeline"
    name = "timeline"

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._clips, self._heads = TimelineEdits(self), Heads(self)
        # What each clip plays, and the clips as they were then, by their ids.
        self._then: Mapping[int, Clip] = {}
        self._waveforms: Mapping[int, Floats] = {}
        self._design, self._view = Design(limb=""), View()
        self._list = self._heads.list
        self._rows = self._list.rows
        self._table = TrackTable(self._list)
        self._empty = QLabel(add_words(self.in_sight, "a track"))
        self._empty.setObjectName("inputs_empty")
        set_tone(self._empty, "dim")
        self._empty.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._empty.setWordWrap(True)
        self._foot = QLabel()
        self._foot.setObjectName("inputs_problem")
        set_tone(self._foot, "error")
        self._foot.setWordWrap(True)
        self._foot.setMargin(UNIT_PX)
        self._foot.hide()
        self._stack = QStackedLayout()
        self._stack.addWidget(self._empty)
        self._stack.addWidget(self._table)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addLayout(self._stack, 1)
        column.addWidget(self._foot)
        self.setFocusProxy(self._rows)
        self._connect()

    def minimumSizeHint(self) -> QSize:
        # One track is seen whole, below its ruler, and some of its time.
        line = self.fontMetrics().height()
        width, ruler = heads_px(line), self._table.lanes.ruler_px
        row = row_places(width, line).row.height()
        least = QSize(width + _LEAST_LANES_PX, round(ruler) + row + _BARS_PX)
        return super().minimumSizeHint().expandedTo(least)

    @property
    def needs(self) -> frozenset[str]:
        """What each clip plays."""
        return frozenset({"clip_waveforms", "inputs", "sample_rate_hz"})

    def show_state(self, design: Design, view: View) -> None:
        self._design, self._view = design, view
        self._heads.show_state(design, view)
        self._clips.show_state(design, view)
        self._stack.setCurrentIndex(1 if design.inputs else 0)
        self._table.show_state(design, view)
        if self.late:
            self.show_late(True)

    def show_in_sight(self, names: frozenset[str]) -> None:
        super().show_in_sight(names)
        self._empty.setText(add_words(names, "a track"))

    def show_playhead(self, view: View) -> None:
        self._view = view
        self._clips.show_state(self._design, view)
        self._table.show_playhead(view)

    def show_results(self, results: Mapping[str, Any]) -> None:
        self._show_foot("")
        self._table.lanes.sample_rate_hz = results["sample_rate_hz"]
        clips = (clip for one in results["inputs"] for clip in one.clips)
        self._then = {clip.id: clip for clip in clips}
        self._waveforms = waveforms_of(results)
        self.show_late(self.late)

    def show_unplayable(self, unplayable: tuple[UnplayableInput, ...]) -> None:
        self._table.show_problems({one.id: one.problem for one in unplayable})

    def show_late(self, late: bool) -> None:
        # What a clip that plays something else now played would be drawn as long as that.
        shown, awaited = self._waveforms, frozenset[int]()
        if late:
            clips = [clip for track in self._design.inputs for clip in track.clips]
            awaited = frozenset(
                clip.id
                for clip in clips
                if clip.id not in self._then or not _play_alike(clip, self._then[clip.id])
            )
            shown = {clip: played for clip, played in shown.items() if clip not in awaited}
        self._table.lanes.show_waveforms(shown, awaited)

    def show_problem(self, reason: str) -> None:
        self._then, self._waveforms = {}, {}
        self.show_late(self.late)
        self._show_foot(reason)

    def drop_place(self, at: QPoint) -> DropPlace | None:
        lanes = self._table.lanes
        place = QPointF(lanes.mapFrom(self, at))
        lane = lanes.content.lane_at(place.y())
        if lane is None or not self._table.isVisible():
            return None
        # Over a head there is no time.
        onset_s = lanes.mouse.time_at(place) if place.x() >= 0.0 else 0.0
        return DropPlace(input_id=lane.track.id, onset_s=onset_s)

    def show_drop(self, at: QPoint | None) -> None:
        place, lanes = (None if at is None else self.drop_place(at)), self._table.lanes
        shown = Shown() if place is None else Shown(guide_s=place.onset_s, words="A clip here")
        lanes.over.show_over(shown, QPointF(lanes.mapFrom(self, at or QPoint())))

    def _connect(self) -> None:
        lanes, clips, toolbar = self._table.lanes, self._clips, self._table.toolbar
        self._heads.edited.connect(self.edited)
        clips.edited.connect(self.edited)
        for part in (lanes.mouse, lanes.keys):
            part.edited.connect(self.edited)
            part.playhead_wanted.connect(self.playhead_wanted)
            part.clip_wanted.connect(clips.add)
            part.marker_wanted.connect(clips.add_marker)
            part.opened.connect(self._open)
        lanes.mouse.elsewhere = self._elsewhere
        lanes.gain.edited.connect(self.edited)
        lanes.looked.connect(self._look)
        menu = LanesMenu(lambda: lanes.content, clips, lanes.gain, lanes)
        menu.edited.connect(self.edited)
        menu.looked.connect(self._look)
        menu.opened.connect(self._open)
        lanes.menu_wanted.connect(menu.open)
        lanes.keys.copied.connect(clips.copy)
        lanes.keys.cut.connect(clips.cut)
        lanes.keys.pasted.connect(clips.paste)
        lanes.keys.zoomed.connect(lanes.seen.zoom)
        lanes.keys.everything_wanted.connect(lanes.seen.show_everything)
        toolbar.snaps_wanted.connect(lanes.set_snaps)
        toolbar.zoom_wanted.connect(lanes.seen.zoom)
        toolbar.everything_wanted.connect(lanes.seen.show_everything)

    def _look(self, view: View) -> None:
        if view != self._view:
            self.view_changed.emit(view)

    def _elsewhere(self, at: QPointF | None) -> DropPlace | None:
        lanes = self._table.lanes
        # What is held over the lanes themselves goes to one of them.
        if at is None or QRectF(lanes.rect()).contains(at):
            return self.held_over(None)
        return self.held_over(lanes.mapToGlobal(at).toPoint())

    def _open(self, clip: int) -> None:
        self.action_wanted.emit("show_clip_editor")

    def _show_foot(self, words: str) -> None:
        self._foot.setText(words)
        self._foot.setVisible(bool(words))


def _play_alike(one: Clip, other: Clip) -> bool:
    """Whether two clips sound alike, apart from when and how loud."""
    return one.waveform == other.waveform and one.effects == other.effects
