"""Puts docks into an arrangement."""

from collections.abc import Mapping
from itertools import pairwise

from PySide6.QtCore import QObject, QSize, Qt, Signal
from PySide6.QtWidgets import QApplication, QMainWindow, QStyle, QToolBar

from skinsource_gui.shell.docks.arrangement_spec import (
    ARRANGEMENTS,
    ArrangementSpec,
    Behind,
    Place,
    Places,
)
from skinsource_gui.shell.docks.dock import Dock
from skinsource_gui.shell.docks.kept_keyboard import KeptKeyboard
from skinsource_gui.shell.docks.room import Folded, Needs, Room, folded, room_of

_ACROSS, _DOWN = Qt.Orientation.Horizontal, Qt.Orientation.Vertical
# Around the letters of a dock's title, or of its tab; the frame of a dock.
_TITLE_PX, _EDGE_PX = 16, 4
_GAP = QStyle.PixelMetric.PM_DockWidgetSeparatorExtent
_TOP = Qt.DockWidgetArea.TopDockWidgetArea


class Arrangements(QObject):
    """Puts the docks of one window into one of the arrangements.

    Parameters
    ----------
    window
        Holds the docks; also the parent.
    docks
        By the name of their panel, in the order in which they stand in a column.
    places
        Where each stands in each arrangement.  A panel about which nothing is said stands at the
        foot of the last column.

    Attributes
    ----------
    keyboard
        Who has it while docks come and go.
    """

    #: The `ArrangementSpec` that is taken up; before that happens.
    chosen = Signal(object)
    #: Size of words that belongs to it.
    text_scaled = Signal(float)

    def __init__(self, window: QMainWindow, docks: Mapping[str, Dock], places: Places) -> None:
        super().__init__(window)
        self._window, self._docks, self._places = window, docks, places
        self._spec: ArrangementSpec | None = None
        self._folded: Folded | None = None
        self._room: Room | None = None
        self.keyboard = KeptKeyboard(window, docks)

    def show(self, name: str) -> None:
        """Take up the arrangement ``name``; the first one where it is not known."""
        spec = next((one for one in ARRANGEMENTS if one.name == name), ARRANGEMENTS[0])
        # Larger words would have them refitted before they stand.
        self._spec = None
        self.chosen.emit(spec)
        self.text_scaled.emit(spec.text_scale)
        self._spec = spec
        places = {panel: self._place(panel, spec) for panel in self._docks}
        shown = {panel: one for panel, one in places.items() if isinstance(one, Place)}
        self._room, self._folded = None, self._fold(spec)
        standing = self._folded
        with self.keyboard.kept():
            self._put(standing)
            for panel, place in places.items():
                if isinstance(place, Behind):
                    self._window.tabifyDockWidget(self._docks[place.panel], self._docks[panel])
            for panel, dock in self._docks.items():
                dock.setVisible(panel in shown)
            for tabs in standing.tabs:
                self._docks[tabs[0]].raise_()
            self.share_room()
        # A panel that was a window of its own may have had the keyboard.
        if QApplication.activeWindow() is not self._window:
            self._window.activateWindow()

    def bring(self, panel: str) -> None:
        """Bring a panel into sight, where it stands: no other one is moved."""
        self._docks[panel].bring_forward()

    def refit(self) -> None:
        """Share the room anew among panels that nobody has moved: words have another size."""
        if self._spec is None:
            return
        if self._fold(self._spec) != self._folded:
            brought = self._brought(self._spec)
            self.show(self._spec.name)
            for panel in brought:
                self.bring(panel)
        else:
            self.share_room()

    def share_room(self) -> None:
        """Give the panels of the present arrangement the room that is theirs at first."""
        spec, standing = self._spec, self._folded
        if spec is None or standing is None:
            return
        room = room_of(standing, self._needs(spec))
        if room == self._room:
            return  # Qt would round it otherwise
        self._room = room
        widths, (height, below), heights = room
        tops = [self._docks[column[0][0]] for column in standing.columns]
        self._window.resizeDocks(tops, widths, _ACROSS)
        if standing.foot:
            docks = [tops[0], self._docks[standing.foot[0]]]
            self._window.resizeDocks(docks, [height, below], _DOWN)
        for column, parts in zip(standing.columns, heights, strict=True):
            self._window.resizeDocks([self._docks[tabs[0]] for tabs in column], parts, _DOWN)

    def _brought(self, spec: ArrangementSpec) -> list[str]:
        """Panels that the arrangement does not show by itself, those that lie behind first."""
        there = [panel for panel, dock in self._docks.items() if not dock.isHidden()]
        added = [panel for panel in there if not isinstance(self._place(panel, spec), Place)]
        return sorted(added, key=lambda panel: self._docks[panel].in_sight)

    def _place(self, panel: str, spec: ArrangementSpec) -> Place | Behind:
        places = self._places.get(panel, {})
        return places.get(spec.name, Place(len(spec.columns) - 1)) or Behind(spec.host)

    def _fold(self, spec: ArrangementSpec) -> Folded:
        places = {panel: self._place(panel, spec) for panel in self._docks}
        shown = {panel: one for panel, one in places.items() if isinstance(one, Place)}
        foot = [panel for panel, place in shown.items() if place.at_foot]
        foot.sort(key=lambda panel: shown[panel].column)
        columns: list[list[str]] = [[] for _ in spec.columns]
        for panel, place in shown.items():
            if panel not in foot:
                columns[min(place.column, len(columns) - 1)].append(panel)
        return folded(columns, foot, self._needs(spec))

    def _needs(self, spec: ArrangementSpec) -> Needs:
        window = self._window
        bars = [window.menuBar(), window.statusBar(), *window.findChildren(QToolBar)]
        around = sum(bar.sizeHint().height() for bar in bars if not bar.isHidden())
        shown = {panel: self._place(panel, spec) for panel in self._docks}
        return Needs(
            room=window.size() - QSize(0, around),
            spec=spec,
            places={panel: one for panel, one in shown.items() if isinstance(one, Place)},
            least={
                panel: self._least(panel) for panel, one in shown.items() if isinstance(one, Place)
            },
            tab_px=window.fontMetrics().height() + _TITLE_PX,
            gap_px=window.style().pixelMetric(_GAP),
        )

    def _put(self, standing: Folded) -> None:
        for dock in self._docks.values():
            dock.setFloating(False)
            self._window.removeDockWidget(dock)
        tops = [self._docks[column[0][0]] for column in standing.columns]
        self._window.addDockWidget(_TOP, tops[0])
        # First what lies below all columns: what is split later stays above it.
        below_all = [self._docks[panel] for panel in standing.foot]
        for first in below_all[:1]:
            self._window.splitDockWidget(tops[0], first, _DOWN)
        for left, right in pairwise(below_all):
            self._window.splitDockWidget(left, right, _ACROSS)
        for left, right in pairwise(tops):
            self._window.splitDockWidget(left, right, _ACROSS)
        for column in standing.columns:
            for above, below in pairwise(column):
                self._window.splitDockWidget(self._docks[above[0]], self._docks[below[0]], _DOWN)
        for tabs in standing.tabs:
            for before, after in pairwise(tabs):
                self._window.tabifyDockWidget(self._docks[before], self._docks[after])

    def _least(self, panel: str) -> QSize:
        """Return the least room in which nothing of the panel has to scroll."""
        content = self._docks[panel].panel
        size = content.minimumSize().expandedTo(content.minimumSizeHint())
        title = self._window.fontMetrics().height() + _TITLE_PX
        return size + QSize(_EDGE_PX, title)
