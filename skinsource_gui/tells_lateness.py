"""What tells the eye that it shows results of an older design, and hands none of them out."""

from PySide6.QtWidgets import QWidget

from skinsource_gui.widgets.copy_button import CopyButton
from skinsource_gui.widgets.inputs.pointing import PointsAtInputs
from skinsource_gui.widgets.lateness import Lateness
from skinsource_gui.widgets.over.veil import Veil


class TellsLateness(PointsAtInputs):
    """Is told whether what it shows is out of date.

    What has been so for a while is veiled and cannot be copied; what comes into sight so, at once.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        #: Parts that are veiled, as they say nothing themselves of what belongs to which design.
        self.computed: tuple[QWidget, ...] = ()
        #: Whether somebody begins to look now: what was drawn meanwhile was never seen to change.
        self.comes_into_sight = False
        self._veils: list[Veil] = []
        self._lateness = Lateness(self)
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

    def show_late(self, late: bool) -> None:
        """Let it be seen that what is drawn belongs to an older design, or does no more."""
        while self._veils:
            self._veils.pop().take_away()
        if late:
            self._veils = [Veil(part) for part in self.computed]

    def _follow_lateness(self, late: bool) -> None:
        for button in self.findChildren(CopyButton):
            button.show_late(late)
        self.show_late(late)
