from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, Qt, QTimer
from PySide6.QtGui import QColor, QHelpEvent, QImage, QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QToolTip

from skinsource.catalogue import load_limb
from skinsource.design import start_design
from skinsource.limb import LimbMap
from skinsource.surface import surface_operator
from skinsource.view import View
from skinsource_gui.panels.surface import SILENT, SurfacePanel
from skinsource_gui.theme import DARK, LIGHT
from skinsource_gui.widgets.colour_maps import colour_indices, colour_table
from skinsource_gui.widgets.field_image import FieldImage
from skinsource_gui.widgets.level_range import AutomaticRange, tick_levels
from skinsource_gui.widgets.map_canvas import FIT_ALL, FIT_HAND, MapCanvas
from skinsource_gui.widgets.map_content import MapContent
from skinsource_gui.widgets.output_picking import DORSAL_OUTPUTS, output_beyond

LEFT, MIDDLE = Qt.MouseButton.LeftButton, Qt.MouseButton.MiddleButton
PLAIN, SHIFT = Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ShiftModifier
CONTROL = Qt.KeyboardModifier.ControlModifier
SEED = 7


@pytest.fixture(scope="module")
def results():
    limb = load_limb("synthetic-1")
    surface = surface_operator(limb)
    levels = np.random.default_rng(SEED).uniform(-60, -12, 72)
    levels[28] = -11.0
    return {
        "limb_data": limb,
        "limb_map": limb.map,
        "surface": surface,
        "output_levels_db": levels,
        "surface_levels_db": surface.interpolate(levels),
    }


class Window:
    """Gives a panel's wishes back to it, as the application does."""

    def __init__(self, panel, results):
        self.panel, self.results = panel, results
        self.design, self.view = start_design("synthetic-1"), View()
        self.views = []
        panel.view_changed.connect(self.take)

    def take(self, view):
        self.views.append(view)
        self.view = view
        self.panel.show_state(self.design, view)

    def show(self, **changes):
        self.view = replace(self.view, **changes)
        self.panel.show_state(self.design, self.view)

    def deliver(self, **changes):
        wanted = {name: self.results[name] for name in self.panel.needs}
        self.panel.show_results({**wanted, **changes})


@pytest.fixture
def window(qtbot, results):
    panel = SurfacePanel()
    qtbot.addWidget(panel)
    panel.resize(420, 640)
    window = Window(panel, results)
    window.show()
    panel.show()
    qtbot.waitExposed(panel)
    window.deliver()
    return window


def place(window, number):
    return window.panel.map.place_of(number).toPoint()


def click(window, number, modifiers=PLAIN):
    QTest.mouseClick(window.panel.map, LEFT, modifiers, place(window, number))


def drag(widget, start, end, button=LEFT, modifiers=PLAIN):
    QTest.mousePress(widget, button, modifiers, start)
    for part in (0.5, 1.0):
        # QTest.mouseMove names no button or modifier; none is needed while one is held.
        QTest.mouseMove(widget, start + (end - start) * part)
    QTest.mouseRelease(widget, button, modifiers, end)


def wheel(widget, at, notches, modifiers=PLAIN):
    event = QWheelEvent(
        QPointF(at),
        QPointF(widget.mapToGlobal(at)),
        QPoint(),
        QPoint(0, 120 * notches),
        Qt.MouseButton.NoButton,
        modifiers,
        Qt.ScrollPhase.NoScrollPhase,
        False,
    )
    QApplication.sendEvent(widget, event)


def pixel(picture, at):
    return QColor(picture.pixel(at)).getRgb()[:3]


def empty_place(window):
    return QPoint(8, window.panel.map.height() - 120)


# What is asked for


def test_the_surface_is_asked_for_only_while_the_map_is_interpolated(window):
    assert {"limb_map", "output_levels_db", "surface", "surface_levels_db"} <= window.panel.needs
    window.show(map_style="sensors")
    assert window.panel.needs == {"limb_map", "output_levels_db"}


