"""What a panel is, how it is imported when first used, and the registry of those that were made."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from importlib import import_module
from pathlib import Path
from typing import Any, ClassVar

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QPoint, Qt, Signal

from skinsource.design.design import Design, Snapshot, View
from skinsource.design.panel_settings import with_settings
from skinsource.design.signal_path import UnplayableInput
from skinsource_gui.plots.pictures import DrawableWidget
from skinsource_gui.qt.frames import DropPlace
from skinsource_gui.qt.labels import HOW_TO_SELECT_OUTPUT
from skinsource_gui.qt.overlays import Cover, Staleness, StaleOverlay
from skinsource_gui.qt.questions import CopyButton
from skinsource_gui.state.compared import Compared


class ShowsStaleness(DrawableWidget):
    """Shows whether its results are out of date.

    Results that are stale for a while get an overlay and cannot be copied; a panel that comes into
    sight with stale results gets it at once.
    """

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        #: Parts that get the overlay, as they do not show themselves that they are stale.
        self.computed: tuple[QtWidgets.QWidget, ...] = ()
        #: Whether it comes into sight just now.
        self.comes_into_sight = False
        self._overlays: list[StaleOverlay] = []
        self._staleness = Staleness(self)
        self._staleness.changed.connect(self._follow_staleness)

    @property
    def is_stale(self) -> bool:
        """Whether it is shown that the results belong to an older design."""
        return self._staleness.is_stale

    def show_stale(self, stale: bool) -> None:
        """Take over whether the results belong to an older design than the present one."""
        self._staleness.set_stale(stale, at_once=self.comes_into_sight)

    def show_newer(self) -> None:
        """Begin the waiting time anew: newer results were drawn, though not the newest."""
        self._staleness.restart()

    def show_staleness(self, stale: bool) -> None:
        """Show or remove the overlays of stale results."""
        while self._overlays:
            self._overlays.pop().take_away()
        if stale:
            self._overlays = [StaleOverlay(part) for part in self.computed]

    def _follow_staleness(self, stale: bool) -> None:
        for button in self.findChildren(CopyButton):
            button.show_staleness(stale)
        self.show_staleness(stale)


#: What a panel shows until the first prediction.
PREPARING = "Preparing…"


class Panel(ShowsStaleness):
    """A view of the design and of computed quantities.

    A panel names the quantities that it ``needs`` and draws them.  It starts no computation, and
    while it is hidden nothing is computed for it.  What the user wants is emitted as signals.

    A panel may also need quantities of the snapshots, and of the present design on other limbs.
    They are computed only while something is needed of them.
    """

    #: Title of the dock; its `objectName`.
    title: ClassVar[str] = ""
    name: ClassVar[str] = ""
    #: Whether it may need quantities of snapshots, or of the design on other limbs.
    compares: ClassVar[bool] = False
    #: Whether Tab goes from top to bottom, as its fields stand, whenever each was made.
    reads_down: ClassVar[bool] = False

    # The present ones, from the first `show_state` on.
    _design = Design(limb="")
    _view = View()

    #: `Edit` or `Refusal`, number of the gesture or None.
    edited = Signal(object, object)
    #: The new `View`.
    view_changed = Signal(object)
    #: The name of an action of the window, such as "export_picture".
    action_requested = Signal(str)
    #: The new time of the playhead, s; the other signals do not move it.
    playhead_requested = Signal(float)
    visibility_changed = Signal()
    #: Number of the snapshot to show.
    snapshot_requested = Signal(int)
    #: Why something that the user wanted of this panel was not done, a sentence.
    failed = Signal(str)
    #: What this panel did for the user; an error before that is over.
    done = Signal(str)
    #: `Path` of a file that this panel wrote for the user.
    written = Signal(object)
    #: Id of the input under the pointer in this panel, or None.
    input_pointed_at = Signal(object)
    #: Place of the limb under the pointer, (x, y) in pixels of its outline, or None.
    place_pointed_at = Signal(object)

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        #: Parts that show what the skin map shows: they are covered together with it.
        self.guessed: tuple[QtWidgets.QWidget, ...] = ()
        self._covers: list[Cover] = []
        # Without it, each change would paint the window behind again.
        self.setAutoFillBackground(True)
        #: Returns the caption of its picture; set by the window.
        self.caption: Callable[[], str] = str
        #: Inside this context it shows no matched levels, as exports need it; set by the window.
        self.as_stored: Callable[[], AbstractContextManager[None]] = nullcontext
        #: Returns where another panel would put what is dragged from here to a point of the
        #: screen; called with None at the end.  Set by the window.
        self.held_over: Callable[[QPoint | None], DropPlace | None] = lambda _: None

    def show_pointed_place(self, at: tuple[float, float] | None) -> None:
        """Mark the place that is under the pointer in another panel; None: there is none."""

    def show_pointed_input(self, input_id: int | None) -> None:
        """Mark the input that is under the pointer in another panel; None: there is none."""

    def heightForWidth(self, width: int) -> int:
        # A dock scrolls only where there is less than the least height.
        layout = self.layout()
        return -1 if layout is None else layout.minimumHeightForWidth(width)

    @property
    def needs(self) -> frozenset[str]:
        """Names of the quantities that `show_results` draws."""
        return frozenset()

    @property
    def needs_of_snapshots(self) -> frozenset[str]:
        """Names of the quantities of each snapshot that `show_snapshots` draws; empty: none."""
        return frozenset()

    @property
    def needs_on_limbs(self) -> Mapping[Any, frozenset[str]]:
        """Names of quantities that `show_on_limbs` draws, by limb or frequency; empty: none."""
        return {}

    def snapshots_drawn(self, snapshots: Sequence[Snapshot]) -> Sequence[Snapshot]:
        """Return which of these designs it draws."""
        return snapshots

    def showing(self, view: str) -> AbstractContextManager[None]:
        """Return a context in which it shows one of its views, if it has some; "": as it is."""
        return nullcontext()

    def show_snapshots(self, compared: Sequence[Compared]) -> None:
        """Draw the designs side by side; called while it is visible."""

    def show_on_limbs(self, compared: Sequence[Compared]) -> None:
        """Draw the present design on the limbs of `needs_on_limbs`; called while it is visible."""

    def show_state(self, design: Design, view: View) -> None:
        """Take over the present design and view, before any results.

        Called when it is made, at each change while it is visible, and when it comes into sight
        after a change.
        """

    def show_playhead(self, view: View) -> None:
        """Take over a view in which only the playhead has moved, at each step while it plays.

        `show_state` is not called for that.
        """

    def show_running(self, running: bool) -> None:
        """Take over whether time runs."""

    def start_over(self) -> None:
        """Forget what was held of the design before: another one is open."""

    def reset_range(self) -> None:
        """Draw the next results as the first ones: nothing is held from before."""

    def show_results(self, results: Mapping[str, Any]) -> None:
        """Draw ``results``, which holds at least the quantities in ``needs``."""

    def show_problem(self, reason: str) -> None:
        """Empty the picture and say why there is none."""

    def show_noisy(self, outputs: tuple[int, ...]) -> None:
        """Take over the outputs at which the prediction is mostly noise."""

    def show_caution(self, text: str, about: str) -> None:
        """Take over which conditions but noise the design leaves, and the state of all of them.

        The ``text`` is in a few words; "": it leaves none.
        """

    def show_unplayable(self, unplayable: tuple[UnplayableInput, ...]) -> None:
        """Take over the inputs that cannot be played; the next results are without them."""

    def show_covered(self, covered: bool) -> None:
        """Cover the parts that an audience is to guess, or reveal them."""
        while self._covers:
            self._covers.pop().take_away()
        if covered:
            self._covers = [Cover(part) for part in self.guessed]

    def show_folder(self, folder: Path) -> None:
        """Take over the folder to suggest for the next file."""

    def drop_place(self, at: QPoint) -> DropPlace | None:
        """Return where something that is dropped at ``at`` goes; None: nowhere in particular."""
        return None

    def show_drop(self, at: QPoint | None) -> None:
        """Show where something held over ``at`` would go; None: it is elsewhere."""

    def showEvent(self, event: QtGui.QShowEvent) -> None:
        super().showEvent(event)
        self.comes_into_sight = True
        self.visibility_changed.emit()
        self.comes_into_sight = False

    def hideEvent(self, event: QtGui.QHideEvent) -> None:
        super().hideEvent(event)
        self.visibility_changed.emit()


#: Message until there are results.
COMPUTING = "Computing…"


class OutputsPanel(Panel):
    """A panel of the selected outputs, or a message, as long as there are none.

    Attributes
    ----------
    settings
        Those of the panel, a frozen dataclass, if it has any.
    """

    settings: Any = None
    # What was drawn last, where it may be drawn again in another way.
    _results: Mapping[str, Any] | None = None

    @property
    def no_outputs(self) -> str:
        """Message while no output is selected."""
        return HOW_TO_SELECT_OUTPUT

    @property
    def message(self) -> str:
        """The message that is shown in place of results, or ""."""
        raise NotImplementedError

    def say_instead(self, message: str) -> None:
        """Show a message in place of the results."""
        raise NotImplementedError

    def await_results(self) -> None:
        """Say that results are being computed."""
        self.say_instead(COMPUTING)

    def save_picture(self) -> None:
        """Ask for a file, and write a picture of this panel to it."""
        # The action saves the panel that has the keyboard focus.
        self.setFocus(Qt.FocusReason.MouseFocusReason)
        self.action_requested.emit("export_panel_picture")

    def show_selection(self, view: View, fewest: int = 1) -> bool:
        """Ask for at least so many outputs, or stop that; return whether results are drawn."""
        empty = len(view.outputs) < fewest
        if empty:
            self.say_instead(self.no_outputs)
        elif self.message == self.no_outputs:
            self.await_results()
            empty = True
        return not empty

    def change_settings(self, **changes: Any) -> None:
        """Emit the view with other settings, if they are others."""
        settings = replace(self.settings, **changes)
        if settings != self.settings:
            self.view_changed.emit(with_settings(self._view, self.name, settings))

    def show_state(self, design: Design, view: View) -> None:
        self.show_selection(view)

    def show_problem(self, reason: str) -> None:
        self.say_instead(reason)


@dataclass(frozen=True, slots=True)
class LazyPanel:
    """Name and title of a panel that is imported when it is first made.

    A call makes the panel: its class is called by its name, with "Panel" behind, and stands in the
    module ``panel`` of its folder, unless other names are given.
    """

    name: str
    title: str
    folder: str = ""
    module: str = "panel"

    @property
    def type(self) -> type[Panel]:
        """The class of the panel, which is imported now if it was not before."""
        module = import_module(f"skinsource_gui.panels.{self.folder or self.name}.{self.module}")
        words = (word.capitalize() for word in self.name.split("_"))
        return getattr(module, f"{''.join(words)}Panel")

    def __call__(self) -> Panel:
        return self.type()


#: Is called once with each panel.
Meet = Callable[[Panel], object]


class PanelRegistry:
    """Makes each panel when it is first used; iterating gives those that were made.

    Parameters
    ----------
    makers
        Functions that make the panels, by name, in the order in which the keyboard reaches them.
    """

    def __init__(self, makers: Mapping[str, Callable[[], Panel]]) -> None:
        self._makers = makers
        self._made: dict[str, Panel] = {}
        self._in_order: tuple[Panel, ...] = ()
        self._callbacks: list[Meet] = []

    def __iter__(self) -> Iterator[Panel]:
        # A panel that is made meanwhile is not part of the iteration.
        return iter(self._in_order)

    def __contains__(self, name: str) -> bool:
        """Return whether the panel of that name was made."""
        return name in self._made

    def __getitem__(self, name: str) -> Panel:
        """Return the panel of that name, which is made now if it was not before."""
        panel = self._made.get(name)
        if panel is None:
            panel = self._made[name] = self._makers[name]()
            self._in_order = tuple(self._made[name] for name in self._makers if name in self._made)
            for meet in tuple(self._callbacks):
                meet(panel)
        return panel

    def each(self, meet: Meet) -> None:
        """Call ``meet`` with each panel that was made, and later with each new one."""
        self._callbacks.append(meet)
        for panel in self._in_order:
            meet(panel)
