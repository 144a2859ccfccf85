"""A plot with toolbar, legend and menu, and what it exports: pictures and tables.

Pictures are drawn from a copy of the plot on paper, with a heading and a legend, without crosshair.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from copy import copy
from dataclasses import replace
from functools import partial
from itertools import pairwise
from math import ceil
from pathlib import Path
from typing import Any

import numpy as np
from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QObject, QPoint, QRectF, QSize, Qt, Signal

from skinsource.base.decibels import levels_for_tables
from skinsource.base.errors import SkinSourceError
from skinsource.base.job import never
from skinsource.design.labels import limb_label, signal_label
from skinsource.export.exported_design import (
    describe_levels,
    describe_played,
    describe_projection,
    output_file,
)
from skinsource.export.tables import CsvTable
from skinsource_gui.plots.curves import Curves, PlotTexts
from skinsource_gui.plots.legend import PEAK, LegendStrip, LegendText, along_axes
from skinsource_gui.plots.pictures import (
    Draw,
    caption_px,
    drawn_image,
    lines_of,
    save_drawing,
    with_caption,
)
from skinsource_gui.plots.plot import Plot
from skinsource_gui.plots.ranges import Kind, Range, XAxis
from skinsource_gui.qt.buttons import passing_menu, tool_button
from skinsource_gui.qt.keys import KEYS, key_text
from skinsource_gui.qt.layouts import FlowLayout, in_column, named
from skinsource_gui.qt.overlays import Staleness
from skinsource_gui.qt.questions import ask_save
from skinsource_gui.qt.theme import LIGHT, UNIT_PX, Theme, current_theme, drawn_in, on_paper

_LAYOUTS = (
    ("overlaid", "Overlaid", "All curves over each other"),
    ("stacked", "Stacked", "Each curve in its own row, all with the same scale"),
)


class PlotToolbar(QtWidgets.QWidget):
    """Buttons for the layout, switches of one plot, and a button that leaves a zoom.

    Signals tell what the user wants; the owner sets what the buttons show.  Where it is narrow,
    they stand in several rows.
    """

    #: ``"overlaid"``, ``"stacked"``, or a layout that was added.
    layout_chosen = Signal(str)
    everything_requested = Signal()

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._row = FlowLayout(self, UNIT_PX // 2)
        self._row.setContentsMargins(UNIT_PX // 2, 1, UNIT_PX // 2, 1)
        self._buttons: list[QtWidgets.QToolButton] = []
        self._layouts = QtWidgets.QButtonGroup(self)
        self._layout_buttons: dict[str, QtWidgets.QToolButton] = {}
        self._everything = self._button("show-all", "Fit", "Reset zoom (key 0)", at=0)
        self._everything.setCheckable(False)
        self._everything.clicked.connect(self.everything_requested)
        self._everything.setVisible(False)
        for name, text, hint in _LAYOUTS:
            self.add_layout(name, text, hint)
        self._layouts.buttonClicked.connect(
            lambda button: self.layout_chosen.emit(button.objectName())
        )

    def add_layout(self, name: str, text: str, hint: str) -> None:
        """Add a further layout, before any switch."""
        button = self._button(name, text, hint, at=len(self._layout_buttons))
        self._layouts.addButton(button)
        self._layout_buttons[name] = button

    def add_switch(
        self, name: str, text: str, hint: str, toggled: Callable[[bool], None]
    ) -> QtWidgets.QToolButton:
        """Return a new switch; ``toggled`` is called with the state that the user wants."""
        button = self._button(name, text, hint, at=len(self._buttons) - 1)
        button.clicked.connect(toggled)
        return button

    def show_passing(self, button: QtWidgets.QToolButton, on: bool) -> None:
        """Show a switch only while it is on."""
        button.setChecked(on)
        if button.isHidden() == on:
            self._show(button, on)

    def show_state(self, *, layout: str, zoomed: bool) -> None:
        """Show the present layout, and whether the plot is zoomed."""
        self._layout_buttons[layout].setChecked(True)
        if self._everything.isHidden() == zoomed:
            self._show(self._everything, zoomed)

    def _show(self, button: QtWidgets.QToolButton, shown: bool) -> None:
        """Show or hide a button; the focus stays in the toolbar."""
        chosen = self._layouts.checkedButton()
        if not shown and button.hasFocus() and chosen is not None:
            chosen.setFocus(Qt.FocusReason.OtherFocusReason)
        button.setVisible(shown)

    def _button(self, name: str, text: str, hint: str, *, at: int) -> QtWidgets.QToolButton:
        button = tool_button(self, name, text, hint, checkable=True)
        button.setAccessibleName(text)
        button.setAccessibleDescription(hint)
        self._row.insert(at, button)
        self._buttons.insert(at, button)
        # Tab goes from left to right, in any order of creation.
        for before, after in pairwise(self._buttons):
            QtWidgets.QWidget.setTabOrder(before, after)
        return button


_SCALE = 2
_SWATCH_PX, _GAP_PX = 16, 4


def usual_size(plot: Plot) -> QSize:
    """Return the usual size of a picture of ``plot``, px: twice that on the screen, with legend."""
    return QSize(plot.width(), plot.height() + _head_px(plot, plot.width())) * _SCALE


def draw_signals(
    painter: QtGui.QPainter, width: int, height: int, *, plot: Plot, theme: Theme = LIGHT
) -> None:
    """Draw what ``plot`` shows, ``width`` by ``height`` px; letters grow with the picture."""
    with drawn_in(theme):
        _draw(painter, width, height, plot)


def _draw(painter: QtGui.QPainter, width: int, height: int, plot: Plot) -> None:
    usual = usual_size(plot).toSizeF() * (1.0 / _SCALE)
    scale = min(width / usual.width(), height / usual.height())
    room = QSize(round(width / scale), round(height / scale))
    head_px = _head_px(plot, room.width())
    paper_plot = copy_of(plot, QSize(room.width(), max(room.height() - head_px, 1)))
    painter.save()
    painter.fillRect(QRectF(0, 0, width, height), QtGui.QColor(current_theme().base))
    painter.scale(scale, scale)
    _paint_head(painter, paper_plot)
    painter.translate(0, head_px)
    area = QRectF(paper_plot.rect())
    with on_paper():
        paper_plot.scene().render(painter, area, area)
    painter.restore()
    paper_plot.deleteLater()


def copy_of(plot: Plot, size: QSize) -> Plot:
    """Return a plot on paper that shows the same as ``plot``, in another size, without crosshair.

    The plot on the screen does not change.
    """
    paper_plot = Plot(on_paper=True)
    paper_plot.resize(size)
    paper_plot.set_view(plot.x_window.axis, plot.zoom, stacked=plot.stacked, fitted=plot.fitted)
    paper_plot.set_texts(replace(plot.texts, stale=False))
    paper_plot.steady_range = copy(plot.steady_range)
    if plot.curves is not None:
        paper_plot.show_curves(plot.curves)
    for item in paper_plot.scene().items():
        # As lines and letters, not as pictures of them.
        item.setCacheMode(item.CacheMode.NoCache)
    return paper_plot


def _head_px(plot: Plot, width_px: int) -> int:
    n_lines = len(_heading_lines(plot, width_px)) + len(_legend_lines(plot, width_px))
    return ceil(n_lines * _line_px(plot)) + UNIT_PX // 2


def _paint_head(painter: QtGui.QPainter, plot: Plot) -> None:
    line_px = _line_px(plot)
    painter.setFont(plot.text_font)
    painter.setPen(QtGui.QColor(current_theme().text))
    heading = _heading_lines(plot, plot.width())
    for row, words in enumerate(heading):
        room = QRectF(UNIT_PX, row * line_px, plot.width(), line_px)
        painter.drawText(room, Qt.AlignmentFlag.AlignVCenter, words)
    for row, line in enumerate(_legend_lines(plot, plot.width()), start=len(heading)):
        middle = (row + 0.5) * line_px
        for left, pen, text in line:
            if pen is not None:
                painter.setPen(pen)
                painter.drawLine(left, int(middle), left + _SWATCH_PX, int(middle))
                left += _SWATCH_PX + _GAP_PX
            painter.setPen(QtGui.QColor(current_theme().text))
            room = QRectF(left, row * line_px, plot.width(), line_px)
            painter.drawText(room, Qt.AlignmentFlag.AlignVCenter, text)


def _line_px(plot: Plot) -> float:
    return QtGui.QFontMetricsF(plot.text_font).height() + 2


def _heading_lines(plot: Plot, width_px: int) -> list[str]:
    """Return the heading in as many lines as it needs."""
    if plot.curves is None or not plot.curves.heading:
        return []
    heading = "\N{NO-BREAK SPACE}· ".join(plot.curves.heading)
    return lines_of(heading, QtGui.QFontMetricsF(plot.text_font), width_px - 2 * UNIT_PX)


def _legend_lines(plot: Plot, width_px: int) -> list[list[tuple[int, QtGui.QPen | None, str]]]:
    """Return left edge, pen and text of each entry of the legend, line by line."""
    metrics = QtGui.QFontMetricsF(plot.text_font)
    lines: list[list[tuple[int, QtGui.QPen | None, str]]] = [[]]
    left = UNIT_PX
    for pen, text in _entries(plot):
        swatch_px = 0 if pen is None else _SWATCH_PX + _GAP_PX
        width = ceil(swatch_px + metrics.horizontalAdvance(text) + 2 * UNIT_PX)
        if lines[-1] and left + width > width_px:
            lines.append([])
            left = UNIT_PX
        lines[-1].append((left, pen, text))
        left += width
    return lines


def _entries(plot: Plot) -> Iterator[tuple[QtGui.QPen | None, str]]:
    """Return pens and texts; where axes have the pens, outputs are named by the numbers of rows."""
    curves = plot.curves
    if curves is None:
        return
    for rank, axis in enumerate(curves.axes):
        yield QtGui.QPen(current_theme().axis_colour(rank), 2.0), axis
    for rank, name in enumerate(curves.names):
        text = f"{name.number}  {name.short}" if name.number else name.short
        if curves.peaks:
            text += f", peak {curves.peak_texts[rank]} {curves.peak_unit.symbol}"
        pen = current_theme().output_pen(rank, 2.0)
        pen.setColor(name.colour(pen.color()))
        yield None if curves.axes else pen, text


_UNITS: dict[Kind, str] = {
    "amplitude": "m_per_s2",
    "level": "db_re_1_m_per_s2",
    "relative": "of_its_peak",
}


def save_table(path: Path, plot: Plot, title: str, lines: Sequence[str] = ()) -> None:
    """Write the curves of ``plot`` as a table: all samples, in SI, whatever part is visible.

    ``lines`` are further lines for its head, without those that are there already.

    Raises
    ------
    StorageError
        The folder cannot be written, or the disk is full.
    """
    curves = plot.curves
    if curves is None:
        return
    unit = _UNITS[curves.kind]
    axis = plot.x_window.axis
    about = ["SkinSource studio", title, axis.titles[0]]
    about.extend(curves.about())
    if curves.peaks:
        pairs = zip(curves.names, curves.peaks, strict=True)
        about.append(
            f"peaks in m/s²: {', '.join(f'{name.number}: {peak!r}' for name, peak in pairs)}"
        )
    about.extend(line for line in lines if line not in about)
    if plot.texts.synthetic:
        about.insert(1, "SYNTHETIC LIMB: computed responses, not measured ones")
    columns = curves.columns or tuple(
        f"output_{name.number}{axis and f'_{axis}'}_{unit}"
        for name in curves.names
        for axis in curves.axes or ("",)
    )
    header = [axis.column, *columns]
    y = levels_for_tables(curves.y) if curves.kind == "level" else curves.y
    with output_file(path, never) as file:
        CsvTable(file, about, header, never).add(np.vstack((curves.x, y)).T)


_PICTURES = "PNG picture (*.png);;SVG drawing (*.svg);;PDF page (*.pdf)"
_TABLES = "CSV (*.csv)"


class SignalExports(QObject):
    """Copies and saves what ``plot`` shows; ``title`` names it.

    Attributes
    ----------
    folder
        Folder that file dialogs suggest.
    caption, lines
        Return the caption of a picture, and further lines for the head of a table.
    as_stored
        Returns a context in which the plot shows no matched levels.
    """

    #: Path of a file that was written.
    written = Signal(object)
    #: Sentence that says why a file was not written.
    failed = Signal(str)

    def __init__(self, plot: Plot, title: str, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent)
        self._plot, self._title, self._parent = plot, title, parent
        self.folder = Path()
        self.caption: Callable[[], str] = str
        self.lines: Callable[[], Sequence[str]] = tuple
        self.as_stored: Callable[[], AbstractContextManager[None]] = nullcontext

    def copy_picture(self) -> None:
        """Put a picture on the clipboard."""
        with self.as_stored():
            picture = drawn_image(*self._picture())
        QtWidgets.QApplication.clipboard().setImage(picture)

    def save_picture(self) -> None:
        """Ask for a file, and write a picture of the usual size to it."""
        start = self.folder / f"{self._plot.objectName()}.png"
        path = ask_save(self._parent, "Save picture", start, _PICTURES)
        if path is not None:
            self._write(path, partial(save_drawing, path, *self._picture(), title=self._title))

    def save_data(self) -> None:
        """Ask for a file, and write the curves to it as a table."""
        start = self.folder / f"{self._plot.objectName()}.csv"
        path = ask_save(self._parent, "Export data", start, _TABLES)
        if path is not None:
            lines = self.lines()
            self._write(path, partial(save_table, path, self._plot, self._title, lines))

    def _picture(self) -> tuple[Draw, int, int]:
        """Return how a picture is drawn, and its width and height."""
        size, caption = usual_size(self._plot), self.caption()
        height = size.height() + caption_px(caption, size.width(), size.height())
        draw = with_caption(partial(draw_signals, plot=self._plot), caption)
        return draw, size.width(), height

    def _write(self, path: Path, write: Callable[[], None]) -> None:
        try:
            with self.as_stored():
                write()
        except SkinSourceError as error:
            self.failed.emit(str(error))
        else:
            self.written.emit(path)


_COMPUTING = "Computing…"
# Nothing moves while cursors are dragged.
_MEASURED_ROOM = "0.0000, 0.0000"


class SignalView(QtWidgets.QWidget):
    """A toolbar, a legend with readings, and a plot with zoom, crosshair and menu.

    It shows what panels tell it, and its signals tell what the user wants.

    Parameters
    ----------
    name, accessible_name
        `objectName` of the plot; what it shows, for screen readers.
    lateness
        Staleness that is shared with others; unless given, the view has its own.
    """

    #: Part of the x axis the user wants to see, SI; None: everything.
    zoom_requested = Signal(object)
    #: Where the user wants the two cursors, SI; None: nowhere.
    cursors_requested = Signal(object)

    def __init__(
        self,
        name: str,
        accessible_name: str,
        parent: QtWidgets.QWidget | None = None,
        lateness: Staleness | None = None,
    ) -> None:
        super().__init__(parent)
        self.toolbar = PlotToolbar(self)
        self.legend = LegendStrip(self)
        self.plot = named(Plot(self), name, accessible_name)
        self.plot.setAccessibleDescription(
            "; ".join(KEYS["plot"].sentences("step", "zoom_in", "zoom_out", "whole"))
        )
        in_column(self.toolbar, self.legend, (self.plot, 1), of=self, margins=0, gap_px=0)
        self.exports = SignalExports(self.plot, accessible_name, self)
        #: A panel of the window has the export dialog ask for more.
        self.save_picture: Callable[[], None] = self.exports.save_picture
        self._in_menu: list[QtWidgets.QToolButton] = []
        self._measured: tuple[Curves | None, Range | None] = None, None
        self._staleness = lateness or Staleness(self)
        self._staleness.changed.connect(self._mark_stale)
        self.plot.navigation.zoom_requested.connect(self.zoom_requested)
        self.plot.cursors.moved_to.connect(self.cursors_requested)
        self._cursors = self.add_switch_in_menu(
            "cursors",
            "Cursors",
            "Measure between two lines; drag them, or press I and O",
            self._ask_cursors,
        )
        self.toolbar.everything_requested.connect(self.plot.navigation.show_everything)
        self.plot.reading_changed.connect(self._read)
        self.plot.menu_requested.connect(self._open_menu)

    def add_switch_in_menu(
        self, name: str, text: str, hint: str, toggled: Callable[[bool], None]
    ) -> QtWidgets.QToolButton:
        """Return a new switch of the menu, which the toolbar shows too while it is on."""
        button = self.toolbar.add_switch(name, text, hint, toggled)
        self._in_menu.append(button)
        self.show_switch(button, False)
        return button

    def show_switch(self, button: QtWidgets.QToolButton, on: bool) -> None:
        """Show whether a switch is on; one of the menu is seen only then."""
        if button in self._in_menu:
            self.toolbar.show_passing(button, on)
        else:
            button.setChecked(on)

    def show_cursors(self, at: Range | None) -> None:
        """Put the two cursors somewhere, SI, or take them away."""
        if at != self.plot.cursors.at:
            self.plot.cursors.show_at(at)
            self.show_switch(self._cursors, at is not None)
            self._read()

    def show_curves(self, curves: Curves, *, synthetic: bool, notes: tuple[str, ...] = ()) -> None:
        """Draw ``curves``, and the longest of ``notes`` that fits.

        The curves are up to date until the staleness says otherwise.
        """
        self._staleness.set_stale(False)
        self.plot.set_texts(PlotTexts(synthetic=synthetic, notes=notes))
        self.plot.show_curves(curves)

    def wait_for_curves(self) -> None:
        """Remove the curves until there are new ones; a message appears after a while."""
        self.plot.show_message(_COMPUTING if self._staleness.is_stale else "")

    def _mark_stale(self, stale: bool) -> None:
        if self.plot.curves is None and not self.plot.message:
            self.plot.show_message(_COMPUTING)
        self.plot.set_texts(replace(self.plot.texts, stale=stale))

    def _ask_cursors(self, on: bool) -> None:
        low, high = self.plot.x_window.values(self.plot.x_window.shown)
        quarter = (high - low) / 4
        self.cursors_requested.emit((low + quarter, high - quarter) if on else None)

    def _copy_measured(self) -> None:
        QtWidgets.QApplication.clipboard().setText(self.legend.text.lines())

    def _open_menu(self, at: QPoint) -> None:
        """Open the menu at a place on the screen; it is deleted when it closes."""
        if self.plot.curves is None:
            return
        menu = passing_menu(self, "plot-menu")
        # The plot handles the keys; the menu only shows them.
        view_all = menu.addAction(f"View all\t{key_text('plot', 'whole')}")
        view_all.triggered.connect(self.plot.navigation.show_everything)
        for switch in self._in_menu:
            chosen = menu.addAction(switch.accessibleName())
            chosen.setCheckable(True)
            chosen.setChecked(switch.isChecked())
            chosen.setToolTip(switch.toolTip())
            chosen.triggered.connect(switch.click)
        menu.setToolTipsVisible(True)
        menu.addSeparator()
        measured = () if measured_text(self.plot) is None else ("Copy what cursors read",)
        for text, export in (
            *((text, self._copy_measured) for text in measured),
            ("Copy picture", self.exports.copy_picture),
            ("Save picture as…", self.save_picture),
            ("Export data…", self.exports.save_data),
        ):
            action = menu.addAction(text)
            # Curves of an older design cannot be exported.
            action.setEnabled(not self._staleness.is_stale)
            action.triggered.connect(export)
        menu.popup(at)

    def _read(self) -> None:
        measured = self.plot.curves, self.plot.cursors.at
        # The crosshair changes nothing that was measured.
        if measured != self._measured or measured[1] is None:
            self._measured = measured
            self.legend.say(reading(self.plot))


def reading(plot: Plot) -> LegendText:
    """Return the names of the curves of ``plot``, and what the crosshair reads."""
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
        # With room for peaks too, so that nothing moves.
        text = replace(text, reading_room=max((text.reading_room, *curves.peak_texts), key=len))
    if measured := measured_text(plot):
        return measured
    if plot.crosshair.index is None:
        if curves.axes or not curves.peaks:
            return text
        return replace(text, unit=curves.peak_unit.symbol, where=PEAK, readings=curves.peak_texts)
    readings = tuple(unit.reading(float(y)) for y in curves.y[:, plot.crosshair.index])
    return replace(
        text,
        where=axis.reading(float(curves.x[plot.crosshair.index])),
        readings=along_axes(readings, curves.each) if curves.axes else readings,
    )


def measured_text(plot: Plot) -> LegendText | None:
    """Return what the curves do between the cursors; None without cursors."""
    curves, at = plot.curves, plot.cursors.held
    if curves is None or curves.measure is None or at is None:
        return None
    measured = curves.measure(at)
    readings = measured.readings
    text = LegendText(
        names=curves.names,
        where=f"{measured.meaning} · {measured.distance}",
        where_room=f"{measured.meaning} · {measured.distance}",
        reading_room=max((_MEASURED_ROOM, *readings), key=len),
    )
    if curves.axes:
        text, readings = text.of_axes(curves.axes), along_axes(readings, curves.each)
    return replace(text, readings=readings, details=measured.details)


#: Quantities that describe curves in files and pictures.
DESCRIPTION_QUANTITIES = frozenset(
    {
        "actuation",
        "axes",
        "inputs",
        "limb",
        "limb_data",
        "match_gain",
        "method",
        "record_samples",
        "sample_rate_hz",
        "scaling",
        "span",
    }
)
#: Text for curves along each axis by itself.
EACH_AXIS = "each axis of the sensors"


def lazy_lines(
    results: Mapping[str, Any], *first: str, each_axis: bool = False
) -> Callable[[], tuple[str, ...]]:
    """Return a function that writes lines for the head of a table, only when they are needed."""
    return partial(
        _lines, {name: results[name] for name in DESCRIPTION_QUANTITIES}, first, each_axis
    )


def _lines(results: Mapping[str, Any], first: tuple[str, ...], each_axis: bool) -> tuple[str, ...]:
    note, inputs = results["limb_data"].note, results["inputs"]
    record_s = results["record_samples"] / results["sample_rate_hz"]
    return (
        *first,
        *describe_played(results["limb"], note, results["scaling"], inputs, results["actuation"]),
        f"axes: {EACH_AXIS}, by itself"
        if each_axis
        else describe_projection(results["axes"], results["method"]),
        describe_levels(results["span"], record_s, results["actuation"]),
    )


def heading_of(results: Mapping[str, Any], *, each_axis: bool = False) -> tuple[str, ...]:
    """Return the parts of the heading of a picture; its caption describes the stimulus."""
    label = signal_label(results["axes"], results["method"])
    projection = f"along {EACH_AXIS}" if each_axis else label
    return limb_label(results["limb"]).title, projection


class ResponseView(SignalView):
    """Plots curves, and keeps zoom and layout itself."""

    def __init__(self, name: str, title: str) -> None:
        super().__init__(name, title)
        self._axis: XAxis | None = None
        self._zoom: tuple[float, float] | None = None
        self._layout = "overlaid"
        self.zoom_requested.connect(self._show_part)
        self.toolbar.layout_chosen.connect(self._lay_curves)
        self._show_view()

    def show_over(self, axis: XAxis, curves: Curves) -> None:
        """Plot curves over an axis; all of another axis is shown."""
        if axis != self._axis:
            self._axis, self._zoom = axis, None
        self._show_view()
        self.show_curves(curves, synthetic=False)

    def _show_part(self, zoom: tuple[float, float] | None) -> None:
        self._zoom = zoom
        self._show_view()

    def _lay_curves(self, layout: str) -> None:
        self._layout = layout
        self._show_view()

    def _show_view(self) -> None:
        self.toolbar.show_state(layout=self._layout, zoomed=self._zoom is not None)
        if self._axis is not None:
            self.plot.set_view(self._axis, self._zoom, stacked=self._layout == "stacked")
