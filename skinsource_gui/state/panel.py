"""What tells the eye that it shows results of an older design, and hands none of them out."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any, ClassVar

from PySide6.QtCore import QPoint, Signal
from PySide6.QtGui import QHideEvent, QShowEvent
from PySide6.QtWidgets import QWidget

from skinsource.design.comparing import Snapshot
from skinsource.design.design import Design
from skinsource.design.signal_path import UnplayableInput
from skinsource.design.view import View
from skinsource_gui.plots.preview import PointsAtInputs
from skinsource_gui.qt.asking import CopyButton
from skinsource_gui.qt.frames import DropPlace
from skinsource_gui.qt.labels import USUALLY_IN_SIGHT
from skinsource_gui.qt.overlays import Cover, Staleness, StaleOverlay
from skinsource_gui.state.compared import Compared
from skinsource_gui.state.history import History


class ShowsStaleness(PointsAtInputs):
    """Is told whether what it shows is out of date.

    What has been so for a while is veiled and cannot be copied; what comes into sight so, at once.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        #: Parts that are veiled, as they say nothing themselves of what belongs to which design.
        self.computed: tuple[QWidget, ...] = ()
        #: Whether somebody begins to look now: what was drawn meanwhile was never seen to change.
        self.comes_into_sight = False
        self._veils: list[StaleOverlay] = []
        self._lateness = Staleness(self)
        self._lateness.changed.connect(self._follow_lateness)

    @property
    def late(self) -> bool:
        """Whether it tells that what it shows belongs to an older design."""
        return self._lateness.late

    def show_stale(self, stale: bool) -> None:
        """Say whether what is drawn belongs to an older design than the present one."""
        self._lateness.set_stale(stale, at_once=self.comes_into_sight)

    def show_newer(self) -> None:
        """Newer results were drawn, if not the newest: it is given time for those anew."""
        self._lateness.count_anew()

    def show_late(self, stale: bool) -> None:
        """Let it be seen that what is drawn belongs to an older design, or does no more."""
        while self._veils:
            self._veils.pop().take_away()
        if stale:
            self._veils = [StaleOverlay(part) for part in self.computed]

    def _follow_lateness(self, stale: bool) -> None:
        for button in self.findChildren(CopyButton):
            button.show_late(stale)
        self.show_late(stale)


# What wants to know of more designs than the one in the window.


class ComparesDesigns(ShowsStaleness):
    """Names what it needs of snapshots, and of the present design on limbs; is told while visible.

    Nothing is computed of either unless something is needed of it.
    """

    @property
    def needs_of_snapshots(self) -> frozenset[str]:
        """Names of the quantities of each snapshot that `show_snapshots` draws; none: not told."""
        return frozenset()

    @property
    def needs_on_limbs(self) -> Mapping[str, frozenset[str]]:
        """Names of the quantities that `show_on_limbs` draws of the design on limbs, by limb.

        None: it is not told.
        """
        return {}

    def snapshots_drawn(self, snapshots: Sequence[Snapshot]) -> Sequence[Snapshot]:
        """Which of the designs that it is told of it draws."""
        return snapshots

    def show_snapshots(self, compared: Sequence[Compared]) -> None:
        """Draw the designs side by side; called while it is visible."""

    def show_on_limbs(self, compared: Sequence[Compared]) -> None:
        """Draw the present design on the limbs of `needs_on_limbs`; called while it is visible."""


# What every panel is.

#: What a panel is told in place of a problem while nothing has been predicted yet.
PREPARING = "Preparing…"


