"""What the view of signals draws, and where."""

from itertools import pairwise

import numpy as np
import pytest
from PySide6.QtCore import QPointF
from PySide6.QtGui import QColor, QFontMetricsF, QImage, QPainter

from skinsource_gui.plots.axis import Axis
from skinsource_gui.plots.curves import CurvePoints, Curves, SignalCurve
from skinsource_gui.qt.theme import LIGHT
from tests.gui.signal_view.bench import TIME, drawn, header_of, waves


def test_each_curve_is_one_line_in_its_place(signals):
    signals.show_curves(waves(3), synthetic=False)
    assert len(drawn(signals)) == 3
    view = signals.plot.stack.rows[0].view
    for curve in drawn(signals):
        assert curve.isVisible()
        assert curve.points.smooth
        assert curve.points.x.size == 651
        assert 0 <= curve.points.y.min() < curve.points.y.max() <= 1
        # From one edge to the other.
        assert [curve.points.x[0], curve.points.x[-1]] == pytest.approx(view.viewRange()[0])
    signals.show_curves(waves(2), synthetic=False)
    assert len(drawn(signals)) == 2
    assert [curve.isVisible() for curve in signals.plot.stack.rows[0].curves] == [True, True, False]


def test_a_curve_is_drawn_at_the_heights_of_its_values(signals):
    curves = waves(1)
    signals.show_curves(curves, synthetic=False)
    low, high = signals.plot.value_scale.values
    area, view = signals.plot.places.area, signals.plot.stack.rows[0].view
    curve = drawn(signals)[0]
    for k in (0, 7, 400):
        part = (curves.y[0, k] - low) / (high - low)
        at = view.mapViewToScene(QPointF(curve.points.x[k], curve.points.y[k]))
        assert abs(at.y() - (area.bottom() - part * area.height())) < 1e-9
        assert abs(at.x() - (area.left() + k / 650 * area.width())) < 1e-9


def test_what_is_around_the_curves_is_painted_once(signals, monkeypatch):
    painted = []
    paint = Axis.drawPicture
    monkeypatch.setattr(
        Axis, "drawPicture", lambda axis, *how: (painted.append(axis), paint(axis, *how))
    )
    signals.show_curves(waves(2, amplitude=0.3), synthetic=False)
    signals.plot.grab()
    painted.clear()
    for amplitude in (0.31, 0.29, 0.3):
        signals.show_curves(waves(2, amplitude=amplitude), synthetic=False)
        signals.plot.grab()
    assert painted == []
    signals.show_curves(waves(2, amplitude=3.0), synthetic=False)
    signals.plot.grab()
    assert painted == [signals.plot.stack.rows[0].axis]


def test_labels_lie_inside_the_plot_and_do_not_touch(signals):
    plot = signals.plot
    metrics = QFontMetricsF(plot.font())
    for amplitude in (1e-7, 0.05, 123456.0):
        signals.show_curves(waves(4, amplitude=amplitude), synthetic=True)
        for stacked in (False, True):
            signals.set_view(TIME, None, stacked=stacked)
            ticks = [
                (row.axis.mapToScene(0, at).y(), text)
                for row in plot.stack.rows
                for at, text in row.axis.ticks()
            ]
            widest = max(metrics.horizontalAdvance(text) for _, text in ticks)
            assert widest * 0.9 <= plot.places.left
            labelled = sorted(at for at, text in ticks if text)
            assert np.all(np.diff(labelled) >= 0.7 * metrics.height())


def test_stacked_rows_have_equal_heights_and_one_scale(signals):
    signals.resize(500, 500)
    signals.show_curves(waves(4), synthetic=False)
    signals.set_view(TIME, None, stacked=True)
    rows = signals.plot.stack.rows
    geometries = [row.view.geometry() for row in rows]
    assert np.ptp([geometry.height() for geometry in geometries]) < 1e-6
    for above, below in pairwise(geometries):
        assert above.bottom() == pytest.approx(below.top())
    assert [row.number.text for row in rows] == ["1", "2", "3", "4"]
    assert [row.view.viewRange() for row in rows] == [rows[0].view.viewRange()] * 4
    labels = [[text for _, text in row.axis.ticks()] for row in rows]
    assert labels == [labels[0]] * 4
    assert any(labels[0])


