"""Heads, lanes, ruler and scroll bars, which move together."""

from collections.abc import Mapping, Sequence

from PySide6.QtCore import QEvent, QSignalBlocker, Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QGridLayout, QScrollBar, QWidget

from skinsource.design.design import Design, Input, audible_inputs
from skinsource.design.view import View
from skinsource_gui.panels.timeline.heads.input_list import InputList
from skinsource_gui.panels.timeline.heads.input_row import InputRow
from skinsource_gui.panels.timeline.heads.row_places import heads_px
from skinsource_gui.panels.timeline.lane import Lane
from skinsource_gui.panels.timeline.lanes_view import LanesView
from skinsource_gui.panels.timeline.time_scroll_bar import TimeBar
from skinsource_gui.panels.timeline.timeline_toolbar import TimelineToolbar

_ROWS_PER_NOTCH = 3


class TrackTable(QWidget):
    """Lays out the parts of the timeline, and scrolls them together.

    Attributes
    ----------
    lanes, toolbar, time_bar
        Its parts, beside the list of heads.
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
        self.lanes.scroll_wanted.connect(self._scroll)
        self.time_bar.range_wanted.connect(self.lanes.seen.show_range)

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
    """The lanes of a design, each as high as its head; the first begins at ``top_px``.

    ``problems``: why inputs cannot be played, by their ids.
    """
    audible = {one.id for one in audible_inputs(design.inputs)}
    lanes = []
    # A list that takes over other heads scrolls before the lanes know of them; they come next.
    for track, row in zip(design.inputs, rows, strict=False):
        heard = track.id in audible
        # What is muted meanwhile has no problem any more.
        problem = problems.get(track.id, "") if heard else ""
        lanes.append(
            Lane(
                track=track,
                top_px=float(top_px),
                height_px=float(row.height()),
                silent="cannot be played" if problem else _why_silent(track, heard=heard),
                problem=problem,
                selected=track.id in view.selected_inputs,
            )
        )
        top_px += row.height()
    return tuple(lanes)


def _why_silent(track: Input, *, heard: bool) -> str:
    if track.muted:
        return "muted"
    if not heard:
        return "another track is solo"
    return "" if track.clips else "no clips: double click to add one"
