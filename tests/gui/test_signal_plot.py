"""The plot of traces and spectra, without a panel."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QFontMetricsF, QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from skinsource_gui.theme import DARK, LIGHT
from skinsource_gui.widgets.curves import Curves, output_names
from skinsource_gui.widgets.plot_axis import (
    XAxis,
)
from skinsource_gui.widgets.signal_plot import SignalPlot

TIME = XAxis(titles=("Time (ms) and much more to say about it", "Time (ms)"), unit="ms", factor=1e3)
FREQUENCY = XAxis(titles=("Frequency (Hz)",), unit="Hz", extent=(10.0, 650.0), log=True)


def waves(n_curves=2, n_points=651, amplitude=0.3):
    x = np.arange(n_points) / 1300
    y = [amplitude / (1 + k) * np.sin(2 * np.pi * 20 * x + k) for k in range(n_curves)]
    return Curves(x=x, y=np.array(y), names=output_names(tuple(range(1, n_curves + 1))))


@pytest.fixture
def plot(qtbot):
    widget = SignalPlot("plot", "Plot")
    qtbot.addWidget(widget)
    widget.resize(420, 172)
    widget.set_view(TIME, None, stacked=False)
    widget.show()
    qtbot.waitExposed(widget)
    return widget


def test_curve_items_live_on_while_data_change(plot):
    plot.show_curves(waves(3), synthetic=False)
    items = list(plot.canvas.layer.items)
    plot.show_curves(waves(3, n_points=900, amplitude=2.0), synthetic=False)
    assert plot.canvas.layer.items == items
    plot.show_curves(waves(2), synthetic=False)
    assert plot.canvas.layer.items == items[:2]


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
    assert [item.isVisible() for item in plot.canvas.layer.items] == [True] * 12 + [False] * 3
    plot.set_view(TIME, None, stacked=False)
    assert all(item.isVisible() for item in plot.canvas.layer.items)


def test_thin_rows_say_their_range_in_words(plot):
    plot.show_curves(waves(12), synthetic=False)
    plot.set_view(TIME, None, stacked=True)
    assert plot.canvas.frame.unit == "m/s², each row ±0.32"


def test_the_crosshair_reads_exact_samples_and_leaves_with_the_mouse(plot):
    curves = waves(2)
    plot.show_curves(curves, synthetic=False)
    canvas = plot.canvas
    QTest.mouseMove(canvas.viewport(), QPoint(200, 60))
    index = canvas.cursor
    assert index is not None
    text = plot.legend.text
    assert text.where == f"{curves.x[index] * 1e3:.1f} ms"
    assert text.readings == tuple(f"{y:.4f}".replace("-", "−") for y in curves.y[:, index])
    assert text.unit == "m/s²"
    left, _, width, _ = canvas.frame.plot
    assert curves.x[index] == pytest.approx((200 - left) / width * curves.x[-1], abs=1 / 1300)
    QTest.mouseMove(canvas.viewport(), QPoint(2, 2))
    assert canvas.cursor is None
    assert plot.legend.text.readings == ()


def test_the_crosshair_keeps_its_place_when_data_change(plot):
    plot.show_curves(waves(2), synthetic=False)
    plot.canvas.set_cursor(130)
    plot.show_curves(waves(2, n_points=1300, amplitude=0.25), synthetic=False)
    assert plot.canvas.cursor == 130
    assert plot.legend.text.where == "100.0 ms"
    plot.show_curves(waves(2, n_points=50), synthetic=False)
    assert plot.canvas.cursor == 49


def test_keys_move_the_crosshair_until_escape(plot):
    plot.show_curves(waves(2), synthetic=False)
    canvas = plot.canvas
    QTest.keyClick(canvas, Qt.Key.Key_Right)
    assert canvas.cursor == 325
    QTest.keyClick(canvas, Qt.Key.Key_Left)
    QTest.keyClick(canvas, Qt.Key.Key_Right, Qt.KeyboardModifier.ShiftModifier)
    assert canvas.cursor == 334
    QTest.keyClick(canvas, Qt.Key.Key_End)
    QTest.keyClick(canvas, Qt.Key.Key_Right)
    assert canvas.cursor == 650
    QTest.keyClick(canvas, Qt.Key.Key_Home)
    assert canvas.cursor == 0
    QTest.keyClick(canvas, Qt.Key.Key_Escape)
    assert canvas.cursor is None


def test_a_crosshair_moved_out_of_sight_asks_for_the_part_it_is_in(plot, qtbot):
    plot.show_curves(waves(2), synthetic=False)
    plot.set_view(TIME, (0.1, 0.2), stacked=False)
    with qtbot.waitSignal(plot.zoom_requested) as asked:
        QTest.keyClick(plot.canvas, Qt.Key.Key_End)
    assert asked.args[0] == pytest.approx((0.4, 0.5))


def test_a_drag_zooms_to_what_it_covers(plot, qtbot):
    plot.show_curves(waves(2), synthetic=False)
    viewport = plot.canvas.viewport()
    left, _, width, _ = plot.canvas.frame.plot
    with qtbot.waitSignal(plot.zoom_requested) as asked:
        QTest.mousePress(viewport, Qt.MouseButton.LeftButton, pos=QPoint(300, 60))
        QTest.mouseMove(viewport, QPoint(200, 62))
        QTest.mouseRelease(viewport, Qt.MouseButton.LeftButton, pos=QPoint(200, 62))
    low, high = asked.args[0]
    assert low == pytest.approx(0.5 * (200 - left) / width)
    assert high == pytest.approx(0.5 * (300 - left) / width)


def test_a_click_or_an_escaped_drag_zooms_nowhere(plot, qtbot):
    plot.show_curves(waves(2), synthetic=False)
    canvas = plot.canvas
    with qtbot.assertNotEmitted(plot.zoom_requested):
        QTest.mouseClick(canvas.viewport(), Qt.MouseButton.LeftButton, pos=QPoint(150, 60))
        QTest.mousePress(canvas.viewport(), Qt.MouseButton.LeftButton, pos=QPoint(150, 60))
        QTest.mouseMove(canvas.viewport(), QPoint(250, 60))
        QTest.keyClick(canvas, Qt.Key.Key_Escape)
        QTest.mouseRelease(canvas.viewport(), Qt.MouseButton.LeftButton, pos=QPoint(250, 60))


def turn_wheel(canvas, x, modifiers, turned=120):
    at = QPointF(x, 60)
    event = QWheelEvent(
        at,
        canvas.viewport().mapToGlobal(at),
        QPoint(),
        QPoint(0, turned),
        Qt.MouseButton.NoButton,
        modifiers,
        Qt.ScrollPhase.NoScrollPhase,
        False,
    )
    QApplication.sendEvent(canvas.viewport(), event)


def test_ctrl_and_the_wheel_zoom_at_the_pointer_and_the_wheel_alone_does_not(plot, qtbot):
    plot.show_curves(waves(2), synthetic=False)
    canvas = plot.canvas
    before = canvas.window.position((200 - canvas.frame.plot[0]) / canvas.frame.plot[2])
    with qtbot.assertNotEmitted(plot.zoom_requested):
        turn_wheel(canvas, 200, Qt.KeyboardModifier.NoModifier)
    with qtbot.waitSignal(plot.zoom_requested) as asked:
        turn_wheel(canvas, 200, Qt.KeyboardModifier.ControlModifier)
    low, high = asked.args[0]
    assert high - low == pytest.approx(0.5 / 1.2)
    plot.set_view(TIME, asked.args[0], stacked=False)
    after = canvas.window.position((200 - canvas.frame.plot[0]) / canvas.frame.plot[2])
    assert after == pytest.approx(before)


def test_the_middle_button_pans_and_stops_at_the_ends(plot):
    plot.show_curves(waves(2), synthetic=False)
    plot.set_view(TIME, (0.1, 0.3), stacked=False)
    asked = []
    plot.zoom_requested.connect(asked.append)
    viewport, width = plot.canvas.viewport(), plot.canvas.frame.plot[2]
    QTest.mousePress(viewport, Qt.MouseButton.MiddleButton, pos=QPoint(200, 60))
    QTest.mouseMove(viewport, QPoint(150, 60))
    QTest.mouseRelease(viewport, Qt.MouseButton.MiddleButton, pos=QPoint(150, 60))
    assert asked[-1] == pytest.approx((0.1 + 50 / width * 0.2, 0.3 + 50 / width * 0.2))
    QTest.mousePress(viewport, Qt.MouseButton.MiddleButton, pos=QPoint(60, 60))
    QTest.mouseMove(viewport, QPoint(400, 60))
    QTest.mouseRelease(viewport, Qt.MouseButton.MiddleButton, pos=QPoint(400, 60))
    assert asked[-1] == pytest.approx((0.0, 0.2))


def test_double_click_and_0_show_everything_and_plus_and_minus_zoom(plot):
    plot.show_curves(waves(2), synthetic=False)
    asked = []
    plot.zoom_requested.connect(asked.append)
    QTest.keyClick(plot.canvas, Qt.Key.Key_Plus)
    assert asked[-1] == pytest.approx((0.25 - 0.5 / 3, 0.25 + 0.5 / 3))
    plot.set_view(TIME, asked[-1], stacked=False)
    QTest.keyClick(plot.canvas, Qt.Key.Key_Minus)
    assert asked[-1] is None
    QTest.keyClick(plot.canvas, Qt.Key.Key_0)
    QTest.mouseDClick(plot.canvas.viewport(), Qt.MouseButton.LeftButton, pos=QPoint(150, 60))
    assert asked[-2:] == [None, None]


def test_a_logarithmic_axis_zooms_evenly_in_octaves(plot, qtbot):
    x = np.arange(326) * 2.0
    plot.show_curves(Curves(x=x, y=np.ones((1, x.size)), names=output_names((1,))), synthetic=False)
    plot.set_view(FREQUENCY, (50.0, 200.0), stacked=False)
    plot.canvas.set_cursor(50)
    assert plot.legend.text.where == "100.0 Hz"
    with qtbot.waitSignal(plot.zoom_requested) as asked:
        QTest.keyClick(plot.canvas, Qt.Key.Key_Minus)
    low, high = asked.args[0]
    assert (100 / low, high / 100) == pytest.approx((2**1.5, 2**1.5))
    plot.set_view(FREQUENCY, (0.0, 50.0), stacked=False)
    assert plot.canvas.window.values(plot.canvas.window.shown) == pytest.approx((10.0, 50.0))


def test_a_zoom_that_holds_no_data_says_how_to_leave_it(plot):
    plot.show_curves(waves(2), synthetic=False)
    plot.set_view(TIME, (2.0, 3.0), stacked=False)
    assert "Press 0" in plot.canvas.frame.hint
    plot.set_view(TIME, None, stacked=False)
    assert plot.canvas.frame.hint == ""


def test_ranges_do_not_change_while_data_change_a_little(plot):
    plot.show_curves(waves(2, amplitude=0.3), synthetic=False)
    before = plot.canvas.frame
    for amplitude in (0.31, 0.25, 0.2, 0.31):
        plot.show_curves(waves(2, amplitude=amplitude), synthetic=False)
        assert plot.canvas.frame is before


def test_values_that_are_not_finite_empty_the_picture(plot):
    curves = waves(1)
    curves.y[0, 3] = np.nan
    plot.show_curves(curves, synthetic=False)
    assert plot.canvas.curves is None
    assert "not finite" in plot.canvas.message


def test_late_results_are_marked_and_quick_ones_are_not(plot, qtbot):
    plot.show_curves(waves(2), synthetic=False)
    plot.set_stale(True)
    assert plot.canvas.frame.mark == ""
    plot.show_curves(waves(2), synthetic=False)
    plot.set_stale(True)
    qtbot.waitUntil(lambda: plot.canvas.frame.mark == "updating…")
    plot.set_stale(False)
    assert plot.canvas.frame.mark == ""


def test_each_theme_has_its_own_background_and_colours(plot):
    plot.show_curves(waves(2), synthetic=False)
    for theme in (LIGHT, DARK):
        plot.set_theme(theme)
        picture = plot.canvas.grab().toImage()
        assert picture.pixelColor(1, picture.height() // 2).name() == theme.base
        pens = [item.opts["pen"].color().name() for item in plot.canvas.layer.items]
        assert tuple(pens) == theme.outputs[:2]


def test_what_is_drawn_follows_the_data(plot):
    plot.show_curves(waves(1), synthetic=False)
    before = plot.canvas.grab().toImage()
    curves = waves(1)
    plot.show_curves(Curves(x=curves.x, y=-curves.y, names=curves.names), synthetic=False)
    assert plot.canvas.grab().toImage() != before
    plot.show_curves(curves, synthetic=False)
    assert plot.canvas.grab().toImage() == before


def test_a_narrow_legend_leaves_out_words_but_its_tooltip_has_them_all(plot):
    plot.show_curves(waves(9), synthetic=False)
    plot.canvas.set_cursor(10)
    lines = plot.legend.text.lines().splitlines()
    assert len(lines) == 10
    assert lines[1].startswith("1  Digit V, beside the nail, ulnar: ")
    assert all(line.endswith("m/s²") for line in lines[1:])
