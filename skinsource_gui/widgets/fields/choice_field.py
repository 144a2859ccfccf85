"""One of several names, as a list that drops down."""

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QSizePolicy, QWidget

from skinsource.base.quoting import printable
from skinsource.specs.fields import ChoiceSpec
from skinsource_gui.widgets.fields.burst import Burst
from skinsource_gui.widgets.fields.drop_down import DropDown
from skinsource_gui.widgets.tooltips import tooltip


class ChoiceField(DropDown):
    """A drop-down list of the options of ``spec``.

    A value that is not among the options is shown as not available, until another is chosen.
    ``empty`` is said while there is none.
    """

    #: The chosen option; number of the gesture that quick further choices share.
    chosen = Signal(str, object)

    def __init__(
        self, spec: ChoiceSpec, parent: QWidget | None = None, *, empty: str = "Nothing yet"
    ) -> None:
        super().__init__(parent)
        self._burst = Burst(self)
        self._strange, self._empty = "", empty
        self.offer(spec)
        self.setAccessibleName(spec.label)
        self.setToolTip(tooltip(spec.label, spec.hint))
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.activated.connect(self._choose)

    def offer(self, spec: ChoiceSpec) -> None:
        """Offer other options; what is chosen stays so, whether or not it is among them."""
        value = self.value
        self.blockSignals(True)
        self.clear()
        for option, words in spec.options:
            self.addItem(words, option)
        self.blockSignals(False)
        index = self.findData(value) if value else self.currentIndex()
        self._strange = "" if index >= 0 else value
        self.setCurrentIndex(index)

    @property
    def value(self) -> str:
        """The chosen option."""
        return self._strange if self.currentIndex() < 0 else self.currentData()

    def set_value(self, option: str) -> None:
        """Show another choice, and tell nobody."""
        if option != self.value:
            self._burst.end()
            index = self.findData(option)
            self._strange = "" if index >= 0 else option
            self.setCurrentIndex(index)
            self.update()

    @property
    def shown_text(self) -> str:
        """The words for the choice."""
        if self.currentIndex() >= 0:
            return self.currentText()
        # Without any choice there is nothing that could be missing.
        return f"{printable(self._strange)} (not available)" if self._strange else self._empty

    def choose(self, option: str) -> None:
        """Choose an option, as a user does."""
        index = self.findData(option)
        self.setCurrentIndex(index)
        self.activated.emit(index)

    def _choose(self, index: int) -> None:
        self.chosen.emit(self.itemData(index), self._burst.gesture())