def test_sensors_only_is_drawn_without_a_surface(window):
    window.show(map_style="sensors", outputs=())
    window.deliver()
    level = window.results["output_levels_db"][51]
    low_high = window.panel.colour_bar.range_db
    expected = QColor(int(colour_table()[colour_indices(np.array(level), low_high)]))
    picture = window.panel.map.grab().toImage()
    assert pixel(picture, place(window, 52)) == expected.getRgb()[:3]


def test_a_map_kept_from_before_is_not_shown_when_interpolation_is_switched_on_again(window):
    window.show(map_style="sensors")
    window.show(map_style="interpolated")
    assert window.panel.map.content.shown_field is None
    window.deliver()
    assert window.panel.map.content.shown_field is not None


# Selecting


def test_a_click_selects_one_output(window):
    click(window, 8)
    assert window.view.outputs == (8,)


@pytest.mark.parametrize("modifier", [SHIFT, CONTROL])
def test_a_click_with_shift_or_control_adds_and_removes(window, modifier):
    click(window, 8, modifier)
    assert window.view.outputs == (29, 52, 8)
    click(window, 29, modifier)
    assert window.view.outputs == (52, 8)


@pytest.mark.parametrize("size", [(300, 330), (420, 640), (1000, 1300)])
def test_each_of_the_72_outputs_can_be_clicked(window, size):
    window.panel.resize(*size)
    for number in range(1, 73):
        click(window, number)
        assert window.view.outputs == (number,)


def test_the_palmar_outputs_stay_where_they_are_while_the_map_is_zoomed(window):
    before = place(window, 61)
    window.panel.map.zoom(4.0, QPointF(100, 100))
    assert place(window, 61) == before
    click(window, 61)
    assert window.view.outputs == (61,)


def test_a_rubber_band_selects_what_is_inside(window):
    around = QRectF(place(window, 43), place(window, 55)).normalized().adjusted(-6, -6, 6, 6)
    drag(window.panel.map, around.topLeft().toPoint(), around.bottomRight().toPoint())
    assert window.view.outputs == (43, 44, 45, 46, 52, 53, 54, 55)


def test_a_rubber_band_with_shift_adds(window):
    at = place(window, 41)
    drag(window.panel.map, at - QPoint(9, 9), at + QPoint(9, 9), modifiers=SHIFT)
    assert window.view.outputs == (29, 52, 41)


def test_a_rubber_band_around_nothing_selects_nothing(window):
    start = QPoint(6, window.panel.map.height() - 60)
    drag(window.panel.map, start, start + QPoint(12, 20))
    assert window.view.outputs == ()


def test_a_click_on_empty_space_keeps_the_selection(window):
    QTest.mouseClick(window.panel.map, LEFT, PLAIN, empty_place(window))
    assert window.views == []


def test_escape_gives_up_a_rubber_band_and_then_the_selection(window):
    view = window.panel.map
    QTest.mousePress(view, LEFT, PLAIN, QPoint(10, 10))
    QTest.mouseMove(view, QPoint(300, 500))
    QTest.keyClick(view, Qt.Key.Key_Escape)
    QTest.mouseRelease(view, LEFT, PLAIN, QPoint(300, 500))
    assert window.views == []
    QTest.keyClick(view, Qt.Key.Key_Escape)
    assert window.view.outputs == ()


def test_control_a_selects_all_dorsal_outputs(window):
    QTest.keyClick(window.panel.map, Qt.Key.Key_A, CONTROL)
    assert window.view.outputs == DORSAL_OUTPUTS
    assert len(DORSAL_OUTPUTS) == 66


def test_arrows_and_space_select_outputs(window):
    view = window.panel.map
    view.setFocus()
    window.show(outputs=(52,))
    for key in (Qt.Key.Key_Down, Qt.Key.Key_Down, Qt.Key.Key_Space):
        QTest.keyClick(view, key)
    assert window.view.outputs == (54,)
    QTest.keyClick(view, Qt.Key.Key_Left)
    QTest.keyClick(view, Qt.Key.Key_Space, SHIFT)
    assert window.view.outputs == (54, 55)
    assert window.panel.readout.text().startswith("Output 55, ")


