"""A row of widgets that folds into several where it is narrow."""

from collections.abc import Sequence

from PySide6.QtCore import QSize
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QGridLayout, QWidget

from skinsource_gui.widgets.into_sight import bars_px


class FoldingRow(QWidget):
    """Puts widgets beside each other; those that do not fit go below.

    A scroll bar beside it takes a little of each: if the row folded for that, it would become
    higher, and keep the scroll bar that made it fold.

    Parameters
    ----------
    widgets
        In their order; hidden ones take no room.
    spacing_px
        Between them.
    left
        Whether they keep to the left; else they share the width.
    parent
        As in Qt.
    """

    def __init__(
        self,
        widgets: Sequence[QWidget],
        spacing_px: int,
        *,
        left: bool = False,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self._widgets, self._spacing_px, self._left = tuple(widgets), spacing_px, left
        self._placed: tuple[tuple[QWidget, ...], int] = ((), 0)
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setSpacing(spacing_px)
        for one in self._widgets:
            # One that is hidden now would be a window of its own once it is shown.
            one.setParent(self)
        self.fold()

    def minimumSizeHint(self) -> QSize:
        return QSize(self._widest_px, self._grid.minimumSize().height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self.fold()

    def fold(self) -> None:
        """Place them anew: the width is another one, or others are shown."""
        shown = tuple(one for one in self._widgets if not one.isHidden())
        room = self.width() + bars_px(self) + self._spacing_px
        fit = max(room // max(self._widest_px + self._spacing_px, 1), 1)
        rows = -(-len(shown) // fit) or 1
        columns = -(-len(shown) // rows) or 1
        if (shown, columns) == self._placed:
            return
        self._placed = shown, columns
        for one in self._widgets:
            self._grid.removeWidget(one)
        for k, one in enumerate(shown):
            self._grid.addWidget(one, k // columns, k % columns)
        for column in range(len(self._widgets) + 1):
            self._grid.setColumnStretch(column, int(self._left and column == columns))
        self.setMinimumHeight(self._grid.minimumSize().height())
        self.updateGeometry()

    def px_of(self, columns: int) -> int:
        """How wide it has to be for so many widgets in a row, or for all if they are fewer."""
        count = min(sum(not one.isHidden() for one in self._widgets), columns)
        return count * (self._widest_px + self._spacing_px) - self._spacing_px

    @property
    def _widest_px(self) -> int:
        return max((one.minimumSizeHint().width() for one in self._widgets), default=0)
