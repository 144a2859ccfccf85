"""The arrangements of the docks: which panels stand where, how much room each has.

`Arrangements` puts docks into an arrangement, `DockSizes` knows whether the user has moved them
since, and `DockLayout` stores the result between sessions and in design files.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial, reduce
from itertools import pairwise

from PySide6.QtCore import QByteArray, QEvent, QObject, QRect, QSize, Qt, QTimer, Signal
from PySide6.QtGui import QGuiApplication, QScreen
from PySide6.QtWidgets import (
    QApplication,
    QMainWindow,
    QScrollArea,
    QStyle,
    QToolBar,
    QVBoxLayout,
    QWidget,
)

from skinsource_gui.shell.appearance import Appearance
from skinsource_gui.shell.arrangement_spec import (
    ARRANGEMENTS,
    PRESENTATION,
    ArrangementSpec,
    Behind,
    Place,
    Places,
)
from skinsource_gui.shell.docks import Dock, KeyboardKeeper
from skinsource_gui.state.panel import Panel
from skinsource_gui.state.preferences import Preferences

#: Panels that share a place, as tabs; the first one is in front.
Tabs = tuple[str, ...]
#: Widths of columns; height of them and of what is below; heights in each column, px.
Room = tuple[list[int], list[int], list[list[int]]]


@dataclass(frozen=True, slots=True)
class Folded:
    """The columns of an arrangement, in which panels without room became tabs.

    Attributes
    ----------
    columns
        From the left; in each, from the top, panels that share a place.
    foot
        Panels beside each other below all columns.
    """

    columns: tuple[tuple[Tabs, ...], ...]
    foot: tuple[str, ...]

    @property
    def tabs(self) -> tuple[Tabs, ...]:
        """Where several panels share a place."""
        return tuple(tabs for column in self.columns for tabs in column if len(tabs) > 1)


@dataclass(frozen=True, slots=True, kw_only=True)
class Needs:
    """The room of an arrangement, and what its panels need.

    Attributes
    ----------
    room
        What the window has for all panels, px.
    spec, places
        The arrangement, and where its panels stand in it.
    least
        Room in which nothing of a panel has to scroll, its title included, px.
    tab_px
        Height of a row of tabs.
    gap_px
        Between two panels.
    """

    room: QSize
    spec: ArrangementSpec
    places: Mapping[str, Place]
    least: Mapping[str, QSize]
    tab_px: int
    gap_px: int

    def widths(self, columns: Sequence[Sequence[Tabs]]) -> int:
        """Least width of columns with the gaps between them, px."""
        return sum(map(self.width, columns)) + self.gap_px * (len(columns) - 1)

    def heights(self, column: Sequence[Tabs]) -> int:
        """Least height of a column with the gaps in it, px."""
        return sum(map(self.height, column)) + self.gap_px * (len(column) - 1)

    def width(self, column: Sequence[Tabs]) -> int:
        """Least width of a column, px."""
        return max(self.least[panel].width() for tabs in column for panel in tabs)

    def height(self, tabs: Tabs) -> int:
        """Least height of panels that share a place, px."""
        row = self.tab_px if len(tabs) > 1 else 0
        return max(self.least[panel].height() for panel in tabs) + row


def folded(columns: Sequence[Sequence[str]], foot: Sequence[str], needs: Needs) -> Folded:
    """Put panels that have too little room behind others, as tabs.

    Those of a column that is too low come behind its first one; what stands below all columns, and
    columns that yield, come behind the host.
    """
    stacks: list[tuple[Tabs, ...]] = [
        tuple((panel,) for panel in column) for column in columns if column
    ]
    host = needs.spec.host
    hosted = any(host in column for column in columns)
    below = max((needs.least[panel].height() + needs.gap_px for panel in foot), default=0)
    fitted = _stacked(stacks, needs, needs.room.height() - below)
    if foot and hosted and fitted is None:
        fitted = _stacked(stacks, needs, needs.room.height())
        stacks = _behind_host(fitted or _tabbed(stacks), tuple(foot), host)
        foot = ()
    else:
        stacks = fitted or _tabbed(stacks)
    for panel in needs.spec.yields if hosted else ():
        if needs.widths(stacks) <= needs.room.width():
            break
        yielding = [column for column in stacks if any(panel in tabs for tabs in column)]
        stacks = [column for column in stacks if column not in yielding]
        moved = tuple(panel for column in yielding for tabs in column for panel in tabs)
        stacks = _behind_host(stacks, moved, host)
    return Folded(tuple(stacks), tuple(foot))


def room_of(folded: Folded, needs: Needs) -> Room:
    """Widths of the columns; height of them and of what is below; heights in each column, px."""
    shares = [needs.spec.columns[_column(column, needs)] for column in folded.columns]
    width = needs.room.width() - needs.gap_px * (len(folded.columns) - 1)
    widths = shared(width, shares, list(map(needs.width, folded.columns)))
    height, below = needs.room.height(), 0
    least = [list(map(needs.height, column)) for column in folded.columns]
    if folded.foot:
        share = max(needs.places[panel].height for panel in folded.foot)
        needed = [
            max(map(needs.heights, folded.columns)),
            max(needs.least[panel].height() for panel in folded.foot),
        ]
        height, below = shared(height - needs.gap_px, (100 - share, share), needed)
    parts = [[needs.places[tabs[0]].height for tabs in column] for column in folded.columns]
    heights = [
        shared(height - needs.gap_px * (len(part) - 1), part, need)
        for part, need in zip(parts, least, strict=True)
    ]
    return widths, [height, below], heights


def shared(whole: int, shares: Sequence[int], least: Sequence[int]) -> list[int]:
    """Split ``whole`` by ``shares``, but give each part what it needs at least, if that fits."""
    if sum(least) >= whole:
        return [whole * need // sum(least) for need in least]
    short = [whole * share // sum(shares) < need for share, need in zip(shares, least, strict=True)]
    if not any(short):
        return [whole * share // sum(shares) for share in shares]
    # Those that would come off too badly get what they need, and the others share the rest.
    rest = whole - sum(need for need, is_short in zip(least, short, strict=True) if is_short)
    others = [k for k, is_short in enumerate(short) if not is_short]
    among = shared(rest, [shares[k] for k in others], [least[k] for k in others])
    of_others = dict(zip(others, among, strict=True))
    return [of_others.get(k, need) for k, need in enumerate(least)]


def _column(column: Sequence[Tabs], needs: Needs) -> int:
    return min(needs.places[column[0][0]].column, len(needs.spec.columns) - 1)


def _stacked(
    stacks: list[tuple[Tabs, ...]], needs: Needs, height: int
) -> list[tuple[Tabs, ...]] | None:
    """Return columns that fit the height, as tabs where needed; None where nothing fits."""
    if needs.spec.stacks:
        return stacks
    fitted = [
        column if needs.heights(column) <= height else as_tabs
        for column, as_tabs in zip(stacks, _tabbed(stacks), strict=True)
    ]
    fit = all(needs.heights(column) <= height for column in fitted)
    return fitted if fit else None


def _tabbed(stacks: list[tuple[Tabs, ...]]) -> list[tuple[Tabs, ...]]:
    return [(tuple(panel for tabs in column for panel in tabs),) for column in stacks]


def _behind_host(
    stacks: list[tuple[Tabs, ...]], panels: tuple[str, ...], host: str
) -> list[tuple[Tabs, ...]]:
    return [tuple(tabs + panels if host in tabs else tabs for tabs in column) for column in stacks]


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
        Where each stands in each arrangement; at the foot of the last column by default.
    """

    #: The `ArrangementSpec` that is about to be applied.
    chosen = Signal(object)
    #: Its text scale.
    text_scaled = Signal(float)

    def __init__(self, window: QMainWindow, docks: Mapping[str, Dock], places: Places) -> None:
        super().__init__(window)
        self._window, self._docks, self._places = window, docks, places
        self._spec: ArrangementSpec | None = None
        self._folded: Folded | None = None
        self._room: Room | None = None
        self.keyboard = KeyboardKeeper(window, docks)

    def show(self, name: str) -> None:
        """Apply the arrangement ``name``; the first one where it is not known."""
        spec = next(
            (arrangement for arrangement in ARRANGEMENTS if arrangement.name == name),
            ARRANGEMENTS[0],
        )
        # Larger text would have them refitted before they stand.
        self._spec = None
        self.chosen.emit(spec)
        self.text_scaled.emit(spec.text_scale)
        self._spec = spec
        places = {panel: self._place(panel, spec) for panel in self._docks}
        shown = {panel: place for panel, place in places.items() if isinstance(place, Place)}
        self._room, self._folded = None, self._fold(spec)
        standing = self._folded
        with self.keyboard.kept():
            self._place_docks(standing)
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
        """Bring a panel into sight without moving others."""
        self._docks[panel].bring_forward()

    def refit(self) -> None:
        """Share the room anew among panels that were not moved: the text has another size."""
        if self._spec is None:
            return
        if self._fold(self._spec) != self._folded:
            brought = self._added_panels(self._spec)
            self.show(self._spec.name)
            for panel in brought:
                self.bring(panel)
        else:
            self.share_room()

    def share_room(self) -> None:
        """Give the panels of the present arrangement their first sizes."""
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

    def _added_panels(self, spec: ArrangementSpec) -> list[str]:
        """Panels that the arrangement does not show by itself, those that lie behind first."""
        there = [panel for panel, dock in self._docks.items() if not dock.isHidden()]
        added = [panel for panel in there if not isinstance(self._place(panel, spec), Place)]
        return sorted(added, key=lambda panel: self._docks[panel].in_sight)

    def _place(self, panel: str, spec: ArrangementSpec) -> Place | Behind:
        places = self._places.get(panel, {})
        return places.get(spec.name, Place(len(spec.columns) - 1)) or Behind(spec.host)

    def _shown_places(self, spec: ArrangementSpec) -> dict[str, Place]:
        """Return the places of the panels that the arrangement shows by itself."""
        places = {panel: self._place(panel, spec) for panel in self._docks}
        return {panel: place for panel, place in places.items() if isinstance(place, Place)}

    def _fold(self, spec: ArrangementSpec) -> Folded:
        shown = self._shown_places(spec)
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
        places = self._shown_places(spec)
        return Needs(
            room=window.size() - QSize(0, around),
            spec=spec,
            places=places,
            least={panel: self._least(panel) for panel in places},
            tab_px=window.fontMetrics().height() + _TITLE_PX,
            gap_px=window.style().pixelMetric(_GAP),
        )

    def _place_docks(self, standing: Folded) -> None:
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


