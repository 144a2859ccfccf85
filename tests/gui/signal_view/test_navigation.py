"""The plot of traces and spectra, without a panel: mouse, keys, and its menu."""

import numpy as np
import pytest
from PySide6.QtCore import QCoreApplication, QEvent, QPoint, Qt
from PySide6.QtGui import QContextMenuEvent, QCursor
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QFileDialog, QMenu, QScrollArea, QVBoxLayout, QWidget

from skinsource_gui.plots.curves import Curves, output_names
from skinsource_gui.plots.signal_view import SignalView
from skinsource_gui.qt.theme import DARK, LIGHT
from skinsource_gui.qt.wheel import PAUSE_S, ScrollGesture
from tests.gui.signal_view.bench import FREQUENCY, TIME, left_and_width, turn_wheel, waves
from tests.gui.skin.bench import drag


@pytest.fixture
def signals(signals):
    """With two curves."""
    signals.show_curves(waves(2), synthetic=False)
    return signals


def test_the_crosshair_reads_exact_samples_and_leaves_with_the_mouse(signals):
    canvas, curves = signals.plot, signals.plot.curves
    QTest.mouseMove(canvas.viewport(), QPoint(200, 60))
    index = canvas.crosshair.index
    assert index is not None
    text = signals.legend.text
    assert text.where == f"{curves.x[index] * 1e3:.1f} ms"
    assert text.readings == tuple(f"{y:.4f}".replace("-", "−") for y in curves.y[:, index])
    assert text.unit == "m/s²"
    left, width = left_and_width(signals)
    assert curves.x[index] == pytest.approx((200 - left) / width * curves.x[-1], abs=1 / 1300)
    QTest.mouseMove(canvas.viewport(), QPoint(2, 2))
    assert canvas.crosshair.index is None
    assert signals.legend.text.readings == ()


def test_the_crosshair_reads_what_is_under_a_pointer_that_rests_while_the_wheel_zooms(signals):
    signals.zoom_requested.connect(lambda part: signals.plot.set_view(TIME, part, stacked=False))
    plot, at = signals.plot, QPoint(200, 60)
    QTest.mouseMove(plot.viewport(), at)
    signals.plot.set_view(TIME, (0.1, 0.2), stacked=False)
    left, width = left_and_width(signals)
    under = 0.1 + 0.1 * (at.x() - left) / width
    assert plot.curves.x[plot.crosshair.index] == pytest.approx(under, abs=1 / 1300)
    # Keys keep their place, and what left reads nothing.
    QTest.keyClick(plot, Qt.Key.Key_Right)
    pinned = plot.crosshair.index
    signals.plot.set_view(TIME, None, stacked=False)
    assert plot.crosshair.index == pinned
    QTest.keyClick(plot, Qt.Key.Key_Escape)
    signals.plot.set_view(TIME, (0.1, 0.3), stacked=False)
    assert plot.crosshair.index is None


def test_the_crosshair_keeps_its_place_when_data_change(signals):
    signals.plot.crosshair.put(130)
    signals.show_curves(waves(2, n_points=1300, amplitude=0.25), synthetic=False)
    assert signals.plot.crosshair.index == 130
    assert signals.legend.text.where == "100.0 ms"
    signals.show_curves(waves(2, n_points=50), synthetic=False)
    assert signals.plot.crosshair.index == 49


def test_keys_move_the_crosshair_until_escape(signals):
    canvas = signals.plot
    QTest.keyClick(canvas, Qt.Key.Key_Right)
    assert canvas.crosshair.index == 325
    QTest.keyClick(canvas, Qt.Key.Key_Left)
    QTest.keyClick(canvas, Qt.Key.Key_Right, Qt.KeyboardModifier.ShiftModifier)
    assert canvas.crosshair.index == 334
    QTest.keyClick(canvas, Qt.Key.Key_End)
    QTest.keyClick(canvas, Qt.Key.Key_Right)
    assert canvas.crosshair.index == 650
    QTest.keyClick(canvas, Qt.Key.Key_Home)
    assert canvas.crosshair.index == 0
    QTest.keyClick(canvas, Qt.Key.Key_Escape)
    assert canvas.crosshair.index is None


def test_a_crosshair_moved_out_of_sight_asks_for_the_part_it_is_in(signals, qtbot):
    signals.plot.set_view(TIME, (0.1, 0.2), stacked=False)
    with qtbot.waitSignal(signals.zoom_requested) as asked:
        QTest.keyClick(signals.plot, Qt.Key.Key_End)
    assert asked.args[0] == pytest.approx((0.4, 0.5))


def test_a_drag_zooms_to_what_it_covers(signals, qtbot):
    canvas = signals.plot
    left, width = left_and_width(signals)
    with qtbot.waitSignal(signals.zoom_requested) as asked:
        drag(canvas.viewport(), QPoint(300, 60), QPoint(200, 62))
    low, high = asked.args[0]
    assert low == pytest.approx(0.5 * (200 - left) / width)
    assert high == pytest.approx(0.5 * (300 - left) / width)


