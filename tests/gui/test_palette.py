"""Actions and keys: in menus and the palette, as their page says, in fields as well."""

from dataclasses import replace
from functools import partial
from itertools import product

import pytest
import shiboken6
from PySide6.QtCore import QCoreApplication, QEvent, Qt, QUrl
from PySide6.QtGui import QAction, QKeyEvent, QKeySequence, QShortcut
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QApplication, QLineEdit, QMenu, QTextBrowser, QWidget
from shiboken6 import isValid

from skinsource.design.panel_settings import settings_of, with_settings
from skinsource_gui.fields.number_field import NumberField, begins_typing, makes_step
from skinsource_gui.panels.skin.scale import key_step_db
from skinsource_gui.panels.skin.settings import SkinSettings
from skinsource_gui.panels.skin.time import ScrubBar
from skinsource_gui.qt.keys import KEYS, MOUSE, SHORTCUTS, meaning_of
from skinsource_gui.shell import pages
from skinsource_gui.shell.actions import ACTIONS, MENUS
from skinsource_gui.shell.menus import Palette, matching
from skinsource_gui.shell.playing import Transport


def test_what_begins_with_the_letters_comes_before_what_holds_them(qapp):
    names = ("Dark theme", "Get the measured limbs…", "Theme of the day")
    actions = [QAction(name) for name in names]
    found = [action.text() for action in matching(actions, "theme")]
    assert found == ["Theme of the day", "Dark theme"]


def test_the_line_is_there_until_what_its_key_runs_is_done(qtbot):
    # As panels that come to the front do it, within the key event of the line.
    def handle_events(_checked=False):
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete.value)
        there.append(isValid(line))

    there, action = [], QAction("Go to Playback")
    action.triggered.connect(handle_events)
    parent = QWidget()
    qtbot.addWidget(parent)
    palette = Palette([action], parent)
    palette.open()
    line = palette.line
    line.returnPressed.emit()
    assert there == [True]
    qtbot.waitUntil(lambda: not isValid(line))


def test_every_action_of_the_table_stands_in_its_menu_under_its_words(window):
    menus = {menu.title().replace("&", ""): menu for menu in window.menuBar().findChildren(QMenu)}
    for name, menu in (("undo", "Edit"), ("compare_side_by_side", "Snapshots"), ("play", "Play")):
        assert window.actions_by_name[name] in menus[menu].actions()
    for spec in ACTIONS:
        action = window.actions_by_name[spec.name]
        # Buttons stay below the mouse, and would hide what is reported.
        assert bool(action.statusTip()) == (spec.group != "workspace")
        if spec.menu:
            assert action in menus[spec.submenu or spec.menu].actions(), spec.name
        text = action.text().partition("\t")[0]
        assert text == spec.text or spec.name in ("undo", "redo")
        assert spec.hint in action.toolTip()
        assert bool(spec.missing) == (spec.enabled is not None)
        assert [keys.toString() for keys in action.shortcuts()] == [
            QKeySequence(keys).toString() for keys in spec.keys
        ]


def palette_with(window, qtbot, letters):
    """The palette, opened, with letters typed into its line."""
    window.do("find_action")
    palette = next(palette for palette in window.findChildren(Palette) if palette.isVisible())
    qtbot.keyClicks(palette.line, letters)
    return palette


def listed_for(window, qtbot, letters):
    palette = palette_with(window, qtbot, letters)
    texts = [
        palette.list.topLevelItem(row).text(0) for row in range(palette.list.topLevelItemCount())
    ]
    palette.reject()
    return texts


def run_from_palette(window, qtbot, letters):
    palette = palette_with(window, qtbot, letters)
    qtbot.keyClick(palette.line, Qt.Key.Key_Return)


