"""Tab goes as one reads; the panel in use is the one pressed or with the keyboard last."""

from itertools import pairwise

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QApplication, QDialog, QScrollArea, QWidget

from skinsource import Design, View, track
from skinsource.design.panel_settings import with_settings
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.fields.editors import FieldCell
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.panels.skin.settings import SkinSettings
from skinsource_gui.plots.pictures import PANEL_IN_USE
from skinsource_gui.qt.theme import current_theme
from skinsource_gui.shell.focus import tab_stops
from tests.gui.dock_bench import bar_with, titles

KEY = Qt.Key
SHIFT = Qt.KeyboardModifier.ShiftModifier
PLAIN = Qt.KeyboardModifier.NoModifier


@pytest.fixture
def at_work(window):
    """The window, with the keyboard in the hand."""
    window.panel("hand").setFocus()
    return window


def press(window, key, modifiers=PLAIN):
    QTest.keyClick(QApplication.focusWidget() or window, key, modifiers)
    QApplication.processEvents()
    return QApplication.focusWidget()


def walk(window, modifiers=PLAIN):
    """Names of the controls that Tab reaches, until it is back."""
    start = QApplication.focusWidget()
    names = []
    for _ in range(100):
        focused = press(window, KEY.Key_Tab, modifiers)
        names.append((region_of(window, focused), focused.objectName()))
        if focused is start:
            return names
    raise AssertionError(f"Tab does not come back: {names}")


def region_of(window, widget):
    parts = {
        "notice": window.notice.card,
        "setup": window.setup_bar,
        "transport": window.playback.bar,
        "status": window.statusBar(),
        **{panel.name: panel for panel in window.panels},
        "head": window.menuWidget(),
    }
    return next(name for name, part in parts.items() if part.isAncestorOf(widget))


def in_turn(names):
    regions = [region for region, _ in names]
    return [region for k, region in enumerate(regions) if k == 0 or regions[k - 1] != region]


def test_tab_goes_through_all_panels_in_the_order_of_the_work_and_shift_tab_back(at_work):
    names = walk(at_work)
    assert walk(at_work, SHIFT)[:-1] == names[-2::-1]
    assert in_turn(names) == [
        "hand",  # the switch that mirrors it
        "timeline",
        "inspector",
        "skin",
        "traces",
        "spectra",
        "status",  # how to get the measured limbs
        "transport",
        "setup",
        "hand",
    ]
    assert len(set(names)) == len(names)
    assert {
        ("setup", "limb"),
        ("transport", "play_button"),
        ("timeline", "input_rows"),
        ("timeline", "lanes"),
        ("inspector", "kind_field"),
        ("inspector", "location_field"),
        *(("skin", f"measure_{word}") for word in ("quantity", "axes", "span", "unit")),
        *(("skin", name) for name in ("map_arm", "skin_map", "range_low_field", "colour_strip")),
        ("traces", "overlaid"),
        ("traces", "relative"),
        ("traces", "traces-plot"),
        ("spectra", "log-magnitude"),
        ("spectra", "spectra-plot"),
    } <= set(names)


def test_what_is_disabled_or_hidden_is_left_out(at_work, settle):
    view = at_work.document.view
    at_work.document.look(with_settings(view, "skin", SkinSettings(quantity="sensation")))
    at_work.docks["inspector"].close()
    settle()
    names = walk(at_work)
    assert ("skin", "measure_unit") in names
    assert not {("skin", "measure_axes"), ("skin", "measure_span")}.intersection(names)
    assert "inspector" not in in_turn(names)


def test_each_workspace_has_its_own_round(at_work):
    at_work.do("arrange_presentation")
    QApplication.processEvents()
    at_work.panel("stage").findChild(QWidget, "stage_dial").setFocus()
    visible = {panel.name for panel in at_work.panels if panel.isVisible()}
    assert {region for region, _ in walk(at_work)} == visible | {"setup", "transport", "status"}


def test_tab_ends_typing_and_goes_on(at_work):
    field = next(
        cell
        for cell in at_work.panel("inspector").findChildren(FieldCell)
        if cell.field.objectName() == "duration_s_field"
    ).field
    field.setFocus()
    QTest.keyClicks(field, "300")
    assert press(at_work, KEY.Key_Tab).objectName() == "kind_field"
    assert at_work.document.design.inputs[0].clips[0].waveform.duration_s == 0.3