def test_arrows_reach_every_output(window):
    points = window.panel.map.map_layout().points
    reached, waiting = {52}, [52]
    while waiting:
        number = waiting.pop()
        for step in ((1, 0), (-1, 0), (0, 1), (0, -1)):
            beyond = output_beyond(points, number, *step)
            if beyond not in reached:
                reached.add(beyond)
                waiting.append(beyond)
    assert reached == set(range(1, 73))


# Zooming


def test_control_and_wheel_zoom_around_the_pointer(window):
    view, at = window.panel.map, QPoint(150, 100)
    before = view.map_layout().frame
    wheel(view, at, 3, CONTROL)
    after = view.map_layout().frame
    assert after.scale > 1.5 * before.scale
    assert after.to_map(QPointF(at)) == pytest.approx(before.to_map(QPointF(at)))


def test_zooming_out_ends_at_the_whole_outline(window):
    view = window.panel.map
    wheel(view, QPoint(150, 100), 3, CONTROL)
    wheel(view, QPoint(10, 10), -9, CONTROL)
    assert view.fit == FIT_ALL


def test_a_drag_with_the_middle_button_pans(window):
    view = window.panel.map
    view.zoom(4.0, QPointF(150, 200))
    before = place(window, 25)
    drag(view, QPoint(100, 100), QPoint(130, 160), button=MIDDLE)
    assert place(window, 25) - before == QPoint(30, 60)
    assert window.views == []


@pytest.mark.parametrize("way", ["key", "double click", "button"])
def test_there_are_three_ways_back_to_the_whole_outline(window, way):
    view = window.panel.map
    view.zoom(2.0, QPointF(0, 0))
    assert view.fit != FIT_ALL
    if way == "key":
        QTest.keyClick(view, Qt.Key.Key_0)
    elif way == "double click":
        QTest.mouseDClick(view, LEFT, PLAIN, QPoint(3, 3))
    else:
        QTest.mouseClick(window.panel.toolbar.all, LEFT)
    assert view.fit == FIT_ALL


def test_the_hand_can_be_fitted_alone(window):
    view = window.panel.map
    whole = view.map_layout().frame.scale
    QTest.mouseClick(window.panel.toolbar.hand, LEFT)
    assert view.fit == FIT_HAND
    assert view.map_layout().frame.scale > 1.3 * whole
    room = QRectF(view.rect())
    assert all(room.contains(view.place_of(number)) for number in range(1, 43))


def test_nothing_of_the_outline_is_cut_off_or_covered_at_any_size(window):
    outline = window.results["limb_map"].outline
    for size in ((300, 330), (300, 900), (420, 640), (1200, 500)):
        window.panel.resize(*size)
        layout = window.panel.map.map_layout()
        x, y = layout.frame.to_screen(outline).T
        assert layout.room.contains(QRectF(QPointF(x.min(), y.min()), QPointF(x.max(), y.max())))
        card = layout.palmar_card
        inside = (x > card.left()) & (x < card.right()) & (y > card.top()) & (y < card.bottom())
        assert not inside.any(), size


def test_an_output_reached_by_arrows_comes_into_sight(window):
    view = window.panel.map
    room = QRectF(view.rect())
    view.show_hand()
    hidden = {k for k in range(1, 73) if not room.contains(view.place_of(k))}
    view.cursor_output, visited = 54, set()
    for _ in range(12):
        QTest.keyClick(view, Qt.Key.Key_Down)
        assert room.contains(view.place_of(view.cursor_output))
        visited.add(view.cursor_output)
    assert visited & hidden


# The picture


