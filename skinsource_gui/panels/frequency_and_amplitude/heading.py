"""What is turned, in words that are no higher than two lines."""

from PySide6.QtCore import QRect, Qt
from PySide6.QtWidgets import QLabel

from skinsource_gui.widgets.room.room_or_words import RoomOrWords

_TWO_LINES = "A\nA"
_ANY_HEIGHT_PX = 10_000
_WRAPPED = Qt.TextFlag.TextWordWrap


class Heading(QLabel):
    """Shows the first of some phrasings that fits into two lines; else the last, in more of them.

    It is as high as two lines whatever it says: what stands below keeps its place from scene to
    scene, and a long title does not push it out of the window.
    """

    def __init__(self, words: str) -> None:
        super().__init__(words)
        self._phrases: tuple[str, ...] = (words,)
        self.setWordWrap(True)
        RoomOrWords(self).changed.connect(self._fit)

    def show_phrases(self, *phrases: str) -> None:
        """Take over phrasings, the longest first."""
        self._phrases = phrases
        self._fit()

    def _fit(self) -> None:
        two_lines = self._height_of(_TWO_LINES)
        fitting = (one for one in self._phrases if self._height_of(one) <= two_lines)
        words = next(fitting, self._phrases[-1])
        self.setText(words)
        # What is left out is said where somebody points at it.
        self.setToolTip("" if words == self._phrases[0] else self._phrases[0])
        self.setMinimumHeight(max(self._height_of(words), two_lines))

    def _height_of(self, words: str) -> int:
        room = QRect(0, 0, self.contentsRect().width(), _ANY_HEIGHT_PX)
        return self.fontMetrics().boundingRect(room, _WRAPPED, words).height()