# What the sharing of room rounds away, px.
_ROUNDING_PX = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class _DockState:
    hidden: bool
    floating: bool
    in_sight: bool
    place: QRect

    def is_like(self, other: "_DockState", *, as_wide: bool, as_high: bool) -> bool:
        flags = (self.hidden, self.floating, self.in_sight)
        if flags != (other.hidden, other.floating, other.in_sight):
            return False
        if not self.in_sight:
            return True
        corners = self.place.topLeft() - other.place.topLeft()
        sizes = self.place.size() - other.place.size()
        across, down = (corners.x(), sizes.width()), (corners.y(), sizes.height())
        differences = (across if as_wide else ()) + (down if as_high else ())
        return all(abs(difference) <= _ROUNDING_PX for difference in differences)


@dataclass(frozen=True, slots=True)
class DockPlaces:
    """The state of each dock, and the room of all, which is less where bars grow."""

    room: QSize
    docks: Mapping[str, _DockState]

    @classmethod
    def of(cls, docks: Mapping[str, Dock]) -> "DockPlaces":
        """Return the present state."""
        here = [
            dock.geometry() for dock in docks.values() if dock.in_sight and not dock.isFloating()
        ]
        return cls(
            reduce(QRect.united, here, QRect()).size(),
            {
                name: _DockState(
                    hidden=dock.isHidden(),
                    floating=dock.isFloating(),
                    in_sight=dock.in_sight,
                    place=dock.geometry(),
                )
                for name, dock in docks.items()
            },
        )

    def is_like(self, other: "DockPlaces") -> bool:
        """Return whether no dock was moved; in a room of another size, shown or hidden."""
        as_wide = self.room.width() == other.room.width()
        as_high = self.room.height() == other.room.height()
        return all(
            state.is_like(other.docks[name], as_wide=as_wide, as_high=as_high)
            for name, state in self.docks.items()
        )


