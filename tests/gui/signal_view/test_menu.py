"""The menu of a plot, and what it gives away."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QContextMenuEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QFileDialog, QMenu

from skinsource_gui.qt.theme import DARK, LIGHT
from tests.gui.signal_view.bench import TIME, waves


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


@pytest.fixture
def save_to(monkeypatch, tmp_path):
    """Answer the question for a file."""

    def answer(name, kind=""):
        path = tmp_path / name
        monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(path), kind))
        return path

    return answer


def test_the_right_button_opens_a_menu_that_shows_everything(signals, qtbot):
    signals.show_curves(waves(2), synthetic=False)
    signals.set_view(TIME, (0.1, 0.2), stacked=False)
    with qtbot.waitSignal(signals.zoom_requested) as asked:
        choose(signals, "View all")
    assert asked.args == [None]


def test_without_curves_there_is_no_menu(signals):
    signals.show_message("Select outputs on the skin map")
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
    signals.set_view(TIME, (0.1, 0.2), stacked=False)
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
    signals.show_curves(waves(2), synthetic=False)
    save_to("no such folder/traces.png")
    with qtbot.waitSignal(signals.exports.failed) as failure:
        choose(signals, "Save picture")
    assert "no such folder" in failure.args[0]
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: ("", ""))
    with qtbot.assertNotEmitted(signals.exports.written):
        choose(signals, "Save picture")
        choose(signals, "Export data")
