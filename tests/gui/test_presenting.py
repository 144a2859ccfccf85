"""Presenting: bars away, scenes by one key, a map that can be covered, notes beside."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMessageBox

import skinsource as ss
from skinsource.design_file import save_design
from skinsource.panel_settings import with_settings
from skinsource.scenes import all_scenes
from skinsource_gui.panels.frequency_and_amplitude.settings import ControlSettings
from skinsource_gui.panels.skin.inputs.marks import mark_at
from skinsource_gui.panels.skin.map_content import COVERED
from skinsource_gui.shell.presenting.notes_window import NotesWindow
from skinsource_gui.theme import CONTRAST

TONE = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.2)
DESIGN = ss.Design(
    limb="synthetic-1",
    inputs=(ss.track(7, TONE), ss.track(13, TONE, colour=1, onset_s=0.05)),
)


@pytest.fixture
def folder(tmp_path):
    """Three designs, each with its name as its title."""
    for name in ("1 tap", "2 tone", "3 both"):
        design = replace(DESIGN, title=name, notes=f"Say {name}")
        save_design(tmp_path / f"{name}.skinsource", design, ss.View())
    return tmp_path


@pytest.fixture
def studio(make_window, folder):
    window = make_window(DESIGN)
    window.files.open(folder / "2 tone.skinsource")
    return window


def title(window):
    return window.document.design.title


def bars(window):
    return window.menuBar(), window.statusBar(), window.setup_bar


def test_presenting_takes_the_bars_away_and_gives_them_back(make_window):
    window = make_window(DESIGN)
    shown = {name for name, dock in window.docks.items() if not dock.isHidden()}
    window.activateWindow()
    window.panel("traces").setFocus()
    focused = window.focusWidget()
    window.do("present")
    assert not any(bar.isVisible() for bar in bars(window))
    assert window.isFullScreen()
    assert window.panel("skin").isVisible()
    assert window.panel("hand").isVisible()
    assert not window.panel("inspector").isVisible()
    window.do("present")
    assert all(bar.isVisible() for bar in bars(window))
    assert not window.isFullScreen()
    assert {name for name, dock in window.docks.items() if not dock.isHidden()} == shown
    assert window.focusWidget() is focused


def test_keys_work_while_the_menus_are_away(studio, qtbot):
    studio.do("present")
    studio.activateWindow()
    skin = studio.panel("skin")
    skin.setFocus()
    QTest.keyClick(skin.map, Qt.Key.Key_PageDown)
    qtbot.waitUntil(lambda: title(studio) == "3 both")
    QTest.keyClick(studio.focusWidget() or studio, Qt.Key.Key_PageUp)
    qtbot.waitUntil(lambda: title(studio) == "2 tone")
    QTest.keyClick(studio.focusWidget() or studio, Qt.Key.Key_B)
    qtbot.waitUntil(lambda: skin.map.content.message == COVERED)
    QTest.keyClick(studio.focusWidget() or studio, Qt.Key.Key_F9)
    qtbot.waitUntil(lambda: studio.menuBar().isVisible())
    # Out of presenting nothing stays covered, and the keys mean what they did.
    assert skin.map.content.message != COVERED
    QTest.keyClick(skin.map, Qt.Key.Key_PageDown)
    assert title(studio) == "2 tone"


def test_clickers_step_scenes_whatever_has_the_keyboard(studio, qtbot):
    studio.activateWindow()
    qtbot.waitUntil(studio.isActiveWindow)
    panel = studio.panel("traces")
    studio.do("present")
    studio.docks["traces"].bring_forward()
    at_s = studio.document.view.playhead_s
    panel.setFocus()
    for key, wanted in (("PageUp", "1 tap"), ("PageDown", "2 tone"), ("PageDown", "3 both")):
        panel.setFocus()
        assert panel.isAncestorOf(studio.focusWidget())
        QTest.keyClick(studio.focusWidget(), getattr(Qt.Key, f"Key_{key}"))
        assert title(studio) == wanted
    assert studio.document.view.playhead_s == at_s
    studio.do("present")
    studio.docks["traces"].bring_forward()
    panel.setFocus()
    # Back among the bars the keys are those of the plot.
    QTest.keyClick(studio.focusWidget(), Qt.Key.Key_PageUp)
    assert title(studio) == "3 both"


def test_the_hand_names_the_place_of_the_scene_that_is_shown(studio, folder, qtbot):
    other = replace(DESIGN, inputs=(ss.track(8, TONE),), title="3 both")
    save_design(folder / "3 both.skinsource", other, ss.View())
    studio.activateWindow()
    studio.do("present")
    hand = studio.panel("hand").diagram
    hand.setFocus(Qt.FocusReason.OtherFocusReason)
    qtbot.waitUntil(lambda: hand.state.cursor == 7)
    QTest.keyClick(hand, Qt.Key.Key_PageDown)
    assert title(studio) == "3 both"
    qtbot.waitUntil(lambda: hand.state.cursor == 8)
    assert hand.cursor_site == 8
    # Nor where a head of a track was pointed at when its panel went.
    studio.panel("hand").show_pointed_input(1)
    assert hand.state.target == 8
    QTest.keyClick(hand, Qt.Key.Key_PageUp)
    assert title(studio) == "2 tone"
    qtbot.waitUntil(lambda: hand.state.target == 7)


def test_scenes_are_the_designs_of_the_folder_in_their_order(studio):
    seen = []
    for name in ("next_scene", "next_scene", "previous_scene", "previous_scene", "previous_scene"):
        studio.do(name)
        seen.append(title(studio))
    assert seen == ["3 both", "3 both", "2 tone", "1 tap", "1 tap"]
    # A scene is no file any more: saving asks for a name.
    assert studio.document.path is None


def test_without_a_file_the_scenes_are_those_of_the_paper(make_window):
    window = make_window(DESIGN)
    window.do("next_scene")
    assert all_scenes()[0].name in title(window)
    window.do("next_scene")
    assert all_scenes()[1].name in title(window)
    # The panels that show it are in sight.
    assert all(not window.docks[name].isHidden() for name in all_scenes()[1].panels)


@pytest.fixture
def asked(monkeypatch):
    """Questions about what would be lost; they are answered with Cancel."""
    found = []

    def question(*given):
        found.append(given)
        return QMessageBox.StandardButton.Cancel

    monkeypatch.setattr(QMessageBox, "exec", lambda box: question(box.text()))
    for kind in ("question", "warning"):
        monkeypatch.setattr(QMessageBox, kind, question)
    return found


def louder(window, amplitude):
    window.document.edit("Louder", window.document.design.with_input(0, amplitude=amplitude))
    return window.document.design


def test_what_is_turned_while_a_scene_is_presented_is_not_asked_about(make_window, asked):
    window = make_window(DESIGN)
    window.do("next_scene")
    window.do("present")
    first = louder(window, 2.0)
    window.do("next_scene")
    assert window.document.design != first
    louder(window, 3.0)
    window.do("next_scene")
    assert all_scenes()[2].name in title(window)
    assert not asked


@pytest.mark.parametrize("presented", ["never", "afterwards", "before"])
def test_work_that_was_done_in_a_scene_is_not_lost_unasked(make_window, asked, presented):
    window = make_window(DESIGN)
    window.do("next_scene")
    if presented == "before":
        window.do("present")
        window.do("present")
    edited = louder(window, 2.0)
    if presented == "afterwards":
        window.do("present")
    window.do("next_scene")
    assert len(asked) == 1
    assert window.document.design == edited
    window.document.undo_stack.setClean()


def test_the_next_scene_is_that_after_the_one_that_was_opened_last(make_window):
    window = make_window(DESIGN)
    names = [one.name for one in all_scenes()]
    window.do("next_scene")
    window.scenes.open(names[5])
    window.do("next_scene")
    assert names[6] in title(window)
    window.files.new()
    window.do("next_scene")
    assert names[0] in title(window)


def test_a_covered_map_shows_nothing_that_was_computed(window, settle):
    skin = window.panel("skin")
    window.do("cover_map")
    content = skin.map.content
    assert content.coloured_values is None
    assert content.shown_field is None
    assert skin.map.readout() == ""
    window.document.edit("Louder", window.document.design.with_input(0, amplitude=2.0))
    settle()
    assert skin.map.content.message == COVERED
    window.do("cover_map")
    assert skin.map.content.coloured_values is not None


def test_notes_follow_the_scenes(studio):
    studio.do("show_notes")
    (notes,) = [one for one in QApplication.topLevelWidgets() if isinstance(one, NotesWindow)]
    assert notes.notes.toPlainText() == "Say 2 tone"
    studio.do("next_scene")
    assert notes.heading.text() == "3 both"
    assert notes.notes.toPlainText() == "Say 3 both"
    assert notes.next.text() == "This is the last one."
    studio.do("previous_scene")
    assert notes.next.text() == "Next: 3 both"
    notes.close()


def test_while_the_bars_are_away_words_lie_over_the_window(studio):
    studio.do("present")
    assert "F9: leave" in studio.notice.text
    studio.do("next_scene")
    assert studio.notice.text == "Scene 3 of 3: 3 both"
    studio.do("next_scene")
    assert studio.notice.text == "This is the last scene"
    studio.do("present")
    studio.do("previous_scene")
    assert studio.statusBar().currentMessage() == "Scene 2 of 3: 2 tone"
    assert not studio.notice.text


def test_inputs_are_marked_on_the_map_where_they_are_behind(make_window):
    window = make_window(DESIGN)
    skin = window.panel("skin")
    content, layout = skin.map.content, skin.map.map_layout()
    assert [mark.location for mark in content.inputs] == [7, 13]
    place = layout.frame.to_screen(content.limb_map.input_positions[[12]])[0]
    found = mark_at(content.inputs, content.limb_map, layout, QPointF(*place))
    assert found.location == 13
    assert mark_at(content.inputs, content.limb_map, layout, QPointF(1.0, 1.0)) is None


def test_hand_and_map_point_at_the_same_input(make_window):
    window = make_window(DESIGN)
    hand, skin = window.panel("hand"), window.panel("skin")
    first, second = window.document.design.ids
    hand.diagram.stage.change(hovered=13)
    assert skin.map.content.pointed_at == second
    hand.diagram.stage.change(hovered=20)
    assert skin.map.content.pointed_at is None
    content, layout = skin.map.content, skin.map.map_layout()
    [x, y] = layout.frame.to_screen(content.limb_map.input_positions[[6]])[0]
    QTest.mouseMove(skin.map, QPointF(float(x), float(y)).toPoint())
    assert hand.diagram.state.target == 7
    skin.map.input_chosen.emit(second)
    assert window.document.view.selected_inputs == (second,)
    assert first in window.document.design.ids


def test_a_scene_says_what_is_turned(make_window):
    window = make_window(DESIGN)
    window.do("arrange_presentation")
    view, panel = window.document.view, window.panel("frequency_and_amplitude")
    for control, shown in {
        "onset": {"onset_s"},
        "all": {"frequency_hz", "amplitude"},
        "frequency": {"frequency_hz"},
        "amplitude": {"amplitude"},
    }.items():
        window.document.look(
            with_settings(view, "frequency_and_amplitude", ControlSettings(control=control))
        )
        cells = {"amplitude": panel._amplitude, "onset_s": panel._onset}
        if panel._frequency is not None:
            cells["frequency_hz"] = panel._frequency
        assert {name for name, cell in cells.items() if cell.isVisible()} == shown, control


def test_turning_the_onset_moves_the_clip(make_window):
    window = make_window(DESIGN)
    panel = window.panel("frequency_and_amplitude")
    panel._change("onset_s", 0.1, None)
    assert window.document.design.inputs[0].clips[0].onset_s == 0.1


def test_the_theme_of_high_contrast_is_one_of_three(window):
    window.do("use_contrast_theme")
    assert window.theme == CONTRAST
    window.do("use_light_theme")