class DockSizes(QObject):
    """Shares the room once panels have their widths, and knows whether docks were moved.

    Parameters
    ----------
    window
        Whose docks; the parent.
    docks, arrangements
        Its docks, and what arranges them.
    """

    def __init__(
        self, window: QMainWindow, docks: Mapping[str, Dock], arrangements: Arrangements
    ) -> None:
        super().__init__(window)
        self._docks, self._arrangements = docks, arrangements
        arrangements.chosen.connect(self._begin)
        # The state of the docks as they were arranged; None: they may have been moved.
        self._untouched: DockPlaces | None = None
        # Whether no dock was moved before the text took another size.
        self._to_refit = False
        # How high some panels must be is known once they have their width.
        self._widened = QTimer(self, singleShot=True, interval=0)
        self._widened.timeout.connect(self._share_room)
        # Qt shares the room a moment after it was told how.
        self._settled = QTimer(self, singleShot=True, interval=0)
        self._settled.timeout.connect(self._note)

    @property
    def untouched(self) -> bool:
        """Whether no dock was moved since they were arranged."""
        if self._settled.isActive() or self._widened.isActive():
            return True
        now = DockPlaces.of(self._docks)
        return self._untouched is not None and now.is_like(self._untouched)

    def follow(self, appearance: Appearance) -> None:
        """Arrange docks that were not moved anew whenever the text has another size."""
        appearance.changing.connect(self._look)
        appearance.changed.connect(self._refit)

    def refit(self) -> None:
        """Arrange docks that were not moved anew: the window has another size."""
        self._look()
        self._refit()

    def forget(self) -> None:
        """Note that the docks were moved."""
        self._settled.stop()
        self._widened.stop()
        self._untouched = None

    def _look(self) -> None:
        # Bars that grow with their text push docks, which then look as if they had been moved.
        self._to_refit = self.untouched

    def _refit(self) -> None:
        if self._to_refit:
            self._arrangements.refit()
            self._begin()

    def _begin(self) -> None:
        self._settled.stop()
        self._widened.start()

    def _share_room(self) -> None:
        self._arrangements.share_room()
        self._settled.start()

    def _note(self) -> None:
        self._untouched = DockPlaces.of(self._docks)


