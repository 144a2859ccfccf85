"""The plot of traces and spectra, without a panel."""

import numpy as np
import pytest
from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QColor, QFontMetricsF, QImage, QPainter, QPolygonF

from skinsource_gui.theme import LIGHT
from skinsource_gui.widgets.plot import plot_canvas
from skinsource_gui.widgets.plot.curve_lines import CurveLine, paint_lines
from skinsource_gui.widgets.plot.curves import Curves
from tests.gui.signal_plot.bench import TIME, waves


def test_each_curve_is_one_line_in_its_place(plot):
    plot.show_curves(waves(3), synthetic=False)
    area = plot.canvas.frame.area
    assert len(plot.canvas.lines) == 3
    for line in plot.canvas.lines:
        assert line.smooth
        assert line.points.size() == 651
        assert area.contains(line.points.boundingRect())
        assert line.points.first().x() == area.left()
        assert line.points.last().x() == area.right()
    plot.show_curves(waves(2), synthetic=False)
    assert len(plot.canvas.lines) == 2


def test_a_curve_is_drawn_at_the_heights_of_its_values(plot):
    curves = waves(1)
    plot.show_curves(curves, synthetic=False)
    low, high = plot.canvas.rows.values
    area = plot.canvas.frame.area
    line = plot.canvas.lines[0].points
    for k in (0, 7, 400):
        part = (curves.y[0, k] - low) / (high - low)
        assert abs(line.at(k).y() - (area.bottom() - part * area.height())) < 1e-9


def test_what_is_around_the_curves_is_painted_once(plot, monkeypatch):
    painted = []
    monkeypatch.setattr(plot_canvas, "paint_frame", lambda *_: painted.append(1))
    plot.show_curves(waves(2, amplitude=0.3), synthetic=False)
    plot.canvas.grab()
    for amplitude in (0.31, 0.29, 0.3):
        plot.show_curves(waves(2, amplitude=amplitude), synthetic=False)
        plot.canvas.grab()
    assert len(painted) == 1
    plot.show_curves(waves(2, amplitude=3.0), synthetic=False)
    plot.canvas.grab()
    assert len(painted) == 2


def test_labels_lie_inside_the_canvas_and_do_not_touch(plot):
    metrics = QFontMetricsF(plot.canvas.font())
    for amplitude in (1e-7, 0.05, 123456.0):
        plot.show_curves(waves(4, amplitude=amplitude), synthetic=True)
        for stacked in (False, True):
            plot.set_view(TIME, None, stacked=stacked)
            frame = plot.canvas.frame
            widest = max(metrics.horizontalAdvance(mark.text) for mark in frame.y_marks)
            assert widest * 0.9 <= frame.plot[0]
            labelled = sorted(mark.at for mark in frame.y_marks if mark.text)
            assert np.all(np.diff(labelled) >= 0.7 * metrics.height())


def test_stacked_rows_have_equal_heights_and_one_scale(plot):
    plot.resize(500, 500)
    plot.show_curves(waves(4), synthetic=False)
    plot.set_view(TIME, None, stacked=True)
    frame = plot.canvas.frame
    edges = [frame.plot[1], *frame.row_edges, frame.plot[1] + frame.plot[3]]
    assert np.ptp(np.diff(edges)) < 1e-6
    assert [mark.text for mark in frame.row_numbers] == ["1", "2", "3", "4"]
    labels = [mark.text for mark in frame.y_marks]
    assert labels == labels[: len(labels) // 4] * 4


def test_more_than_twelve_rows_are_counted_instead_of_drawn(plot):
    plot.show_curves(waves(15), synthetic=False)
    plot.set_view(TIME, None, stacked=True)
    assert plot.canvas.rows.count == 12
    assert plot.canvas.frame.mark == "+3 more"
    assert len(plot.canvas.lines) == 12
    plot.set_view(TIME, None, stacked=False)
    assert len(plot.canvas.lines) == 15


def test_thin_rows_say_their_range_in_words(plot):
    plot.show_curves(waves(12), synthetic=False)
    plot.set_view(TIME, None, stacked=True)
    assert plot.canvas.frame.unit == "m/s², each row ±0.32"


def test_only_blocks_of_strokes_go_without_smooth_edges(plot):
    x = np.arange(20_000) / 1300
    y = np.array([np.sin(2 * np.pi * 100 * x), 1e-3 * x])
    plot.show_curves(Curves(x=x, y=y, names=waves(2).names), synthetic=False)
    assert [line.smooth for line in plot.canvas.lines] == [False, True]


@pytest.mark.parametrize("ratio", [1.0, 1.5, 2.0])
def test_curves_are_one_pixel_wide_on_every_screen(qapp, ratio):
    picture = QImage(60, 60, QImage.Format.Format_RGB32)
    picture.setDevicePixelRatio(ratio)
    picture.fill(QColor("white"))
    points = QPolygonF([QPointF(0, 20.25 / ratio), QPointF(30, 20.25 / ratio)])
    line = CurveLine(points=points, smooth=False)
    painter = QPainter(picture)
    paint_lines(painter, (line,), QRectF(0, 0, 30, 30), LIGHT, stale=False)
    painter.end()
    inked = [row for row in range(60) if picture.pixelColor(10, row).name() == LIGHT.outputs[0]]
    assert inked == [20]
