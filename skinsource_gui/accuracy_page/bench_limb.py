"""What the benchmark is measured on: made-up responses, or the limb of the design."""

from PySide6.QtWidgets import QComboBox, QWidget

from skinsource.own_limbs import facts_of, missing_limb
from skinsource_gui.state.document import Document

_MADE_UP = "Made-up responses"
_HINT = (
    "Promises are made for made-up responses in the shape of the published limbs. With the "
    "design's own limb the same engines play its places, at its rate"
)


class BenchLimb(QComboBox):
    """A choice of two, of which the second follows the design.

    Parameters
    ----------
    document
        Has the design.
    """

    def __init__(self, document: Document, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("bench_limb")
        self.setAccessibleName("Measured on")
        self.setToolTip(_HINT)
        self.addItems([_MADE_UP, ""])
        self._document = document
        document.changed.connect(self._name_limb)
        self._name_limb()

    @property
    def limb(self) -> str:
        """Name of the limb that is chosen; empty: none, but made-up responses."""
        return self._document.design.limb if self.currentIndex() else ""

    @property
    def missing(self) -> str:
        """Why it cannot be measured on what is chosen, in a sentence; empty if it can."""
        design = self._document.design
        return missing_limb(design.limb, design.limb_digest) if self.currentIndex() else ""

    def _name_limb(self) -> None:
        words = facts_of(self._document.design.limb).title
        if words != self.itemText(1):
            self.setItemText(1, words)