_AS_AT_FIRST = "Panels as at first; {key} again brings yours back"
_AS_LEFT = "Panels as you had them; {key} again shows them as at first"


class DockLayout(QObject):
    """Stores and restores the layout of the docks, for each arrangement.

    Parameters
    ----------
    window
        Whose docks; also the parent.
    docks, arrangements
        Its docks, and what arranges them.
    preferences
        Store the layout between sessions.
    """

    #: A message on how the panels stand now.
    done = Signal(str)

    def __init__(
        self,
        window: QMainWindow,
        docks: Mapping[str, Dock],
        arrangements: Arrangements,
        preferences: Preferences,
    ) -> None:
        super().__init__(window)
        self._window, self._docks, self._preferences = window, docks, preferences
        self._arrangements = arrangements
        self.settling = DockSizes(window, docks, arrangements)
        arrangements.chosen.connect(self._note_arrangement)
        self._present: ArrangementSpec | None = None
        # The layout of the user, by the name of the arrangement.
        self._own: dict[str, bytes] = {}
        # What the user had before a scene took up its arrangement: its name, and where the docks
        # stood if they were moved; None: no scene has.
        self._before_scene: tuple[str, bytes] | None = None
        # Place of the window, arrangement and docks before they were presented; None: they are not.
        self._before_presenting: tuple[QByteArray, str, bytes] | None = None

    def choose(self, name: str) -> None:
        """Take up an arrangement as it was left; the present one as at first, and again as left.

        Nothing that the user made of an arrangement is lost by its key.
        """
        before, touched = self._present, bool(self._store_own())
        self._before_scene = None
        own = self._own.get(name, b"")
        again = before is not None and before.name == name
        self._arrangements.show(name)
        if own and not (again and touched):
            self.put(own)
        self._arrangements.keyboard.settle()
        if own and self._present is not None:
            text = _AS_AT_FIRST if again and touched else _AS_LEFT
            self.done.emit(text.format(key=self._present.keys[0]))

    def show_scene(self, arrangement: str, panels: Sequence[str]) -> None:
        """Take up the arrangement of a scene, as at first, and bring its panels in sight.

        It is the same whatever was in sight before; `leave_scene` takes it back.  While scenes are
        presented they stand as people further off can read them.

        Parameters
        ----------
        arrangement
            Its name.
        panels
            Names of panels; the last of several in one place comes to the front.
        """
        if self._before_presenting is not None:
            self._arrangements.show(PRESENTATION)
        else:
            content = self._store_own()
            if self._before_scene is None and self._present is not None:
                self._before_scene = (self._present.name, content)
            self._arrangements.show(arrangement)
        for panel in panels:
            if panel in self._docks:
                self._docks[panel].bring_forward()

    def leave_scene(self) -> None:
        """Put the docks where the user had them before a scene took up its arrangement.

        While they are presented they stay as people further off can read them.
        """
        if self._before_scene is None or self._before_presenting is not None:
            return
        self._store_own()
        (name, content), self._before_scene = self._before_scene, None
        self._arrangements.show(name)
        self.put(content)
        self._arrangements.keyboard.settle()

    def hold(self) -> None:
        """Store the present layout for the next session: what follows is for an audience."""
        self._before_presenting = (
            self._window.saveGeometry(),
            self._preferences.arrangement,
            self.own(),
        )

    def release(self) -> None:
        """Store again what follows."""
        self._before_presenting = None

    def content(self) -> bytes:
        """Return the layout for `put` and `show_panels`."""
        return bytes(self._window.saveState().data())

    def own(self) -> bytes:
        """Return the layout for `put`; empty where no dock was moved."""
        return b"" if self.settling.untouched else self.content()

    def put(self, content: bytes) -> None:
        """Restore the layout ``content`` of this window; do nothing where it is empty."""
        if content:
            self._window.restoreState(QByteArray(content))
            self.settling.forget()

    def show_panels(self, content: bytes) -> None:
        """Show and hide panels as in the layout ``content``; do nothing where it is empty.

        Of panels that share a place, one that was in sight comes to the front.

        Where they stand and how large they are stays: that belongs to this window and its screen,
        not to the one in which a file was saved.
        """
        before = self._window.saveState()
        if not content or not self._window.restoreState(QByteArray(content)):
            return
        docks = self._docks.values()
        hidden = {dock: dock.isHidden() for dock in docks}
        in_sight = [dock for dock in docks if dock.isVisible() and dock.in_sight]
        self._window.restoreState(before)
        for dock, hide in hidden.items():
            if dock.isHidden() != hide:
                dock.setHidden(hide)
        for dock in in_sight:
            if not dock.in_sight:
                dock.raise_()
        self._arrangements.keyboard.settle()

    def restore(self) -> None:
        """Restore the last session; its sizes only where its screen is there."""
        screen, layout = self._preferences.screen, self._preferences.layout
        fits = not screen or screen in map(screen_key, QGuiApplication.screens())
        if fits:
            self._window.restoreGeometry(self._preferences.geometry)
        # With the arrangement come its large words; where its docks were moved, they stand there.
        self._arrangements.show(self._preferences.arrangement)
        self._own = self._preferences.own_arrangements if fits else {}
        (self.put if fits else self.show_panels)(bytes(layout.data()))
        self._window.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if watched is self._window and event.type() == QEvent.Type.Show:
            watched.removeEventFilter(self)
            # Qt shows the window itself after this event.
            QTimer.singleShot(0, self, self._show_floating)
        return super().eventFilter(watched, event)

    def close(self) -> None:
        """Store the layout for the next session, as the window closes."""
        now = self._window.saveGeometry(), self._preferences.arrangement, self.own()
        # The next session begins without an audience, and without a scene.
        geometry, arrangement, content = self._before_presenting or now
        arrangement, content = self._before_scene or (arrangement, content)
        self._preferences.geometry, self._preferences.arrangement = geometry, arrangement
        self._preferences.layout = QByteArray(content)
        self._preferences.screen = screen_key(self._window.screen())
        self._preferences.own_arrangements = self._own
        self._preferences.flush()
        for dock in self._docks.values():
            # A panel in a window of its own does not close with this one on every desktop.
            if dock.isFloating():
                dock.hide()

    def _store_own(self) -> bytes:
        """Store and return the layout of the present arrangement; empty where no dock was moved."""
        if self._present is None or self.settling.untouched:
            return b""
        content = self._own[self._present.name] = self.content()
        return content

    def _note_arrangement(self, spec: ArrangementSpec) -> None:
        self._preferences.arrangement = spec.name
        self._present = spec

    def _show_floating(self) -> None:
        """Show panels out of the window once more, now that there is one to be in front of.

        A desktop keeps a window in front of its parent only if that was shown first.
        """
        for dock in self._docks.values():
            if dock.isFloating() and dock.isVisible():
                dock.hide()
                dock.show()
        # The window is as large as its screen lets it be.
        self.settling.refit()


