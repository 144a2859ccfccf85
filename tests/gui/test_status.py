from dataclasses import replace

from PySide6.QtWidgets import QLabel

from skinsource.design.design import Design
from skinsource_gui.shell.limb_note import LimbNote


def test_the_way_to_measured_limbs_is_told_only_where_they_are_missing(qtbot):
    for measured in (True, False):
        note = LimbNote()
        note.show_available(("measured-1", "synthetic-1") if measured else ("synthetic-1",))
        qtbot.addWidget(note)
        note.show_limb("synthetic-2")
        note.resize(note.sizeHint())
        assert "SYNTHETIC LIMB" in note.text()
        assert ("not installed" in note.text()) != measured
        note.show_limb("measured-2")
        assert note.isHidden()


def test_the_link_of_the_note_opens_the_page(window):
    window.findChild(LimbNote).linkActivated.emit("#get")
    text = window.findChild(QLabel, "page_text")
    assert "measured" in text.text()
    text.window().close()


def test_the_menu_and_the_switch_shift_a_zoomed_time_axis_alike(window):
    window.document.look(replace(window.document.view, time_range_s=(0.1, 0.2)))
    window.actions_by_name["remove_delay"].trigger()
    assert window.document.view.delay_removed
    low, high = window.document.view.time_range_s
    assert (round(low, 6), round(high, 6)) == (0.048, 0.148)


def test_mute_and_solo_are_in_the_menu_too(window):
    window.actions_by_name["mute_input"].trigger()
    assert window.document.design.inputs[0].muted
    assert window.actions_by_name["mute_input"].isChecked()
    window.do("undo")
    assert not window.actions_by_name["mute_input"].isChecked()
    window.document.edit("a", Design(limb="synthetic-1"))
    assert not window.actions_by_name["solo_input"].isEnabled()


def test_f6_goes_around_the_panels(window, qtbot):
    visited = []
    shown = [panel for panel in window.panels if panel.isVisible()]
    for _ in shown:
        window.actions_by_name["next_panel"].trigger()
        focused = window.focusWidget()
        visited += [panel.name for panel in window.panels if panel.isAncestorOf(focused)]
    assert sorted(visited) == sorted(panel.name for panel in shown)
    window.actions_by_name["previous_panel"].trigger()
    before = next(panel for panel in window.panels if panel.isAncestorOf(window.focusWidget()))
    assert before.name == visited[-2]


def test_the_theme_in_use_is_ticked(window):
    window.actions_by_name["use_dark_theme"].trigger()
    ticked = [
        name
        for name in ("use_light_theme", "use_dark_theme", "use_system_theme")
        if window.actions_by_name[name].isChecked()
    ]
    assert ticked == ["use_dark_theme"]


def test_choices_of_the_setup_are_found_by_the_palette(window):
    choices = {action.text(): action for action in window.setup_bar.choices(window)}
    choices["Limb: Synthetic 3 (185 mm)"].trigger()
    assert window.document.design.limb == "synthetic-3"
    assert not choices["Limb: Measured 1 (175 mm)"].isEnabled()
