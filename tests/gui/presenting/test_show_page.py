"""A show is made in the window: designs, files and scenes in an order, with words and a knob."""

from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QFileDialog, QMessageBox, QPushButton, QWidget

import skinsource as ss
from skinsource.design.design_file import ShowEntry, open_design
from skinsource.design.panel_settings import StageSettings, stage_settings, with_settings
from skinsource_gui.panels.compare.stage import knob_options
from tests.gui.compare.compare_bench import choose

LEFT = Qt.MouseButton.LeftButton


def titles(page):
    return [page.list.item(row).text() for row in range(page.list.count())]


@pytest.fixture
def page(studio):
    return studio.presenter.make_show()


@pytest.fixture
def path(tmp_path, monkeypatch):
    path = tmp_path / "lecture.skinshow"
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(path), ""))
    return path


@pytest.fixture
def made(page, folder, monkeypatch):
    """A page with the open design, two files and a scene."""
    names = [str(folder / f"{name}.skinsource") for name in ("1 tap", "3 both")]
    monkeypatch.setattr(QFileDialog, "getOpenFileNames", lambda *_: (names, ""))
    page.add_open_design()
    page.add_files()
    page.add_scene("2F")
    return page


def test_designs_files_and_scenes_are_put_into_an_order_and_saved(studio, made, path):
    assert titles(made) == ["2 tone", "1 tap", "3 both", "Two inputs interfere"]
    made.shift(-1)
    made.list.setCurrentRow(0)
    made.remove()
    assert titles(made) == ["1 tap", "Two inputs interfere", "3 both"]
    made.list.setCurrentRow(2)
    made.heading.textEdited.emit("Both")
    made.sentence.textEdited.emit("Two inputs at once.")
    made.notes.setPlainText("Ask first.")
    made.knob.choose("Amplitude, place\N{NO-BREAK SPACE}13")
    assert made.save()
    read = ss.open_show(path)
    assert [entry.title for entry in read] == titles(made)
    last = read[-1]
    said = last.sentence, last.notes, last.knob
    assert said == ("Two inputs at once.", "Ask first.", "amplitude")
    # What was saved is not asked about.
    made.reject()
    assert not made.isVisible()


def knobs(page):
    return [page.knob.itemText(k) for k in range(page.knob.count())]


WORDS = "Automatic", "Frequency", "Amplitude", "Onset"


def test_the_knob_of_a_show_offers_the_numbers_of_each_input(page):
    two = [f", place\N{NO-BREAK SPACE}{k}" for k in (8, 13)]
    for scene, inputs in (("2A", [""]), ("2F", two)):
        page.add_scene(scene)
        assert knobs(page) == [f"{word}{of}" for of in inputs for word in WORDS]


def test_on_the_stage_the_knob_turns_the_input_that_was_chosen(studio, page, path):
    tone = ss.waveforms.Tone(frequency_hz=100.0)
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(8, tone), ss.track(7, tone)))
    page._add([ShowEntry.of(design, ss.View(selected_inputs=()))])
    page.knob.choose("Frequency, place\N{NO-BREAK SPACE}7")
    page.list.setCurrentRow(-1)
    page.list.setCurrentRow(0)
    assert page.knob.shown_text == "Frequency, place\N{NO-BREAK SPACE}7"
    assert page.save()
    page.done(0)
    studio.files.open(path)
    dial = studio.panel("stage").knob
    assert dial.label.text() == "Tone frequency, place\N{NO-BREAK SPACE}7"
    dial.edited.emit(50.0, None)
    turned = [track.clips[0].waveform.frequency_hz for track in studio.document.design.inputs]
    assert turned == [100.0, 50.0]


def test_a_knob_that_turns_several_inputs_can_be_chosen_again(page):
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(8), ss.track(7)))
    view = ss.View(selected_inputs=(1, 2), selected_clips=(2,))
    entry = replace(ShowEntry.of(design, view), knob="onset")
    page._add([entry])
    assert page.knob.shown_text == "Onset, 2 inputs"
    page.knob.choose("Amplitude, place\N{NO-BREAK SPACE}8")
    assert page.entries[0].view.selected_inputs == (1,)
    page.knob.choose("Onset, 2 inputs")
    assert page.entries == (entry,)


def test_the_knob_tells_inputs_at_one_place_apart_and_lists_some_dozens_of_numbers():
    design = ss.Design(limb="synthetic-1", inputs=tuple(ss.track(7) for _ in range(40)))
    options = knob_options(design, ss.View(selected_inputs=(40,)))
    assert len(options) < 60
    for k in (1, 12, 40):
        title = f"Amplitude, place\N{NO-BREAK SPACE}7, {k} of 40"
        assert options[title] == ("amplitude", ss.View(selected_inputs=(k,)))