def screen_key(screen: QScreen) -> str:
    """Return a key of what window sizes depend on: the room on a screen and its scale."""
    room = screen.availableGeometry()
    return f"{room.width()} x {room.height()} at {screen.devicePixelRatio():g}"


def usual_size(panel: Panel) -> QSize:
    """Return the preferred size of a panel, px."""
    return panel.sizeHint().expandedTo(panel.minimumSizeHint()).expandedTo(panel.minimumSize())


@contextmanager
def shown_off_screen(dock: Dock, width: int, height: int) -> Iterator[Callable[[], None]]:
    """Show the panel of a dock off the screen, for as long as it is drawn.

    A panel that was never shown has no layout and no results.  Yields a function that makes room
    for what has to be scrolled; call it once the results are there.

    Parameters
    ----------
    dock
        The dock, in which the panel is hidden.
    width, height
        Of the picture: the panel is of this shape, and as large as it likes to be at least.
    """
    size = usual_size(dock.panel)
    wide = max(size.width(), round(size.height() * width / max(height, 1)))
    high = max(size.height(), round(wide * height / max(width, 1)))
    stage = QWidget()
    stage.setAttribute(Qt.WidgetAttribute.WA_DontShowOnScreen)
    stage.setAttribute(Qt.WidgetAttribute.WA_ShowWithoutActivating)
    column = QVBoxLayout(stage)
    column.setContentsMargins(0, 0, 0, 0)
    with dock.lent() as panel:
        column.addWidget(panel)
        panel.show()
        stage.resize(wide, high)
        stage.show()
        try:
            yield partial(_make_room, stage)
        finally:
            column.removeWidget(panel)
            panel.setParent(None)
            stage.deleteLater()


def _make_room(stage: QWidget) -> None:
    hidden = max(
        (area.verticalScrollBar().maximum() for area in stage.findChildren(QScrollArea)), default=0
    )
    high = stage.height() + hidden
    # The shape stays the same.
    stage.resize(round(stage.width() * high / max(stage.height(), 1)), high)
