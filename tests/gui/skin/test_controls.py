import pytest
from PySide6.QtCore import QEvent, QObject, QPoint, Qt
from PySide6.QtGui import QColor, QHelpEvent, QRegion
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QToolTip

from skinsource.design.labels import TRIAD_SENTENCE
from skinsource_gui.panels.skin.picture import heading_of
from skinsource_gui.panels.skin.scale import ColourStrip
from skinsource_gui.qt.theme import DARK, LIGHT
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
        if stops and widget.isEnabled() and widget.isVisibleTo(panel):
            reached.append(widget)
        widget = widget.nextInFocusChain()
    names = [widget.objectName() for widget in reached]
    assert names == [
        "map_interpolated",
        "map_sensors_shown",
        "map_fit_all",
        "map_fit_hand",
        "skin_quantity",
        "skin_map",
        "range_high_field",
        "colour_strip",
        "range_high",
        "range_low",
        "range_low_field",
        "range_auto",
    ]
    assert all(widget.accessibleName() or widget.text() for widget in reached)


@pytest.mark.parametrize("theme", [LIGHT, DARK])
def test_the_map_follows_the_theme(window, theme, use_theme):
    use_theme(theme)
    corner = pixel(window.panel.map.grab().toImage(), QPoint(4, 4))
    assert corner == QColor(theme.base).getRgb()[:3]


def test_readings_say_what_a_level_is_the_rms_over(window):
    window.show(span="loudest")
    view = window.panel.map
    QTest.mouseMove(view, place(window, 29))
    assert window.panel.readout.text().endswith("(0.282 m/s² RMS, loudest 100 ms)")
    assert (
        heading_of(window.design, window.view).title
        == "Skin acceleration, RMS over the loudest 100 ms"
    )


def test_the_scale_says_what_its_levels_are_the_rms_over(window):
    strip = window.panel.colour_bar.strip
    before = strip.grab().toImage()
    window.show(span="loudest")
    assert strip.grab().toImage() != before
    window.show(span="record")
    assert strip.grab().toImage() == before


@pytest.mark.parametrize("size", [(250, 300), (300, 330), (300, 900), (420, 640), (1200, 500)])
def test_the_map_shows_which_way_the_axes_point_and_says_more_on_hover(window, size):
    window.panel.resize(*size)
    view = window.panel.map
    card = view.stage.layout.triad_card
    assert view.stage.layout.room.contains(card)
    assert not card.intersects(view.stage.layout.palmar_card)
    inked = view.grab(card.toRect()).toImage()
    dark = sum(
        QColor(inked.pixel(x, y)).lightnessF() < 0.5
        for x in range(inked.width())
        for y in range(inked.height())
    )
    assert dark > 100
    at = card.center().toPoint()
    event = QHelpEvent(QEvent.Type.ToolTip, at, view.mapToGlobal(at))
    QApplication.sendEvent(view, event)
    assert " ".join(QToolTip.text().split()) == TRIAD_SENTENCE
    QToolTip.hideText()


def test_in_a_narrow_panel_the_fits_are_left_to_keys_and_menu(window):
    toolbar = window.panel.toolbar
    assert toolbar.hand.isVisible()
    window.panel.resize(window.panel.minimumSize())
    assert not toolbar.hand.isVisible()
    QApplication.processEvents()
    buttons = (toolbar.interpolated, toolbar.sensors_only, toolbar.sensors)
    for part in (*buttons, window.panel.colour_bar):
        right = part.mapTo(window.panel, part.rect().bottomRight()).x()
        assert right < window.panel.width()
        assert part.width() >= part.minimumSizeHint().width()
    window.panel.resize(420, 640)
    assert toolbar.hand.isVisible()


class Painted(QObject):
    """Which part of a widget is painted."""

    def __init__(self, widget):
        super().__init__(widget)
        self.region = QRegion()
        widget.installEventFilter(self)

    def eventFilter(self, watched, event):
        if event.type() == QEvent.Type.Paint:
            self.region += event.region()
        return False


def test_marks_of_levels_have_only_their_column_painted_anew(qtbot):
    strip = ColourStrip()
    qtbot.addWidget(strip)
    strip.resize(60, 400)
    strip.show_range((-60.0, 0.0))
    strip.show()
    qtbot.waitExposed(strip)
    QApplication.processEvents()
    for before, after in (((), (-20.0,)), ((-20.0,), (-25.0,)), ((-25.0, -40.0), ())):
        strip.show_marks(tuple((level, 0) for level in before))
        QApplication.processEvents()
        pictures, painted = [strip.grab().toImage()], Painted(strip)
        strip.show_marks(tuple((level, 0) for level in after))
        QApplication.processEvents()
        # Told so before it is painted as a whole, below.
        region = QRegion(painted.region)
        pictures.append(strip.grab().toImage())
        assert region.boundingRect().width() < 20
        columns, rows = range(strip.width()), range(strip.height())
        other = [
            QPoint(x, y)
            for x in columns
            for y in rows
            if pictures[0].pixel(x, y) != pictures[1].pixel(x, y)
        ]
        assert other
        assert all(region.contains(at) for at in other)
