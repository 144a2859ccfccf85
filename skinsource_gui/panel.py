"""What every panel is."""

from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import Any, ClassVar

from PySide6.QtCore import QPoint, Signal
from PySide6.QtGui import QHideEvent, QShowEvent
from PySide6.QtWidgets import QWidget

from skinsource.design.design import Design
from skinsource.design.signal_path import UnplayableInput
from skinsource.design.view import View
from skinsource_gui.compares import ComparesDesigns
from skinsource_gui.history import History
from skinsource_gui.widgets.drop_place import DropPlace
from skinsource_gui.widgets.empty_words import USUALLY_IN_SIGHT
from skinsource_gui.widgets.over.cover import Cover

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
