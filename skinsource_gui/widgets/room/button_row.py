"""Buttons beside each other, whose words are whole in a narrow room too."""

from collections.abc import Sequence

from PySide6.QtWidgets import QAbstractButton, QHBoxLayout, QSizePolicy, QWidget

from skinsource_gui.theme import UNIT_PX
from skinsource_gui.widgets.room.room_or_words import RoomOrWords
from skinsource_gui.widgets.room.words_in_room import fitting_font, smallest_of, width_in, write_in


class ButtonRow(QWidget):
    """Keeps buttons to the left, and writes them smaller where there is too little room.

    Parameters
    ----------
    buttons
        From left to right.
    parent
        As in Qt.
    """

    def __init__(self, buttons: Sequence[QAbstractButton], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._buttons = tuple(buttons)
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(UNIT_PX // 2)
        for one in self._buttons:
            row.addWidget(one)
        row.addStretch(1)
        self._gap_px = row.spacing()
        RoomOrWords(self).changed.connect(self._fit)

    def _fit(self) -> None:
        shown = [one for one in self._buttons if not one.isHidden()]
        gaps_px = self._gap_px * len(shown)
        write_in(fitting_font((shown,), self.font(), self.width() - gaps_px), self._buttons)
        self.setMinimumWidth(width_in(smallest_of(self.font()), shown) + gaps_px)
