from dataclasses import replace

import pytest
from PySide6.QtGui import QKeySequence, QShortcut

from skinsource_gui.shell.actions import ACTIONS, MENUS, ActionSpec


def test_conditions_follow_the_document(window):
    enabled = {name: action.isEnabled for name, action in window.actions_by_name.items()}
    assert enabled["select_no_outputs"]()
    assert enabled["mute_input"]()
    window.document.look(replace(window.document.view, outputs=(), selected_inputs=()))
    assert not enabled["select_no_outputs"]()
    assert not enabled["mute_input"]()
    assert enabled["clear_inputs"]()
    window.do("clear_inputs")
    assert not enabled["clear_inputs"]()


def test_an_action_is_a_command_or_an_edit_not_both_and_not_neither():
    fields = {"name": "a", "text": "A", "hint": "A"}
    for more in ({}, {"command": "files.new", "edit": lambda design, view: None}):
        with pytest.raises(ValueError, match="either a command or an edit"):
            ActionSpec(**fields, **more)


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
