"""The measure line: what the numbers on the map are, chosen word by word."""

import pytest
from PySide6.QtCore import Qt, QTimer
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from skinsource.design.labels import AXES, METHODS, SPANS
from skinsource_gui.panels.skin.settings import LEVELS, MAGNITUDE, SENSATION, Z
from skinsource_gui.plots.small_map import COLOURS
from tests.gui.skin.bench import choose, entries


def words(window):
    line = window.panel.measure
    return [word.accessibleDescription() for word in (line.quantity, line.axes, line.span)]


def test_the_words_say_what_is_shown_and_their_menus_change_it(window):
    line = window.panel.measure
    window.panel.resize(700, 640)
    assert words(window) == ["RMS", "x, y, z, principal axis", "whole record, 0.8 s"]
    assert line.unit.accessibleDescription() == "dB re 1 m/s²"
    choose(line.axes, "x, y")
    choose(line.axes, "Sum of components")
    choose(line.span, "Loudest 100 ms")
    assert (window.view.axes, window.view.method, window.view.span) == ("xy", "soc", "loudest")
    assert words(window) == ["RMS", "x, y, sum of components", "loudest 100 ms"]
    choose(line.quantity, "Sensation level")
    assert window.settings.quantity == SENSATION
    assert words(window)[0] == "Sensation level"
    # Its axes and window are its own: nothing is offered that it would not follow.
    assert words(window)[1:] == ["x, y, z together", "loudest 100 ms"]
    assert not line.span.isEnabled()
    assert not line.axes.isEnabled()


def test_every_choice_is_explained_in_the_words_of_the_page(window):
    line = window.panel.measure
    for word, entry_words in ((line.axes, (*AXES, *METHODS)), (line.span, SPANS)):
        offered = entries(word)
        assert list(offered) == [each.title for each in entry_words]
        for each in entry_words:
            hint = offered[each.title].toolTip()
            assert " ".join(hint.split()) == each.sentence


def test_a_single_axis_needs_no_method(window):
    window.show(axes="z")
    offered = entries(window.panel.measure.axes)
    assert not any(offered[method.title].isEnabled() for method in METHODS)
    assert words(window)[1] == "z"


@pytest.mark.parametrize(("quantity", "signal"), [(Z, "z"), (MAGNITUDE, "x, y, z, magnitude")])
def test_what_moves_says_which_axes_it_is_of(window, quantity, signal):
    window.panel.resize(700, 640)
    window.show(quantity=quantity)
    assert words(window)[:2] == ["Animation", signal]
    assert window.panel.measure.span.isHidden()


def test_the_unit_offers_range_style_and_colours(window):
    unit = window.panel.measure.unit
    offered = entries(unit)
    assert offered["Automatic range"].isChecked()
    choose(unit, "Automatic range")
    assert window.settings.map_range_db == (-60.0, -10.0)
    choose(unit, "Automatic range")
    assert window.settings.map_range_db is None
    choose(unit, "Sensors only")
    assert window.settings.map_style == "sensors"
    assert not entries(unit)["Mark sensors"].isEnabled()
    choose(unit, "Interpolated")
    choose(unit, "Mark sensors")
    assert not window.settings.sensors_shown
    assert [text for _, text in COLOURS.options if entries(unit)[text].isChecked()] == ["Viridis"]
    choose(unit, "Magma")
    assert window.settings.colours == "magma"


@pytest.mark.parametrize("quantity", [LEVELS, SENSATION])
def test_where_there_is_little_room_words_are_short_and_nothing_is_cut(window, quantity):
    line = window.panel.measure
    for width in (700, 420, 300, 240):
        window.panel.resize(width, 640)
        window.show(quantity=quantity)
        QApplication.processEvents()
        shown = [part for part in line.findChildren(type(line.axes)) if part.isVisible()]
        for part in (*shown, line.arm):
            assert part.width() >= part.sizeHint().width()
            assert part.geometry().right() < line.width()
        assert len(shown) == 4 or width < 420
    assert line.unit.focusPolicy() & Qt.FocusPolicy.TabFocus


@pytest.mark.parametrize("key", [Qt.Key.Key_Return, Qt.Key.Key_Down])
def test_keys_open_the_menu_of_a_word(window, key):
    word, opened = window.panel.measure.axes, []
    # It returns only once the menu is closed.
    word.menu().aboutToShow.connect(lambda: QTimer.singleShot(0, word.menu().close))
    word.menu().aboutToShow.connect(lambda: opened.append(word))
    QTest.keyClick(word, key)
    assert opened == [word]
