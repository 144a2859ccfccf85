"""How far the computation of a stimulus is that is not shown yet."""

from PySide6.QtWidgets import QHBoxLayout, QLabel, QProgressBar, QWidget

from skinsource_gui.theme import UNIT_PX, tabular
from skinsource_gui.widgets.lateness import Lateness

_BAR_PX = 96


class PreparingRow(QWidget):
    """A word and a bar, hidden while nothing is computed.

    What takes no time is not told: the word would only flicker.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("stimulus_preparing")
        self._words = QLabel()
        self._words.setObjectName("stimulus_computing")
        self._words.setFont(tabular(self.font()))
        self._bar = QProgressBar()
        self._bar.setObjectName("stimulus_progress")
        self._bar.setAccessibleName("Progress")
        self._bar.setTextVisible(False)
        self._bar.setFixedSize(_BAR_PX, UNIT_PX)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(UNIT_PX)
        row.addWidget(self._words)
        row.addWidget(self._bar)
        row.addStretch(1)
        policy = self.sizePolicy()
        # What stands beside it stays where it is.
        policy.setRetainSizeWhenHidden(True)
        self.setSizePolicy(policy)
        self.lateness = Lateness(self)
        self.lateness.changed.connect(self.setVisible)
        self.begin()
        self.hide()

    def begin(self) -> None:
        """Something is computed from now on, of which nothing is known yet."""
        self.show_progress(0, 0)
        self.lateness.set_stale(True)

    def end(self) -> None:
        """Nothing is computed any more."""
        self.lateness.set_stale(False)

    def show_progress(self, done: int, total: int) -> None:
        """Show how much is done, of how much; a total of 0: not known."""
        # A bar of which nothing is known looks full.
        self._bar.setVisible(bool(total))
        self._bar.setMaximum(max(total, 1))
        self._bar.setValue(done)
        percent = f" {100 * done // total} %" if total else ""
        self._words.setText(f"Computing\u2026{percent}")
