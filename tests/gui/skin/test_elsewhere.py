"""Selected outputs that the limb does not have."""

from PySide6.QtCore import QEvent, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from skinsource_gui.fields.units import output_text
from tests.gui.skin.bench import SHIFT, click


def test_outputs_that_the_limb_does_not_have_are_not_drawn_and_stay_selected(window):
    window.show(outputs=(29, 52))
    without = window.panel.map.grab().toImage()
    window.show(outputs=(29, 52, 80))
    assert window.panel.map.grab().toImage() == without
    assert not window.panel.picture(300, 400).isNull()
    click(window, 3, SHIFT)
    assert window.view.outputs == (29, 52, 80, 3)


def test_the_cursor_begins_at_an_output_that_is_there(window):
    window.show(outputs=(80, 29))
    window.panel.map.setFocus()
    QTest.keyClick(window.panel.map, Qt.Key.Key_Space)
    assert window.view.outputs == (29,)


def test_an_output_that_is_not_there_is_named():
    assert output_text(80) == "Output 80, not on this limb"
    assert output_text(72).startswith("Output 72, Elbow")


def test_nothing_is_said_of_an_output_that_was_clicked_before_others_were_selected_elsewhere(
    window,
):
    view = window.panel.map
    view.setFocus()
    click(window, 57)
    QApplication.sendEvent(view, QEvent(QEvent.Type.Leave))
    assert window.panel.readout.text().startswith("Output 57")
    window.show(outputs=(3, 12))
    assert window.panel.readout.text().startswith("2 outputs selected")