def test_every_place_of_the_skin_is_drawn_where_it_is(qtbot):
    """A level that grows evenly along x shows a shift of a part of a pixel."""
    spacing, corners = np.arange(5.0, 65.0), [(10.0, 10.0), (110, 10), (110, 110), (10, 110)]
    limb_map = LimbMap(
        outline=np.array(corners),
        output_positions=np.random.default_rng(SEED).uniform(20, 100, (72, 2)),
        input_positions=np.zeros((20, 2)),
        hand_length_px=100.0,
    )
    field = FieldImage(np.ones((60, 60), bool), spacing, spacing, px_per_mm=2.0)
    table = colour_table()
    row_of_colour = {int(argb): k for k, argb in enumerate(table)}
    canvas = MapCanvas()
    qtbot.addWidget(canvas)
    canvas.resize(433, 517)
    for along_x in (True, False):
        levels = np.broadcast_to(spacing, (60, 60))
        content = MapContent(
            limb_map=limb_map,
            levels_db=np.full(72, 30.0),
            field=field,
            field_levels_db=np.ascontiguousarray(levels if along_x else levels.T),
            range_db=(0.0, 64.0),
            sensors_shown=False,
        )
        canvas.show_content(content)
        picture = canvas.grab().toImage()
        frame = canvas.map_layout().frame
        for k in range(1, 20):
            part = 10 + 5 * k
            x, y = frame.to_screen(np.array([[part, part]]))[0]
            at = QPoint(int(x), int(y))
            centre = QPointF(at.x() + 0.5, at.y() + 0.5)
            level = frame.to_map(centre)[0 if along_x else 1] / 2.0
            found = [row_of_colour[c] for c in near(picture.pixel(at), row_of_colour)]
            expected = level / 64.0 * 255
            # Half a pixel of the field is two rows of the table.
            assert min(abs(k - expected) for k in found) <= 1.6


def near(argb, colours):
    """The colours of a table nearest to one that may lie between two of them."""
    channels = np.array([[(c >> s) & 255 for s in (0, 8, 16)] for c in colours], int)
    wanted = np.array([(argb >> s) & 255 for s in (0, 8, 16)])
    distance = np.abs(channels - wanted).sum(axis=1)
    return [c for c, d in zip(colours, distance, strict=True) if d == distance.min()]


def test_the_rim_shows_no_empty_pixel(window):
    window.show(outputs=(), sensors_shown=False, map_range_db=(-100.0, -99.0))
    window.panel.resize(900, 1900)
    view = window.panel.map
    picture = view.grab().toImage()
    highest = QColor(int(colour_table()[-1])).getRgb()[:3]
    layout = view.map_layout()
    outline = layout.frame.to_screen(window.results["limb_map"].outline)
    ahead = np.roll(outline, -1, axis=0) - outline
    # The outline runs counter-clockwise; on the screen, with y down, inside is to the left.
    inwards = np.stack([ahead[:, 1], -ahead[:, 0]], axis=1)
    inwards /= np.linalg.norm(inwards, axis=1)[:, None]
    wrong = 0
    for x, y in outline + 2.0 * inwards:
        wrong += pixel(picture, QPoint(int(x), int(y))) != highest
    # Where it bends, two pixels inwards may lie on the line itself.
    assert wrong <= 0.01 * len(outline)


def test_levels_outside_the_range_have_the_colours_of_its_ends():
    levels = np.array([-200.0, -50.0, -24.95, 0.0, 40.0, np.nan])
    assert colour_indices(levels, (-50.0, 0.0)).tolist() == [0, 0, 128, 255, 255, 0]


def test_fingers_are_up_and_the_thumb_is_left(window):
    assert place(window, 20).y() < place(window, 52).y() < place(window, 69).y()
    assert place(window, 41).x() < place(window, 6).x()


def test_silence_is_told_and_shows_no_colours(window):
    window.deliver(
        output_levels_db=np.full(72, -200.0),
        surface_levels_db=np.where(window.results["surface"].mask, -200.0, np.nan),
    )
    assert window.panel.map.content.message == SILENT
    assert window.panel.map.content.shown_field is None
    window.deliver()
    assert window.panel.map.content.message == ""
    assert window.panel.map.content.shown_field is not None


