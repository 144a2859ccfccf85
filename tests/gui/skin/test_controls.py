import pytest
from PySide6.QtCore import QEvent, QPoint, Qt
from PySide6.QtGui import QColor, QHelpEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QToolTip

from skinsource_gui.theme import DARK, LIGHT
from tests.gui.skin.bench import LEFT, pixel, place

# Words


def test_the_readout_follows_the_mouse(window):
    view = window.panel.map
    QTest.mouseMove(view, place(window, 29))
    assert window.panel.readout.text() == (
        "Output 29, Digit II, beside the nail, radial\n"
        "−11.0 dB re 1 m/s²  (0.282 m/s² RMS, whole record)"
    )
    window.show(outputs=())
    QTest.mouseMove(view, (place(window, 60) + place(window, 69)) / 2)
    assert window.panel.readout.text().endswith(" mm/s² RMS, whole record)")
    QTest.mouseMove(view, QPoint(5, 5))
    assert window.panel.readout.text().startswith("No output selected")


def test_an_output_tells_its_number_place_and_level(window):
    at = place(window, 29)
    event = QHelpEvent(QEvent.Type.ToolTip, at, window.panel.map.mapToGlobal(at))
    QApplication.sendEvent(window.panel.map, event)
    assert QToolTip.text().startswith("Output 29, Digit II, beside the nail, radial\n−11.0 dB")
    QToolTip.hideText()


def test_buttons_change_the_view(window):
    toolbar = window.panel.toolbar
    QTest.mouseClick(toolbar.sensors_only, LEFT)
    assert window.settings.map_style == "sensors"
    assert not toolbar.sensors.isEnabled()
    QTest.mouseClick(toolbar.interpolated, LEFT)
    assert window.settings.map_style == "interpolated"
    QTest.mouseClick(toolbar.sensors, LEFT)
    assert not window.settings.sensors_shown


def test_arrows_choose_the_style(window):
    toolbar = window.panel.toolbar
    toolbar.interpolated.setFocus()
    QTest.keyClick(toolbar.interpolated, Qt.Key.Key_Right)
    assert window.settings.map_style == "sensors"


def test_everything_that_can_be_used_is_reached_by_tab_and_named(window):
    panel = window.panel
    reached, widget = [], panel.nextInFocusChain()
    while widget is not panel:
        stops = widget.focusPolicy() & Qt.FocusPolicy.TabFocus and widget.focusProxy() is None
        if stops and widget.isEnabled():
            reached.append(widget)
        widget = widget.nextInFocusChain()
    names = [one.objectName() for one in reached]
    assert names == [
        "map_interpolated",
        "map_sensors_shown",
        "map_fit_all",
        "map_fit_hand",
        "skin_map",
        "range_high_field",
        "colour_strip",
        "range_high",
        "range_low",
        "range_low_field",
        "range_auto",
    ]
    assert all(one.accessibleName() or one.text() for one in reached)


@pytest.mark.parametrize("theme", [LIGHT, DARK])
def test_the_map_follows_the_theme(window, theme):
    window.panel.show_theme(theme)
    corner = pixel(window.panel.map.grab().toImage(), QPoint(4, 4))
    assert corner == QColor(theme.base).getRgb()[:3]