def test_other_words_for_an_action_find_it(window, qtbot):
    for letters, expected in {
        "colour": "Dark theme",
        "color": "Light theme",
        "preferences": "Larger text",
        "matlab": "Export table: Traces…",
        "download": "Get the measured limbs…",
        "font": "Larger text",
        "delete": "Remove input",
        "excel": "Export table: RMS levels…",
        "noise": "Waveform: Noise",
        "wave speed": "Analysis: Wave speed",
        "sensation level": "Analysis: Perception",
        "equal level": "Match input levels",
        "difference": "Compare side by side",
        "people": "Compare side by side",
        "trim": "Trim a clip, to play less or more",
        "snap": "Snap edges to the grid, clip ends and the playhead",
        "gain curve": "Show or hide the gain curve of the track",
        "next clip": "Select the clip before, the next clip",
        "join": "Split, join, group, repeat, mute, remove it, and more",
    }.items():
        assert expected in listed_for(window, qtbot, letters), letters


def test_a_view_of_analysis_is_found_and_opened(window, qtbot):
    for letters, name in (("time windows", "windowed"), ("wave speed", "wave")):
        run_from_palette(window, qtbot, letters)
        qtbot.waitUntil(window.panel("analysis").isVisible)
        assert window.panel("analysis").view.name == name


def test_an_effect_is_added_to_the_selected_clips_by_its_name(window, qtbot):
    document = window.document
    window.do("add_input")
    document.look(replace(document.view, selected_clips=(document.design.clips[1].id,)))
    run_from_palette(window, qtbot, "rectify")
    titles = [[effect.title for effect in clip.effects] for clip in document.design.clips]
    assert titles == [[], ["Rectify"]]


def test_a_key_of_a_panel_is_pressed_and_another_gesture_told(window, qtbot):
    run_from_palette(window, qtbot, "put a marker at")
    assert len(window.document.design.markers) == 1
    run_from_palette(window, qtbot, "trim a clip")
    assert window.statusBar().currentMessage().startswith("Drag the start or the end of a clip")


def test_a_stored_snapshot_is_renamed_from_the_palette(window, qtbot, monkeypatch):
    window.do("store_snapshot_2")
    asked = iter(["x" * 201, "Soft"])
    getter = "PySide6.QtWidgets.QInputDialog.getText"
    monkeypatch.setattr(getter, lambda *_, text: (next(asked), True))
    run_from_palette(window, qtbot, "rename snapshot 2")
    assert [each.title for each in window.document.view.snapshots] == ["Soft"]


def test_where_nothing_is_found_the_palette_says_so_and_enter_does_nothing(window, qtbot):
    texts = listed_for(window, qtbot, "qqqq")
    assert texts[0] == "Nothing found"
    assert "F1" in texts[-1]
    palette = palette_with(window, qtbot, "qqqq")
    qtbot.keyClick(palette.line, Qt.Key.Key_Return)
    assert palette.isVisible()


def test_what_cannot_be_done_now_comes_last_with_its_reason_and_is_not_run(window, qtbot):
    enabled = {name: action.isEnabled for name, action in window.actions_by_name.items()}
    assert enabled["select_no_outputs"]()
    assert enabled["mute_input"]()
    window.document.look(replace(window.document.view, outputs=(), selected_inputs=()))
    assert not enabled["select_no_outputs"]()
    assert enabled["clear_inputs"]()
    window.do("clear_inputs")
    assert not enabled["clear_inputs"]()
    for letters, name in (("mute", "Mute input"), ("waveform: wavelet", "Waveform: Wavelet train")):
        assert listed_for(window, qtbot, letters)[-1] == name
    palette = palette_with(window, qtbot, "input")
    row = palette.list.findItems("Mute input", Qt.MatchFlag.MatchExactly)[0]
    assert (row.isDisabled(), row.text(1)) == (True, "Select an input")
    at = palette.list.visualItemRect(row).center()
    QTest.mouseClick(palette.list.viewport(), Qt.MouseButton.LeftButton, pos=at)
    assert palette.isVisible()
    palette.line.setText("mute input")
    qtbot.keyClick(palette.line, Qt.Key.Key_Return)
    assert palette.isVisible()
    palette.reject()


