import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDialog, QWidget

from skinsource.design.design import Design, track
from skinsource.design.panel_settings import with_settings
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.fields.editors import FieldCell
from skinsource_gui.fields.number_field import NumberField
from skinsource_gui.panels.skin.settings import SkinSettings

KEY = Qt.Key
SHIFT = Qt.KeyboardModifier.ShiftModifier
PLAIN = Qt.KeyboardModifier.NoModifier


@pytest.fixture
def at_work(qtbot, window):
    """The window, with the keyboard in the hand."""
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
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
