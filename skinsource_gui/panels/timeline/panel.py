"""The panel of tracks and their clips over time, with clipboard, menu, toolbar and scroll bars."""

from collections.abc import Mapping
from functools import partial
from typing import Any

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, QSignalBlocker, QSize, Qt, Signal

from skinsource.base.conventions import SAMPLE_RATE_HZ, Floats
from skinsource.design import edits
from skinsource.design.design import Design, Input, View, audible_inputs
from skinsource.design.edits.inputs import add_track
from skinsource.design.signal_path import UnplayableInput
from skinsource.design.waveform import Waveform
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.samples import Drawn
from skinsource.design.waveforms.tones import Chirp, Tone
from skinsource.design.waveforms.wavelet_train import WaveletTrain
from skinsource.specs.samples import Samples
from skinsource_gui.fields.inputs import played_of, waveforms_of
from skinsource_gui.panels.timeline.content import Lane
from skinsource_gui.panels.timeline.gestures import GesturePreview
from skinsource_gui.panels.timeline.heads import Heads, heads_px, row_px
from skinsource_gui.panels.timeline.lanes import ZOOM, LanesView
from skinsource_gui.plots.time_scale import Range
from skinsource_gui.qt.buttons import FirstLetters, page_label, show_or_hide, tool_button
from skinsource_gui.qt.frames import DropPlace
from skinsource_gui.qt.keys import KEYS
from skinsource_gui.qt.labels import how_to_add
from skinsource_gui.qt.layouts import in_column, in_row, named
from skinsource_gui.qt.theme import UNIT_PX, set_tone
from skinsource_gui.state.panel import PREPARING, Panel

# Long designs count past what the bar can hold in smaller steps.
_STEPS_PER_S = 100_000