def test_the_colours_in_use_are_checked_however_they_were_chosen(window):
    actions = window.actions_by_name
    assert actions["use_viridis_colours"].isChecked()
    window.do("use_magma_colours")
    view = window.document.view
    assert settings_of(view, "skin", SkinSettings).colours == "magma"
    assert not window.document.undo_stack.canUndo()
    assert actions["use_magma_colours"].isChecked()
    assert not actions["use_viridis_colours"].isChecked()
    grey = SkinSettings(colours="CET-L1")
    window.document.look(with_settings(view, "skin", grey))
    assert actions["use_cet_l1_colours"].isChecked()


def test_a_frequency_is_set_by_keys_on_an_input_that_was_placed_by_keys(window, qtbot):
    window.document.look(replace(window.document.view, selected_inputs=()))
    assert "Edit: Frequency" not in listed_for(window, qtbot, "frequency")
    run_from_palette(window, qtbot, "add input")
    before = window.document.design.inputs[:-1]
    assert listed_for(window, qtbot, "frequency")[0] == "Edit: Frequency"
    run_from_palette(window, qtbot, "freq")
    window.activateWindow()
    qtbot.waitUntil(lambda: isinstance(QApplication.focusWidget(), NumberField))
    qtbot.keyClicks(QApplication.focusWidget(), "250")
    qtbot.keyClick(QApplication.focusWidget(), Qt.Key.Key_Return)
    (*others, placed) = window.document.design.inputs
    assert placed.clips[0].waveform.frequency_hz == 250.0
    assert tuple(others) == before


def test_hiding_is_an_entry_of_its_own_and_a_panel_that_is_shown_gets_the_keyboard(window, qtbot):
    window.activateWindow()
    assert listed_for(window, qtbot, "panel: skin") == ["Show panel: Skin", "Close panel: Skin"]
    run_from_palette(window, qtbot, "Close panel: Skin")
    assert window.docks["skin"].isHidden()
    assert listed_for(window, qtbot, "panel: skin") == ["Show panel: Skin"]
    for panel in map(window.panel, ("skin", "timeline")):
        run_from_palette(window, qtbot, f"Show panel: {panel.title}")
        qtbot.waitUntil(lambda panel=panel: panel.isAncestorOf(QApplication.focusWidget()))


def test_each_menu_opens_with_a_letter_of_its_own_and_the_first_with_f10(window, qtbot):
    bar = window.menuBar()
    keys = [QKeySequence.mnemonic(action.text()) for action in bar.actions()]
    assert QKeySequence() not in keys
    others = [QKeySequence(key) for spec in ACTIONS for key in spec.keys]
    assert len(set(keys) - set(others)) == len(keys) == len(MENUS)
    (key,) = [
        shortcut
        for shortcut in bar.findChildren(QShortcut)
        if shortcut.key() == QKeySequence("F10")
    ]
    assert key.key() not in others
    key.activated.emit()
    menu = bar.actions()[0].menu()
    qtbot.waitUntil(menu.isVisible)
    menu.close()


def test_scenes_of_the_paper_are_found_by_their_figure_and_opened(window, qtbot):
    assert "Scene: 5F · Separate and joint" in listed_for(window, qtbot, "5F")
    figures = {action.text(): action for action in window._findable()}
    figures["Scene: 2F · Two inputs interfere"].trigger()
    assert window.document.scene == "Two inputs interfere"


_Key, _Held = Qt.Key, Qt.KeyboardModifier
SIGNS = [Qt.Key(ord(sign)) for sign in "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ+-=. "]
NAMED = [
    *(_Key.Key_Left, _Key.Key_Right, _Key.Key_Up, _Key.Key_Down, _Key.Key_Home, _Key.Key_End),
    *(_Key.Key_PageUp, _Key.Key_PageDown, _Key.Key_Return, _Key.Key_Enter, _Key.Key_Delete),
    *(_Key.Key_Backspace, _Key.Key_Insert, _Key.Key_Escape, _Key.Key_F2),
]
#: What stands on keys that Qt calls otherwise.
ON_KEYS = {
    **{"PgUp": "Page Up", "PgDown": "Page Down", "Ins": "Insert", "Del": "Delete"},
    **{"Return": "Enter", "-": "−"},
}
HELD = [
    _Held.NoModifier,
    _Held.ShiftModifier,
    _Held.ControlModifier,
    _Held.AltModifier,
    _Held.ControlModifier | _Held.ShiftModifier,
    _Held.AltModifier | _Held.ShiftModifier,
]


