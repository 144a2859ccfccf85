"""Where a panel stands that is drawn and seen by nobody."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QScrollArea, QVBoxLayout, QWidget

from skinsource_gui.panel import Panel
from skinsource_gui.shell.docks.dock import Dock


def usual_size(panel: Panel) -> QSize:
    """How large a panel likes to be, px."""
    return panel.sizeHint().expandedTo(panel.minimumSizeHint()).expandedTo(panel.minimumSize())


@contextmanager
def staged(dock: Dock, width: int, height: int) -> Iterator[Callable[[], None]]:
    """Show the panel of a dock out of sight, for as long as it is drawn.

    What was never shown has no layout, and is told nothing.  Gives what makes room for all that has
    to be scrolled: how much that is, results tell.

    Parameters
    ----------
    dock
        Whose panel; it is hidden there.
    width, height
        Of the picture: the panel is of this shape, and as large as it likes to be at least.
    """
    size = usual_size(dock.panel)
    wide = max(size.width(), round(size.height() * width / max(height, 1)))
    high = max(size.height(), round(wide * height / max(width, 1)))
    stage = QWidget()
    stage.setAttribute(Qt.WidgetAttribute.WA_DontShowOnScreen)
    stage.setAttribute(Qt.WidgetAttribute.WA_ShowWithoutActivating)
    column = QVBoxLayout(stage)
    column.setContentsMargins(0, 0, 0, 0)
    with dock.lent() as panel:
        column.addWidget(panel)
        panel.show()
        stage.resize(wide, high)
        stage.show()
        try:
            yield partial(_make_room, stage)
        finally:
            column.removeWidget(panel)
            panel.setParent(None)
            stage.deleteLater()


def _make_room(stage: QWidget) -> None:
    hidden = max(
        (area.verticalScrollBar().maximum() for area in stage.findChildren(QScrollArea)), default=0
    )
    high = stage.height() + hidden
    # Of the same shape.
    stage.resize(round(stage.width() * high / max(stage.height(), 1)), high)