def test_a_problem_empties_the_map_and_is_told_there(window):
    window.panel.show_problem("no dataset is installed")
    content = window.panel.map.content
    assert content.message == "no dataset is installed"
    assert content.shown_field is None
    assert content.coloured_levels_db is None
    window.panel.map.grab()
    window.deliver()
    assert window.panel.map.content.message == ""


def test_a_problem_before_any_result_is_told(qtbot):
    panel = SurfacePanel()
    qtbot.addWidget(panel)
    panel.show_problem("no dataset is installed")
    empty = SurfacePanel()
    qtbot.addWidget(empty)
    assert panel.grab().toImage() != empty.grab().toImage()


def test_something_outdated_is_marked_after_a_while(window, qtbot):
    window.panel.show_stale(True)
    assert not window.panel.map.content.outdated
    qtbot.waitUntil(lambda: window.panel.map.content.outdated)
    window.deliver()
    assert not window.panel.map.content.outdated


def test_results_in_time_prevent_the_mark(window):
    window.panel.show_stale(True)
    window.deliver()
    assert not any(timer.isActive() for timer in window.panel.findChildren(QTimer))


def test_a_synthetic_limb_is_named_so_on_the_map_and_in_pictures(window):
    assert window.panel.map.content.synthetic
    marked = window.panel.picture(400, 600)
    window.design = replace(window.design, limb="measured-1")
    window.show()
    # The picture on screen is still that of the synthetic limb.
    assert window.panel.map.content.synthetic
    window.deliver()
    assert not window.panel.map.content.synthetic
    assert window.panel.picture(400, 600) != marked


@pytest.mark.parametrize("size", [(320, 240), (600, 800), (2000, 1200)])
def test_pictures_have_the_size_asked_for(window, size):
    picture = window.panel.picture(*size)
    assert isinstance(picture, QImage)
    assert (picture.width(), picture.height()) == size


# Words


def test_the_readout_follows_the_mouse(window):
    view = window.panel.map
    QTest.mouseMove(view, place(window, 29))
    assert window.panel.readout.text() == (
        "Output 29, Digit II, beside the nail, radial\n−11.0 dB re 1 m/s²  (0.282 m/s²)"
    )
    window.show(outputs=())
    QTest.mouseMove(view, (place(window, 60) + place(window, 69)) / 2)
    assert window.panel.readout.text().endswith(" mm/s²)")
    QTest.mouseMove(view, QPoint(5, 5))
    assert window.panel.readout.text().startswith("No output selected")


@pytest.mark.qt_log_ignore("This plugin does not support raise")
def test_an_output_tells_its_number_place_and_level(window):
    at = place(window, 29)
    event = QHelpEvent(QEvent.Type.ToolTip, at, window.panel.map.mapToGlobal(at))
    QApplication.sendEvent(window.panel.map, event)
    assert QToolTip.text().startswith("Output 29, Digit II, beside the nail, radial\n−11.0 dB")
    QToolTip.hideText()


def test_buttons_change_the_view(window):
    toolbar = window.panel.toolbar
    QTest.mouseClick(toolbar.sensors_only, LEFT)
    assert window.view.map_style == "sensors"
    assert not toolbar.sensors.isEnabled()
    QTest.mouseClick(toolbar.interpolated, LEFT)
    assert window.view.map_style == "interpolated"
    QTest.mouseClick(toolbar.sensors, LEFT)
    assert not window.view.sensors_shown


def test_arrows_choose_the_style(window):
    toolbar = window.panel.toolbar
    toolbar.interpolated.setFocus()
    QTest.keyClick(toolbar.interpolated, Qt.Key.Key_Right)
    assert window.view.map_style == "sensors"


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


# The range of the colours


def test_the_automatic_range_holds_the_loudest_output(window):
    assert window.panel.colour_bar.range_db == (-60.0, -10.0)
    assert window.panel.colour_bar.auto_button.isChecked()


