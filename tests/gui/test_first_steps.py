"""Empty panels say what can be done, and it can be done there."""

from dataclasses import replace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel

from skinsource_gui.plots.plot import Plot
from skinsource_gui.shell.panels import PANELS
from skinsource_gui.shell.workspaces import WORKSPACES

ANYWHERE = ("Press ", "View > Panels")
#: Words of a sentence, and the panel that they lead to.
LEADS = {"on the hand": "hand", "in the timeline": "timeline", "on the skin map": "skin"}


def requests_of(panel):
    """All sentences of a panel that ask for something."""
    labels = (label.text() for label in panel.findChildren(QLabel) if label.isVisibleTo(panel))
    plots = (plot.message for plot in panel.findChildren(Plot))
    return [w for w in (*labels, *plots) if w.startswith(("Click ", "Press ", "Select ", "Show "))]


@pytest.mark.parametrize(
    ("state", "workspaces"),
    [("empty", WORKSPACES), ("nothing selected", WORKSPACES[-1:])],
    ids=["empty", "nothing selected"],
)
def test_no_words_lead_to_a_panel_that_is_not_in_sight(window, settle, state, workspaces):
    if state == "empty":
        window.do("clear_inputs")
    window.document.look(replace(window.document.view, outputs=(), selected_inputs=()))
    for arrangement in workspaces:
        window.do(f"arrange_{arrangement.name}")
        settle()
        n_texts = 0
        for spec in PANELS:
            window.docks[spec.panel.name].bring_forward()
            settle()
            panel = window.panel(spec.panel.name)
            for text in requests_of(panel):
                n_texts += 1
                ways = [name for part, name in LEADS.items() if part in text]
                assert ways or any(part in text for part in ANYWHERE), text
                for name in ways:
                    assert window.panel(name).isVisible(), (arrangement.name, panel.name, text)
        assert n_texts >= 4, arrangement.name


def test_what_is_said_without_a_hand_adds_an_input(window, settle, qtbot):
    window.do("clear_inputs")
    window.docks["hand"].hide()
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    settle()
    empty = window.panel("timeline").findChild(QLabel, "inputs_empty")
    assert empty.text() == "Press Ctrl+Shift+N to add a track"
    held = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier
    QTest.keyClick(window, Qt.Key.Key_N, held)
    settle()
    assert [track.location for track in window.document.design.inputs] == [7]
    assert not empty.isVisible()
    window.do("clear_inputs")
    window.docks["hand"].show()
    settle()
    assert empty.text() == "Click a place on the hand to add a track"
