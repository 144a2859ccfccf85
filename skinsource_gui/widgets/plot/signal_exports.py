"""What a plot shows, taken elsewhere: a picture, or its numbers."""

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QApplication, QFileDialog, QWidget

from skinsource.errors import SkinSourceError
from skinsource_gui.widgets.plot.plot import Plot
from skinsource_gui.widgets.plot.signal_picture import save_picture, signal_picture
from skinsource_gui.widgets.plot.signal_table import save_table

Write = Callable[[Path, Plot, str], None]

_PICTURES = "PNG picture (*.png);;SVG drawing (*.svg)"
_TABLES = "CSV (*.csv)"


class SignalExports(QObject):
    """Copies and saves what ``plot`` shows when it is asked to; ``title`` names it.

    Attributes
    ----------
    folder
        Where files are suggested.
    """

    #: A file was written there, `Path`.
    written = Signal(object)
    #: A sentence that says why a file was not written.
    failed = Signal(str)

    def __init__(self, plot: Plot, title: str, parent: QWidget) -> None:
        super().__init__(parent)
        self._plot, self._title, self._parent = plot, title, parent
        self.folder = Path()

    def copy_picture(self) -> None:
        """Put a picture on the clipboard."""
        QApplication.clipboard().setImage(signal_picture(self._plot))

    def save_picture(self) -> None:
        """Ask for a file, and write a picture to it."""
        path = self._ask("Save picture", f"{self._plot.objectName()}.png", _PICTURES)
        if path is not None:
            self._write(path, save_picture)

    def save_data(self) -> None:
        """Ask for a file, and write the curves to it as a table."""
        path = self._ask("Export data", f"{self._plot.objectName()}.csv", _TABLES)
        if path is not None:
            self._write(path, save_table)

    def _ask(self, title: str, name: str, kinds: str) -> Path | None:
        chosen, kind = QFileDialog.getSaveFileName(
            self._parent, title, str(self.folder / name), kinds
        )
        if not chosen:
            return None
        path = Path(chosen)
        if path.suffix:
            return path
        return path.with_name(path.name + (".svg" if "svg" in kind else Path(name).suffix))

    def _write(self, path: Path, write: Write) -> None:
        try:
            write(path, self._plot, self._title)
        except SkinSourceError as error:
            self.failed.emit(str(error))
        else:
            self.written.emit(path)
