"""The keyboard's cursor on the hand."""

from PySide6.QtCore import QObject, Signal

from skinsource_gui.panels.hand.hand_stage import HandStage
from skinsource_gui.panels.hand.hand_state import HandState
from skinsource_gui.panels.hand.site_keys import SiteKeys


class SiteCursor(QObject):
    """Goes from site to site, and acts there.

    Parameters
    ----------
    stage
        The hand; its cursor is changed here.

    Attributes
    ----------
    site
        Where it is, whether or not it is shown.
    keys
        What moves it.
    """

    #: It is at another site, or something else is there.
    moved = Signal(int)
    #: Site of a new input.
    placed = Signal(int)
    #: Number of an input.
    selected = Signal(int)
    #: Number of an input, its new site, gesture.
    shifted = Signal(int, int, int)

    def __init__(self, stage: HandStage) -> None:
        super().__init__(stage)
        self._stage = stage
        self.site = 1
        self.keys = SiteKeys(len(stage.layout.centres), self)
        self.keys.stepped.connect(self._step)
        self.keys.jumped.connect(self.go_to)
        self.keys.activated.connect(self._activate)
        self.keys.shifted.connect(self._shift)

    def show_hand(self) -> None:
        """The hand is another one: where the cursor was there may be nothing."""
        self.keys.show_count(self._stage.layout.n_sites)
        if not self._stage.layout.has(self.site):
            self.site = 1
        self.moved.emit(self.site)

    def keep_up(self, before: HandState, *, anew: bool, focused: bool) -> None:
        """Other inputs are shown than ``before``; see `HandDiagram.show_inputs`."""
        state = self._stage.state
        site = state.selected_site
        if site is not None and state.selected != before.selected and not focused:
            self.follow(site)
        elif site is not None and anew and site != before.selected_site:
            # Another design: the cursor would name a place of the one before.
            (self.follow if before.cursor is None else self.go_to)(site)
        else:
            self.moved.emit(self.site)

    def follow(self, site: int) -> None:
        """Go where the mouse was used, without showing; nowhere else than on this hand."""
        if not self._stage.layout.has(site):
            return
        self.site = site
        self.moved.emit(site)

    def go_to(self, site: int) -> None:
        """Go to a site, and show there."""
        if not self._stage.layout.has(site):
            return
        self.follow(site)
        self._stage.change(cursor=site)
        self._stage.pan_zoom.reveal(self._stage.layout.centre(site))

    def _step(self, x: int, y: int) -> None:
        self.go_to(self._stage.layout.neighbour(self.site, (x, y)))

    def _activate(self, further: bool) -> None:
        self.go_to(self.site)
        following = self._stage.state.next_at(self.site)
        if further or following is None:
            self.placed.emit(self.site)
        else:
            self.selected.emit(following)

    def _shift(self, x: int, y: int, gesture: int) -> None:
        state = self._stage.state
        if state.selected is None:
            return
        origin = state.marks[state.selected].site
        if not self._stage.layout.has(origin):
            # It comes to the hand where the cursor is.
            self.shifted.emit(state.selected, self.site, gesture)
            return
        site = self._stage.layout.neighbour(origin, (x, y))
        if site != origin:
            self.shifted.emit(state.selected, site, gesture)
        self.go_to(site)
