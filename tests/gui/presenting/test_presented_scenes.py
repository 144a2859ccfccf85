"""Scenes that follow one another, and the notes beside them."""

from dataclasses import replace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDialogButtonBox, QMessageBox

from skinsource.design.panel_settings import with_settings
from skinsource.studies.scenes.catalog import all_scenes, open_scene
from skinsource_gui.panels.frequency_and_amplitude.settings import ControlSettings
from skinsource_gui.plots.small_map import level_style
from skinsource_gui.shell.presenting import NotesWindow


@pytest.fixture
def open_window(make_window):
    """Each test has a window of its own."""
    return make_window


def title(window):
    return window.document.design.title


def test_scenes_are_the_designs_of_the_folder_in_their_order(studio):
    titles = []
    for name in ("next_scene", "next_scene", "previous_scene", "previous_scene", "previous_scene"):
        studio.do(name)
        titles.append(title(studio))
    assert titles == ["3 both", "3 both", "2 tone", "1 tap", "1 tap"]
    # A scene is no file any more: saving asks for a name.
    assert studio.document.path is None


def test_without_a_file_the_scenes_are_those_of_the_paper(open_window, design):
    window = open_window(design)
    window.do("next_scene")
    assert all_scenes()[0].name in title(window)
    window.do("next_scene")
    assert all_scenes()[1].name in title(window)
    # The panels that show it are in sight.
    assert all(not window.docks[name].isHidden() for name in all_scenes()[1].panels)


@pytest.mark.parametrize("opened_by", ["gallery", "key"])
def test_a_scene_that_is_open_is_presented_with_the_panels_that_show_it(
    open_window, opened_by, design
):
    window = open_window(design)
    names = [scene.name for scene in all_scenes()]
    if opened_by == "gallery":
        page = window.scenes.show()
        page.list.setCurrentRow(names.index("2H"))
        page.buttons.button(QDialogButtonBox.StandardButton.Open).click()
    else:
        for _ in range(names.index("2H") + 1):
            window.do("next_scene")
    assert "2H" in title(window)
    window.do("present")
    assert "windowed" in in_front(window)
    window.do("present")
    window.do("new_design")
    window.do("present")
    assert "windowed" not in in_front(window)


def in_front(window):
    """Panels that can be seen."""
    QApplication.processEvents()
    return {panel.name for panel in window.panels if panel.isVisible()}


@pytest.fixture
def asked(monkeypatch):
    """Questions about what would be lost; they are answered with Cancel."""
    questions = []

    def question(*given):
        questions.append(given)
        return QMessageBox.StandardButton.Cancel

    monkeypatch.setattr(QMessageBox, "exec", lambda box: question(box.text()))
    for kind in ("question", "warning"):
        monkeypatch.setattr(QMessageBox, kind, question)
    return questions


def louder(window, amplitude):
    window.document.edit("Louder", window.document.design.with_input(0, amplitude=amplitude))
    return window.document.design


def test_what_is_turned_while_a_scene_is_presented_is_not_asked_about(open_window, asked, design):
    window = open_window(design)
    window.do("next_scene")
    window.do("present")
    first = louder(window, 2.0)
    window.do("next_scene")
    assert window.document.design != first
    louder(window, 3.0)
    window.do("next_scene")
    assert all_scenes()[2].name in title(window)
    assert not asked


def test_of_a_scene_that_was_turned_it_is_said_that_it_is_left_as_it_was(open_window, design):
    window = open_window(design)
    window.do("next_scene")
    window.do("present")
    name, first = all_scenes()[0].name, window.document.design
    louder(window, 2.0)
    window.do("next_scene")
    assert window.notice.text.endswith(f"; changes to {name} are not kept")
    window.do("previous_scene")
    assert window.notice.text == f"Scene 1 of {len(all_scenes())}: {all_scenes()[0].heading}"
    assert window.document.design == first
    # What was turned back is nothing that could be kept.
    louder(window, 2.0)
    window.do("undo")
    window.do("next_scene")
    assert "kept" not in window.notice.text
    # By hand, too.
    before = window.document.design.inputs[0].amplitude
    louder(window, 2.0 * before)
    louder(window, before)
    window.do("next_scene")
    assert "kept" not in window.notice.text


def test_a_file_that_is_presented_as_it_was_saved_is_left_unasked(studio, folder, asked):
    studio.do("present")
    saved = (folder / "2 tone.skinsource").read_bytes()
    louder(studio, 2.0)
    studio.do("next_scene")
    assert studio.notice.text == "Scene 3 of 3: 3 both; changes to 2 tone are not kept"
    studio.do("previous_scene")
    assert studio.document.design.inputs[0].amplitude == 1.0
    assert (folder / "2 tone.skinsource").read_bytes() == saved
    assert not asked


def test_work_on_a_file_from_before_it_was_presented_is_asked_about(studio, asked):
    edited = louder(studio, 2.0)
    studio.do("present")
    studio.do("next_scene")
    assert len(asked) == 1
    assert studio.document.design == edited
    studio.document.mark_saved(studio.document.path)


