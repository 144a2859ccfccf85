"""Files that are dropped on the window: designs, presets, and recordings."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QEvent, QObject, QPoint, Qt, Signal
from PySide6.QtGui import QDragMoveEvent, QDropEvent
from PySide6.QtWidgets import QWidget

from skinsource.design.design_file import SUFFIX
from skinsource.design.presets import presets
from skinsource_gui.made_panels import MadePanels
from skinsource_gui.panel import Panel
from skinsource_gui.widgets.drop_place import DropPlace


class FileDrops(QObject):
    """Takes files that are dropped on ``window``, and asks its panels where they belong.

    Parameters
    ----------
    window
        Takes the drops; also the parent.
    panels
        Show where a recording would go, and say where it was dropped.
    """

    #: A design, `Path`.
    design_dropped = Signal(object)
    #: A recording, `Path`, and its `DropPlace` or None.
    recording_dropped = Signal(object, object)
    #: A preset, also one that is dragged from the library, `Path`, and its `DropPlace` or None.
    preset_dropped = Signal(object, object)

    def __init__(self, window: QWidget, panels: MadePanels) -> None:
        super().__init__(window)
        self._window, self._panels = window, panels
        window.setAcceptDrops(True)
        window.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        handlers: dict[QEvent.Type, Callable[..., None]] = {
            QEvent.Type.DragEnter: self._take_along,
            QEvent.Type.DragMove: self._take_along,
            QEvent.Type.DragLeave: self._leave,
            QEvent.Type.Drop: self._drop,
        }
        handler = handlers.get(event.type()) if watched is self._window else None
        if handler is None:
            return super().eventFilter(watched, event)
        handler(event)
        return True

    def _take_along(self, event: QDragMoveEvent) -> None:
        paths = _paths(event)
        if not paths:
            event.ignore()
            return
        event.setDropAction(Qt.DropAction.CopyAction)
        event.accept()
        at = event.position().toPoint()
        for panel in self._panels:
            placed = paths[0].suffix != SUFFIX and self._inside(panel, at)
            panel.show_drop(panel.mapFrom(self._window, at) if placed else None)

    def _leave(self, event: QEvent) -> None:
        for panel in self._panels:
            panel.show_drop(None)

    def _drop(self, event: QDropEvent) -> None:
        paths = _paths(event)
        self._leave(event)
        if not paths:
            event.ignore()
            return
        # Whoever offers a file to be moved would delete it afterwards.
        event.setDropAction(Qt.DropAction.CopyAction)
        event.accept()
        if paths[0].suffix == SUFFIX:
            self.design_dropped.emit(paths[0])
        else:
            kind = paths[0].suffix == presets.SUFFIX
            dropped = self.preset_dropped if kind else self.recording_dropped
            dropped.emit(paths[0], self._place(event.position().toPoint()))

    def _place(self, at: QPoint) -> DropPlace | None:
        for panel in self._panels:
            if self._inside(panel, at):
                return panel.drop_place(panel.mapFrom(self._window, at))
        return None

    def _inside(self, panel: Panel, at: QPoint) -> bool:
        # Panels in tabs lie above each other; one that floats is a window of its own.
        visible = panel.isVisible() and panel.window() is self._window
        return visible and panel.rect().contains(panel.mapFrom(self._window, at))


def _paths(event: QDropEvent) -> list[Path]:
    return [Path(url.toLocalFile()) for url in event.mimeData().urls() if url.isLocalFile()]