class TimeBar(QtWidgets.QScrollBar):
    """A scroll bar over the time; it is hidden while all of the time is shown."""

    #: The part to see.
    range_requested = Signal(object)

    def __init__(self) -> None:
        super().__init__(Qt.Orientation.Horizontal)
        named(self, "time_bar", "Time shown")
        self.valueChanged.connect(self._emit)
        self.hide()

    def show_range(self, shown_s: Range, whole_s: Range) -> None:
        """Show a part of the whole."""
        length = round((shown_s[1] - shown_s[0]) * _STEPS_PER_S)
        whole = round((whole_s[1] - whole_s[0]) * _STEPS_PER_S)
        with QSignalBlocker(self):
            self.setRange(0, max(whole - length, 0))
            self.setPageStep(max(length, 1))
            self.setSingleStep(max(length // 10, 1))
            self.setValue(round((shown_s[0] - whole_s[0]) * _STEPS_PER_S))
        self.setVisible(whole > length)

    def _emit(self, value: int) -> None:
        self.range_requested.emit((value / _STEPS_PER_S, (value + self.pageStep()) / _STEPS_PER_S))


#: What "+ Add" offers.
ADDED: tuple[type[Waveform], ...] = (Tone, WaveletTrain, Tap, Chirp, Noise)


class TimelineToolbar(QtWidgets.QWidget):
    """Buttons that add and draw clips, and for snapping and zoom.

    Attributes
    ----------
    add
        Opens a menu of what can be added.
    snap, everything
        The buttons that let edges snap, and fit the content.
    """

    #: A kind of waveform, whose clip is to be added.
    add_requested = Signal(object)
    #: A clip is to be drawn: a new one, or the selected one.
    draw_requested = Signal(bool)
    file_requested = Signal()
    track_requested = Signal()
    zoom_requested = Signal(float)

    def __init__(self) -> None:
        super().__init__()
        self.setStyleSheet("QToolButton { padding: 1px 6px; }")
        self._row, keys = in_row(of=self, margins=(4, 1, 4, 1), gap_px=2), KEYS["timeline"].gestures
        self.add = self._button("add", "+ Add", "Add a clip at the playhead, or a track")
        self.add.setPopupMode(self.add.ToolButtonPopupMode.InstantPopup)
        menu = QtWidgets.QMenu(self.add)
        for kind in ADDED:
            menu.addAction(kind.title).triggered.connect(partial(self.add_requested.emit, kind))
        menu.addAction("Draw").triggered.connect(lambda: self.draw_requested.emit(True))
        menu.addAction("File…").triggered.connect(self.file_requested)
        menu.addSeparator()
        menu.addAction("Track").triggered.connect(self.track_requested)
        FirstLetters(menu)
        self.add.setMenu(menu)
        draw = self._button("draw", "Draw", "Draw the selected clip, or a new one")
        draw.clicked.connect(lambda: self.draw_requested.emit(False))
        self._row.addStretch(1)
        self.snap = self._button(
            "snap", "Snap", "Edges snap to the grid, clip ends and the playhead"
        )
        self.snap.setCheckable(True)
        self.snap.setChecked(True)
        wider = self._button("zoom_out", "\u2212", keys["zoom_out"].hint)
        wider.clicked.connect(lambda: self.zoom_requested.emit(1 / ZOOM))
        closer = self._button("zoom_in", "+", keys["zoom_in"].hint)
        closer.clicked.connect(lambda: self.zoom_requested.emit(ZOOM))
        self.everything = self._button("fit", "Fit", keys["whole"].hint)

    def _button(self, name: str, text: str, hint: str) -> QtWidgets.QToolButton:
        button = tool_button(self, f"timeline_{name}", text, hint, takes_keyboard=False)
        button.setAccessibleName(hint)
        self._row.addWidget(button)
        return button


def lanes_of(
    design: Design, view: View, row_px: float, top_px: float, problems: Mapping[int, str]
) -> tuple[Lane, ...]:
    """Return the lanes of a design, each as high as its head; the first begins at ``top_px``.

    ``problems``: why tracks cannot be played, by their ids.
    """
    audible_ids = {track.id for track in audible_inputs(design.inputs)}
    lanes = []
    for number, track in enumerate(design.inputs):
        audible = track.id in audible_ids
        # What is muted meanwhile has no problem any more.
        problem = problems.get(track.id, "") if audible else ""
        lanes.append(
            Lane(
                track=track,
                top_px=top_px + number * row_px,
                height_px=row_px,
                silent="cannot be played" if problem else _silence_reason(track, audible=audible),
                problem=problem,
                selected=track.id in view.selected_inputs,
            )
        )
    return tuple(lanes)


def _silence_reason(track: Input, *, audible: bool) -> str:
    if track.muted:
        return "muted"
    if not audible:
        return "another track is solo"
    return "" if track.clips else "no clips: double click to add one"


_LEAST_LANES_PX, _BARS_PX = 140, 12
_ROWS_PER_NOTCH = 3
# Length of a new clip that is to be drawn.
_DRAWN_S = 0.2


class TimelinePanel(Panel):
    """A head for each track, its clips on one ruler, and a playhead.

    Attributes
    ----------
    heads, lanes
        The heads, and the lanes beside them, which scroll at the same time.
    """

    title = "Timeline"
    name = "timeline"
    #: What each clip plays, and each track.
    needs = frozenset({"clip_waveforms", "input_waveforms", "inputs", "sample_rate_hz"})

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        # Samples of clips, and from which waveforms and effects they were computed, by their ids.
        self._computed_clips: Mapping[int, tuple[Any, ...]] = {}
        self._waveforms: Mapping[int, Floats] = {}
        # What each track plays before its amplitude, by its id.
        self._played: dict[int, Floats] = {}
        self._rate_hz = SAMPLE_RATE_HZ
        self._problems: Mapping[int, str] = {}
        self.heads, self.lanes = Heads(), LanesView()
        self._toolbar, self._time_bar = TimelineToolbar(), TimeBar()
        self._bar = QtWidgets.QScrollBar(Qt.Orientation.Vertical)
        self._bar.setAccessibleName("Tracks shown")
        self._corner = QtWidgets.QWidget()
        table = QtWidgets.QWidget()
        grid = QtWidgets.QGridLayout(table)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setSpacing(0)
        grid.addWidget(self._corner, 0, 0)
        grid.addWidget(self.heads, 1, 0)
        grid.addWidget(self.lanes, 0, 1, 2, 1)
        grid.addWidget(self._bar, 0, 2, 2, 1)
        grid.addWidget(self._time_bar, 2, 1)
        grid.setColumnStretch(1, 1)
        grid.setRowStretch(1, 1)
        hint = how_to_add("a track")
        self._empty = page_label("inputs_empty", hint, tone="dim", centred=True)
        self._foot = page_label("inputs_problem")
        self._foot.setMargin(UNIT_PX)
        self._foot.hide()
        self._stack = QtWidgets.QStackedLayout()
        self._stack.addWidget(self._empty)
        self._stack.addWidget(table)
        in_column(self._toolbar, (self._stack, 1), self._foot, of=self, margins=0, gap_px=0)
        self.setFocusProxy(self.lanes)
        self._connect()

    def minimumSizeHint(self) -> QSize:
        # Room for one whole track below the ruler, and for some of its time.
        row = row_px(self.fontMetrics().height())
        above = self._toolbar.sizeHint().height() + round(self.lanes.ruler_px)
        least = QSize(self._heads_px + _LEAST_LANES_PX, above + row + _BARS_PX)
        return super().minimumSizeHint().expandedTo(least)

    def show_state(self, design: Design, view: View) -> None:
        self._design, self._view = design, view
        self._show_heads()
        self._stack.setCurrentIndex(1 if design.inputs else 0)
        self._place_lanes()
        # Keys act on what is outlined, also when they come back from another window.
        if view.selected_clips and self.window().focusWidget() is self.heads:
            self.lanes.setFocus()
        if self.is_stale:
            self.show_staleness(True)

    def start_over(self) -> None:
        self.lanes.start_over()

    def show_playhead(self, view: View) -> None:
        self._view = view
        self.lanes.show_playhead(view)

    def show_results(self, results: Mapping[str, Any]) -> None:
        show_or_hide(self._foot, "")
        self._rate_hz = results["sample_rate_hz"]
        clips = (clip for track in results["inputs"] for clip in track.clips)
        self._computed_clips = {clip.id: (clip.waveform, clip.effects) for clip in clips}
        self._waveforms = waveforms_of(results)
        self._played = played_of(results)
        self._show_heads()
        self.show_staleness(self.is_stale)

    def show_unplayable(self, unplayable: tuple[UnplayableInput, ...]) -> None:
        problems = {track.id: track.problem for track in unplayable}
        if problems != self._problems:
            self._problems = problems
            self._place_lanes()

    def show_staleness(self, stale: bool) -> None:
        # What a clip that plays something else now played would be drawn as long as that.
        shown, awaited = self._waveforms, frozenset[int]()
        if stale:
            awaited = frozenset(
                clip.id
                for clip in self._design.clips
                if self._computed_clips.get(clip.id) != (clip.waveform, clip.effects)
            )
            shown = {clip: played for clip, played in shown.items() if clip not in awaited}
        self.lanes.show_samples(waveforms=shown, awaited=awaited, sample_rate_hz=self._rate_hz)

    def show_problem(self, reason: str) -> None:
        self._computed_clips, self._waveforms, self._played = {}, {}, {}
        self._show_heads()
        self.show_staleness(self.is_stale)
        set_tone(self._foot, "dim" if reason == PREPARING else "error")
        show_or_hide(self._foot, reason)

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._place_lanes()

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            # Some desktops have a font of their own for lists.
            self.heads.setFont(self.font())
            self._place_lanes()

    def drop_place(self, at: QPoint) -> DropPlace | None:
        place = QPointF(self.lanes.mapFrom(self, at))
        lane = self.lanes.content.lane_at(place.y())
        if lane is None or not self.lanes.isVisible():
            return None
        # Over a head there is no time.
        onset_s = self.lanes.mouse.time_at(place) if place.x() >= 0.0 else None
        return DropPlace(input_id=lane.track.id, onset_s=onset_s)

    def show_drop(self, at: QPoint | None) -> None:
        place, shown = (None if at is None else self.drop_place(at)), GesturePreview()
        if place is not None:
            shown = GesturePreview(guide_s=place.onset_s, label="A clip here")
        self.lanes.overlay.show_preview(shown, QPointF(self.lanes.mapFrom(self, at or QPoint())))

    @property
    def _heads_px(self) -> int:
        return heads_px(self.fontMetrics().height())

    def _connect(self) -> None:
        lanes, bar, tools = self.lanes, self.heads.verticalScrollBar(), self._toolbar
        self.heads.edited.connect(self.edited)
        lanes.edited.connect(self.edited)
        lanes.view_changed.connect(self._show_view)
        lanes.playhead_requested.connect(self.playhead_requested)
        lanes.action_requested.connect(self.action_requested)
        lanes.elsewhere = self._drop_place_elsewhere
        lanes.scroll_requested.connect(self._scroll)
        tools.add_requested.connect(lambda kind: lanes.edit(edits.add_waveform, kind()))
        tools.draw_requested.connect(self._draw)
        tools.file_requested.connect(lambda: self.action_requested.emit("import_recording"))
        tools.track_requested.connect(lambda: lanes.edit(add_track))
        for adds in (tools.add_requested, tools.track_requested):
            adds.connect(self.lanes.setFocus)
        tools.snap.clicked.connect(lambda snaps: lanes.change(snaps=snaps))
        tools.zoom_requested.connect(lanes.zoom)
        tools.everything.clicked.connect(lanes.show_everything)
        self._time_bar.range_requested.connect(lanes.show_range)
        self.heads.laid_out.connect(self._follow_heads)
        self.heads.laid_out.connect(self._place_lanes)
        bar.valueChanged.connect(self._follow_heads)
        bar.valueChanged.connect(self._place_lanes)
        self._bar.valueChanged.connect(bar.setValue)

    def _draw(self, new: bool) -> None:
        """Take the pen to the selected clip, or to a new one, which is silent yet."""
        if new or self._view.selected_clip is None:
            values = np.zeros(round(_DRAWN_S * self._rate_hz))
            drawn = Drawn(Samples(values=values, sample_rate_hz=self._rate_hz))
            self.lanes.edit(edits.add_waveform, drawn)
        self.action_requested.emit("draw_clip")

    def _show_heads(self) -> None:
        self.heads.show_state(self._design, self._view, self._played)

    def _place_lanes(self) -> None:
        """Put each lane beside its head."""
        width, ruler_px = self._heads_px, int(self.lanes.ruler_px)
        self.heads.setFixedWidth(width)
        self._corner.setFixedSize(width, ruler_px)
        top = ruler_px - self.heads.verticalScrollBar().value()
        height = row_px(self.heads.fontMetrics().height())
        lanes = lanes_of(self._design, self._view, height, top, self._problems)
        self.lanes.show_state(self._design, self._view, lanes)
        shown_s, end_s = self.lanes.content.scale.shown_s, self.lanes.content.lengths.end_s
        self._time_bar.show_range(shown_s, (0.0, max(end_s, shown_s[1])))

    def _scroll(self, notches: float) -> None:
        bar = self.heads.verticalScrollBar()
        bar.setValue(round(bar.value() - notches * bar.singleStep() * _ROWS_PER_NOTCH))

    def _follow_heads(self) -> None:
        bar = self.heads.verticalScrollBar()
        with QSignalBlocker(self._bar):
            self._bar.setRange(bar.minimum(), bar.maximum())
            self._bar.setPageStep(bar.pageStep())
            self._bar.setValue(bar.value())
        self._bar.setVisible(bar.maximum() > bar.minimum())

    def _show_view(self, view: View) -> None:
        if view != self._view:
            self.view_changed.emit(view)

    def _drop_place_elsewhere(self, at: QPointF | None) -> DropPlace | None:
        # Over the lanes themselves there is no other panel.
        if at is None or QRectF(self.lanes.rect()).contains(at):
            return self.held_over(None)
        return self.held_over(self.lanes.mapToGlobal(at).toPoint())
