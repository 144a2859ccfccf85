"""Importing a recording in the studio: the page, drops, places, and what comes of it."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
import soundfile
from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt, QUrl
from PySide6.QtGui import QDragEnterEvent, QDragLeaveEvent, QDragMoveEvent, QDropEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel, QWidget

from skinsource.design import edits
from skinsource.design.recordings import take
from skinsource.design.waveforms.samples import Recording
from skinsource_gui.pages import actions
from skinsource_gui.panels.timeline.content import clip_name
from skinsource_gui.qt.frames import DropPlace

NO_KEYS = Qt.KeyboardModifier.NoModifier


@pytest.fixture
def sound(tmp_path):
    """Half a second of 150 Hz and of its half, at 48 kHz."""
    tone = 0.8 * np.sin(2.0 * np.pi * 150.0 * np.arange(24_000) / 48_000) * np.hanning(24_000)
    soundfile.write(tmp_path / "tap.wav", np.stack([tone, 0.5 * tone], axis=1), 48_000)
    return tmp_path / "tap.wav"


@pytest.fixture
def page_at(desk, qtbot):
    """Open the page on a file, and wait until it shows what it can."""
    return partial(opened, desk.imports, qtbot)


def opened(imports, qtbot, path, place=None):
    imports.open_page(path, place)
    return looked_at(imports.pages[-1], qtbot)


def looked_at(page, qtbot):
    """Wait until it shows what it can."""
    qtbot.waitUntil(lambda: not page.busy, timeout=60_000)
    QApplication.processEvents()
    return page


def asked(form):
    """What of a file is left open."""
    shown = {w.objectName() for w in form.children() if w.isWidgetType() and w.isVisible()}
    return {name.removeprefix("import_") for name in shown if name.startswith("import_")}


def choose(page, qtbot, name, option):
    page.form.findChild(object, f"import_{name}").choose(option)
    looked_at(page, qtbot)


def test_what_is_shown_is_placed_in_one_step(window, settle, qtbot, sound):
    before, steps = window.document.design, window.document.undo_stack.count()
    window.activateWindow()
    window.panel("timeline").heads.setFocus()
    page = opened(window.imports, qtbot, sound, DropPlace(location=13))
    assert page.ready
    assert "0.5 s" in page.preview.text
    page.accept()
    design = window.document.design
    new = design.inputs[-1]
    assert (new.location, len(design.inputs)) == (13, len(before.inputs) + 1)
    (clip,) = new.clips
    assert clip.waveform == take(sound).waveform
    # The keyboard comes back to the window.
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    view = window.document.view
    assert (view.selected_inputs, view.selected_clips) == ((new.id,), (clip.id,))
    assert window.document.undo_stack.count() == steps + 1
    settle()
    inspector = window.panel("inspector")
    labels = [
        inspector.findChild(QLabel, f"{name}_field") for name in ("samples", "source_rate_hz")
    ]
    assert [label.text() for label in labels] == ["650 at 1300 Hz", "48000 Hz"]
    window.do("undo")
    assert window.document.design == before


def test_only_what_the_file_leaves_open_is_asked(page_at, sound, tmp_path):
    expected = {"signal", "axes", "unit", "scale", "offset", "start", "duration"}
    assert asked(page_at(sound).form) == expected
    rows = "\n".join(f"{k / 1300:.6f},{np.sin(k):.6f}" for k in range(500))
    (tmp_path / "a.csv").write_text(f"time [s],acc [g]\n{rows}\n")
    form = page_at(tmp_path / "a.csv").form
    assert not asked(form) & {"unit", "rate"}
    assert form.choice.unit == "g"
    assert form.choice.time == "0"


def test_choices_change_what_is_shown_and_placed(desk, page_at, qtbot, sound):
    page = page_at(sound)
    choose(page, qtbot, "signal", "1")
    assert page.form.choice.scale == "peak"
    choose(page, qtbot, "unit", "g")
    assert page.form.choice.scale == "keep"
    assert "largest sample 3.89" in page.preview.text
    assert "m/s²" in page.preview.text
    page.accept()
    waveform = desk.document.design.inputs[-1].clips[-1].waveform
    assert waveform.samples.unit == "m/s²"
    assert waveform.name == "tap.wav, channel 2"
    assert np.abs(waveform.samples.values).max() == pytest.approx(0.4 * 9.80665, rel=0.02)


def test_missing_numbers_are_a_choice(page_at, qtbot, tmp_path):
    values = np.sin(np.arange(2600) * 0.3)
    values[7] = np.nan
    np.save(tmp_path / "raw.npy", values)
    page = page_at(tmp_path / "raw.npy")
    assert not page.ready
    assert "the first is number 8" in page.preview.text
    box = page.form.findChild(object, "import_missing")
    assert box.isVisible()
    box.setChecked(True)
    assert looked_at(page, qtbot).ready
    assert "1 missing numbers count as 0" in page.preview.text


def test_a_file_that_is_none_says_why_and_imports_nothing(desk, page_at, tmp_path):
    (tmp_path / "bad.wav").write_bytes(b"RIFF\x10\0\0\0WAVEnothing here")
    before = desk.document.design
    page = page_at(tmp_path / "bad.wav")
    assert not page.ready
    assert "bad.wav: cannot be read" in page.preview.text
    assert not page.findChild(object, "spectrum_preview").isVisible()
    page.reject()
    assert desk.document.design is before


def test_the_whole_is_shown_and_its_part_is_dragged(page_at, qtbot, tmp_path):
    values = np.zeros(8 * 8000)
    values[5 * 8000 : 6 * 8000] = np.sin(np.arange(8000) * 0.1)
    soundfile.write(tmp_path / "long.wav", values, 8000)
    page = page_at(tmp_path / "long.wav")
    strip = page.findChild(object, "import_overview")
    qtbot.waitUntil(lambda: strip.extremes is not None, timeout=30_000)
    loud = np.flatnonzero(strip.extremes[1] > 0.5) * 8.0 / strip.extremes.shape[1]
    assert (loud[0], loud[-1]) == (pytest.approx(5.0, abs=0.05), pytest.approx(6.0, abs=0.05))
    assert strip.isVisible()
    drag(qtbot, strip, 8.0, 7.5, 7.0)
    drag(qtbot, strip, 3.5, 4.0, 4.5)
    choice = page.form.choice
    assert choice.duration_s == pytest.approx(7.0, abs=0.1)
    assert choice.start_s == pytest.approx(1.0, abs=0.1)
    qtbot.waitUntil(lambda: not page.busy, timeout=60_000)
    assert page.preview.text.startswith("7")


def drag(qtbot, strip, *times_s):
    places = [QPoint(round(strip.x_of(time_s)), 20) for time_s in times_s]
    view = strip.viewport()
    qtbot.mousePress(view, Qt.MouseButton.LeftButton, pos=places[0])
    for place in places[1:]:
        qtbot.mouseMove(view, place)
        QApplication.processEvents()
    qtbot.mouseRelease(view, Qt.MouseButton.LeftButton, pos=places[-1])


def test_time_stamps_say_how_long_a_table_is(page_at, qtbot, tmp_path):
    times_s = np.concatenate((np.arange(1000) / 1000, 4.0 + np.arange(1000) / 1000))
    values = np.where(times_s < 1.0, 0.2, 1.0) * np.sin(times_s * 500.0)
    rows = "\n".join(f"{t:.6f},{x:.6f}" for t, x in zip(times_s, values, strict=True))
    (tmp_path / "gap.csv").write_text(f"time [s],acc [g]\n{rows}\n")
    page = page_at(tmp_path / "gap.csv")
    qtbot.waitUntil(lambda: page.ready, timeout=60_000)
    assert page.form.choice.duration_s == pytest.approx(4.999 * 2000 / 1999, abs=1e-6)
    assert page.form.lasts_s == page.form.choice.duration_s
    assert page.preview.text.startswith("5 s")
    strip = page.findChild(object, "import_overview")
    assert strip.isVisible()
    qtbot.waitUntil(lambda: strip.extremes is not None, timeout=30_000)
    # What lies behind the gap is drawn there, though half of all samples lie before it.
    image = strip.grab().toImage()

    def tall(time_s):
        x, gap = round(strip.x_of(time_s)), round(strip.x_of(2.5))
        return sum(
            image.pixelColor(x, y) != image.pixelColor(gap, y) for y in range(image.height())
        )

    assert tall(4.5) > 20 > tall(0.5)
    drag(qtbot, strip, 3.9, 4.5)
    qtbot.waitUntil(lambda: page.ready, timeout=60_000)
    assert page.form.choice.duration_s == pytest.approx(0.6, abs=0.02)
    # A part that was chosen stays.
    choose(page, qtbot, "scale", "keep")
    assert page.form.choice.duration_s == pytest.approx(0.6, abs=0.02)


def test_a_page_that_is_closed_while_it_reads_leaves_nothing(desk, sound):
    desk.imports.open_page(sound)
    desk.imports.pages[-1].reject()
    QApplication.processEvents()
    assert desk.imports.pages == ()


def test_places_begin_with_the_likeliest(desk):
    design, view = desk.document.design, desk.document.view
    track = design.inputs[0]
    names = [name for name, _ in actions.options(design, view, DropPlace(location=4))]
    assert names[0] == "new 4"
    assert len(names) == len(set(names)) == 21
    assert actions.options(design, view, DropPlace(input_id=track.id))[0][0] == f"track {track.id}"
    more = edits.duplicate_inputs(edits.place_input(design, view, 4).design, view, (1,)).design
    texts = [text for name, text in actions.options(more, view, None) if name.startswith("track")]
    assert [text[-5:] for text in texts] == ["row 1", " tip)", "row 3"]
    nothing = actions.options(design.without_input(0), view, None)
    assert [name for name, _ in nothing][:2] == ["new 7", "new 1"]


def test_three_axes_are_offered_as_one(desk, page_at, qtbot, tmp_path):
    axes = np.random.default_rng(1).normal(size=(650, 3))
    rows = "\n".join(",".join(f"{x:.9f}" for x in row) for row in axes)
    (tmp_path / "a.csv").write_text(f"acc_x [g],acc_y [g],acc_z [g]\n{rows}\n")
    page = page_at(tmp_path / "a.csv")
    field = page.form.findChild(QWidget, "import_axes")
    assert field.isVisible()
    assert [field.itemData(k) for k in range(field.count())] == ["", "1 2", "each"]
    choose(page, qtbot, "axes", "1 2")
    assert "DFT321, Landin et al. 2010" in page.preview.text
    assert page.form.choice.others == ("1", "2")
    page.accept()
    waveform = desk.document.design.inputs[-1].clips[-1].waveform
    assert waveform.name == "a.csv, acc_x, acc_y, acc_z"


def test_a_rate_that_is_assumed_is_said_so_until_it_is_typed(page_at, qtbot, tmp_path):
    np.save(tmp_path / "raw.npy", np.sin(np.arange(2600) * 0.3))
    page = page_at(tmp_path / "raw.npy")
    warning = page.findChild(object, "import_warning")
    assert warning.isVisible()
    assert "1300" in warning.text()
    field = page.form.findChild(object, "import_rate")
    field.set_value(2600.0)
    field.edited.emit(2600.0, None)
    looked_at(page, qtbot)
    assert not warning.isVisible()
    assert page.preview.text.startswith("1 s")


@pytest.fixture
def placeholder(desk):
    """A track whose only clip stands for a recording, and that clip, which is selected."""
    document = desk.document
    track = document.design.inputs[0]
    document.apply(edits.change_kind(document.design, document.view, (track.id,), "Recording"))
    clip = document.design.inputs[0].clips[0]
    document.apply(edits.select_clips(document.design, document.view, (clip.id,)))
    return track, clip


def test_a_recording_replaces_what_stands_for_one_or_another(desk, page_at, sound, placeholder):
    document, track, clip = desk.document, *placeholder
    first = actions.options(document.design, document.view, None)[0]
    assert first[0] == f"clip {clip.id}"
    assert first[1].startswith("In place of the recording at ")
    page_at(sound).accept()
    (now,) = document.design.inputs[0].clips
    assert now.waveform.name == "tap.wav, channel 1"
    assert (now.id, now.onset_s) == (clip.id, clip.onset_s)
    gained = document.design.with_clip(clip.id, gain=0.5, label="Tap")
    both = actions.placed(gained, document.view, first[0], 0.0, [now.waveform] * 2).design.clips
    assert [(each.gain, each.label) for each in both] == [(0.5, "Tap"), (0.5, "")]
    again = [name for name, _ in actions.options(document.design, document.view, None)]
    assert again[:2] == [f"track {track.id}", f"clip {clip.id}"]


def test_a_recording_whose_place_went_meanwhile_is_refused(desk, page_at, sound, placeholder):
    document, (_, clip) = desk.document, placeholder
    page, messages = page_at(sound), []
    document.refused.connect(messages.append)
    document.apply(edits.remove_clips(document.design, document.view, (clip.id,)), None)
    without = document.design
    page.accept()
    assert messages == ["That recording is no longer there; import it to another place."]
    assert document.design == without


def drop(window, path, at, kind=QDropEvent, *others):
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(each)) for each in (path, *others)])
    where = QPointF(at) if kind is QDropEvent else at
    event = kind(where, Qt.DropAction.CopyAction, data, Qt.MouseButton.LeftButton, NO_KEYS)
    QApplication.sendEvent(window, event)
    return event


def site(window, number):
    diagram = window.panel("hand").diagram
    return diagram.mapTo(window, diagram.site_centre(number))


@pytest.mark.parametrize("where", ["site", "row", "elsewhere"])
def test_a_file_that_is_dropped_goes_where_it_was_dropped(window, qtbot, sound, where):
    first = window.document.design.inputs[0]
    row = window.panel("timeline").heads.viewport()
    at = {
        "site": site(window, 13),
        "row": row.mapTo(window, QPoint(60, 10)),
        "elsewhere": window.panel("traces").mapTo(window, QPoint(50, 50)),
    }[where]
    assert drop(window, sound, at, QDragEnterEvent).isAccepted()
    assert drop(window, sound, at).isAccepted()
    (page,) = window.imports.pages
    looked_at(page, qtbot).accept()
    inputs = window.document.design.inputs
    assert isinstance(inputs[-1].clips[-1].waveform, Recording)
    # The start design's only input is the selected one.
    assert len(inputs) == 1 + (where == "site")
    assert inputs[-1].location == (13 if where == "site" else first.location)


def test_several_files_are_asked_about_in_turn_and_others_named(window, qtbot, sound, tmp_path):
    second = tmp_path / "second.wav"
    second.write_bytes(sound.read_bytes())
    row = window.panel("timeline").heads.viewport().mapTo(window, QPoint(60, 10))
    for kind in (QDragEnterEvent, QDropEvent):
        drop(window, sound, row, kind, tmp_path / "a.skinsource", second)
    assert "a.skinsource" in window.notice.text
    for title in ("tap.wav, file 1 of 2", "second.wav, file 2 of 2"):
        assert title in window.imports.pages[0].windowTitle()
        window.imports.pages[0].reject()
        QApplication.processEvents()
    assert window.imports.pages == ()


def test_each_file_begins_with_the_choices_of_the_last(desk, qtbot, sound, tmp_path, answers):
    soundfile.write(tmp_path / "mono.wav", np.ones(4800), 48_000)
    answers["several"] = [str(sound), str(sound), str(tmp_path / "mono.wav")]
    desk.imports.ask_and_import()
    page = looked_at(desk.imports.pages[0], qtbot)
    for name, option in (("signal", "1"), ("unit", "g"), ("scale", "peak")):
        choose(page, qtbot, name, option)
    page.form.findChild(object, "import_offset").setChecked(False)
    page.form.take_part(0.2, 0.15)
    first = page.form.choice
    for expected in (first, first, replace(first, series="0", start_s=0.0, duration_s=0.1)):
        (page,) = desk.imports.pages
        assert looked_at(page, qtbot).form.choice == expected
        page.accept()
        QApplication.processEvents()
    steps = desk.document.undo_stack
    assert (steps.count(), steps.undoText()) == (1, "Import 3 files")
    desk.imports.ask_and_import()
    assert looked_at(desk.imports.pages[0], qtbot).form.made == {}


def test_files_of_one_shape_are_asked_about_once(desk, qtbot, sound, tmp_path, answers):
    mono, imports = tmp_path / "mono.wav", desk.imports
    soundfile.write(mono, np.arange(4800) / 4800, 48_000)
    answers["several"] = [str(path) for path in (sound, sound, mono, sound)]
    imports.ask_and_import()
    choose(looked_at(imports.pages[0], qtbot), qtbot, "signal", "1")
    assert " on 7 (II pad), 8 (III pad), 9 (IV pad), 10 (V pad), over" in where(imports.pages[0])
    said = []
    imports.done.connect(said.append)
    imports.pages[0].same.click()
    imports.pages[0].accept()
    # What has another shape is asked about.
    qtbot.waitUntil(lambda: any(page.isVisible() and page.ready for page in imports.pages))
    assert "3 of 4" in imports.pages[0].windowTitle()
    imports.pages[0].accept()
    qtbot.waitUntil(lambda: len(desk.document.design.inputs) == 4)
    qtbot.waitUntil(lambda: not desk.findChildren(QWidget, "import_page"))
    tracks = desk.document.design.inputs
    assert [track.location for track in tracks] == [7, 8, 9, 10]
    places = "tap.wav on 7 (II pad), tap.wav on 8 (III pad), mono.wav on 9 (IV pad)"
    assert said[-1] == f"Imported {places}, tap.wav on 10 (V pad)"
    names = [track.clips[-1].waveform.name for track in tracks]
    assert names == ["tap.wav, channel 2"] * 2 + ["mono.wav", "tap.wav, channel 2"]


def test_a_site_lights_up_while_a_recording_is_held_over_it(window, sound, tmp_path):
    stage = window.panel("hand").diagram.stage
    at = site(window, 13)
    drop(window, sound, at, QDragEnterEvent)
    drop(window, sound, at, QDragMoveEvent)
    assert stage.state.target == 13
    QApplication.sendEvent(window, QDragLeaveEvent())
    assert stage.state.target is None
    drop(window, tmp_path / "a.skinsource", at, QDragEnterEvent)
    assert stage.state.target is None


def where(page):
    return page.findChild(QLabel, "import_where").text()


def test_a_recording_goes_to_the_playhead_and_has_the_name_of_its_file(desk, page_at, sound):
    document = desk.document
    document.apply(edits.move_playhead(document.design, document.view, 0.1))
    assert document.design.inputs[0].clips[0].end_s > 0.1
    page = page_at(sound)
    # It says so where something plays there already.
    assert where(page) == "Starts at 100 ms on 7 (II pad), over 1 other clip"
    QTest.keyClick(page.findChild(QWidget, "import_place"), Qt.Key.Key_End)
    assert not where(page).startswith("Starts at 100 ms on 7 (II pad)")
    QTest.keyClick(page.findChild(QWidget, "import_place"), Qt.Key.Key_Home)
    # What was said holds.
    document.apply(edits.move_playhead(document.design, document.view, 3.0))
    page.accept()
    clip = document.design.inputs[0].clips[-1]
    assert clip.onset_s == 0.1
    assert clip_name(clip).startswith("tap.wav")


def test_each_channel_gets_a_place_of_its_own_and_keeps_its_share(desk, qtbot, page_at, sound):
    document = desk.document
    document.edit("Strong", document.design.with_input(0, amplitude=3.603))
    document.apply(edits.move_playhead(document.design, document.view, 1.0))
    page = page_at(sound)
    field = page.form.findChild(QWidget, "import_axes")
    assert field.isVisibleTo(page)
    QTest.keyClick(field, Qt.Key.Key_Down)
    qtbot.waitUntil(lambda: page.ready, timeout=60_000)
    assert page.preview.text.startswith("1 of 2")
    assert where(page) == "Starts at 1000 ms on 7 (II pad), 8 (III pad)"
    # Another signal leaves that choice.
    choose(page, qtbot, "signal", "1")
    assert len(page.form.choices) == 2
    # What is shown is the chosen signal.
    assert page.preview.text.startswith("2 of 2: 0.5 s · largest sample 0.5 ")
    before, said = document.undo_stack.count(), []
    document.message.connect(said.append)
    page.accept()
    assert document.undo_stack.count() == before + 1
    assert said == [where(page)]
    tracks = document.design.inputs
    assert [(track.location, track.amplitude) for track in tracks] == [(7, 3.603), (8, 3.603)]
    clips = [track.clips[-1] for track in tracks]
    assert [clip.waveform.name for clip in clips] == ["tap.wav, channel 1", "tap.wav, channel 2"]
    assert [clip.onset_s for clip in clips] == [1.0, 1.0]
    assert [clip.waveform.samples.peak for clip in clips] == pytest.approx([1.0, 0.5], rel=1e-3)
    assert document.view.selected_inputs == document.design.ids
    assert document.view.selected_clips == tuple(clip.id for clip in clips)
