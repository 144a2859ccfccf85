"""The measure line and the colour range: what the numbers on the map are, and their colours."""

from itertools import pairwise

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QRectF, Qt, QTimer
from PySide6.QtGui import QFont, QPainter, QPixmap
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from skinsource.design.design import Snapshot
from skinsource.design.labels import AXES, METHODS, SPANS
from skinsource.signals.map_range import map_range_db
from skinsource_gui.panels.skin.settings import LEVELS, MAGNITUDE, SENSATION, Z
from skinsource_gui.plots.small_map import COLOURS, ColourScale, paint_ramp
from skinsource_gui.qt.theme import LIGHT
from skinsource_gui.state.compared import Compared
from tests.gui.skin.bench import CONTROL, LEFT, PLAIN, choose, drag, entries


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
    line.axes.menu().popup(QPoint())
    choose(line.quantity, "Sensation level")
    assert window.settings.quantity == SENSATION
    # A menu from which nothing can be chosen is not left open.
    assert not line.axes.menu().isVisible()
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


@pytest.mark.parametrize("width", [700, 414, 240])
def test_how_axes_are_combined_is_told_in_any_width(window, width):
    window.panel.resize(width, 640)
    said = set()
    for method in METHODS:
        window.show(method=method.name, span="loudest")
        said.add(window.panel.measure.axes.text())
    assert len(said) == len(METHODS)


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
            assert part.visibleRegion().boundingRect() == part.rect()
        assert len(shown) == 4


def test_a_word_needs_the_same_room_whatever_it_shows_in_letters_of_broken_widths(window):
    word = window.panel.measure.span
    font = word.font()
    font.setLetterSpacing(QFont.SpacingType.AbsoluteSpacing, 0.3)
    word.setFont(font)
    widths = set()
    for shown in ("record, 1.32 s", "1.32 s", "100 ms", "whole record, 1.32 s"):
        word.show_word(shown)
        assert word.width_of(shown) == word.sizeHint().width()
        widths.add(word.width_of("record, 1.32 s"))
    assert len(widths) == 1


@pytest.mark.parametrize("gain", [1.0, 0.5])
@pytest.mark.parametrize("method", [method.name for method in METHODS])
def test_every_word_opens_its_menu_beside_a_long_record(window, method, gain):
    line = window.panel.measure
    window.panel.resize(414, 640)
    window.show(window.design.with_clip(1, onset_s=12.34), method=method)
    window.deliver(match_gain=gain)
    assert [word.text() for word in line._words if not word.isVisible()] == []
    assert line.span.text().endswith(" s ▾")
    assert ("matched" in line.unit.text()) == (gain != 1.0)


@pytest.mark.parametrize("key", [Qt.Key.Key_Return, Qt.Key.Key_Down])
def test_keys_open_the_menu_of_a_word(window, key):
    word, opened = window.panel.measure.axes, []
    # It returns only once the menu is closed.
    word.menu().aboutToShow.connect(lambda: QTimer.singleShot(0, word.menu().close))
    word.menu().aboutToShow.connect(lambda: opened.append(word))
    QTest.keyClick(word, key)
    assert opened == [word]


def test_the_automatic_range_follows_the_loudest_output_alone(window):
    tops = {-11.0: -10, -5.0: -5, -4.9: 0, -200.0: 0, -190.0: -150, 333.0: 200}
    for loudest, top in tops.items():
        assert map_range_db(np.array([-200.0, loudest])) == (top - 50.0, top)
    # The same levels have the same colours, whatever was shown before.
    for by, top in ((0.9, -10.0), (-6.0, -15.0), (1.1, -5.0), (-6.0, -15.0), (-15.0, -25.0)):
        window.deliver(output_levels_db=window.results["output_levels_db"] + by)
        assert window.panel.colour_bar.strip.value_range == (top - 50.0, top)


def test_the_automatic_range_spans_snapshots_too_as_loud_as_they_are_shown(window):
    design, levels = window.design, window.results["output_levels_db"]
    snapshots = tuple(Snapshot(number=k, design=design) for k in (1, 2))
    window.show(snapshots=snapshots)
    assert window.panel.needs_of_snapshots == {"output_levels_db"}
    louder = {"output_levels_db": levels + 12.0}
    window.panel.show_snapshots([Compared(snapshot=snapshots[1], values=louder)])
    assert window.panel.colour_bar.strip.value_range == (-45.0, 5.0)
    window.deliver(output_levels_db=louder["output_levels_db"])
    assert window.panel.colour_bar.strip.value_range == (-45.0, 5.0)
    window.panel.show_snapshots([Compared(snapshot=snapshots[1], values=louder, gain=10.0)])
    assert window.panel.colour_bar.strip.value_range == (-25.0, 25.0)
    window.show(snapshots=())
    assert window.panel.needs_of_snapshots == frozenset()
    window.deliver()
    assert window.panel.colour_bar.strip.value_range == (-60.0, -10.0)


