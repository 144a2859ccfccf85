"""Arrangements of the docks to start from."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

from PySide6.QtCore import QObject, QSize, Qt, Signal
from PySide6.QtWidgets import QApplication, QMainWindow

from skinsource_gui.shell.docks.dock import Dock
from skinsource_gui.shell.docks.kept_keyboard import KeptKeyboard

_ACROSS, _DOWN = Qt.Orientation.Horizontal, Qt.Orientation.Vertical
# Title and frame of a dock; what lies above and below all docks.
_TITLE_PX, _EDGE_PX, _AROUND_PX = 30, 4, 96
_TOP = Qt.DockWidgetArea.TopDockWidgetArea


@dataclass(frozen=True, slots=True)
class Place:
    """Where a panel stands in an arrangement.

    Attributes
    ----------
    column
        From the left, 0 is the first.  Panels of one column stand in the order of their table.
    height
        Share of the column's height, beside the shares of the others.
    at_foot
        Whether it stands below all columns, in a row of its own as wide as the window; ``column``
        is then its place in that row, and ``height`` its share of the window.
    """

    column: int
    height: int = 40
    at_foot: bool = False


@dataclass(frozen=True, slots=True)
class Behind:
    """Where a panel comes up that an arrangement does not show: as a tab with another one.

    Attributes
    ----------
    panel
        Name of one that has a place of its own in the arrangement.
    """

    panel: str


@dataclass(frozen=True, slots=True, kw_only=True)
class ArrangementSpec:
    """One arrangement.

    Attributes
    ----------
    name, text, hint, keys
        As those of an action; ``text`` goes on after "Arrange for".
    columns
        Widths of the columns, as shares.
    host
        Name of the panel with which those come up that it does not show, if nothing else is said.
    text_scale
        Size of all words, beside the size that is chosen otherwise.
    """

    name: str
    text: str
    hint: str
    keys: tuple[str, ...]
    columns: tuple[int, ...]
    host: str
    text_scale: float = 1.0


ARRANGEMENTS: tuple[ArrangementSpec, ...] = (
    ArrangementSpec(
        name="design",
        text="designing",
        hint="All panels, the hand and the skin in front",
        keys=("Alt+1",),
        columns=(22, 25, 24, 29),
        host="inspector",
    ),
    ArrangementSpec(
        name="drawing",
        text="drawing",
        hint="One clip large, to draw and to shape it, beside what the skin does",
        keys=("Alt+2",),
        columns=(28, 72),
        host="skin",
    ),
    ArrangementSpec(
        name="analysis",
        text="analysis",
        hint="The skin, traces and spectra, large",
        keys=("Alt+3",),
        columns=(32, 68),
        # Not the skin: outputs are chosen there.
        host="spectra",
    ),
    ArrangementSpec(
        name="presentation",
        text="presenting",
        hint="The hand, the skin, and frequency and amplitude to turn, in large words",
        keys=("Alt+4",),
        columns=(50, 50),
        host="hand",
        text_scale=1.25,
    ),
)

#: For each panel its place in each arrangement, or behind what it comes up; None: behind the host.
Places = Mapping[str, Mapping[str, Place | Behind | None]]


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
        self.keyboard = KeptKeyboard(window, docks)

    def show(self, name: str) -> None:
        """Take up the arrangement ``name``; the first one where it is not known."""
        spec = next((one for one in ARRANGEMENTS if one.name == name), ARRANGEMENTS[0])
        self.chosen.emit(spec)
        self.text_scaled.emit(spec.text_scale)
        places = {panel: self._place(panel, spec) for panel in self._docks}
        shown = {panel: one for panel, one in places.items() if isinstance(one, Place)}
        foot = [panel for panel, place in shown.items() if place.at_foot]
        foot.sort(key=lambda panel: shown[panel].column)
        columns = self._columns(shown, spec, without=foot)
        with self.keyboard.kept():
            self._put(columns, foot)
            for panel, place in places.items():
                if isinstance(place, Behind):
                    self._window.tabifyDockWidget(self._docks[place.panel], self._docks[panel])
            for panel, dock in self._docks.items():
                dock.setVisible(panel in shown)
            self._share_room(columns, foot, shown, spec)
        # A panel that was a window of its own may have had the keyboard.
        if QApplication.activeWindow() is not self._window:
            self._window.activateWindow()

    def bring(self, panel: str) -> None:
        """Bring a panel into sight, where it stands: no other one is moved."""
        self._docks[panel].bring_forward()

    def _place(self, panel: str, spec: ArrangementSpec) -> Place | Behind:
        places = self._places.get(panel, {})
        return places.get(spec.name, Place(len(spec.columns) - 1)) or Behind(spec.host)

    def _columns(
        self, shown: Mapping[str, Place], spec: ArrangementSpec, without: Sequence[str]
    ) -> list[list[str]]:
        columns: list[list[str]] = [[] for _ in spec.columns]
        for panel, place in shown.items():
            if panel not in without:
                columns[min(place.column, len(columns) - 1)].append(panel)
        return [column for column in columns if column]

    def _put(self, columns: Sequence[Sequence[str]], foot: Sequence[str]) -> None:
        for dock in self._docks.values():
            dock.setFloating(False)
            self._window.removeDockWidget(dock)
        tops = [self._docks[column[0]] for column in columns]
        self._window.addDockWidget(_TOP, tops[0])
        # First what lies below all columns: what is split later stays above it.
        below_all = [self._docks[panel] for panel in foot]
        for first in below_all[:1]:
            self._window.splitDockWidget(tops[0], first, _DOWN)
        for left, right in pairwise(below_all):
            self._window.splitDockWidget(left, right, _ACROSS)
        for left, right in pairwise(tops):
            self._window.splitDockWidget(left, right, _ACROSS)
        for column in columns:
            for above, below in pairwise(column):
                self._window.splitDockWidget(self._docks[above], self._docks[below], _DOWN)

    def _share_room(
        self,
        columns: Sequence[Sequence[str]],
        foot: Sequence[str],
        places: Mapping[str, Place],
        spec: ArrangementSpec,
    ) -> None:
        shares = [
            spec.columns[min(places[one[0]].column, len(spec.columns) - 1)] for one in columns
        ]
        least = [max(self._least(panel).width() for panel in column) for column in columns]
        self._window.resizeDocks(
            [self._docks[column[0]] for column in columns],
            shared(self._window.width(), shares, least),
            _ACROSS,
        )
        height = self._window.height() - _AROUND_PX
        if foot:
            share = max(places[panel].height for panel in foot)
            needed = [
                max(sum(self._least(panel).height() for panel in column) for column in columns),
                max(self._least(panel).height() for panel in foot),
            ]
            height, below = shared(height, (100 - share, share), needed)
            first = self._docks[columns[0][0]]
            self._window.resizeDocks([first, self._docks[foot[0]]], [height, below], _DOWN)
        for column in columns:
            docks = [self._docks[panel] for panel in column]
            parts = [places[panel].height for panel in column]
            least = [self._least(panel).height() for panel in column]
            self._window.resizeDocks(docks, shared(height, parts, least), _DOWN)

    def _least(self, panel: str) -> QSize:
        """Return the least room in which nothing of the panel has to scroll."""
        content = self._docks[panel].panel
        size = content.minimumSize().expandedTo(content.minimumSizeHint())
        return size + QSize(_EDGE_PX, _TITLE_PX)


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
    given = dict(zip(others, among, strict=True))
    return [given.get(k, need) for k, need in enumerate(least)]
