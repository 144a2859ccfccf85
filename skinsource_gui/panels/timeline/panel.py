"""The panel of tracks and their clips over time, with clipboard, menu, toolbar and scroll bars."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

from PySide6.QtCore import (
    QEvent,
    QMimeData,
    QObject,
    QPoint,
    QPointF,
    QRectF,
    QSignalBlocker,
    QSize,
    Qt,
    Signal,
)
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import (
    QApplication,
    QGridLayout,
    QHBoxLayout,
    QInputDialog,
    QMenu,
    QScrollBar,
    QStackedLayout,
    QToolButton,
    QWidget,
)

from skinsource.base.arrays import Floats
from skinsource.base.errors import SkinSourceError
from skinsource.base.quoting import sentence
from skinsource.design import edits
from skinsource.design.clips import Clip, Fragment
from skinsource.design.design import Design, Input, audible_inputs
from skinsource.design.edits.edit import Edit, Refusal
from skinsource.design.signal_path import UnplayableInput
from skinsource.design.view import View
from skinsource.design.waveform import Waveform
from skinsource.limbs.locations import input_name
from skinsource.limbs.own_limbs import facts_of
from skinsource_gui.fields.inputs import waveforms_of
from skinsource_gui.panels.timeline.content import (
    Box,
    GainStrip,
    Lane,
    TimelineContent,
    chosen_clips,
    clip_text,
    toggle_gain_curves,
)
from skinsource_gui.panels.timeline.gain import GainPoints
from skinsource_gui.panels.timeline.gestures import GesturePreview
from skinsource_gui.panels.timeline.head_row import InputRow, heads_px, row_places
from skinsource_gui.panels.timeline.heads import Heads, InputList
from skinsource_gui.panels.timeline.lanes import LanesView, marker_at
from skinsource_gui.plots.time_scale import Range
from skinsource_gui.qt.buttons import page_label, passing_menu
from skinsource_gui.qt.fitting import LayoutWatcher, fitting_font, set_fonts
from skinsource_gui.qt.frames import DropPlace
from skinsource_gui.qt.keys import KEYS, key_text
from skinsource_gui.qt.labels import how_to_add
from skinsource_gui.qt.layouts import in_column
from skinsource_gui.qt.theme import UNIT_PX
from skinsource_gui.state.panel import Panel

_MIME = "application/x-skinsource-clips"
# A text with clips has this sign within so many characters.
_SIGN, _BEGINNING = "skinsource clips", 2000


def copy_fragment(fragment: Fragment) -> None:
    """Put clips on the clipboard.

    Raises
    ------
    InvalidInputError
        They hold more samples than a text may.
    """
    text = edits.fragment_text(fragment)
    data = QMimeData()
    data.setData(_MIME, text.encode())
    data.setText(text)
    QApplication.clipboard().setMimeData(data)


def pasted_fragment() -> Fragment | None:
    """Return the clips on the clipboard, also those that came as text; None: there are none.

    Raises
    ------
    FileFormatError
        They are damaged, or from a newer version.
    """
    data = QApplication.clipboard().mimeData()
    if data is None:
        return None
    if data.hasFormat(_MIME):
        return edits.fragment_from(bytes(data.data(_MIME).data()).decode(errors="replace"))
    text = data.text() if data.hasText() else ""
    return edits.fragment_from(text) if _SIGN in text[:_BEGINNING] else None


_NO_CLIPS = Refusal(sentence="No clip is selected; click one in the timeline.")
_NOTHING_TO_PASTE = Refusal(
    sentence=f"The clipboard holds no clips; copy some first, with {key_text('timeline', 'copy')}."
)


class TimelineEdits(QObject):
    """Edits the selected clips; new clips play what the one plays that was selected last."""

    edited = Signal(object, object)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._design, self._view = Design(limb=""), View()
        self._last: Waveform = Clip().waveform

    def show_state(self, design: Design, view: View) -> None:
        """Take over the present design and view."""
        self._design, self._view = design, view
        chosen = view.selected_clips[-1:]
        for track in design.inputs:
            for clip in track.clips:
                if (clip.id,) == chosen:
                    self._last = clip.waveform

    def add(self, track: int, at_s: float) -> None:
        """Add a clip of the last used kind to a track."""
        self._emit(edits.add_clip(self._design, self._view, track, at_s, self._last))

    def add_marker(self, at_s: float) -> None:
        """Add a marker with a number for a name."""
        name = str(len(self._design.markers) + 1)
        self._emit(edits.add_marker(self._design, self._view, at_s, name))

    def copy(self) -> bool:
        """Put the selected clips on the clipboard; whether they are there."""
        fragment = edits.fragment_of(self._design, chosen_clips(self._design, self._view))
        if fragment is None:
            self._emit(_NO_CLIPS)
            return False
        try:
            copy_fragment(fragment)
        except SkinSourceError as error:
            self._emit(Refusal(sentence=sentence(str(error))))
            return False
        return True

    def cut(self) -> None:
        """Move the selected clips to the clipboard; what cannot be there stays."""
        if self.copy():
            chosen = chosen_clips(self._design, self._view)
            self._emit(edits.cut_clips(self._design, self._view, chosen))

    def paste(self) -> None:
        """Put the clips of the clipboard at the playhead."""
        try:
            fragment = pasted_fragment()
        except SkinSourceError as error:
            self._emit(Refusal(sentence=sentence(str(error))))
            return
        if fragment is None:
            self._emit(_NOTHING_TO_PASTE)
        else:
            at_s = self._view.playhead_s
            self._emit(edits.paste_fragment(self._design, self._view, fragment, at_s))

    def _emit(self, outcome: Edit | Refusal) -> None:
        self.edited.emit(outcome, None)


AnyEdit = Callable[..., Edit | Refusal]
_PLACE = "timeline"


class LanesMenu(QObject):
    """Opens the menu of what lies under the pointer.

    Parameters
    ----------
    content
        Returns what the lanes show now.
    clips, gain
        Edit clips and gain curves, as keys do too.
    parent
        Widget over which the menu opens.
    """

    edited = Signal(object, object)
    view_changed = Signal(object)
    opened = Signal(int)

    def __init__(
        self,
        content: Callable[[], TimelineContent],
        clips: TimelineEdits,
        gain: GainPoints,
        parent: QWidget,
    ) -> None:
        super().__init__(parent)
        self._content, self._clips, self._gain, self._parent = content, clips, gain, parent

    def open(self, at: QPoint, place: QPointF) -> None:
        """Open the menu of a place, at a place of the screen."""
        content = self._content()
        box = content.box_at(place)
        menu = passing_menu(self._parent, "lanes_menu")
        time_s = max(content.scale.time(place.x()), 0.0)
        if place.y() < content.ruler_px:
            self._fill_ruler(menu, content, place, time_s)
        elif (strip := self._gain.strip_at(place)) is not None:
            self._fill_curve(menu, strip, place)
        elif box is not None:
            if box.clip.id not in content.view.selected_clips:
                self._select(box.clip.id)
            self._fill_clips_here(menu, content.boxes_at(place))
            self._fill_clip(menu, box.clip.id)
        else:
            self._fill_ground(menu, content, place, time_s)
        menu.popup(at)

    def _fill_clips_here(self, menu: QMenu, boxes: Sequence[Box]) -> None:
        """Offer to select each of several clips that lie over each other."""
        if len(boxes) < 2:
            return
        here = menu.addMenu("Clips here")
        here.setObjectName("clips_here")
        for box in boxes:
            line = here.addAction(clip_text(box.clip))
            line.setCheckable(True)
            line.setChecked(box.clip.id in self._content().view.selected_clips)
            line.triggered.connect(partial(self._select, box.clip.id))
        menu.addSeparator()

    def _select(self, clip: int, _checked: bool = False) -> None:
        content = self._content()
        self.view_changed.emit(edits.select_clips(content.design, content.view, (clip,)).view)

    def _fill_clip(self, menu: QMenu, clip: int) -> None:
        content = self._content()
        chosen = content.view.selected_clips
        several = len(chosen) > 1
        what = f"{len(chosen)} clips" if several else "clip"
        self._line(menu, "Edit clip", "open", lambda: self.opened.emit(clip))
        menu.addSeparator()
        self._act(menu, "Split at playhead", "split", edits.split_clips, content.view.playhead_s)
        if several:
            self._act(menu, "Join parts of a clip", "", edits.join_clips)
            self._act(menu, "Make one clip of them", "", edits.group_clips)
        else:
            self._act(menu, "Take layers apart", "", edits.ungroup_clips)
        self._act(menu, f"Repeat {what}", "repeat", edits.repeat_clips, 2)
        self._act(menu, f"Duplicate {what}", "duplicate", edits.duplicate_clips)
        self._act(menu, f"Mute {what}", "mute", edits.toggle_mute_clips)
        menu.addSeparator()
        self._fill_places(menu, f"Move {what} to")
        self._line(menu, "Copy", "copy", self._clips.copy)
        self._line(menu, "Cut", "cut", self._clips.cut)
        self._act(menu, f"Remove {what}", "remove", edits.remove_clips)

    def _fill_places(self, menu: QMenu, label: str) -> None:
        places = menu.addMenu(label)
        places.setObjectName("lanes_places")
        design = self._content().design
        occupied = {track.location for track in design.inputs}
        for number in range(1, facts_of(design.limb).n_inputs + 1):
            track = "" if number in occupied else " (new track)"
            title = f"{number} · {input_name(number, design.limb).name}{track}"
            self._act(places, title, "", edits.move_clips_to_place, number)

    def _fill_ground(
        self, menu: QMenu, content: TimelineContent, place: QPointF, time_s: float
    ) -> None:
        lane = content.lane_at(place.y())
        if lane is not None:
            track = lane.track.id
            self._line(menu, "Add clip here", "", lambda: self._clips.add(track, time_s))
            shown = track in content.gain_shown
            text = "Hide gain curve" if shown else "Show gain curve"
            self._line(menu, text, "gain_curve", lambda: self._toggle_gain(track))
        self._line(menu, "Paste at playhead", "paste", self._clips.paste)
        menu.addSeparator()
        self._fill_time(menu, content)

    def _fill_curve(self, menu: QMenu, strip: GainStrip, place: QPointF) -> None:
        track, near = strip.lane.track.id, strip.point_at(place)
        if near is not None:
            self._gain.choose((track, near))
            self._line(menu, "Remove point", "remove", lambda: self._gain.remove(track, (near,)))
        else:
            self._line(menu, "Add point here", "", lambda: self._gain.double_click(place))
        everything = tuple(range(len(strip.points)))
        self._line(menu, "Remove gain curve", "", lambda: self._gain.remove(track, everything))
        self._line(menu, "Hide gain curve", "gain_curve", lambda: self._toggle_gain(track))

    def _toggle_gain(self, track: int) -> None:
        content = self._content()
        self.view_changed.emit(toggle_gain_curves(content.design, content.view, (track,)).view)

    def _fill_ruler(
        self, menu: QMenu, content: TimelineContent, place: QPointF, time_s: float
    ) -> None:
        marker = marker_at(content, place)
        if marker is None:
            self._line(menu, "Add marker here", "", lambda: self._clips.add_marker(time_s))
        else:
            index = content.design.markers.index(marker)
            self._line(menu, "Rename marker…", "", lambda: self._rename(index))
            self._edit_line(menu, "Remove marker", edits.remove_marker, index)
        menu.addSeparator()
        ends = _ends_of_chosen(content)
        if ends is not None:
            self._edit_line(menu, "Loop the selected clips", edits.set_loop, ends)
        if content.design.loop_s is not None:
            self._edit_line(menu, "No loop", edits.set_loop, None)
        self._fill_time(menu, content)

    def _fill_time(self, menu: QMenu, content: TimelineContent) -> None:
        if content.design.loop_s is None:
            return
        start_s, end_s = content.design.loop_s
        menu.addSeparator()
        insert = edits.insert_time
        self._edit_line(menu, "Insert the loop's time before it", insert, start_s, end_s - start_s)
        self._edit_line(menu, "Remove the loop's time", edits.remove_time, start_s, end_s)

    def _act(self, menu: QMenu, text: str, key: str, edit: AnyEdit, *more: object) -> None:
        """Add a line that edits the clips which are selected when it is chosen."""
        self._line(
            menu, text, key, lambda: self._edit(edit, self._content().view.selected_clips, *more)
        )

    def _edit_line(self, menu: QMenu, text: str, edit: AnyEdit, *more: object) -> None:
        self._line(menu, text, "", lambda: self._edit(edit, *more))

    def _edit(self, edit: AnyEdit, *more: object) -> None:
        content = self._content()
        self.edited.emit(edit(content.design, content.view, *more), None)

    def _line(self, menu: QMenu, text: str, key: str, act: Callable[[], object]) -> None:
        # A tab puts the key at the right; the menu has no shortcuts, keys belong to the lanes.
        shown = f"{text}\t{key_text(_PLACE, key)}" if key else text
        menu.addAction(shown).triggered.connect(lambda _=False: act())

    def _rename(self, index: int) -> None:
        before = self._content().design.markers[index].name
        name, sure = QInputDialog.getText(self._parent, "Rename marker", "Name", text=before)
        if sure:
            self._edit(edits.rename_marker, index, name)


def _ends_of_chosen(content: TimelineContent) -> tuple[float, float] | None:
    clips = [clip for clip in content.design.clips if clip.id in content.view.selected_clips]
    if not clips:
        return None
    return (min(clip.onset_s for clip in clips), max(clip.end_s for clip in clips))


_STEPS_PER_S = 10_000


class TimeBar(QScrollBar):
    """A scroll bar over the time; it is hidden while all of the time is shown."""

    #: The part to see.
    range_requested = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(Qt.Orientation.Horizontal, parent)
        self.setObjectName("time_bar")
        self.setAccessibleName("Time shown")
        self._shown_s: Range = (0.0, 1.0)
        self.valueChanged.connect(self._emit)
        self.hide()

    def show_range(self, shown_s: Range, whole_s: Range) -> None:
        """Show a part of the whole."""
        self._shown_s = shown_s
        length = round((shown_s[1] - shown_s[0]) * _STEPS_PER_S)
        whole = round((whole_s[1] - whole_s[0]) * _STEPS_PER_S)
        with QSignalBlocker(self):
            self.setRange(0, max(whole - length, 0))
            self.setPageStep(max(length, 1))
            self.setSingleStep(max(length // 10, 1))
            self.setValue(round((shown_s[0] - whole_s[0]) * _STEPS_PER_S))
        self.setVisible(whole > length)

    def _emit(self, value: int) -> None:
        length = self._shown_s[1] - self._shown_s[0]
        start = value / _STEPS_PER_S
        self.range_requested.emit((start, start + length))


_ZOOM = 1.5


class TimelineToolbar(QWidget):
    """Buttons for snapping and zoom."""

    snaps_requested = Signal(bool)
    zoom_requested = Signal(float)
    everything_requested = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setStyleSheet("QToolButton { padding: 1px 6px; }")
        self._row = row = QHBoxLayout(self)
        row.setContentsMargins(4, 1, 4, 1)
        row.setSpacing(2)
        self._snap = self._button(
            "Snap", "Edges snap to the grid, to ends of clips and to the playhead"
        )
        self._snap.setCheckable(True)
        self._snap.clicked.connect(self.snaps_requested)
        self._closer = self._button("+", _hint("zoom_in"))
        self._closer.clicked.connect(lambda: self.zoom_requested.emit(_ZOOM))
        self._wider = self._button("\u2212", _hint("zoom_out"))
        self._wider.clicked.connect(lambda: self.zoom_requested.emit(1 / _ZOOM))
        self._all = self._button("Fit", _hint("whole"))
        self._all.clicked.connect(lambda: self.everything_requested.emit())
        self._buttons = (self._snap, self._wider, self._closer, self._all)
        for button in self._buttons:
            row.addWidget(button)
        row.addStretch(1)
        LayoutWatcher(self).changed.connect(self._fit)

    def show_state(self, *, snaps: bool, zoomed: bool) -> None:
        """Show whether edges snap, and whether less than everything is shown."""
        self._snap.setChecked(snaps)
        self._all.setEnabled(zoomed)
        self._wider.setEnabled(zoomed)

    def _fit(self) -> None:
        # Heads do not become as wide as the largest letters, so that lanes have room.
        around = self._row.contentsMargins()
        gaps = around.left() + around.right() + self._row.spacing() * len(self._buttons)
        room = self.width() - gaps
        set_fonts(fitting_font((self._buttons,), self.font(), room), self._buttons)

    def _button(self, text: str, hint: str) -> QToolButton:
        button = QToolButton(self)
        button.setObjectName(f"timeline_{text.lower()}")
        button.setText(text)
        button.setToolTip(hint)
        button.setAccessibleName(hint)
        button.setAutoRaise(True)
        return button


def _hint(name: str) -> str:
    gesture = KEYS["timeline"].gestures[name]
    return f"{gesture.effect[:1].upper()}{gesture.effect[1:]} ({gesture.shown})"


_ROWS_PER_NOTCH = 3


class TrackTable(QWidget):
    """Lays out heads, lanes and scroll bars, and scrolls them at the same time.

    Attributes
    ----------
    lanes, toolbar, time_bar
        Parts beside the list of heads.
    """

    def __init__(self, heads: InputList, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._heads = heads
        heads.setFixedWidth(heads_px(self.fontMetrics().height()))
        heads.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._design, self._view = Design(limb=""), View()
        self._problems: Mapping[int, str] = {}
        self.lanes, self.toolbar, self.time_bar = LanesView(), TimelineToolbar(), TimeBar()
        self._bar = QScrollBar(Qt.Orientation.Vertical)
        self._bar.setAccessibleName("Tracks shown")
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setSpacing(0)
        grid.addWidget(self.toolbar, 0, 0)
        grid.addWidget(heads, 1, 0)
        grid.addWidget(self.lanes, 0, 1, 2, 1)
        grid.addWidget(self._bar, 0, 2, 2, 1)
        grid.addWidget(self.time_bar, 2, 1)
        grid.setColumnStretch(1, 1)
        grid.setRowStretch(1, 1)
        bar = heads.verticalScrollBar()
        bar.rangeChanged.connect(self._follow_heads)
        bar.valueChanged.connect(self._follow_heads)
        bar.valueChanged.connect(self.place_lanes)
        self._bar.valueChanged.connect(bar.setValue)
        self.lanes.scroll_requested.connect(self._scroll)
        self.time_bar.range_requested.connect(self.lanes.time_zoom.show_range)

    def show_state(self, design: Design, view: View) -> None:
        """Show the lanes of a design; its heads are there already."""
        self._design, self._view = design, view
        self.toolbar.show_state(snaps=self.lanes.snaps, zoomed=view.time_range_s is not None)
        self.place_lanes()

    def show_problems(self, problems: Mapping[int, str]) -> None:
        """Mark tracks that cannot be played: why, by the ids of their inputs."""
        if problems != self._problems:
            self._problems = problems
            self.place_lanes()

    def show_playhead(self, view: View) -> None:
        """Show a view in which the playhead alone has moved."""
        self._view = view
        self.lanes.show_playhead(view)

    def place_lanes(self) -> None:
        """Put each lane beside its head."""
        self._heads.setFixedWidth(heads_px(self.fontMetrics().height()))
        self.toolbar.setFixedSize(self._heads.width(), int(self.lanes.ruler_px))
        top = int(self.lanes.ruler_px) - self._heads.verticalScrollBar().value()
        rows = self._heads.rows.rows
        lanes = lanes_of(self._design, self._view, rows, top, self._problems)
        self.lanes.show_state(self._design, self._view, lanes)
        content = self.lanes.content
        self.time_bar.show_range(content.scale.shown_s, content.whole_s)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self.place_lanes()

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self.place_lanes()

    def _scroll(self, notches: float) -> None:
        bar = self._heads.verticalScrollBar()
        bar.setValue(round(bar.value() - notches * bar.singleStep() * _ROWS_PER_NOTCH))

    def _follow_heads(self) -> None:
        bar = self._heads.verticalScrollBar()
        with QSignalBlocker(self._bar):
            self._bar.setRange(bar.minimum(), bar.maximum())
            self._bar.setPageStep(bar.pageStep())
            self._bar.setValue(bar.value())
        self._bar.setVisible(bar.maximum() > bar.minimum())


def lanes_of(
    design: Design,
    view: View,
    rows: Sequence[InputRow],
    top_px: float,
    problems: Mapping[int, str],
) -> tuple[Lane, ...]:
    """Return the lanes of a design, each as high as its head; the first begins at ``top_px``.

    ``problems``: why tracks cannot be played, by their ids.
    """
    audible_ids = {track.id for track in audible_inputs(design.inputs)}
    lanes = []
    # The list of heads may be newer than the design: it scrolls first, then the lanes follow.
    for track, row in zip(design.inputs, rows, strict=False):
        audible = track.id in audible_ids
        # What is muted meanwhile has no problem any more.
        problem = problems.get(track.id, "") if audible else ""
        lanes.append(
            Lane(
                track=track,
                top_px=float(top_px),
                height_px=float(row.height()),
                silent="cannot be played" if problem else _silence_reason(track, audible=audible),
                problem=problem,
                selected=track.id in view.selected_inputs,
            )
        )
        top_px += row.height()
    return tuple(lanes)


def _silence_reason(track: Input, *, audible: bool) -> str:
    if track.muted:
        return "muted"
    if not audible:
        return "another track is solo"
    return "" if track.clips else "no clips: double click to add one"


_LEAST_LANES_PX, _BARS_PX = 140, 12


class TimelinePanel(Panel):
    """A head for each track, its clips on one ruler, and a playhead."""

    title = "Timeline"
    name = "timeline"

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._clips, self._heads = TimelineEdits(self), Heads(self)
        # What each clip plays, and the clips as they were then, by their ids.
        self._computed_clips: Mapping[int, Clip] = {}
        self._waveforms: Mapping[int, Floats] = {}
        self._design, self._view = Design(limb=""), View()
        self._list = self._heads.list
        self._rows = self._list.rows
        self._table = TrackTable(self._list)
        how_to = how_to_add(self.in_sight, "a track")
        self._empty = page_label("inputs_empty", how_to, tone="dim", centred=True)
        self._foot = page_label("inputs_problem", tone="error")
        self._foot.setMargin(UNIT_PX)
        self._foot.hide()
        self._stack = QStackedLayout()
        self._stack.addWidget(self._empty)
        self._stack.addWidget(self._table)
        in_column((self._stack, 1), self._foot, of=self, margins=0, gap_px=0)
        self.setFocusProxy(self._rows)
        self._connect()

    def minimumSizeHint(self) -> QSize:
        # Room for one whole track below the ruler, and for some of its time.
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
        if self.is_stale:
            self.show_staleness(True)

    def show_in_sight(self, names: frozenset[str]) -> None:
        super().show_in_sight(names)
        self._empty.setText(how_to_add(names, "a track"))

    def show_playhead(self, view: View) -> None:
        self._view = view
        self._clips.show_state(self._design, view)
        self._table.show_playhead(view)

    def show_results(self, results: Mapping[str, Any]) -> None:
        self._show_foot("")
        self._table.lanes.sample_rate_hz = results["sample_rate_hz"]
        clips = (clip for track in results["inputs"] for clip in track.clips)
        self._computed_clips = {clip.id: clip for clip in clips}
        self._waveforms = waveforms_of(results)
        self.show_staleness(self.is_stale)

    def show_unplayable(self, unplayable: tuple[UnplayableInput, ...]) -> None:
        self._table.show_problems({track.id: track.problem for track in unplayable})

    def show_staleness(self, stale: bool) -> None:
        # What a clip that plays something else now played would be drawn as long as that.
        shown, awaited = self._waveforms, frozenset[int]()
        if stale:
            clips = [clip for track in self._design.inputs for clip in track.clips]
            awaited = frozenset(
                clip.id
                for clip in clips
                if clip.id not in self._computed_clips
                or not _play_same(clip, self._computed_clips[clip.id])
            )
            shown = {clip: played for clip, played in shown.items() if clip not in awaited}
        self._table.lanes.show_waveforms(shown, awaited)

    def show_problem(self, reason: str) -> None:
        self._computed_clips, self._waveforms = {}, {}
        self.show_staleness(self.is_stale)
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
        shown = GesturePreview()
        if place is not None:
            shown = GesturePreview(guide_s=place.onset_s, label="A clip here")
        lanes.overlay.show_preview(shown, QPointF(lanes.mapFrom(self, at or QPoint())))

    def _connect(self) -> None:
        lanes, clips, toolbar = self._table.lanes, self._clips, self._table.toolbar
        self._heads.edited.connect(self.edited)
        clips.edited.connect(self.edited)
        for part in (lanes.mouse, lanes.keys):
            part.edited.connect(self.edited)
            part.playhead_requested.connect(self.playhead_requested)
            part.clip_requested.connect(clips.add)
            part.marker_requested.connect(clips.add_marker)
            part.opened.connect(self._open_clip_editor)
        lanes.mouse.elsewhere = self._drop_place_elsewhere
        lanes.gain.edited.connect(self.edited)
        lanes.view_changed.connect(self._show_view)
        menu = LanesMenu(lambda: lanes.content, clips, lanes.gain, lanes)
        menu.edited.connect(self.edited)
        menu.view_changed.connect(self._show_view)
        menu.opened.connect(self._open_clip_editor)
        lanes.menu_requested.connect(menu.open)
        lanes.keys.copied.connect(clips.copy)
        lanes.keys.cut.connect(clips.cut)
        lanes.keys.pasted.connect(clips.paste)
        lanes.keys.zoomed.connect(lanes.time_zoom.zoom)
        lanes.keys.everything_requested.connect(lanes.time_zoom.show_everything)
        toolbar.snaps_requested.connect(lanes.set_snaps)
        toolbar.zoom_requested.connect(lanes.time_zoom.zoom)
        toolbar.everything_requested.connect(lanes.time_zoom.show_everything)

    def _show_view(self, view: View) -> None:
        if view != self._view:
            self.view_changed.emit(view)

    def _drop_place_elsewhere(self, at: QPointF | None) -> DropPlace | None:
        lanes = self._table.lanes
        # Over the lanes themselves there is no other panel.
        if at is None or QRectF(lanes.rect()).contains(at):
            return self.held_over(None)
        return self.held_over(lanes.mapToGlobal(at).toPoint())

    def _open_clip_editor(self, clip: int) -> None:
        self.action_requested.emit("show_clip_editor")

    def _show_foot(self, text: str) -> None:
        self._foot.setText(text)
        self._foot.setVisible(bool(text))


def _play_same(clip: Clip, other: Clip) -> bool:
    """Return whether two clips play the same, apart from when and how loud."""
    return clip.waveform == other.waveform and clip.effects == other.effects
