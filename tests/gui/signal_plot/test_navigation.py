"""The plot of traces and spectra, without a panel."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from skinsource_gui.widgets.plot.curves import Curves, output_names
from tests.gui.signal_plot.bench import FREQUENCY, TIME, turn_wheel, waves


def test_the_crosshair_reads_exact_samples_and_leaves_with_the_mouse(plot):
    curves = waves(2)
    plot.show_curves(curves, synthetic=False)
    canvas = plot.canvas
    QTest.mouseMove(canvas, QPoint(200, 60))
    index = canvas.cursor
    assert index is not None
    text = plot.legend.text
    assert text.where == f"{curves.x[index] * 1e3:.1f} ms"
    assert text.readings == tuple(f"{y:.4f}".replace("-", "−") for y in curves.y[:, index])
    assert text.unit == "m/s²"
    left, _, width, _ = canvas.frame.plot
    assert curves.x[index] == pytest.approx((200 - left) / width * curves.x[-1], abs=1 / 1300)
    QTest.mouseMove(canvas, QPoint(2, 2))
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
    canvas = plot.canvas
    left, _, width, _ = plot.canvas.frame.plot
    with qtbot.waitSignal(plot.zoom_requested) as asked:
        QTest.mousePress(canvas, Qt.MouseButton.LeftButton, pos=QPoint(300, 60))
        QTest.mouseMove(canvas, QPoint(200, 62))
        QTest.mouseRelease(canvas, Qt.MouseButton.LeftButton, pos=QPoint(200, 62))
    low, high = asked.args[0]
    assert low == pytest.approx(0.5 * (200 - left) / width)
    assert high == pytest.approx(0.5 * (300 - left) / width)


def test_a_click_or_an_escaped_drag_zooms_nowhere(plot, qtbot):
    plot.show_curves(waves(2), synthetic=False)
    canvas = plot.canvas
    with qtbot.assertNotEmitted(plot.zoom_requested):
        QTest.mouseClick(canvas, Qt.MouseButton.LeftButton, pos=QPoint(150, 60))
        QTest.mousePress(canvas, Qt.MouseButton.LeftButton, pos=QPoint(150, 60))
        QTest.mouseMove(canvas, QPoint(250, 60))
        QTest.keyClick(canvas, Qt.Key.Key_Escape)
        QTest.mouseRelease(canvas, Qt.MouseButton.LeftButton, pos=QPoint(250, 60))


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
    canvas, width = plot.canvas, plot.canvas.frame.plot[2]
    QTest.mousePress(canvas, Qt.MouseButton.MiddleButton, pos=QPoint(200, 60))
    QTest.mouseMove(canvas, QPoint(150, 60))
    QTest.mouseRelease(canvas, Qt.MouseButton.MiddleButton, pos=QPoint(150, 60))
    assert asked[-1] == pytest.approx((0.1 + 50 / width * 0.2, 0.3 + 50 / width * 0.2))
    QTest.mousePress(canvas, Qt.MouseButton.MiddleButton, pos=QPoint(60, 60))
    QTest.mouseMove(canvas, QPoint(400, 60))
    QTest.mouseRelease(canvas, Qt.MouseButton.MiddleButton, pos=QPoint(400, 60))
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
    QTest.mouseDClick(plot.canvas, Qt.MouseButton.LeftButton, pos=QPoint(150, 60))
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