@pytest.mark.parametrize("presented", ["never", "afterwards", "before"])
def test_work_that_was_done_in_a_scene_is_not_lost_unasked(open_window, asked, presented, design):
    window = open_window(design)
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
    window.document.mark_saved(window.document.path)


def test_the_next_scene_is_that_after_the_one_that_was_opened_last(open_window, design):
    window = open_window(design)
    names = [scene.name for scene in all_scenes()]
    window.do("next_scene")
    window.scenes.open(names[5])
    window.do("next_scene")
    assert names[6] in title(window)
    window.files.new()
    window.do("next_scene")
    assert names[0] in title(window)


def test_notes_follow_the_scenes(studio):
    studio.do("show_notes")
    (notes,) = [
        widget for widget in QApplication.topLevelWidgets() if isinstance(widget, NotesWindow)
    ]
    assert notes.notes.toPlainText() == "Say 2 tone"
    studio.do("next_scene")
    assert notes.heading.text() == "3 both"
    assert notes.notes.toPlainText() == "Say 3 both"
    assert notes.next.text() == "This is the last one."
    studio.do("previous_scene")
    assert notes.next.text() == "Next: 3 both"
    notes.close()


@pytest.mark.parametrize("first", ["show_notes", "present"])
@pytest.mark.parametrize("leave", [Qt.Key.Key_F9, Qt.Key.Key_Escape])
def test_keys_of_presenting_work_on_the_notes_too_whichever_came_first(studio, qtbot, first, leave):
    for name in (first, *({"show_notes", "present"} - {first})):
        studio.do(name)
    (notes,) = [
        widget for widget in QApplication.topLevelWidgets() if isinstance(widget, NotesWindow)
    ]
    notes.activateWindow()
    notes.notes.setFocus()
    qtbot.waitUntil(notes.isActiveWindow)
    QTest.keyClick(notes.notes, Qt.Key.Key_B)
    assert studio.presenter.covered
    QTest.keyClick(notes.notes, leave)
    assert not studio.presenter.presenting
    assert not notes.isVisible()


def colours(window):
    return level_style(window.document.view).colours


@pytest.mark.parametrize("presented", [True, False])
def test_levels_stay_in_the_colours_that_were_chosen_from_scene_to_scene(
    open_window, design, presented
):
    window = open_window(design)
    if presented:
        window.do("present")
    window.do("next_scene")
    assert colours(window) == "viridis"
    window.do("use_magma_colours")
    for step in ("next_scene", "next_scene", "previous_scene", "previous_scene"):
        window.do(step)
        assert colours(window) == "magma", step
        assert window.document.undo_stack.count() == 0
        assert not window.document.modified
    # What else a scene looks at is its own.
    plain = open_scene(all_scenes()[0].name, available=window.limbs.names).view
    assert replace(window.document.view, panels=()) == replace(plain, panels=())
    window.do("use_viridis_colours")
    window.do("next_scene")
    assert colours(window) == "viridis"


def test_a_scene_says_what_is_turned(open_window, design):
    window = open_window(design)
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


def test_turning_the_onset_moves_the_clip(open_window, design):
    window = open_window(design)
    panel = window.panel("frequency_and_amplitude")
    panel._change("onset_s", 0.1, None)
    assert window.document.design.inputs[0].clips[0].onset_s == 0.1


def test_the_only_input_is_turned_without_being_selected(open_window, design):
    window = open_window(replace(design, inputs=design.inputs[:1]))
    window.do("arrange_presentation")
    panel = window.panel("frequency_and_amplitude")
    unselected = replace(window.document.view, selected_inputs=())
    window.document.look(unselected)
    assert "place 7" in panel._heading.text()
    assert not panel._amplitude_part.isHidden()
    panel._change("amplitude", 0.25, None)
    assert window.document.design.inputs[0].amplitude == 0.25
    panel._change("frequency_hz", 60.0, None)
    assert window.document.design.inputs[0].clips[0].waveform.frequency_hz == 60.0


def test_after_a_show_the_panels_of_the_scene_that_is_open_are_in_front(open_window, qtbot, design):
    window = open_window(design)
    # So low that other panels stand behind each other than on the whole screen.
    window.resize(1366, 600)
    names = [scene.name for scene in all_scenes()]
    window.scenes.open("1G")
    assert "side_by_side" in in_front(window)
    window.do("present")
    for _ in range(names.index("2H") - names.index("1G")):
        window.do("next_scene")
    window.do("present")
    qtbot.waitUntil(lambda: "windowed" in in_front(window))
    qtbot.waitUntil(lambda: window.height() == 600)
    settle()
    assert "windowed" in in_front(window)
    assert "skin" in in_front(window)


def settle():
    """Docks have their room."""
    for _ in range(20):
        QApplication.processEvents()