class Panel(ComparesDesigns):
    """A view of the design and of computed quantities.

    A panel names what it ``needs`` and draws what it is given.  It starts no computation, and
    while it is hidden nothing is computed for it.  What the user wants is told by signals.
    """

    #: Words of the dock's title; `objectName` of the dock; a sentence for its tooltip.
    title: ClassVar[str] = ""
    name: ClassVar[str] = ""
    #: Whether it wants to know the history, see `show_history`.
    lists_history: ClassVar[bool] = False
    #: Whether Tab goes from top to bottom, as its fields stand, whenever each was made.
    reads_down: ClassVar[bool] = False

    #: `Edit` or `Refusal`, number of the gesture or None.
    edited = Signal(object, object)
    #: The new `View`, of what is only looked at.
    view_changed = Signal(object)
    #: The name of an action of the window, such as "export_picture".
    action_wanted = Signal(str)
    #: Where the playhead shall be, s.  What else a panel tells leaves it where it is.
    playhead_wanted = Signal(float)
    visibility_changed = Signal()
    #: How many steps of the history shall be done.
    step_wanted = Signal(int)
    #: Number of the snapshot that shall be shown.
    snapshot_wanted = Signal(int)
    #: A sentence that says why something the user asked this panel for was not done.
    failed = Signal(str)
    #: Words on what the user asked this panel for, and it did: what had failed before is over.
    done = Signal(str)
    #: A file that the user asked this panel for was written there, `Path`.
    written = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        #: Names of the panels that can be used beside it.
        self.in_sight = USUALLY_IN_SIGHT
        #: Parts that show what the map of the skin shows: they are covered together with it.
        self.guessed: tuple[QWidget, ...] = ()
        self._covers: list[Cover] = []
        # The window behind is not painted again for each change in here.
        self.setAutoFillBackground(True)
        #: What stands below a picture of it; the window says how to find out.
        self.caption: Callable[[], str] = str
        #: While this lasts it shows no matched levels: it is for what is taken out of it.
        self.as_stored: Callable[[], AbstractContextManager[None]] = nullcontext
        #: Where something would go in another panel that is dragged from here and held over a
        #: place of the screen; None: it is let go.  The window says how to find out.
        self.held_over: Callable[[QPoint | None], DropPlace | None] = _nowhere

    @property
    def needs(self) -> frozenset[str]:
        """Names of the quantities that `show_results` draws."""
        return frozenset()

    def show_state(self, design: Design, view: View) -> None:
        """Take over the present design and view, before any results.

        Called when it is made and at each change while it is visible; what has changed while it
        was hidden is told when it comes into sight.
        """

    def show_playhead(self, view: View) -> None:
        """Take over a view in which the playhead alone has moved; at each step while it plays.

        `show_state` tells where it is too, but is not called for this.
        """

    def begin_anew(self) -> None:
        """Let the next results be drawn as if there had been none before: nothing is held."""

    def show_results(self, results: Mapping[str, Any]) -> None:
        """Draw ``results``, which holds at least the quantities in ``needs``."""

    def show_problem(self, reason: str) -> None:
        """Empty the picture and say why there is none."""

    def show_noisy(self, outputs: tuple[int, ...]) -> None:
        """Take over at which outputs the prediction is mostly noise; once that was judged."""

    def show_unplayable(self, unplayable: tuple[UnplayableInput, ...]) -> None:
        """Take over which inputs cannot be played; the results that follow are without them."""

    def show_history(self, history: History) -> None:
        """Take over what was done; called while it is visible, where it lists that."""

    def show_in_sight(self, names: frozenset[str]) -> None:
        """Take over which panels are in sight, so that no words lead to one that is not."""
        self.in_sight = names

    def show_covered(self, covered: bool) -> None:
        """Hide what is to be guessed, in front of an audience; or reveal it."""
        while self._covers:
            self._covers.pop().take_away()
        if covered:
            self._covers = [Cover(part) for part in self.guessed]

    def show_folder(self, folder: Path) -> None:
        """Take over where the next file is to be suggested."""

    def drop_place(self, at: QPoint) -> DropPlace | None:
        """Where something that is dropped at ``at`` goes; None: nowhere in particular."""
        del at
        return None

    def show_drop(self, at: QPoint | None) -> None:
        """Show where something would go that is held over ``at``; None: it is elsewhere."""

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self.comes_into_sight = True
        self.visibility_changed.emit()
        self.comes_into_sight = False

    def hideEvent(self, event: QHideEvent) -> None:
        super().hideEvent(event)
        self.visibility_changed.emit()


def _nowhere(at: QPoint | None) -> None:
    """Without a window there is no other panel."""
    del at


# A panel that is imported when it is first made.


@dataclass(frozen=True, slots=True)
class LazyPanel:
    """What a window has to know of a panel before it is there.

    Called, it makes the panel: the class that has its name, with "Panel" behind, in the module
    ``panel`` of its folder.

    Attributes
    ----------
    name, title
        Those of its class.
    """

    name: str
    title: str

    @property
    def type(self) -> type[Panel]:
        """Its class, imported now if it was not before."""
        module = import_module(f"skinsource_gui.panels.{self.name}.panel")
        words = (word.capitalize() for word in self.name.split("_"))
        panel_type: type[Panel] = getattr(module, f"{''.join(words)}Panel")
        if (panel_type.name, panel_type.title) != (self.name, self.title):
            raise ValueError(
                f"{panel_type.__name__} says of itself {panel_type.name!r}, {panel_type.title!r}; the table of "
                f"panels says {self.name!r}, {self.title!r}. Make them the same."
            )
        return panel_type

    def __call__(self) -> Panel:
        return self.type()


# The panels of a window that somebody has looked at.

#: Does what is to be done once with each panel.
Meet = Callable[[Panel], object]


class PanelRegistry:
    """Makes each panel when it first comes into sight or is asked for, and knows those it made.

    What has to do with panels goes through those there are, each time anew, and says with `each`
    what is to be done with one when it is made.

    Parameters
    ----------
    makers
        What makes each, by its name, in the order in which the keyboard reaches them.
    """

    def __init__(self, makers: Mapping[str, Callable[[], Panel]]) -> None:
        self._makers = makers
        self._made: dict[str, Panel] = {}
        self._in_order: tuple[Panel, ...] = ()
        self._meetings: list[Meet] = []

    @classmethod
    def of(cls, *panels: Panel) -> "PanelRegistry":
        """Panels that stand already."""
        made = cls({panel.name: partial(_itself, panel) for panel in panels})
        for panel in panels:
            made[panel.name]
        return made

    def __iter__(self) -> Iterator[Panel]:
        # One that is made meanwhile does not come into it.
        return iter(self._in_order)

    def __contains__(self, name: str) -> bool:
        """Whether the panel of that name was made."""
        return name in self._made

    def __getitem__(self, name: str) -> Panel:
        """The panel of that name; it is made if nobody has wanted it before."""
        panel = self._made.get(name)
        if panel is None:
            panel = self._made[name] = self._makers[name]()
            self._in_order = tuple(self._made[name] for name in self._makers if name in self._made)
            for meet in tuple(self._meetings):
                meet(panel)
        return panel

    def each(self, meet: Meet) -> None:
        """Have ``meet`` called for each panel there is, and for each other once it is made."""
        self._meetings.append(meet)
        for panel in self._in_order:
            meet(panel)


def _itself(panel: Panel) -> Panel:
    return panel