@pytest.mark.parametrize("width", [20, 40, 60, 120])
def test_numbers_of_a_colour_bar_stand_beside_each_other(qapp, width):
    written = []

    class Painter(QPainter):
        def drawText(self, room, flags, text):
            written.append(self.boundingRect(room, flags, text))

    picture, scale = QPixmap(200, 60), ColourScale(range_db=(-60.0, -10.0), text_below="")
    painter = Painter(picture)
    paint_ramp(painter, QRectF(40, 5, width, 10), scale, LIGHT)
    painter.end()
    assert len(written) >= 2 or width == 20
    assert all(one.right() < other.left() for one, other in pairwise(written))


def ends(strip):
    """Places of the lower end, the middle and the upper end of the colours."""
    ramp = strip._ramp()
    return [QPoint(round(x), 12) for x in (ramp.left() + 1, ramp.center().x(), ramp.right() - 1)]


def test_an_end_is_dragged_and_stops_before_the_other(window):
    strip = window.panel.colour_bar.strip
    low, _, high = ends(strip)
    drag(strip, high, high - QPoint(40, 0))
    lowest, highest = window.settings.map_range_db
    assert lowest == -60.0
    assert -30.0 < highest < -10.0
    assert window.panel.colour_bar.strip.value_range == (lowest, highest)
    drag(strip, low, low + QPoint(2000, 0))
    assert window.settings.map_range_db == (highest - 1.0, highest)


def test_a_drag_between_the_ends_moves_both_from_where_they_were_and_back(window):
    strip = window.panel.colour_bar.strip
    _, middle, _ = ends(strip)
    QTest.mousePress(strip, LEFT, PLAIN, middle)
    for by, sign in ((30, 1.0), (-30, -1.0)):
        QTest.mouseMove(strip, middle + QPoint(by, 0))
        low, high = window.panel.colour_bar.strip.value_range
        assert high - low == pytest.approx(50.0)
        assert sign * (high + 10.0) > 5.0
    QTest.mouseMove(strip, middle)
    assert window.panel.colour_bar.strip.value_range == (-60.0, -10.0)
    QTest.mouseRelease(strip, LEFT, PLAIN, middle)
    views = len(window.views)
    QTest.mouseMove(strip, middle + QPoint(30, 0))
    assert len(window.views) == views


def test_keys_move_the_range(window):
    strip = window.panel.colour_bar.strip
    QTest.keyClick(strip, Qt.Key.Key_Up)
    assert window.settings.map_range_db == (-59.0, -9.0)
    QTest.keyClick(strip, Qt.Key.Key_Down, CONTROL)
    assert window.settings.map_range_db == pytest.approx((-59.1, -9.1))
    QTest.keyClick(strip, Qt.Key.Key_PageUp)
    assert window.settings.map_range_db == pytest.approx((-49.1, 0.9))


def test_until_accelerations_are_known_their_bar_has_no_decibels_of_what_was_shown(window):
    # Nobody computes what it needs.
    window.show(quantity=Z)
    low, high = window.panel.colour_bar.strip.value_range
    assert low == -high < 0.0


def test_limits_of_signed_values_stay_alike(window):
    window.show(quantity=Z, z_limits=(-2.0, 2.0))
    bar = window.panel.colour_bar
    assert bar.limit_field.isVisible()
    assert not bar.low_field.isVisible()
    QTest.keyClick(bar.strip, Qt.Key.Key_Up)
    assert window.settings.z_limits == (-2.24, 2.24)
    low, _, _ = ends(bar.strip)
    drag(bar.strip, low, low + QPoint(40, 0))
    limit = window.settings.z_limits[1]
    assert 0.5 < limit < 2.2
    assert window.settings.z_limits == (-limit, limit)


@pytest.mark.parametrize(
    ("name", "typed", "range_db"),
    [
        ("high_field", "-100", (-150.0, -100.0)),
        ("high_field", "-59.5", (-109.5, -59.5)),
        ("high_field", "-59", (-60.0, -59.0)),
        ("high_field", "-190", (-200.0, -190.0)),
        ("low_field", "30", (30.0, 80.0)),
        ("low_field", "190", (190.0, 200.0)),
    ],
)
def test_a_typed_end_pushes_the_other_one_before_it(window, name, typed, range_db):
    bar = window.panel.colour_bar
    field = getattr(bar, name)
    QTest.keyClicks(field, typed)
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert window.settings.map_range_db == range_db
    assert (bar.low_field.value_si, bar.high_field.value_si) == range_db


def test_an_end_that_leaves_no_room_for_the_other_is_refused_with_a_sentence(window):
    field = window.panel.colour_bar.high_field
    QTest.keyClicks(field, "-200")
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert field.problem == ("Highest colour: −200 dB is too low. Allowed: −199 to 200 dB.")
    assert window.views == []