def test_a_click_or_an_escaped_drag_zooms_nowhere(signals, qtbot):
    canvas = signals.plot
    with qtbot.assertNotEmitted(signals.zoom_requested):
        QTest.mouseClick(canvas.viewport(), Qt.MouseButton.LeftButton, pos=QPoint(150, 60))
        QTest.mousePress(canvas.viewport(), Qt.MouseButton.LeftButton, pos=QPoint(150, 60))
        QTest.mouseMove(canvas.viewport(), QPoint(250, 60))
        QTest.keyClick(canvas, Qt.Key.Key_Escape)
        QTest.mouseRelease(canvas.viewport(), Qt.MouseButton.LeftButton, pos=QPoint(250, 60))


@pytest.mark.parametrize(
    "modifier", [Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ControlModifier]
)
def test_the_wheel_zooms_at_the_pointer(signals, qtbot, modifier):
    canvas = signals.plot
    left, width = left_and_width(signals)
    before = canvas.x_window.position((200 - left) / width)
    with qtbot.waitSignal(signals.zoom_requested) as asked:
        turn_wheel(signals, 200, modifier)
    low, high = asked.args[0]
    assert high - low == pytest.approx(0.5 / 1.2)
    signals.plot.set_view(TIME, asked.args[0], stacked=False)
    after = canvas.x_window.position((200 - left) / width)
    assert after == pytest.approx(before)


@pytest.mark.parametrize(
    ("modifier", "aside"),
    [(Qt.KeyboardModifier.ShiftModifier, False), (Qt.KeyboardModifier.NoModifier, True)],
)
def test_the_wheel_with_shift_or_to_the_side_pans(signals, qtbot, modifier, aside):
    signals.plot.set_view(TIME, (0.1, 0.3), stacked=False)
    with qtbot.waitSignal(signals.zoom_requested) as asked:
        turn_wheel(signals, 200, modifier, turned=-120, aside=aside)
    assert asked.args[0] == pytest.approx((0.12, 0.32))


def test_the_middle_button_pans_and_stops_at_the_ends(signals):
    signals.plot.set_view(TIME, (0.1, 0.3), stacked=False)
    asked = []
    signals.zoom_requested.connect(asked.append)
    canvas, (_, width) = signals.plot, left_and_width(signals)
    by_s, middle = 50 / width * 0.2, Qt.MouseButton.MiddleButton
    for start, end, shown_s in ((200, 150, (0.1 + by_s, 0.3 + by_s)), (60, 400, (0.0, 0.2))):
        QTest.mousePress(canvas.viewport(), middle, pos=QPoint(start, 60))
        QTest.mouseMove(canvas.viewport(), QPoint(end, 60))
        QTest.mouseRelease(canvas.viewport(), middle, pos=QPoint(end, 60))
        assert asked[-1] == pytest.approx(shown_s)


def test_double_click_0_and_a_show_everything_and_plus_and_minus_zoom(signals):
    asked = []
    signals.zoom_requested.connect(asked.append)
    QTest.keyClick(signals.plot, Qt.Key.Key_Plus)
    assert asked[-1] == pytest.approx((0.25 - 0.5 / 3, 0.25 + 0.5 / 3))
    signals.plot.set_view(TIME, asked[-1], stacked=False)
    QTest.keyClick(signals.plot, Qt.Key.Key_Minus)
    assert asked[-1] is None
    QTest.keyClick(signals.plot, Qt.Key.Key_0)
    QTest.keyClick(signals.plot, Qt.Key.Key_A)
    QTest.mouseDClick(signals.plot.viewport(), Qt.MouseButton.LeftButton, pos=QPoint(150, 60))
    assert asked[-3:] == [None, None, None]


def test_a_logarithmic_axis_zooms_evenly_in_octaves(signals, qtbot):
    x = np.arange(326) * 2.0
    signals.show_curves(
        Curves(x=x, y=np.ones((1, x.size)), names=output_names((1,), "synthetic-1")),
        synthetic=False,
    )
    signals.plot.set_view(FREQUENCY, (50.0, 200.0), stacked=False)
    signals.plot.crosshair.put(50)
    assert signals.legend.text.where == "100.0 Hz"
    with qtbot.waitSignal(signals.zoom_requested) as asked:
        QTest.keyClick(signals.plot, Qt.Key.Key_Minus)
    low, high = asked.args[0]
    assert (100 / low, high / 100) == pytest.approx((2**1.5, 2**1.5))
    signals.plot.set_view(FREQUENCY, (0.0, 50.0), stacked=False)
    assert signals.plot.x_window.values(signals.plot.x_window.shown) == pytest.approx((10.0, 50.0))


def test_a_zoom_that_holds_no_data_says_how_to_leave_it(signals):
    signals.plot.set_view(TIME, (2.0, 3.0), stacked=False)
    assert "Press 0" in signals.plot.stack.hint.text
    signals.plot.set_view(TIME, None, stacked=False)
    assert signals.plot.stack.hint.text == ""