def claims(place):
    """What says of an event whether the widget takes it."""
    if place == "number":
        return lambda event: makes_step(event) or begins_typing(event)
    if place == "colour_bar":
        return lambda event: bool(key_step_db(event))
    return partial(meaning_of, place)


def test_a_widget_takes_the_keys_that_are_listed(qapp):
    for place in KEYS:
        takes = claims(place)
        keys = [
            QKeySequence(held.value | key.value).toString()
            for held in HELD
            for key in (*SIGNS, *NAMED)
            if takes(QKeyEvent(QEvent.Type.KeyPress, key, held))
        ]
        listed = [key for gesture in KEYS[place].gestures.values() for key in gesture.keys]
        assert sorted(keys) == sorted(listed), place


def test_no_shortcut_is_given_twice():
    keys = [key for spec in ACTIONS for key in spec.keys]
    assert len(keys) == len(set(keys))


def test_the_number_pad_means_what_the_other_keys_mean(qapp):
    held = _Held.KeypadModifier
    assert meaning_of("plot", QKeyEvent(QEvent.Type.KeyPress, _Key.Key_Plus, held)) == "zoom_in"
    assert meaning_of("plot", QKeyEvent(QEvent.Type.KeyPress, _Key.Key_B, held)) == ""


def test_a_single_key_is_called_what_stands_on_it():
    for gesture in (gesture for place in KEYS.values() for gesture in place.gestures.values()):
        if len(gesture.keys) == 1:
            *held, key = gesture.keys[0].split("+")
            assert gesture.shown == "+".join((*held, ON_KEYS.get(key, key)))


@pytest.mark.parametrize("part", [Transport, ScrubBar])
def test_tooltips_name_the_shortcut_that_an_action_has(qtbot, monkeypatch, part):
    monkeypatch.setitem(SHORTCUTS, "play", ("Ctrl+P",))
    widget = part()
    qtbot.addWidget(widget)
    tips = [button.toolTip() for button in widget.findChildren(QAbstractButton)]
    assert any("(Ctrl+P)" in tip for tip in tips)
    assert not any("(Space)" in tip for tip in tips)


def test_the_manual_is_the_readme_with_its_pages(window):
    window.do("show_manual")
    browser = window.findChild(QTextBrowser, "page_text")
    assert "Install and start" in browser.toPlainText()
    browser.setSource(QUrl("docs/limbs.md"))
    assert "pre_trigger_delay_s" in browser.toPlainText()


def test_the_manual_of_a_wheel_is_a_site_in_the_browser(window, tmp_path, monkeypatch):
    site, opened = tmp_path / "index.html", []
    for answer in (True, False):
        monkeypatch.setattr(f"{pages.__name__}.manual_file", lambda: site)
        monkeypatch.setattr(
            pages.QtGui.QDesktopServices, "openUrl", lambda at, a=answer: opened.append(at) or a
        )
        window.do("show_manual")
        assert opened.pop().toLocalFile() == str(site)
        assert (str(site) in window.statusBar().currentMessage()) != answer
    assert window.findChild(QTextBrowser, "page_text") is None


def test_the_keys_page_lists_each_gesture_and_the_key_of_each_action(window):
    window.do("show_keys")
    text = window.findChild(QTextBrowser, "page_text").toPlainText()
    for place in (*MOUSE.values(), *KEYS.values()):
        assert place.heading in text
        for gesture in place.gestures.values():
            assert gesture.shown in text
            assert gesture.effect in text
    for name, action in window.actions_by_name.items():
        keys = ", ".join(key.toString() for key in action.shortcuts())
        assert not keys or f"\n{keys}" in text, name


