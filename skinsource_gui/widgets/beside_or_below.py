"""Groups of widgets that go below each other where they do not fit beside each other."""

from collections.abc import Sequence

from PySide6.QtCore import QSize
from PySide6.QtWidgets import QBoxLayout, QHBoxLayout, QWidget

from skinsource_gui.widgets.room.room_or_words import RoomOrWords

_BESIDE, _BELOW = QBoxLayout.Direction.LeftToRight, QBoxLayout.Direction.TopToBottom


class BesideOrBelow(QWidget):
    """Puts groups beside each other, or, where it is narrow, each into a row of its own.

    Parameters
    ----------
    groups
        Widgets that stay beside each other; None is room between them.
    spacing_px
        Between widgets, groups and rows.
    """

    def __init__(self, *groups: Sequence[QWidget | None], spacing_px: int) -> None:
        super().__init__()
        self._box = QBoxLayout(_BESIDE, self)
        self._box.setContentsMargins(0, 0, 0, 0)
        self._box.setSpacing(spacing_px)
        self._rows: list[QHBoxLayout] = []
        for group in groups:
            row = QHBoxLayout()
            row.setSpacing(spacing_px)
            for part in group:
                if part is None:
                    row.addStretch(1)
                else:
                    row.addWidget(part)
            self._rows.append(row)
            # What is left over belongs to the last group.
            self._box.addLayout(row, int(len(self._rows) == len(groups)))
        RoomOrWords(self).changed.connect(self._fold)

    @property
    def folded(self) -> bool:
        """Whether groups are below each other."""
        return self._box.direction() == _BELOW

    def minimumSizeHint(self) -> QSize:
        widest = max(row.minimumSize().width() for row in self._rows)
        return QSize(widest, self._box.minimumSize().height())

    def _fold(self) -> None:
        needed = sum(row.minimumSize().width() for row in self._rows)
        needed += self._box.spacing() * (len(self._rows) - 1)
        direction = _BESIDE if needed <= self.width() else _BELOW
        if direction != self._box.direction():
            self._box.setDirection(direction)
        height = self._box.minimumSize().height()
        if height != self.minimumHeight():
            self.setMinimumHeight(height)
            self.updateGeometry()