def test_a_knob_that_does_not_list_all_inputs_says_so(page):
    for n, said in ((12, False), (13, True)):
        inputs = tuple(ss.track(7) for _ in range(n))
        page._add([ShowEntry.of(ss.Design(limb="synthetic-1", inputs=inputs), ss.View())])
        assert ("first 12 of 13" in page.knob.toolTip()) is said


def test_inputs_that_a_design_does_not_have_are_not_turned(page):
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(7, ss.waveforms.Tone()),))
    page._add([replace(ShowEntry.of(design, ss.View(selected_inputs=(1, 2))), knob="onset")])
    assert knobs(page) == list(WORDS)
    assert page.knob.shown_text == "Onset"


@pytest.mark.parametrize(
    ("waveform", "turned"),
    [(ss.waveforms.Tap(), ("Automatic", "Amplitude", "Onset")), (ss.waveforms.Tone(), WORDS)],
)
def test_the_knob_of_a_show_turns_a_frequency_only_of_what_has_one(waveform, turned):
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(7, waveform),))
    assert tuple(knob_options(design, ss.View())) == turned


def test_a_knob_for_a_frequency_that_a_design_does_not_have_is_automatic(page):
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(7, ss.waveforms.Tap()),))
    page._add([replace(ShowEntry.of(design, ss.View()), knob="frequency")])
    assert page.knob.shown_text == "Automatic"


@pytest.mark.parametrize("scale", [1.0, 1.8])
def test_words_of_a_show_have_more_room_than_its_list(studio, scale):
    studio.appearance._scale_text(scale)
    page = studio.presenter.make_show()
    assert min(page.heading.width(), page.sentence.width()) > 1.5 * page.list.width()


def test_a_show_is_presented_in_its_order(studio, made, path):
    made.save()
    made.done(0)
    studio.files.open(path)
    assert studio.document.design.title == "2 tone"
    assert studio.panel("stage").isVisible()
    studio.do("present")
    shown = []
    for _ in range(3):
        studio.do("next_scene")
        shown.append(studio.panel("stage").heading.text())
    assert shown == ["1 tap", "3 both", "Two inputs interfere"]


def test_the_stage_shows_what_the_compare_panel_in_sight_compared(studio, page):
    for of, several in (("limbs", True), ("snapshots", False)):
        studio.docks["compare"].bring_forward()
        choose(studio, of=of)
        # There are no snapshots: of the design that is saved, added and presented there is one map.
        page.add_open_design()
        studio.files.save()
        views = page.entries[-1].presented[1], open_design(studio.document.path).view
        assert [stage_settings(view).compared for view in views] == 2 * [several]
    choose(studio, of="axes")
    studio.do("present")
    assert studio.panel("stage").switch.isChecked()
    studio.do("present")


OFFERED = {"motion": ": pause · L: levels", "mean": "scene · L: motion", "levels": "scene · F:"}


@pytest.mark.parametrize(("what", "offered"), OFFERED.items())
def test_the_stage_moves_at_first_where_the_compare_panel_does(studio, what, offered):
    stage, before = studio.panel("stage"), StageSettings(moves=what == "mean")
    studio.document.look(with_settings(studio.document.view, "stage", before))
    studio.docks["compare"].bring_forward()
    choose(studio, of="windows" if what == "levels" else "limbs", shown=what)
    _, view = studio.presenter._shown_entry().presented
    studio.do("present")
    assert stage.moves is stage_settings(view).moves is (what == "motion")
    assert offered in studio.notice.text
    studio.presenter._handlers(stage)["levels"]()
    # Where nothing can move it is said.
    assert stage.moves is (what == "mean")
    assert (studio.notice.text == "Time windows do not move") is (what == "levels")
    studio.do("present")


