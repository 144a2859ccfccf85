"""What the benchmark is measured on: made-up responses, or the limb of the design."""

from PySide6.QtWidgets import QHBoxLayout, QLabel, QWidget

from skinsource.own_limbs import facts_of, missing_limb
from skinsource_gui.state.document import Document
from skinsource_gui.widgets.fields.drop_down import DropDown

_MADE_UP = "Made-up responses"
_HINT = (
    "Promises are made for made-up responses in the shape of the published limbs. On the limb of "
    "the design the same engines are measured with its responses, places and rate"
)
#: Longer titles end in an ellipsis; the list shows them whole.
_SHOWN_LETTERS = 19


class BenchLimb(QWidget):
    """A choice of two, of which the second follows the design.

    Parameters
    ----------
    document
        Has the design.
    """

    def __init__(self, document: Document, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._document = document
        self._choice = DropDown()
        self._choice.setObjectName("bench_limb")
        self._choice.setAccessibleName("Limb of the benchmark")
        self._choice.setToolTip(_HINT)
        self._choice.setMinimumContentsLength(_SHOWN_LETTERS)
        self._choice.addItems([_MADE_UP, ""])
        label = QLabel("Limb")
        label.setBuddy(self._choice)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(label)
        row.addWidget(self._choice)
        document.changed.connect(self._name_limb)
        self._name_limb()

    @property
    def limb(self) -> str:
        """Name of the limb that is chosen; empty: none, but made-up responses."""
        return self._document.design.limb if self._choice.currentIndex() else ""

    @property
    def missing(self) -> str:
        """Why it cannot be measured on what is chosen, in a sentence; empty if it can."""
        design = self._document.design
        return missing_limb(design.limb, design.limb_digest) if self.limb else ""

    def _name_limb(self) -> None:
        title = facts_of(self._document.design.limb).title
        if title != self._choice.itemText(1):
            self._choice.setItemText(1, title)