def test_a_field_that_tab_reaches_scrolls_into_sight(at_work):
    at_work.resize(1366, 620)
    QApplication.processEvents()
    at_work.panel("skin").measure.quantity.setFocus()
    while QApplication.focusWidget().objectName() != "location_field":
        press(at_work, KEY.Key_Tab, SHIFT)
    place = QApplication.focusWidget()
    assert place.visibleRegion().boundingRect() == place.rect()


def test_the_way_to_the_measured_limbs_is_followed_by_key(at_work):
    at_work.panel("spectra").setFocus()
    assert press(at_work, KEY.Key_Tab).objectName() == "conditions"
    assert press(at_work, KEY.Key_Tab).objectName() == "get_limbs"
    press(at_work, KEY.Key_Space)
    page = next(dialog for dialog in at_work.findChildren(QDialog) if dialog.isVisible())
    assert page.windowTitle() == "Get the measured limbs"
    page.close()


def test_f6_goes_from_panel_to_panel_in_the_same_order(at_work):
    shown = [panel for panel in at_work.panels if panel.isVisible()]
    went = [region_of(at_work, press(at_work, KEY.Key_F6)) for _ in shown]
    assert went == ["timeline", "inspector", "skin", "traces", "spectra", "hand"]
    back = [region_of(at_work, press(at_work, KEY.Key_F6, SHIFT)) for _ in shown]
    assert back == ["spectra", "traces", "skin", "inspector", "timeline", "hand"]


def test_all_is_the_text_of_a_number_and_not_all_tracks(open_window):
    tone = Tone(frequency_hz=100.0, duration_s=0.2)
    window = open_window(Design(limb="synthetic-1", inputs=(track(7, tone), track(13, tone))))
    fields = window.panel("inspector").findChildren(NumberField)
    field = next(field for field in fields if field.isVisible())
    window.activateWindow()
    QTest.mouseClick(field, Qt.MouseButton.LeftButton)
    assert window.focusWidget() is field
    selected = window.document.view.selected_inputs
    QTest.keyClick(field, Qt.Key.Key_A, Qt.KeyboardModifier.ControlModifier)
    assert window.document.view.selected_inputs == selected
    assert field.selectedText() == field.text() != ""
    # Once more, while it is typed.
    field.deselect()
    QTest.keyClick(field, Qt.Key.Key_A, Qt.KeyboardModifier.ControlModifier)
    assert field.selectedText() == field.text()
    QTest.keyClick(field, Qt.Key.Key_Escape)
    assert window.document.view.selected_inputs == selected


@pytest.fixture
def window(open_window, qtbot):
    tone = track(7, Tone(frequency_hz=100.0))
    window = open_window(Design(limb="synthetic-1", inputs=(tone,)), View(selected_inputs=(1,)))
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    return window


@pytest.mark.parametrize("unfolded", [False, True])
def test_the_output_too(window, settle, unfolded):
    window.docks["output"].bring_forward()
    settle()
    panel = window.panel("output")
    if unfolded:
        panel.choices.cell("actuator").edited.emit("actuator", "example-piezo", None)
        panel.more.click()
        settle()
    # Wherever its middle is: what scrolls is no line among those that it holds.
    inside = panel.findChild(QScrollArea).widget().layout()
    for top_px in range(0, 60, 6):
        inside.setContentsMargins(0, top_px, 0, 0)
        QApplication.processEvents()
        stops = tab_stops(panel, (panel,))
        check_places([stop for stop in stops if not isinstance(stop, QScrollArea)], panel)
        scrolling = [k for k, stop in enumerate(stops) if isinstance(stop, QScrollArea)]
        assert all(stops[k].isAncestorOf(stops[k + 1]) for k in scrolling)


def check_places(stops, panel):
    places = [(stop.objectName(), stop.mapTo(panel, stop.rect().center()).y()) for stop in stops]
    assert all(after[1] >= before[1] - 4 for before, after in pairwise(places)), places