@pytest.mark.parametrize("saved", [False, True])
@pytest.mark.parametrize(
    ("name", "parts"),
    [
        ("1G", [f"Limb {k} on Synthetic {k}" for k in range(1, 5)]),
        ("2B", ["50 Hz", "100 Hz", "200 Hz", "400 Hz"]),
    ],
)
def test_a_scene_of_a_show_has_its_maps_and_labels(studio, page, path, qtbot, name, parts, saved):
    page.add_scene(name)
    stage, scene_title = studio.panel("stage"), page.entries[0].title
    if saved:
        page.save()
        page.done(0)
        studio.files.open(path)
    else:
        page.findChild(QPushButton, "show_present").click()
    qtbot.waitUntil(lambda: len(stage.maps.content.cells) == 4, timeout=15_000)
    headings = [cell.heading for cell in stage.maps.content.cells]
    assert headings == [f"Snapshot {k + 1} · {parts[k]}" for k in range(4)]
    assert stage.heading.text() == scene_title
    if not saved:
        studio.do("present")
        page.done(0)


def test_an_entry_that_cannot_be_read_is_named_passed_by_and_kept(studio, made, path):
    made.save()
    made.done(0)
    content = bytearray(path.read_bytes())
    content[len(content) // 8] ^= 0x10
    path.write_bytes(content)
    before = studio.document.design
    studio.files.open(path)
    assert "Scene 1" in studio.notice.text
    assert studio.document.design == before
    studio.do("next_scene")
    assert studio.document.design.title == "1 tap"
    again = studio.presenter.make_show()
    assert titles(again)[0] == "Cannot be read"
    again.list.setCurrentRow(0)
    assert not again.heading.isEnabled()
    again.save()
    again.done(0)
    known = [isinstance(entry, ShowEntry) for entry in ss.open_show(path)]
    assert known == [False, True, True, True]


def test_every_file_that_cannot_be_added_is_named(page, folder, monkeypatch):
    names = [str(folder / f"{name}.skinsource") for name in ("0 cut", "2 tone", "1 cut", "3 both")]
    for name in names[::2]:
        Path(name).write_text("{")
    monkeypatch.setattr(QFileDialog, "getOpenFileNames", lambda *_: (names, ""))
    page.add_files()
    assert titles(page) == ["2 tone", "3 both"]
    assert all(name in page.message.text() for name in ("0 cut", "1 cut"))


def test_presenting_a_show_takes_the_page_away_until_its_end(studio, made, qtbot):
    made.list.setCurrentRow(2)
    made.findChild(QPushButton, "show_present").click()
    assert studio.presenter.presenting
    # The show begins with its first design, whichever is selected.
    assert studio.document.design.title == "2 tone"
    studio.do("present")
    made.list.setCurrentRow(1)
    QTest.mousePress(QWidget(), LEFT)
    made.list.doubleClicked.emit(made.list.currentIndex())
    # A window that is hidden by then would miss that the button is up again.
    assert made.isVisible()
    QTest.mouseRelease(QWidget(), LEFT)
    qtbot.waitUntil(lambda: not made.isVisible())
    assert studio.document.design.title == "1 tap"
    studio.do("next_scene")
    assert studio.document.design.title == "3 both"
    studio.do("present")
    assert made.isVisible()
    made.done(0)


def test_after_a_show_that_is_given_up_its_scene_is_one_of_the_paper_again(studio, page, answers):
    studio.scenes.open("2A")
    page.add_open_design()
    page.findChild(QPushButton, "show_present").click()
    studio.do("next_scene")
    assert studio.document.design.title.startswith("Fig. 2A: ")
    studio.do("present")
    answers["question"] = QMessageBox.StandardButton.Discard
    page.reject()
    studio.do("next_scene")
    assert studio.document.design.title.startswith("Fig. 2B: ")


def test_there_is_one_page_of_the_show_and_it_begins_with_what_was_saved(
    studio, made, tmp_path, answers
):
    path = tmp_path / "lecture.skinshow"
    answers["save"] = str(path)
    made.findChild(QPushButton, "show_present").click()
    studio.do("present")
    assert studio.presenter.make_show() is made
    made.list.setCurrentRow(0)
    made.heading.textEdited.emit("New")
    made.save()
    made.reject()
    again = studio.presenter.make_show()
    assert titles(again)[0] == "New"
    again.heading.textEdited.emit("Given up")
    again.findChild(QPushButton, "show_present").click()
    studio.do("present")
    # Changes that are not saved are asked about, also before another show takes the place.
    studio.files.open(path)
    assert again.isVisible()
    answers["question"] = QMessageBox.StandardButton.Discard
    again.reject()
    again = studio.presenter.make_show()
    assert titles(again)[0] == "New"
    studio.files.open(path)
    assert not again.isVisible()
    # A show is not saved over another one that was open before.
    studio.files.open(path.parent / "1 tap.skinsource")
    again = studio.presenter.make_show()
    assert (again.entries, again._path) == ((), None)
    assert again._about.isVisible()