def test_the_automatic_range_does_not_flicker():
    follows, tops = AutomaticRange(), []
    for loudest in (-11.0, -9.9, -12.9, -5.2, -4.9, -7.9, -8.1, -17.9, -18.1, -200.0):
        tops.append(follows.follow(np.array([-200.0, loudest]))[1])
    assert tops == [-10, -5, -5, -5, 0, 0, -5, -15, -15, -15]


def test_a_handle_is_dragged(window):
    bar = window.panel.colour_bar
    drag(bar.strip.high, QPoint(10, 6), QPoint(10, 46))
    low, high = window.view.map_range_db
    assert low == -60.0
    assert -20.0 < high < -10.0
    assert bar.range_db == (low, high)
    assert not bar.auto_button.isChecked()


def test_a_handle_pulled_past_the_other_stops_before_it(window):
    bar = window.panel.colour_bar
    drag(bar.strip.low, QPoint(10, 6), QPoint(10, -900))
    assert window.view.map_range_db == (-11.0, -10.0)


def test_a_drag_between_the_handles_moves_both(window):
    strip = window.panel.colour_bar.strip
    middle = QPoint(17, strip.height() // 2)
    drag(strip, middle, middle - QPoint(0, 30))
    low, high = window.view.map_range_db
    assert high > -10.0
    assert high - low == pytest.approx(50.0)


def test_the_scale_stands_still_while_a_handle_is_dragged(window):
    strip = window.panel.colour_bar.strip
    QTest.mousePress(strip.high, LEFT, PLAIN, QPoint(10, 6))
    before = strip.low.pos(), strip.high.pos().y()
    QTest.mouseMove(strip.high, QPoint(10, 36))
    assert strip.low.pos() == before[0]
    assert strip.high.pos().y() == pytest.approx(before[1] + 30, abs=1)
    QTest.mouseRelease(strip.high, LEFT, PLAIN, QPoint(10, 6))


def test_a_double_click_brings_the_automatic_range_back(window):
    window.show(map_range_db=(-30.0, -20.0))
    QTest.mouseDClick(window.panel.colour_bar.strip, LEFT, PLAIN, QPoint(17, 200))
    assert window.view.map_range_db is None
    assert window.panel.colour_bar.range_db == (-60.0, -10.0)


def test_keys_move_a_handle_or_the_whole_range(window):
    strip = window.panel.colour_bar.strip
    QTest.keyClick(strip.high, Qt.Key.Key_Up)
    assert window.view.map_range_db == (-60.0, -9.0)
    QTest.keyClick(strip.low, Qt.Key.Key_Down, CONTROL)
    assert window.view.map_range_db == (-60.1, -9.0)
    QTest.keyClick(strip, Qt.Key.Key_PageUp)
    assert window.view.map_range_db == pytest.approx((-50.1, 1.0))


def test_exact_levels_are_typed(window):
    field = window.panel.colour_bar.low_field
    field.setFocus()
    field.selectAll()
    QTest.keyClicks(field, "-42.5")
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert window.view.map_range_db == (-42.5, -10.0)
    assert field.text() == "−42.5 dB"


def test_an_impossible_level_goes_as_far_as_it_can(window):
    field = window.panel.colour_bar.low_field
    field.selectAll()
    QTest.keyClicks(field, "30")
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert window.view.map_range_db == (-11.0, -10.0)
    assert field.value() == -11.0


def test_the_switch_holds_the_range_and_frees_it(window):
    button = window.panel.colour_bar.auto_button
    QTest.mouseClick(button, LEFT)
    assert window.view.map_range_db == (-60.0, -10.0)
    QTest.mouseClick(button, LEFT)
    assert window.view.map_range_db is None


def test_ticks_are_round_and_apart():
    assert tick_levels(-66.0, 6.0, room_px=200.0, spacing_px=24.0) == [
        -60,
        -50,
        -40,
        -30,
        -20,
        -10,
        0,
    ]
    assert tick_levels(-1.0, 0.0, room_px=200.0, spacing_px=24.0) == [-1.0, -0.5, 0.0]
