"""A line of text that says less where there is less room."""

from collections.abc import Sequence

from PySide6.QtCore import QEvent, QSize, Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QLabel, QSizePolicy, QWidget


class FittingLabel(QLabel):
    """Shows the first of some phrasings that fits; where none does, dots end the last one."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._phrases: tuple[str, ...] = ("",)
        # Shorter words leave their room at the left: what stands at the right belongs to them.
        self.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Preferred)

    def show_phrases(self, phrases: Sequence[str]) -> None:
        """Take over phrasings, longest first."""
        if tuple(phrases) != self._phrases:
            self._phrases = tuple(phrases) or ("",)
            self._choose()
            self.updateGeometry()

    def sizeHint(self) -> QSize:
        return QSize(self._width_of(self._phrases[0]), super().sizeHint().height())

    def minimumSizeHint(self) -> QSize:
        return QSize(self._width_of(self._phrases[-1]), super().minimumSizeHint().height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._choose()

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._choose()

    def _choose(self) -> None:
        fitting = (one for one in self._phrases if self._width_of(one) <= self.width())
        words = next(fitting, None) or self.fontMetrics().elidedText(
            self._phrases[-1], Qt.TextElideMode.ElideRight, self.contentsRect().width()
        )
        if words != self.text():
            self.setText(words)

    def _width_of(self, words: str) -> int:
        margins = self.contentsMargins()
        return self.fontMetrics().horizontalAdvance(words) + margins.left() + margins.right() + 2
