"""Curves of the selected outputs, with their legend."""

from dataclasses import replace

from PySide6.QtCore import QTimer, Signal
from PySide6.QtWidgets import QVBoxLayout, QWidget

from skinsource_gui.theme import Theme
from skinsource_gui.widgets.plot.curves import Curves
from skinsource_gui.widgets.plot.frame_layout import Words
from skinsource_gui.widgets.plot.legend_strip import LegendStrip, LegendText
from skinsource_gui.widgets.plot.plot_axis import XAxis
from skinsource_gui.widgets.plot.plot_navigation import NavigablePlot
from skinsource_gui.widgets.plot.ranges import Range

# Results come many times a second while something is dragged; only lateness is worth a word.
_LATE_MS = 150


class SignalPlot(QWidget):
    """A legend strip with readings over a plot with zoom and crosshair.

    Attributes
    ----------
    canvas
        The plot.
    legend
        The strip.
    """

    #: Part of the x axis the user wants to see, SI; None: everything.
    zoom_requested = Signal(object)

    def __init__(self, name: str, accessible_name: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.legend = LegendStrip(self)
        self.canvas = NavigablePlot(self)
        self.canvas.setObjectName(name)
        self.canvas.setAccessibleName(accessible_name)
        self.canvas.setAccessibleDescription(
            "Left and right move the crosshair, plus and minus zoom, 0 shows everything"
        )
        self.setFocusProxy(self.canvas)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.legend)
        column.addWidget(self.canvas, 1)
        self._words = Words()
        self._late = QTimer(self, interval=_LATE_MS, singleShot=True)
        self._late.timeout.connect(self._mark_stale)
        self.canvas.zoom_requested.connect(self.zoom_requested)
        self.canvas.reading_changed.connect(self._read)

    def set_theme(self, theme: Theme) -> None:
        """Take over colours."""
        self.legend.set_theme(theme)
        self.canvas.set_theme(theme)

    def set_view(self, axis: XAxis, zoom: Range | None, *, stacked: bool) -> None:
        """X axis, its visible part in SI (``None``: all), and one row for each curve or one."""
        self.canvas.set_view(axis, zoom, stacked=stacked)

    def show_curves(self, curves: Curves, *, synthetic: bool, notes: tuple[str, ...] = ()) -> None:
        """Draw ``curves``, and the longest of ``notes`` that fits.

        They count as up to date until `set_stale` says otherwise.
        """
        self._late.stop()
        self._say(Words(synthetic=synthetic, notes=notes))
        self.canvas.show_curves(curves)

    def show_message(self, message: str) -> None:
        """Empty the picture and say ``message`` in its middle."""
        self.canvas.show_message(message)

    def set_stale(self, stale: bool) -> None:
        """Say whether curves belong to an older design; told to the eye only after a while."""
        if not stale:
            self._late.stop()
            self._say(replace(self._words, stale=False))
        elif not self._words.stale and not self._late.isActive():
            self._late.start()

    def _mark_stale(self) -> None:
        self._say(replace(self._words, stale=True))

    def _say(self, words: Words) -> None:
        self._words = words
        self.canvas.set_words(words)

    def _read(self) -> None:
        canvas = self.canvas
        curves, unit, axis = canvas.curves, canvas.unit, canvas.window.axis
        if curves is None:
            self.legend.say(LegendText())
            return
        text = LegendText(
            names=curves.names,
            unit=unit.symbol,
            where_room=axis.reading(float(max(-curves.x[0], curves.x[-1]))),
            reading_room=max((unit.reading(value) for value in canvas.rows.values), key=len),
        )
        if canvas.cursor is not None:
            text = replace(
                text,
                where=axis.reading(float(curves.x[canvas.cursor])),
                readings=tuple(unit.reading(float(y)) for y in curves.y[:, canvas.cursor]),
            )
        self.legend.say(text)
