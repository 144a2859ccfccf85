"""The bases of the views of Analysis: what each has, and a figure under a row of choices."""

from typing import ClassVar

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QPoint, QRectF, QSize, Qt, Signal

from skinsource_gui.plots.figure import Figure, NoteLabel, draw_figure, open_figure_menu
from skinsource_gui.qt.layouts import in_column, in_row
from skinsource_gui.qt.theme import LIGHT, UNIT_PX, Theme
from skinsource_gui.state.panel import COMPUTING, OutputsPanel


class AnalysisView(OutputsPanel):
    """One view of Analysis: a panel inside of the panel, which shows and hides it.

    Attributes
    ----------
    has_table
        Whether there are numbers to copy now.
    """

    #: Whether it ever has numbers to copy.
    copies: ClassVar[bool] = True

    #: Whether numbers can be copied may be otherwise.
    copy_changed = Signal()
    #: The user wants to copy them.
    copy_requested = Signal()

    has_table = False

    @property
    def message(self) -> str:
        return ""

    def say_instead(self, message: str) -> None:
        """Do nothing: such a view says it beside its results."""

    def table_text(self) -> str:
        """Return the numbers, with tabs between the columns; "" where there are none."""
        return ""

    @property
    def words(self) -> str:
        """What the numbers are: axes, time, reference; it is copied below them."""
        return ""

    def offer_copy(self, exists: bool) -> None:
        """Say whether there are numbers to copy."""
        self.has_table = exists
        self.copy_changed.emit()

    def show_staleness(self, stale: bool) -> None:
        super().show_staleness(stale and not self.message)

    def _follow_staleness(self, stale: bool) -> None:
        super()._follow_staleness(stale)
        self.copy_changed.emit()


class FigureView(AnalysisView):
    """A view with choices above a figure, and a line of text below it.

    Parameters
    ----------
    figure
        Fills the view.

    Attributes
    ----------
    figure, choices, heads, note_label
        Its parts; ``heads`` is a row of its own between choices and figure.
    """

    def __init__(self, figure: Figure, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.figure = figure
        self.setMinimumSize(240, 160)
        self.setFocusProxy(figure)
        self.computed = (figure,)
        self._result = ""
        self._above: NoteLabel | None = None
        self.note_label = NoteLabel(f"{self.name}_words")
        self.choices = in_row(margins=(UNIT_PX // 2, 1, UNIT_PX // 2, 1), gap_px=UNIT_PX // 2)
        # Text on the figure that would have too little room beside the choices.
        self.heads = in_column(margins=(UNIT_PX, 0, UNIT_PX, 1))
        foot = in_row(self.note_label, margins=(UNIT_PX, 1, UNIT_PX, 2))
        in_column(self.choices, self.heads, (figure, 1), foot, of=self, margins=0, gap_px=0)
        figure.reading.connect(self._show_reading)
        figure.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        figure.customContextMenuRequested.connect(self._open_menu)

    @property
    def message(self) -> str:
        return self.figure.message

    @property
    def picture_text(self) -> str:
        """Text above the figure in a picture: what is chosen there."""
        return "" if self._above is None else self._above.whole

    @property
    def words(self) -> str:
        return self.picture_text

    def draw_picture(
        self, painter: QtGui.QPainter, width: int, height: int, theme: Theme = LIGHT
    ) -> None:
        """Draw figure and text for a page or a slide, without the controls; size in px."""
        # The figure has the colours of the theme in use.
        # Text grows with the picture, and is not smaller than on the screen.
        scale = min(width / max(self.width(), 1), height / max(self.height(), 1))
        scale = max(scale, 1.0)
        painter.save()
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        painter.scale(scale, scale)
        room = QRectF(0.0, 0.0, width / scale, height / scale)
        draw_figure(painter, room, self.figure, self.picture_text, self._result)
        painter.restore()

    def sizeHint(self) -> QSize:
        return QSize(360, 280)

    def add_above(self, name: str) -> NoteLabel:
        """Return a new text above the figure, also in pictures; the caller adds it to a layout."""
        self._above = NoteLabel(name)
        return self._above

    def say_instead(self, message: str) -> None:
        self._results = None
        self.figure.say(message)
        self.show_result("")
        self.offer_copy(False)

    def reset_range(self) -> None:
        self.figure.steady_range.reset()

    def await_results(self) -> None:
        self.figure.say(COMPUTING)

    def show_result(self, text: str) -> None:
        """Show a result below the figure while the cursor reads nothing."""
        self._result = text
        if self.figure.cursor_at is None:
            self.note_label.say(text)

    def _open_menu(self, at: QPoint) -> None:
        if not self.figure.message:
            copy = self.copy_requested.emit if self.copies else None
            open_figure_menu(self.figure, self.figure.mapToGlobal(at), self.save_picture, copy)

    def _show_reading(self, text: str) -> None:
        # A reading keeps the room of its line; otherwise the figure would jump.
        self.note_label.say(text or self._result, holding=bool(text))
