"""What a plot shows, taken elsewhere: a picture, or its numbers."""

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import replace
from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QApplication, QFileDialog, QWidget

from skinsource.base.errors import SkinSourceError
from skinsource_gui.widgets.pictures.caption import caption_px, with_caption
from skinsource_gui.widgets.pictures.picture_file import drawn_image, save_drawing
from skinsource_gui.widgets.pictures.picture_options import PictureOptions, ask_picture_options
from skinsource_gui.widgets.plot.plot import Plot
from skinsource_gui.widgets.plot.signal_picture import draw_signals, usual_size
from skinsource_gui.widgets.plot.signal_table import save_table

_PICTURES = "PNG picture (*.png);;SVG drawing (*.svg);;PDF page (*.pdf)"
_TABLES = "CSV (*.csv)"


class SignalExports(QObject):
    """Copies and saves what ``plot`` shows when it is asked to; ``title`` names it.

    Attributes
    ----------
    folder
        Where files are suggested.
    caption, lines
        Give what stands below a picture, and what else stands in the head of a table.
    as_stored
        While this lasts the plot shows no matched levels.
    """

    #: A file was written there, `Path`.
    written = Signal(object)
    #: A sentence that says why a file was not written.
    failed = Signal(str)

    def __init__(self, plot: Plot, title: str, parent: QWidget) -> None:
        super().__init__(parent)
        self._plot, self._title, self._parent = plot, title, parent
        self.folder = Path()
        self.caption: Callable[[], str] = str
        self.lines: Callable[[], Sequence[str]] = tuple
        self.as_stored: Callable[[], AbstractContextManager[None]] = nullcontext
        self._options: PictureOptions | None = None

    def copy_picture(self) -> None:
        """Put a picture on the clipboard."""
        size, draw = usual_size(self._plot), partial(draw_signals, plot=self._plot)
        words = self.caption()
        height = size.height() + caption_px(words, size.width(), size.height())
        with self.as_stored():
            picture = drawn_image(with_caption(draw, words), size.width(), height)
        QApplication.clipboard().setImage(picture)

    def save_picture(self) -> None:
        """Ask for size, colours and a file, and write a picture to it."""
        size = usual_size(self._plot)
        usual = PictureOptions(width_px=size.width(), height_px=size.height())
        words = self.caption()
        page = {"shape": (size.width(), size.height()), "below": partial(caption_px, words)}
        options = ask_picture_options(self._parent, self._options or usual, **page)
        if options is None:
            return
        path = self._ask("Save picture", f"{self._plot.objectName()}.png", _PICTURES)
        if path is None:
            return
        # Who left the size as it was gets the plot as it will be then.
        self._options = None if replace(options, colours=usual.colours) == usual else options
        draw = with_caption(partial(draw_signals, plot=self._plot), words)
        draw = partial(draw, theme=options.theme)
        width, height = options.width_px, options.height_px
        self._write(path, partial(save_drawing, path, draw, width, height, title=self._title))

    def save_data(self) -> None:
        """Ask for a file, and write the curves to it as a table."""
        path = self._ask("Export data", f"{self._plot.objectName()}.csv", _TABLES)
        if path is not None:
            lines = self.lines()
            self._write(path, partial(save_table, path, self._plot, self._title, lines))

    def _ask(self, title: str, name: str, kinds: str) -> Path | None:
        chosen, kind = QFileDialog.getSaveFileName(
            self._parent, title, str(self.folder / name), kinds
        )
        if not chosen:
            return None
        path = Path(chosen)
        if path.suffix:
            return path
        endings = (end for end in (".svg", ".pdf") if end[1:] in kind)
        return path.with_name(path.name + next(endings, Path(name).suffix))

    def _write(self, path: Path, write: Callable[[], None]) -> None:
        try:
            with self.as_stored():
                write()
        except SkinSourceError as error:
            self.failed.emit(str(error))
        else:
            self.written.emit(path)
