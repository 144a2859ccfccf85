"""What wants to know of more designs than the one in the window."""

from collections.abc import Mapping, Sequence

from skinsource.design.comparing import Snapshot
from skinsource_gui.compared import Compared
from skinsource_gui.tells_lateness import TellsLateness


class ComparesDesigns(TellsLateness):
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
