"""What is done with the window as a whole."""

from PySide6.QtCore import QObject, Qt
from PySide6.QtWidgets import QWidget


class WindowFrame(QObject):
    """Closes ``window``, or lays it over the whole screen."""

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self._window = window

    def close(self) -> None:
        """Close it, as its button does."""
        self._window.close()

    def toggle_full_screen(self) -> None:
        """Lay it over the whole screen, or back."""
        # Not showNormal: a maximised window shall be one afterwards.
        self._window.setWindowState(self._window.windowState() ^ Qt.WindowState.WindowFullScreen)
