"""The four workspaces, and where the docks of a window stand in each of them."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import partial, reduce
from itertools import pairwise
from struct import unpack_from

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QByteArray, QEvent, QObject, QPointF, QSize, Qt, QTimer, Signal

from skinsource.design.panel_settings import STAGE
from skinsource_gui.qt.theme import letter_scale
from skinsource_gui.qt.windows import WindowEvents
from skinsource_gui.shell.appearance import Appearance
from skinsource_gui.shell.docks import Dock, KeyboardKeeper
from skinsource_gui.state.preferences import Preferences

_ACROSS, _DOWN = Qt.Orientation.Horizontal, Qt.Orientation.Vertical


@dataclass(frozen=True, slots=True)
class Split:
    """Panels beside each other, or above each other.

    Attributes
    ----------
    orientation
        Horizontal: beside each other.
    parts
        Names of panels, or splits of the other orientation, each with its share of the room.
    """

    orientation: Qt.Orientation
    parts: tuple[tuple["str | Split", int], ...]

    def panels(self) -> Iterator[str]:
        """Yield the names of all panels in it."""
        for part, _ in self.parts:
            if isinstance(part, Split):
                yield from part.panels()
            else:
                yield part


@dataclass(frozen=True, slots=True, kw_only=True)
class Workspace:
    """One workspace as it is at first.

    Attributes
    ----------
    name
        As scenes have it.
    split
        The panels in sight.
    host
        Another panel comes up as a tab beside this one.
    hosts
        By name of a panel, the host where it is another one.
    tabs
        Panels that are tabs from the first, behind their hosts.
    beside
        By name of a panel, the one beside which it comes up where it shares no place.
    folds
        Parts of ``split`` whose panels become tabs, one part after the other, where the window is
        too small.
    """

    name: str
    split: Split
    host: str
    hosts: Mapping[str, str] = field(default_factory=dict)
    tabs: tuple[str, ...] = ()
    beside: Mapping[str, str] = field(default_factory=dict)
    folds: tuple[Split, ...] = ()


#: Panels that fold out of the lower edge of a window that leaves its docks this height, in letters
#: of the usual size; in a lower one they come up as tabs.
_BELOW, _HIGH_PX = ("library",), 800
#: The workspace for an audience, and that for what is wired to this machine.
PRESENTATION, LAB = "presentation", "lab"

_PLOTS = Split(_DOWN, (("traces", 50), ("spectra", 50)))
_INPUTS_AND_PLOTS = Split(_ACROSS, (("hand", 25), ("inspector", 26), (_PLOTS, 49)))
_OUTPUT_AND_TRACES = Split(_DOWN, (("output", 55), ("traces", 45)))
_CALIBRATION = Split(_ACROSS, (("calibration", 55), (_OUTPUT_AND_TRACES, 45)))

WORKSPACES: tuple[Workspace, ...] = (
    Workspace(
        name="design",
        split=Split(
            _ACROSS,
            (("skin", 31), (Split(_DOWN, ((_INPUTS_AND_PLOTS, 59), ("timeline", 41))), 69)),
        ),
        host="timeline",
        beside={"analysis_2": "timeline"},
        folds=(_PLOTS, _INPUTS_AND_PLOTS),
    ),
    Workspace(
        name="analysis",
        split=Split(_ACROSS, (("skin", 32), (_PLOTS, 68))),
        # Not the skin: outputs are chosen there.
        host="spectra",
        hosts={"analysis_2": "traces"},
        tabs=("analysis",),
        folds=(_PLOTS,),
    ),
    Workspace(
        name=PRESENTATION,
        split=Split(_ACROSS, ((STAGE, 1),)),
        host=STAGE,
    ),
    Workspace(
        name=LAB,
        split=Split(_ACROSS, (("skin", 31), (_CALIBRATION, 69))),
        host="traces",
        folds=(_OUTPUT_AND_TRACES, _CALIBRATION),
    ),
)

# Around the letters of a tab; the frame of a dock.
_TAB_PX, _EDGE = 16, QSize(4, 4)
_GAP = QtWidgets.QStyle.PixelMetric.PM_DockWidgetSeparatorExtent
_PRESS, _RELEASE = QEvent.Type.MouseButtonPress, QEvent.Type.MouseButtonRelease


def shared(whole: int, shares: Sequence[int], least: Sequence[int]) -> list[int]:
    """Split ``whole`` by ``shares``, but give each part what it needs at least, if that fits."""
    total = sum(shares)
    parts = [max(whole * share // total, need) for share, need in zip(shares, least, strict=True)]
    spare = sum(parts) - sum(least)
    excess = min(sum(parts) - whole, spare)
    if excess > 0 and spare > 0:
        cuts = [excess * (part - need) // spare for part, need in zip(parts, least, strict=True)]
        parts = [part - cut for part, cut in zip(parts, cuts, strict=True)]
    return parts


#: For each dock, whether it is hidden, floating, and in sight.
_State = dict[str, tuple[bool, bool, bool]]


@dataclass(frozen=True, slots=True)
class _Before:
    """What a presentation leaves: geometry and size of the window, workspace and layout."""

    geometry: QByteArray
    size: QSize
    name: str
    layout: bytes


class Workspaces(QObject):
    """Puts the docks of a window into a workspace, and remembers each as it is left.

    Parameters
    ----------
    window
        Holds the docks; also the parent.
    docks
        By the name of their panel, in the order in which the keyboard reaches them.
    preferences
        Store the workspaces between sessions.
    appearance
        Size of letters.
    """

    #: The name of the workspace that is shown from now on.
    shown = Signal(str)

    def __init__(
        self,
        window: QtWidgets.QMainWindow,
        docks: Mapping[str, Dock],
        preferences: Preferences,
        appearance: Appearance,
    ) -> None:
        super().__init__(window)
        self._window, self._docks = window, docks
        self._preferences, self._appearance = preferences, appearance
        self._keyboard = KeyboardKeeper(window, docks)
        self._present = WORKSPACES[0]
        # Layouts of the user, by the name of the workspace.
        self._own: dict[str, bytes] = {}
        # Whether docks, or the lines between them, were moved since they were arranged.
        self._moved = self._is_arranging = False
        # Whether they stand in place of a layout of the user that was too large.
        self._fitted = False
        # Parts of the workspace that are tabs, since the window is too small.
        self._folded: tuple[Split, ...] = ()
        # Those that fold out of the lower edge.
        self._below: tuple[str, ...] = ()
        self._arranged: _State = {}
        self._at_press = b""
        # The workspace before a scene took up its own.
        self._before_scene = ""
        #: Whether the window stands where the last session left it.
        self.is_placed = False
        # What a presentation has left, and what waits for the window to have its size again.
        self._before_show: _Before | None = None
        self._awaited: _Before | None = None
        # How high some panels must be is known once they have their width.
        self._settling = QTimer(self, singleShot=True, interval=0)
        self._settling.timeout.connect(self._settle)
        # Panels that got their first room since the docks were arranged.
        self._unfolded: set[str] = set()
        for name, dock in docks.items():
            dock.topLevelChanged.connect(self._note_move)
            dock.toggleViewAction().toggled.connect(partial(self._note_shown_panel, name))
        appearance.changed.connect(self._follow_letters)
        WindowEvents.follow(window, self._note_press, _PRESS)
        WindowEvents.follow(window, self._note_release, _RELEASE)
        WindowEvents.follow(window, self._note_size, QEvent.Type.Resize)
        WindowEvents.follow(window, self._note_shown, QEvent.Type.Show)

    @property
    def settled(self) -> bool:
        """Whether the docks stand where they were put."""
        return not self._settling.isActive()

    def choose(self, name: str) -> None:
        """Show a workspace as it was left."""
        self._before_scene = ""
        if name == self._present.name:
            return
        self._store_own()
        self._show(name)
        self.put(self._own.get(name, b""))
        self._keyboard.settle()

    def reset(self) -> None:
        """Show the present workspace as it was at first."""
        self._own.pop(self._present.name, None)
        self._fitted = False
        self._show(self._present.name)

    def show_scene(self) -> None:
        """Show the stage as it was left; `leave_scene` leaves it."""
        if self._before_show is not None:
            self._show(PRESENTATION)
            return
        before = self._before_scene or self._present.name
        self.choose(PRESENTATION)
        self._before_scene = before

    def leave_scene(self) -> None:
        """Show the workspace that was there before the scene; in a presentation it stays."""
        if self._before_scene and self._before_show is None:
            self.choose(self._before_scene)

    def begin_show(self) -> None:
        """Show the workspace for an audience."""
        window = self._window
        # Empty where the docks stand as they were arranged.
        layout = b"" if self._untouched else self.content()
        geometry, name = window.saveGeometry(), self._present.name
        self._before_show = _Before(geometry, window.size(), name, layout)
        self._docks[STAGE].setContextMenuPolicy(Qt.ContextMenuPolicy.NoContextMenu)
        self.show_scene()

    def end_show(self) -> None:
        """Show what was there before the presentation."""
        before, self._before_show = self._before_show, None
        self._docks[STAGE].setContextMenuPolicy(Qt.ContextMenuPolicy.DefaultContextMenu)
        if before is not None:
            self._show(before.name)
            self.put(before.layout)
            self._awaited = before

    def bring(self, panel: str) -> None:
        """Bring a panel into sight without moving others."""
        if panel in self._docks:
            self._docks[panel].bring_forward()

    def content(self) -> bytes:
        """Return the layout for `put`."""
        return bytes(self._window.saveState().data())

    def put(self, content: bytes) -> None:
        """Restore the layout ``content`` of this window; do nothing where it is empty.

        Of one that is too large for the screen only which panels are in sight is taken.
        """
        if content:
            with self._arranging():
                known = self._window.restoreState(QByteArray(content))
            self._settling.stop()
            self._moved = True
            room = self._window.screen().availableSize().expandedTo(self._window.size())
            # Where the window is about to stand as it was left, its layout fits.
            known = known and not (self.is_placed and self._window.isHidden())
            # A layout of Qt begins with the size of all docks, behind some numbers.
            if known and QSize(*unpack_from(">ii", content, 17)).expandedTo(room) != room:
                self._show_anew()
                self._fitted = True

    def restore(self) -> None:
        """Restore the last session; place and size of the window only where its screen is there."""
        screen = self._preferences.screen
        fits = not screen or screen in map(screen_key, QtGui.QGuiApplication.screens())
        self.is_placed = fits and not self._preferences.geometry.isEmpty()
        if self.is_placed:
            self._window.restoreGeometry(self._preferences.geometry)
        self._own = self._preferences.own_arrangements
        self._show(self._preferences.arrangement)
        self.put(self._own.get(self._present.name, b""))

    def close(self) -> None:
        """Store the workspaces for the next session, which begins without scene and audience."""
        self._store_own()
        name, geometry = self._present.name, self._window.saveGeometry()
        if self._before_show is not None:
            name, geometry = self._before_show.name, self._before_show.geometry
            self._own[name] = self._before_show.layout
        self._preferences.geometry = geometry
        self._preferences.arrangement = self._before_scene or name
        self._preferences.screen = screen_key(self._window.screen())
        self._preferences.own_arrangements = self._own
        self._preferences.flush()
        for dock in self._docks.values():
            # A panel in a window of its own does not close with this one on every desktop.
            if dock.isFloating():
                dock.hide()

    def _show(self, name: str) -> None:
        """Put the docks where they are in a workspace at first."""
        named = {workspace.name: workspace for workspace in WORKSPACES}
        self._present = workspace = named.get(name, WORKSPACES[0])
        self._unfolded.clear()
        # Letters of another size share no room before the docks stand.
        self._moved = True
        self._preferences.arrangement = workspace.name
        self._folded, self._below = self._folds(), self._fold_out()
        in_sight = tuple(workspace.split.panels())
        with self._arranging():
            for dock in self._docks.values():
                dock.setFloating(False)
                self._window.removeDockWidget(dock)
            self._window.addDockWidget(
                Qt.DockWidgetArea.TopDockWidgetArea, self._docks[in_sight[0]]
            )
            for panel in self._below:
                self._window.splitDockWidget(self._docks[in_sight[0]], self._docks[panel], _DOWN)
            self._place(workspace.split)
            for panel, neighbour in workspace.beside.items():
                # A dock that is a tab takes no other one beside it.
                self._window.splitDockWidget(self._docks[neighbour], self._docks[panel], _ACROSS)
            for panel, dock in self._docks.items():
                if panel not in (*in_sight, *workspace.beside, *self._below):
                    host = workspace.hosts.get(panel, workspace.host)
                    self._window.tabifyDockWidget(self._docks[host], dock)
                dock.setVisible(panel in (*in_sight, *workspace.tabs))
            for panel in reversed(in_sight):
                self._docks[panel].raise_()
        self._moved = False
        self._share_room()
        self._settling.start()
        if name == PRESENTATION:
            self._docks[STAGE].panel.setFocus()
        self._keyboard.settle()
        self.shown.emit(workspace.name)

    def _show_anew(self) -> None:
        """Put the docks where they are at first, and keep which of them are in sight."""
        before = self._state()
        self._show(self._present.name)
        for name, (hidden, _, in_sight) in before.items():
            dock = self._docks[name]
            if hidden:
                dock.hide()
            elif dock.isHidden():
                dock.bring_forward() if in_sight else dock.show()

    def _place(self, split: Split) -> None:
        parts = (part for part, _ in split.parts)
        firsts = (part if isinstance(part, str) else next(part.panels()) for part in parts)
        docks = [self._docks[first] for first in firsts]
        for before, after in pairwise(docks):
            if split in self._folded:
                self._window.tabifyDockWidget(before, after)
            else:
                self._window.splitDockWidget(before, after, split.orientation)
        for part, _ in split.parts:
            if isinstance(part, Split):
                self._place(part)

    def _share_room(self) -> None:
        """Give the panels of the present workspace their first sizes."""
        room = self._room()
        for panel in self._below:
            if self._docks[panel].in_sight:
                height = self._docks[panel].panel.sizeHint().height()
                room -= QSize(0, height + self._window.style().pixelMetric(_GAP))
        self._share(self._present.split, room)

    def _room(self) -> QSize:
        window = self._window
        bars = [window.menuWidget(), window.statusBar()]
        shown = [bar for bar in bars if not bar.isHidden()]
        around = sum(min(bar.sizeHint().height(), bar.maximumHeight()) for bar in shown)
        return window.size() - QSize(0, around)

    def _folds(self) -> tuple[Split, ...]:
        """Return the parts that must be tabs for all panels to have the room that they need."""
        room, split = self._room(), self._present.split
        for count in range(len(self._present.folds) + 1):
            self._folded = self._present.folds[:count]
            least = self._least(split)
            if least.width() <= room.width() and least.height() <= room.height():
                break
        return self._folded

    def _fold_out(self) -> tuple[str, ...]:
        high = self._room().height() >= _HIGH_PX * letter_scale(self._window.font())
        return _BELOW if high else ()

    def _share(self, split: Split, room: QSize) -> None:
        gap_px = self._window.style().pixelMetric(_GAP)
        across = split.orientation == _ACROSS
        whole = room.width() if across else room.height()
        needs = [self._least(part) for part, _ in split.parts]
        least = [need.width() if across else need.height() for need in needs]
        shares = [share for _, share in split.parts]
        sizes = shared(whole - gap_px * (len(shares) - 1), shares, least)
        docks = [self._docks[_edge(part)] for part, _ in split.parts]
        self._window.resizeDocks(docks, sizes, split.orientation)
        for (part, _), size in zip(split.parts, sizes, strict=True):
            if isinstance(part, Split) and part not in self._folded:
                self._share(
                    part,
                    QSize(size, room.height()) if across else QSize(room.width(), size),
                )

    def _least(self, part: str | Split) -> QSize:
        """Return the least room in which nothing of the panels has to scroll."""
        if isinstance(part, str):
            panel = self._docks[part].panel
            return panel.minimumSize().expandedTo(panel.minimumSizeHint()) + _EDGE
        needs = [self._least(inner) for inner, _ in part.parts]
        if part in self._folded:
            tab_px = self._window.fontMetrics().height() + _TAB_PX
            return reduce(QSize.expandedTo, needs) + QSize(0, tab_px)
        gap_px = self._window.style().pixelMetric(_GAP) * (len(needs) - 1)
        widths, heights = [need.width() for need in needs], [need.height() for need in needs]
        if part.orientation == _ACROSS:
            return QSize(sum(widths) + gap_px, max(heights))
        return QSize(max(widths), sum(heights) + gap_px)

    @property
    def _untouched(self) -> bool:
        """Whether the docks stand as they were arranged."""
        return not self._moved and (not self.settled or self._state() == self._arranged)

    def _state(self) -> _State:
        return {
            name: (dock.isHidden(), dock.isFloating(), dock.in_sight)
            for name, dock in self._docks.items()
        }

    def _store_own(self) -> None:
        if self._before_show is None and (self._fitted or not self._untouched):
            self._own[self._present.name] = self.content()
        self._fitted = False

    @contextmanager
    def _arranging(self) -> Iterator[None]:
        # Qt looks for the edge that was below the mouse at the next key, and ends if it is gone.
        left = QtGui.QHoverEvent(QEvent.Type.HoverLeave, QPointF(), QPointF(), QPointF())
        QtWidgets.QApplication.sendEvent(self._window, left)
        self._is_arranging = True
        try:
            yield
        finally:
            self._is_arranging = False

    def _settle(self) -> None:
        folded = self._folded
        if len(self._folds()) > len(folded):
            # Panels that were hidden know only now what they need in larger letters.
            self._show(self._present.name)
            return
        self._folded = folded
        self._share_room()
        self._arranged = self._state()

    def _follow_letters(self) -> None:
        self._refit()
        # Panels behind others know what they need in other letters a moment later.
        QTimer.singleShot(0, self, self._refit)

    def _refit(self) -> None:
        """Share the room anew among docks that were not moved."""
        if not self._untouched:
            return
        before = self._folded, self._below
        if (self._folds(), self._fold_out()) != before:
            self._show_anew()
        else:
            self._settling.start()

    def _note_move(self) -> None:
        self._moved = self._moved or not self._is_arranging

    def _note_shown_panel(self, panel: str, shown: bool) -> None:
        if shown and not self._is_arranging and panel not in self._unfolded:
            self._unfolded.add(panel)
            # Qt finds a place for it first.
            QTimer.singleShot(0, self, partial(self._unfold, panel))

    def _unfold(self, panel: str) -> None:
        """Give a panel its first room, at the lower edge or beside another one."""
        dock, neighbour = self._docks[panel], self._present.beside.get(panel)
        if panel in self._below and not self._window.tabifiedDockWidgets(dock):
            height = dock.panel.sizeHint().height()
            above = self._docks[_edge(self._present.split)]
            rest = above.height() + dock.height() - height
            self._window.resizeDocks([above, dock], [rest, height], _DOWN)
        elif neighbour is not None:
            # Another one may be in front of the neighbour, in the same place.
            shared_by = self._window.tabifiedDockWidgets(self._docks[neighbour])
            beside = next(
                (other for other in self._docks.values() if other in shared_by and other.in_sight),
                self._docks[neighbour],
            )
            half_px = (beside.width() + dock.width()) // 2
            self._window.resizeDocks([beside, dock], [half_px, half_px], _ACROSS)

    def _note_press(self, _event: QEvent) -> None:
        # The window itself has only the lines between its docks.
        self._at_press = self.content()

    def _note_release(self, _event: QEvent) -> None:
        # Qt moves a line a moment later.
        QTimer.singleShot(0, self, self._compare_lines)

    def _compare_lines(self) -> None:
        self._moved = self._moved or self.content() != self._at_press

    def _note_size(self, _event: QEvent) -> None:
        if self._awaited is not None and self._window.size() == self._awaited.size:
            self.put(self._awaited.layout)
            self._awaited = None
        self._refit()

    def _note_shown(self, _event: QEvent) -> None:
        # Qt shows the window itself after this event.
        QTimer.singleShot(0, self, self._show_floating)

    def _show_floating(self) -> None:
        """Show panels out of the window once more, now that there is one to be in front of.

        A desktop keeps a window in front of its parent only if that was shown first.
        """
        for dock in self._docks.values():
            if dock.isFloating() and dock.isVisible():
                dock.hide()
                dock.show()


def _edge(part: str | Split) -> str:
    """Return a panel of a part that is as long as the part, across its own orientation."""
    if isinstance(part, str):
        return part
    return next(inner for inner, _ in part.parts if isinstance(inner, str))


def screen_key(screen: QtGui.QScreen) -> str:
    """Return a key of what window sizes depend on: the room on a screen and its scale."""
    room = screen.availableGeometry()
    return f"{room.width()} x {room.height()} at {screen.devicePixelRatio():g}"