def test_more_than_twelve_rows_are_counted_instead_of_drawn(signals):
    signals.show_curves(waves(15), synthetic=False)
    signals.set_view(TIME, None, stacked=True)
    assert len(signals.plot.stack.rows) == 12
    assert header_of(signals).mark == "+3 more"
    assert len(drawn(signals)) == 12
    signals.set_view(TIME, None, stacked=False)
    assert len(drawn(signals)) == 15


def test_thin_rows_say_their_range_in_words(signals):
    signals.show_curves(waves(12), synthetic=False)
    signals.set_view(TIME, None, stacked=True)
    assert header_of(signals).unit == "m/s², each row ±0.32"


def test_only_blocks_of_strokes_go_without_smooth_edges(signals):
    x = np.arange(20_000) / 1300
    y = np.array([np.sin(2 * np.pi * 100 * x), 1e-3 * x])
    signals.show_curves(Curves(x=x, y=y, names=waves(2).names), synthetic=False)
    assert [curve.points.smooth for curve in drawn(signals)] == [False, True]


def test_a_block_of_strokes_has_no_gaps(signals):
    x = np.arange(26_000) / 1300
    y = np.sin(2 * np.pi * 100 * x + 0.3)[np.newaxis]
    signals.show_curves(Curves(x=x, y=y, names=waves(1).names), synthetic=False)
    picture, area = signals.plot.grab().toImage(), signals.plot.places.area
    middle = area.center().y()
    for row in (int(middle - 0.3 * area.height()), int(middle + 0.3 * area.height())):
        columns = range(int(area.left()) + 2, int(area.right()) - 2)
        assert {picture.pixelColor(column, row).name() for column in columns} == {LIGHT.outputs[0]}


@pytest.mark.parametrize("ratio", [1.0, 1.5, 2.0])
def test_curves_are_one_pixel_wide_on_every_screen(qapp, ratio):
    picture = QImage(60, 60, QImage.Format.Format_RGB32)
    picture.setDevicePixelRatio(ratio)
    picture.fill(QColor("white"))
    curve = SignalCurve()
    curve.set_look(LIGHT.output_pen(0, 0.0), stale=False)
    x, y = np.array([0.0, 30.0]), np.full(2, 20.25 / ratio)
    curve.show_points(CurvePoints(x=x, y=y, smooth=False))
    painter = QPainter(picture)
    curve.paint(painter, None, None)
    painter.end()
    inked = [row for row in range(60) if picture.pixelColor(10, row).name() == LIGHT.outputs[0]]
    assert inked == [20]


def test_stale_curves_are_pale(signals, qtbot):
    signals.show_curves(waves(2), synthetic=False)
    assert [curve.opacity() for curve in drawn(signals)] == [1.0, 1.0]
    signals.set_stale(True)
    qtbot.waitUntil(lambda: [curve.opacity() for curve in drawn(signals)] == [0.5, 0.5])
    signals.show_curves(waves(2), synthetic=False)
    assert [curve.opacity() for curve in drawn(signals)] == [1.0, 1.0]


def test_curves_keep_their_colours_when_each_gets_a_row_of_its_own(signals):
    signals.show_curves(waves(5), synthetic=False)
    for stacked in (True, False, True):
        signals.set_view(TIME, None, stacked=stacked)
        colours = [curve.pen.color() for curve in drawn(signals)]
        assert colours == [LIGHT.output_colour(rank) for rank in range(5)]


@pytest.mark.parametrize("size", [(160, 90), (240, 110), (300, 140), (420, 150)])
@pytest.mark.parametrize("zoom", [None, (0.051, 0.1266), (0.21, 0.2801)])
def test_both_axes_have_two_labels_at_least_however_small_the_plot(signals, size, zoom):
    plot = signals.plot
    plot.resize(*size)
    for amplitude in (0.09, 0.11, 0.3, 0.47, 0.63, 7.7):
        plot.reset_range()
        plot.show_curves(waves(amplitude=amplitude))
        plot.set_view(TIME, zoom, stacked=False)
        line = plot.stack.rows[0].axis
        metrics = QFontMetricsF(plot.text_font)
        heights = sorted(at for at, text in line.ticks() if text)
        assert len(heights) >= 2
        assert min(np.diff(heights)) >= 0.95 * metrics.height()
        x_axis = plot.stack.x_axis
        _, _, labels = x_axis.generateDrawSpecs(None)
        assert len(labels) >= 2
