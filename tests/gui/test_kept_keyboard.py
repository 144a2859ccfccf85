"""Where the keyboard goes when the panel that has it goes: never to a field that nobody chose."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from skinsource.design.design import Design, track
from skinsource.design.design_file import save_design
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.panels.timeline.head_row import InputRow


@pytest.fixture
def active(window, qtbot):
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    return window


def shown(window, name):
    return not window.docks[name].isHidden()


def into(window, name):
    window.panel(name).setFocus()
    assert window.panel(name).isAncestorOf(QApplication.focusWidget())


def wait_until_in(qtbot, window, name):
    """Wait until a panel has the keyboard."""
    qtbot.waitUntil(
        lambda: (
            (focused := QApplication.focusWidget()) is not None
            and window.panel(name).isAncestorOf(focused)
        )
    )


def test_a_panel_that_goes_leaves_the_keyboard_to_the_first_in_sight(active, qtbot, tmp_path):
    limb = active.document.design.limb
    # With an arrangement that was left otherwise than at first.
    active.docks["skin"].hide()
    active.do("arrange_drawing")
    into(active, "clip_editor")
    active.do("arrange_design")
    assert not shown(active, "skin")
    wait_until_in(qtbot, active, "hand")
    # With its own button, while another one is first in sight.
    active.docks["hand"].hide()
    wait_until_in(qtbot, active, "timeline")
    # With a file that was saved without it.
    path = tmp_path / "without.skinsource"
    active.docks["inspector"].hide()
    content = active.layout_of_docks.content()
    save_design(path, active.document.design, active.document.view, layout=content)
    active.docks["inspector"].show()
    into(active, "inspector")
    active.document.mark_saved(path)
    active.files.open(path)
    assert not shown(active, "inspector")
    wait_until_in(qtbot, active, "timeline")
    assert active.document.design.limb == limb


def test_all_is_the_text_of_a_number_and_not_all_tracks(open_window):
    tone = Tone(frequency_hz=100.0, duration_s=0.2)
    window = open_window(Design(limb="synthetic-1", inputs=(track(7, tone), track(13, tone))))
    field = window.panel("timeline").findChild(InputRow).amplitude
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