def test_the_keys_page_begins_with_the_panel_in_use_and_is_searched(window, qtbot):
    for arrangement, panel, place in (
        ("presentation", "stage", "presenting"),
        ("design", "timeline", "timeline"),
    ):
        window.do(f"arrange_{arrangement}")
        window.activateWindow()
        qtbot.waitUntil(lambda: window.isActiveWindow() and window.workspaces.settled)
        window.docks[panel].enter()
        window.do("show_keys")
        browser = window.findChildren(QTextBrowser, "page_text")[-1]
        assert browser.toPlainText().strip().startswith(KEYS[place].heading)
        line = browser.window().findChild(QLineEdit, "keys_search")
        line.setText("motion pause")
        assert "pause or continue the motion" in browser.toPlainText()
        assert "Page Down" not in browser.toPlainText()
        line.setText("pause nothing")
        assert "pause" not in browser.toPlainText()
        browser.window().reject()


CONTROL = Qt.KeyboardModifier.ControlModifier
ACTION_KEYS = [key for spec in ACTIONS for key in spec.keys]
OF_NUMBERS = {"Ctrl+C", "Ctrl+V"}
OF_TEXTS = {"Ctrl+Z", "Ctrl+Shift+Z", "Ctrl+Y", "Ctrl+Backspace", "Ctrl+X", *OF_NUMBERS}


@pytest.fixture
def field(window, active):
    """The field of the frequency, with the keyboard."""
    field = window.panel("inspector").findChild(QLineEdit, "frequency_hz_field")
    field.setFocus()
    return field


def takes(field, key):
    """Whether the field wants the key for itself."""
    combination = QKeySequence(key)[0]
    event = QKeyEvent(
        QKeyEvent.Type.ShortcutOverride, combination.key(), combination.keyboardModifiers(), ""
    )
    event.ignore()
    QApplication.sendEvent(field, event)
    return event.isAccepted()


def test_every_shortcut_but_copy_and_paste_works_from_a_number_at_rest(field):
    assert {key for key in ACTION_KEYS if takes(field, key)} == OF_NUMBERS


def test_while_typing_only_the_keys_of_texts_stay_with_the_text(field):
    field.begin_editing("12")
    # Whether others take undo and redo is for the texts to say: see below.
    assert {key for key in ACTION_KEYS if takes(field, key)} <= OF_TEXTS
    assert not field.isReadOnly()


def test_undo_in_a_number_that_is_only_selected_takes_back_the_last_edit(window, field):
    window.document.edit("Louder", window.document.design.with_input(0, amplitude=2.0))
    field.begin_editing()
    QTest.keyClick(field, Qt.Key.Key_Z, CONTROL)
    assert window.document.design.inputs[0].amplitude == 1.0
    assert field.isReadOnly()


class GreedyLine(QLineEdit):
    """A line of text as on desktops where nearly every key with Ctrl moves in the text."""

    def event(self, event):
        if event.type() == QKeyEvent.Type.ShortcutOverride:
            event.accept()
            return True
        return super().event(event)


def test_shortcuts_work_on_desktops_where_lines_of_text_want_them(window, field):
    for read_only, key in product((True, False), ("Ctrl+E", "Ctrl+K", "Ctrl+D", "Ctrl+T")):
        line = GreedyLine(window, readOnly=read_only)
        line.show()
        assert takes(line, key)
        line.setFocus()
        assert not takes(line, key), (read_only, key)
        field.setFocus()
        assert takes(line, key)


def test_a_field_that_dies_with_the_keyboard_leaves_the_next_one_watched(window, field):
    dying, following = GreedyLine(window), GreedyLine(window)
    for line in (dying, following):
        line.show()
    dying.setFocus()
    shiboken6.delete(dying)
    following.setFocus()
    assert not takes(following, "Ctrl+E")
