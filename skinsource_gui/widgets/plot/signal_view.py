"""Signals of the selected outputs: their plot, legend, switches and menu."""

from collections.abc import Callable
from dataclasses import replace

from PySide6.QtCore import QPoint, Signal
from PySide6.QtWidgets import QToolButton, QVBoxLayout, QWidget

from skinsource_gui.widgets.keys import KEYS
from skinsource_gui.widgets.lateness import Lateness
from skinsource_gui.widgets.plot.axis_spec import XAxis
from skinsource_gui.widgets.plot.curves import Curves
from skinsource_gui.widgets.plot.legend.legend_strip import LegendStrip
from skinsource_gui.widgets.plot.legend.legend_text import PEAK, LegendText, along_axes
from skinsource_gui.widgets.plot.plot import Plot
from skinsource_gui.widgets.plot.plot_layout import Words
from skinsource_gui.widgets.plot.plot_toolbar import PlotToolbar
from skinsource_gui.widgets.plot.ranges import Range
from skinsource_gui.widgets.plot.signal_exports import SignalExports
from skinsource_gui.widgets.plot.signal_menu import open_menu
from skinsource_gui.widgets.room.height_in_sight import HeightInSight

_COMPUTING = "Computing…"
#: So many lines of text high, a view has room for two rows of switches, or of a legend.
_LINES_OF_TWO_ROWS = 12


class SignalView(QWidget):
    """Switches over a legend with readings over a plot with zoom, crosshair and menu.

    It shows what it is told, and says what the user wants; panels decide.

    Parameters
    ----------
    name, accessible_name
        `objectName` of the plot; what it shows, for those who do not see it.
    lateness
        Whether what it shows is out of date, where somebody else knows.

    Attributes
    ----------
    toolbar, legend, plot
        Its parts.
    exports
        Takes what is shown to the clipboard and to files.
    """

    #: Part of the x axis the user wants to see, SI; None: everything.
    zoom_requested = Signal(object)

    def __init__(
        self,
        name: str,
        accessible_name: str,
        parent: QWidget | None = None,
        lateness: Lateness | None = None,
    ) -> None:
        super().__init__(parent)
        self.toolbar = PlotToolbar(self)
        self.legend = LegendStrip(self)
        self.plot = Plot(self)
        self.plot.setObjectName(name)
        self.plot.setAccessibleName(accessible_name)
        self.plot.setAccessibleDescription(
            "; ".join(KEYS["plot"].sentences("step", "zoom_in", "zoom_out", "whole"))
        )
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.toolbar)
        column.addWidget(self.legend)
        column.addWidget(self.plot, 1)
        self.exports = SignalExports(self.plot, accessible_name, self)
        self._words = Words()
        self._in_menu: list[QToolButton] = []
        self._lateness = lateness or Lateness(self)
        self._lateness.changed.connect(self._mark_stale)
        self.plot.navigation.zoom_requested.connect(self.zoom_requested)
        self.toolbar.everything_wanted.connect(self._show_everything)
        self.plot.reading_changed.connect(self._read)
        self.plot.menu_wanted.connect(self._open_menu)
        self._in_sight = HeightInSight(self)
        self._in_sight.changed.connect(self._share_height)

    def add_switch_in_menu(
        self, name: str, text: str, hint: str, toggled: Callable[[bool], None]
    ) -> QToolButton:
        """Return a new switch of the menu, which stands in the toolbar too while it is on."""
        button = self.toolbar.add_switch(name, text, hint, toggled)
        self.toolbar.show_passing(button, False)
        self._in_menu.append(button)
        return button

    def set_view(
        self, axis: XAxis, zoom: Range | None, *, stacked: bool, fitted: bool = False
    ) -> None:
        """X axis, its visible part in SI (``None``: all), and rows, as `Plot.set_view` has it."""
        self.plot.set_view(axis, zoom, stacked=stacked, fitted=fitted)

    def show_curves(self, curves: Curves, *, synthetic: bool, notes: tuple[str, ...] = ()) -> None:
        """Draw ``curves``, and the longest of ``notes`` that fits.

        They count as up to date until `set_stale` says otherwise.
        """
        self._lateness.set_stale(False)
        self._say(Words(synthetic=synthetic, notes=notes))
        self.plot.show_curves(curves)

    def show_message(self, message: str) -> None:
        """Empty the picture and say ``message`` in its middle."""
        self.plot.show_message(message)

    def wait_for_curves(self) -> None:
        """Empty the picture until there are curves; why it is empty is said after a while."""
        self.plot.show_message(_COMPUTING if self._lateness.late else "")

    def set_stale(self, stale: bool) -> None:
        """Say whether curves belong to an older design; told to the eye only after a while."""
        self._lateness.set_stale(stale)

    def _share_height(self) -> None:
        line_px = self.fontMetrics().lineSpacing()
        has_room = self._in_sight.px >= _LINES_OF_TWO_ROWS * line_px
        for part in (self.toolbar, self.legend):
            part.let_fold(has_room)

    def _mark_stale(self, late: bool) -> None:
        if self.plot.curves is None and not self.plot.message:
            self.plot.show_message(_COMPUTING)
        self._say(replace(self._words, stale=late))

    def _say(self, words: Words) -> None:
        self._words = words
        self.plot.set_words(words)

    def _show_everything(self) -> None:
        self.zoom_requested.emit(None)

    def _open_menu(self, at: QPoint) -> None:
        if self.plot.curves is not None:
            fresh = not self._lateness.late
            open_menu(self, at, self._show_everything, self.exports, self._in_menu, fresh=fresh)

    def _read(self) -> None:
        self.legend.say(reading(self.plot))


def reading(plot: Plot) -> LegendText:
    """Names of the curves of ``plot``, and what the crosshair reads there."""
    curves, unit, axis = plot.curves, plot.unit, plot.x_window.axis
    if curves is None:
        return LegendText()
    text = LegendText(
        names=curves.names,
        unit=unit.symbol,
        where_room=axis.reading(float(max(-curves.x[0], curves.x[-1]))),
        reading_room=max((unit.reading(value) for value in plot.value_scale.values), key=len),
    )
    if curves.axes:
        text = text.of_axes(curves.axes)
    elif curves.peaks:
        text = _with_room_for_peaks(text, curves)
    if plot.crosshair.index is None:
        return _with_peaks(text, curves) if text.relative else text
    readings = tuple(unit.reading(float(y)) for y in curves.y[:, plot.crosshair.index])
    return replace(
        text,
        where=axis.reading(float(curves.x[plot.crosshair.index])),
        readings=along_axes(readings, curves.each) if curves.axes else readings,
    )


def _with_peaks(text: LegendText, curves: Curves) -> LegendText:
    """Where nothing is read: the peaks to which the curves are relative."""
    return replace(text, unit=curves.peak_unit.symbol, where=PEAK, readings=curves.peak_words)


def _with_room_for_peaks(text: LegendText, curves: Curves) -> LegendText:
    """Where peaks give way to readings, and come back: places stay."""
    return replace(
        text,
        relative=True,
        reading_room=max((text.reading_room, *curves.peak_words), key=len),
        unit_room=max((text.unit, curves.peak_unit.symbol), key=len),
    )
