from dataclasses import replace

import pytest
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QApplication

from skinsource.design.view import View
from skinsource_gui.shell.actions import ACTIONS, MENUS
from skinsource_gui.shell.actions.spec import ActionSpec
from skinsource_gui.shell.arrangement_spec import ARRANGEMENTS, Place
from skinsource_gui.shell.dock_layout import shared
from skinsource_gui.shell.panels import PANELS


@pytest.fixture
def open_window(make_window):
    """Each test has a window of its own."""
    return make_window


def test_conditions_follow_the_document(window):
    enabled = {name: action.isEnabled for name, action in window.actions_by_name.items()}
    assert enabled["export_traces"]()
    assert enabled["mute_input"]()
    window.document.look(replace(window.document.view, outputs=(), selected_inputs=()))
    assert not enabled["export_traces"]()
    assert not enabled["select_no_outputs"]()
    assert not enabled["mute_input"]()
    assert enabled["clear_inputs"]()
    window.do("clear_inputs")
    assert not enabled["clear_inputs"]()


def test_an_action_is_a_command_or_an_edit_not_both_and_not_neither():
    fields = {"name": "a", "menu": "File", "text": "A", "hint": "A"}
    for more in ({}, {"command": "files.new", "edit": lambda design, view: None}):
        with pytest.raises(ValueError, match="either a command or an edit"):
            ActionSpec(**fields, **more)


def test_each_arrangement_places_the_panels_of_the_table(window, settle):
    for arrangement in ARRANGEMENTS:
        window.do(f"arrange_{arrangement.name}")
        settle()
        for spec in PANELS:
            dock = window.docks[spec.panel.name]
            assert dock.isVisible() == isinstance(spec.places[arrangement.name], Place)
    assert isinstance(window.document.view, View)


@pytest.mark.parametrize(
    ("whole", "shares", "least", "expected"),
    [
        (100, [50, 50], [10, 10], [50, 50]),
        (100, [10, 90], [30, 10], [30, 70]),
        (100, [10, 30, 60], [30, 30, 10], [30, 30, 40]),
        (100, [50, 50], [100, 300], [25, 75]),
    ],
)
def test_room_is_shared_but_nobody_gets_less_than_is_needed(whole, shares, least, expected):
    assert shared(whole, shares, least) == expected


@pytest.mark.parametrize("name", ["drawing", "analysis", "design"])
def test_another_arrangement_leaves_the_keyboard_with_the_panels(window, qtbot, settle, name):
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    window.panel("timeline").setFocus()
    window.do(f"arrange_{name}")
    settle()
    focused = QApplication.focusWidget()
    assert any(panel.isAncestorOf(focused) for panel in window.panels if panel.isVisible())
    if name != "analysis":
        assert window.panel("timeline").isAncestorOf(focused)


def test_each_menu_opens_with_a_letter_of_its_own_and_the_first_with_f10(window, qtbot):
    bar = window.menuBar()
    keys = [QKeySequence.mnemonic(action.text()) for action in bar.actions()]
    assert QKeySequence() not in keys
    others = [QKeySequence(key) for spec in ACTIONS for key in spec.keys]
    others += [QKeySequence(key) for arrangement in ARRANGEMENTS for key in arrangement.keys]
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