def corner(window):
    diagram = window.panel("hand").diagram
    picture = diagram.grab().toImage()
    return picture.pixelColor(0, picture.height() // 3).name()


def test_the_hand_shows_that_it_has_the_keyboard_before_a_key_is_used_there(window, settle):
    diagram = window.panel("hand").diagram
    QTest.mouseClick(
        diagram, Qt.MouseButton.LeftButton, pos=diagram.rect().center() + QPoint(0, 120)
    )
    assert QApplication.focusWidget() is diagram
    assert diagram.stage.state.cursor is None
    assert corner(window) == current_theme().accent
    window.panel("timeline").setFocus()
    assert corner(window) != current_theme().accent


def test_the_timeline_has_the_keyboard_once_a_motion_was_added(window, settle):
    window.panel("hand").setFocus()
    window.do("make_motion")
    window.findChild(QAbstractButton, "add_motion").click()
    settle()
    assert window.panel("timeline").isAncestorOf(window.focusWidget())


LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def studio(window, qtbot):
    """A window whose keyboard is in the panel Hand."""
    window.docks["hand"].bring_forward()
    keep_keyboard(window, qtbot)
    return window


def keep_keyboard(window, qtbot):
    window.panel("hand").setFocus()
    qtbot.waitUntil(lambda: window.panel("hand").isAncestorOf(QApplication.focusWidget()))
    assert in_use(window) == "Hand"


def in_use(window):
    return window.pictures.picture_of(PANEL_IN_USE).title


def press_on(part, at=None, button=LEFT):
    """Click as a mouse does: in the window, not on a widget that somebody picked."""
    top = part.window()
    spot = part.mapTo(top, part.rect().center() if at is None else at)
    QTest.mouseClick(top.windowHandle(), button, pos=spot)
    QApplication.processEvents()


def empty_part(panel):
    """A spot of a panel where nothing takes the keyboard."""
    window = panel.window()
    spots = (QPoint(x, y) for y in range(1, panel.height(), 2) for x in range(1, panel.width(), 2))
    for at in spots:
        part = window.childAt(panel.mapTo(window, at))
        while part is not panel and not part.focusPolicy() & Qt.FocusPolicy.ClickFocus:
            part = part.parentWidget()
        if part is panel:
            return at
    raise AssertionError(panel.name)


@pytest.mark.parametrize("name", ["skin", "traces", "spectra"])
def test_a_panel_is_in_use_once_its_ground_is_pressed_and_the_keyboard_stays(studio, name):
    focused = QApplication.focusWidget()
    press_on(studio.panel(name), empty_part(studio.panel(name)))
    assert in_use(studio) == studio.panel(name).title
    assert QApplication.focusWidget() is focused


def test_a_panel_without_anything_for_the_keyboard_is_in_use_once_its_tab_is_pressed(studio, qtbot):
    studio.tabifyDockWidget(studio.docks["traces"], studio.docks["spectra"])
    studio.docks["traces"].raise_()
    for part in studio.panel("spectra").findChildren(QWidget):
        part.setFocusPolicy(Qt.FocusPolicy.NoFocus)
    keep_keyboard(studio, qtbot)
    bar = bar_with(studio, "Spectra")
    press_on(bar, bar.tabRect(titles(bar).index("Spectra")).center())
    qtbot.waitUntil(lambda: in_use(studio) == "Spectra")


def test_a_panel_out_of_the_window_is_in_use_once_it_is_pressed(studio, qtbot):
    dock = studio.docks["skin"]
    dock.setFloating(True)
    qtbot.waitExposed(dock)
    keep_keyboard(studio, qtbot)
    focused = QApplication.focusWidget()
    press_on(dock.panel, empty_part(dock.panel))
    assert in_use(studio) == "Skin"
    dock.activateWindow()
    dock.panel.setFocus()
    qtbot.waitUntil(lambda: dock.isAncestorOf(QApplication.focusWidget()))
    studio.activateWindow()  # as who goes to a menu there
    qtbot.waitUntil(lambda: QApplication.focusWidget() is focused)
    assert in_use(studio) == "Skin"


def test_a_panel_that_is_closed_is_in_use_no_longer(studio):
    dock = studio.docks["skin"]
    press_on(dock.panel, empty_part(dock.panel))
    assert in_use(studio) == "Skin"
    studio.do("close_panel")
    assert not dock.isVisible()
    assert in_use(studio) == "Hand"