def test_a_turn_of_the_wheel_that_began_as_scrolling_is_not_taken_until_it_is_meant(qtbot):
    now_s, zooms = [100.0], []
    view, inside, area = SignalView("scrolled", "Scrolled"), QWidget(), QScrollArea()
    qtbot.addWidget(area)
    view.setMinimumHeight(600)
    QVBoxLayout(inside).addWidget(view)
    area.setWidgetResizable(True)
    area.setWidget(inside)
    view.plot.scrolling_on = ScrollGesture(view.plot, lambda: now_s[0])
    area.resize(400, 300)
    area.show()
    qtbot.waitExposed(area)
    view.plot.set_view(TIME, None, stacked=False)
    view.show_curves(waves(), synthetic=False)
    view.zoom_requested.connect(zooms.append)

    def scroll_and_turn(held=Qt.KeyboardModifier.NoModifier, moved_px=0, rests_s=PAUSE_S - 0.1):
        bar = area.verticalScrollBar()
        bar.setValue(bar.value() + 5)
        QCursor.setPos(QCursor.pos() + QPoint(moved_px, 0))
        now_s[0] += rests_s
        before = len(zooms)
        turn_wheel(view, 200, held)
        return len(zooms) - before

    QCursor.setPos(area.mapToGlobal(QPoint(200, 150)))
    assert scroll_and_turn() == 0
    assert scroll_and_turn(moved_px=8) == 1
    assert scroll_and_turn(rests_s=PAUSE_S) == 1
    assert scroll_and_turn(held=Qt.KeyboardModifier.ControlModifier) == 1


def open_menu(signals):
    """Press the right button, as a user does."""
    viewport, at = signals.plot.viewport(), QPoint(200, 60)
    QTest.mousePress(viewport, Qt.MouseButton.RightButton, pos=at)
    event = QContextMenuEvent(QContextMenuEvent.Reason.Mouse, at, viewport.mapToGlobal(at))
    QApplication.sendEvent(viewport, event)
    return signals.findChild(QMenu, "plot-menu")


def choose(signals, text):
    menu = open_menu(signals)
    action = next(action for action in menu.actions() if action.text().startswith(text))
    menu.close()
    action.trigger()
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)


@pytest.fixture
def save_to(monkeypatch, tmp_path):
    """Answer the question for a file."""

    def answer(name, kind=""):
        path = tmp_path / name
        monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(path), kind))
        return path

    return answer


def test_the_right_button_opens_a_menu_that_shows_everything(signals, qtbot):
    signals.plot.set_view(TIME, (0.1, 0.2), stacked=False)
    with qtbot.waitSignal(signals.zoom_requested) as asked:
        choose(signals, "View all")
    assert asked.args == [None]


def test_without_curves_there_is_no_menu(signals):
    signals.plot.show_message("Select outputs on the skin map")
    assert open_menu(signals) is None


def test_the_picture_on_the_clipboard_is_light_large_and_has_a_legend(signals, use_theme):
    use_theme(DARK)
    signals.show_curves(waves(3), synthetic=True)
    signals.plot.crosshair.put(100)
    choose(signals, "Copy picture")
    picture = QApplication.clipboard().image()
    assert picture.width() == 2 * signals.plot.width()
    assert picture.height() > 2 * signals.plot.height()
    colours = {
        picture.pixelColor(x, y).name()
        for x in range(0, picture.width())
        for y in range(0, picture.height(), 3)
    }
    assert {LIGHT.base, *LIGHT.outputs[:3]} <= colours
    assert DARK.base not in colours
    # The plot on the screen stays as it is.
    assert signals.plot.grab().toImage().pixelColor(1, 1).name() == DARK.base
    assert signals.plot.crosshair.index == 100


@pytest.mark.parametrize("kind", ["amplitude", "level"])
def test_the_table_holds_all_samples_exactly_whatever_is_zoomed_to(signals, save_to, kind):
    curves = waves(2)
    shown = type(curves)(
        x=curves.x, y=curves.y, names=curves.names, kind=kind, about=lambda: ("one", "two")
    )
    signals.show_curves(shown, synthetic=True)
    signals.plot.set_view(TIME, (0.1, 0.2), stacked=False)
    path = save_to("data", "CSV (*.csv)").with_suffix(".csv")
    choose(signals, "Export data")
    lines = path.read_text().splitlines()
    about = [line for line in lines if line.startswith("#")]
    assert "# SYNTHETIC LIMB: computed responses, not measured ones" in about
    assert {"# one", "# two"} <= set(about)
    unit = "db_re_1_m_per_s2" if kind == "level" else "m_per_s2"
    assert lines[len(about)] == f"x,output_1_{unit},output_2_{unit}"
    table = np.loadtxt(lines[len(about) + 1 :], delimiter=",")
    assert np.array_equal(table, np.vstack((curves.x, curves.y)).T)


def test_a_file_that_cannot_be_written_is_told_and_an_answer_can_be_none(
    signals, save_to, qtbot, monkeypatch
):
    save_to("no such folder/traces.png")
    with qtbot.waitSignal(signals.exports.failed) as failure:
        choose(signals, "Save picture")
    assert "no such folder" in failure.args[0]
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: ("", ""))
    with qtbot.assertNotEmitted(signals.exports.written):
        choose(signals, "Save picture")
        choose(signals, "Export data")
