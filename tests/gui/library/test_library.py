"""Presets of the library: listed, looked at, placed, dropped, saved, renamed and deleted."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt, QUrl
from PySide6.QtGui import QDragEnterEvent, QDragMoveEvent, QDropEvent, QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDialogButtonBox, QMessageBox, QTabBar

from skinsource import Design, View, track
from skinsource.design.clips import Clip, Fragment, Lane
from skinsource.design.presets import presets
from skinsource.design.presets.presets import Preset, read_preset_folder, shipped_folder
from skinsource.design.waveforms import Tap, Tone
from skinsource_gui.pages.library import fragments_to_save
from skinsource_gui.panels.library.list import OWN
from skinsource_gui.panels.library.panel import LibraryPanel
from skinsource_gui.plots import preview
from tests.gui.panel_host import PanelHost


class Bench(PanelHost):
    """The library, on a design of one track."""

    def __init__(self, qtbot):
        design = Design(limb="synthetic-1", inputs=(track(7),))
        super().__init__(LibraryPanel(), design, View(selected_inputs=(1,)))
        self.appear(qtbot, 300, 560)
        self.activate(qtbot)

    @property
    def names(self):
        model = self.panel.model
        return [model.index(k, 0).data() for k in range(model.rowCount())]

    def go_to(self, name):
        self.panel.rows.go_to(self.names.index(name))
        self.panel.rows.setFocus()

    def save(self, preset):
        """Save one of the user's own, as another program would."""
        path = presets.save_preset(presets.users_folder(), preset)
        self.panel.folders.read()
        return path


@pytest.fixture
def bench(qtbot, user_data):
    return Bench(qtbot)


SHIPPED = read_preset_folder(shipped_folder()).entries


KEY, LEFT, NONE = Qt.Key, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier


def test_enter_places_at_the_playhead_on_the_selected_track_in_one_step(bench):
    bench.show(playhead_s=0.25)
    bench.go_to("Double tap")
    QTest.keyClick(bench.panel.rows, KEY.Key_Return)
    assert bench.labels == ["Place Double tap"]
    (track,) = bench.design.inputs
    assert [clip.onset_s for clip in track.clips[1:]] == [0.25, 0.37]
    assert set(bench.view.selected_clips) == {clip.id for clip in track.clips[1:]}
    # Enter in the search places what is listed first.
    bench.panel.search.line.setText("heart")
    QTest.keyClick(bench.panel.search.line, KEY.Key_Return)
    assert bench.labels[1:] == ["Place Heartbeat"]


def test_a_double_click_places_and_a_click_only_looks(bench):
    rows = bench.panel.rows
    bench.go_to("Click")
    area = rows.visualRect(rows.currentIndex())
    QTest.mouseClick(rows.viewport(), LEFT, pos=area.center())
    assert bench.labels == []
    QTest.mouseDClick(rows.viewport(), LEFT, pos=area.center())
    assert bench.labels == ["Place Click"]


def test_the_preview_stays_that_of_a_row_that_is_dragged_over_others(bench):
    rows = bench.panel.rows
    dragged, other = (rows.visualRect(rows.model().index(k, 0)).center() for k in (1, 3))
    QTest.mouseMove(rows.viewport(), other)
    assert bench.panel.preview.preset.name == bench.names[3]
    QTest.mousePress(rows.viewport(), LEFT, pos=dragged)
    QTest.mouseMove(rows.viewport(), other)
    assert bench.panel.preview.preset.name == bench.names[1]
    QTest.mouseRelease(rows.viewport(), LEFT, pos=other)


def test_every_shipped_preset_is_listed_and_drawn_once_it_is_shown(bench):
    assert set(bench.names) == {entry.preset.name for entry in SHIPPED}
    panel = bench.panel
    for row in range(panel.model.rowCount()):
        panel.rows.go_to(row)
        assert panel.preview.strip.message == ""
        assert panel.preview.preset.name in panel.preview.text.text()
        assert panel.preview.preset.name == panel.model.index(row, 0).data()


def test_words_and_tags_narrow_the_list(bench):
    panel = bench.panel
    QTest.keyClicks(panel.search.line, "contracting equal")
    assert bench.names == ["Contracting train, equal energy"]
    QTest.keyClick(panel.search.line, KEY.Key_Escape)
    assert len(bench.names) == len(SHIPPED)
    panel.search.tags.setCurrentText("flutter")
    assert bench.names == ["Tone 30 Hz"]
    panel.search.line.setText("noise")
    assert bench.names == []
    assert panel.preview.isHidden()
    assert not panel.buttons.place.isEnabled()


@pytest.fixture
def drop(window, qtbot):
    """Lets a preset go over the window, as it is dragged from the list."""
    assert window.panel("library").model.rowCount() == 0, "a hidden panel reads no file"
    window.docks["library"].bring_forward()
    panel = window.panel("library")
    qtbot.waitUntil(panel.isVisible)

    def let_go(name, at):
        model = panel.model
        row = next(k for k in range(model.rowCount()) if model.index(k, 0).data() == name)
        copy, data = Qt.DropAction.CopyAction, model.mimeData([model.index(row, 0)])
        QApplication.sendEvent(window, QDragEnterEvent(at, copy, data, LEFT, NONE))
        event = QDropEvent(QPointF(at), copy, data, LEFT, NONE)
        QApplication.sendEvent(window, event)
        assert event.dropAction() == copy

    return let_go


def test_a_preset_goes_where_it_is_dropped_and_elsewhere_to_the_selected_track(
    window, drop, settle, qtbot
):
    document, diagram = window.document, window.panel("hand").diagram
    drop("Heartbeat", diagram.mapTo(window, diagram.site_centre(13)))
    new = document.design.inputs[-1]
    assert (new.location, len(new.clips)) == (13, 6)
    # Near a place is on it; away from all places nothing is taken.
    data, taken = QMimeData(), []
    data.setUrls([QUrl.fromLocalFile("/tap.skinpreset")])
    beside = QPoint(round(2 * diagram.stage.layout.radii_px[12]), 0)
    for at in (diagram.site_centre(13) + beside, QPoint(2, 2)):
        for move in (QDragEnterEvent, QDragMoveEvent):
            event = move(diagram.mapTo(window, at), Qt.DropAction.CopyAction, data, LEFT, NONE)
            QApplication.sendEvent(window, event)
        taken.append(event.isAccepted())
    assert taken == [True, False]
    settle()
    timeline, (bar,) = window.panel("timeline"), window.findChildren(QTabBar)
    # The Timeline is the first tab.
    for move in (QDragEnterEvent, QDragMoveEvent):
        event = move(bar.tabRect(0).center(), Qt.DropAction.CopyAction, QMimeData(), LEFT, NONE)
        QApplication.sendEvent(bar, event)
    qtbot.waitUntil(timeline.isVisible)
    y, place = next(
        (y, place)
        for y in range(timeline.height())
        if (place := timeline.drop_place(QPoint(400, y))) is not None
    )
    drop("Click", timeline.mapTo(window, QPoint(400, y)))
    track = document.design.input(place.input_id)
    assert track.clips[-1].onset_s == pytest.approx(place.onset_s)
    assert len(track.clips) == 2
    document.look(replace(document.view, selected_inputs=(new.id,)))
    drop("Tap", QPoint(5, 5))
    assert len(document.design.input(new.id).clips) == 7


def test_a_damaged_file_that_is_dropped_is_refused_in_a_sentence(window, tmp_path):
    path, messages = tmp_path / "bad.skinpreset", []
    path.write_text("{}")
    before = window.document.design
    window.library.failed.connect(messages.append)
    window.library.place_file(path, None)
    assert "bad.skinpreset" in messages[0]
    assert window.document.design is before


SEVERAL = Design(
    limb="synthetic-1",
    inputs=(
        replace(track(7, Tone(80.0)), clips=(Clip(onset_s=0.1, label="Hum"), Clip(onset_s=0.5))),
        track(2, Tap(), onset_s=0.2, muted=True),
    ),
)


def test_what_can_be_kept_is_what_is_selected_the_track_and_all():
    view = View(selected_inputs=(1,), selected_clips=(1,))
    fragments = fragments_to_save(SEVERAL, view)
    assert [fragment.text for fragment in fragments] == [
        "Selected: 1 clip",
        "On the selected track: 2 clips",
        "The whole design: 3 clips on 2 tracks",
    ]
    assert [fragment.name for fragment in fragments] == ["Hum"] * 3
    assert [len(fragment.fragment.lanes) for fragment in fragments] == [1, 1, 2]
    assert fragments[-1].fragment.lanes[1].clips[0].muted
    assert len(fragments_to_save(Design(limb="synthetic-1", inputs=(track(7),)), View())) == 1
    assert fragments_to_save(Design(limb="synthetic-1"), View()) == ()


def test_a_clip_is_kept_under_a_name(window):
    page = window.library.ask_and_save()
    button = page.buttons.button(QDialogButtonBox.StandardButton.Save)
    page.name.setText("  ")
    assert not button.isEnabled()
    page.name.setText("  Good   tone ")
    page.tags.setText("mine, low, mine")
    page.description.setText("For the start.")
    button.click()
    (entry,) = presets.read_preset_folder(presets.users_folder()).entries
    assert (entry.preset.name, entry.preset.tags) == ("Good tone", ("mine", "low"))
    assert entry.preset.description == "For the start."
    (clip,) = entry.preset.fragment.lanes[0].clips
    assert clip.waveform == window.document.design.clips[0].waveform
    assert window.document.undo_stack.count() == 0


def test_what_cannot_be_kept_says_why_and_the_page_stays(window, user_data):
    (user_data / "presets").write_text("in the way")
    page = window.library.ask_and_save()
    page.buttons.button(QDialogButtonBox.StandardButton.Save).click()
    assert page.isVisible()
    assert "cannot be written" in page.message.text()
    page.tags.setText("x" * 50)
    page.buttons.button(QDialogButtonBox.StandardButton.Save).click()
    assert "tags" in page.message.text()
    page.reject()


MINE = Preset(
    name="My tap",
    tags=("mine", "quick"),
    description="A <b>tap</b>.",
    fragment=Fragment(lanes=(Lane(location=3, clips=(Clip(waveform=Tap()),)),)),
)


def test_own_presets_are_there_when_the_user_comes_back_and_bad_ones_are_named(bench):
    panel, comes_back = bench.panel, QGuiApplication.instance().focusWindowChanged.emit
    path = presets.save_preset(presets.users_folder(), MINE)
    comes_back(None)
    assert bench.names[0] == "My tap"
    assert panel.model.index(0, 0).data(OWN)
    path.write_text(presets.preset_text(replace(MINE, name="My other tap")))
    comes_back(None)
    assert bench.names[0] == "My other tap"
    bad = presets.users_folder() / "bad.skinpreset"
    bad.write_text("{")
    comes_back(None)
    assert panel.faults.isVisible()
    assert "bad.skinpreset" in panel.faults.text()
    assert bench.names[0] == "My other tap"
    # What changes while it is hidden is there when it is shown.
    panel.hide()
    bad.unlink()
    path.unlink()
    panel.show()
    assert panel.faults.isHidden()
    assert len(bench.names) == len(read_preset_folder(shipped_folder()).entries)


def test_own_presets_are_renamed_in_place_and_shipped_ones_are_not(bench, qtbot):
    panel = bench.panel
    bench.save(MINE)
    index = panel.model.index(0, 0)
    assert index.flags() & Qt.ItemFlag.ItemIsEditable
    panel.model.setData(index, "Ready", Qt.ItemDataRole.EditRole)
    assert bench.names[0] == panel.rows.currentIndex().data() == "Ready"
    assert [path.name for path in presets.users_folder().iterdir()] == ["ready.skinpreset"]
    with qtbot.waitSignal(panel.failed) as failure:
        panel.model.setData(panel.model.index(0, 0), " ", Qt.ItemDataRole.EditRole)
    assert "name" in failure.args[0]
    assert bench.names[0] == "Ready"
    bench.go_to("Tap")
    assert not panel.rows.currentIndex().flags() & Qt.ItemFlag.ItemIsEditable
    assert not panel.buttons.rename.isEnabled()
    assert not panel.buttons.delete.isEnabled()


@pytest.mark.parametrize("yes", [True, False])
def test_own_presets_are_deleted_after_a_question_and_shipped_ones_never(bench, answers, yes):
    kinds = QMessageBox.StandardButton
    answers["question"] = kinds.Yes if yes else kinds.No
    path = bench.save(MINE)
    for name in ("My tap", "Tap"):
        bench.go_to(name)
        QTest.keyClick(bench.panel.rows, Qt.Key.Key_Delete)
    assert path.exists() is not yes
    assert ("My tap" in bench.names) is not yes
    assert "Tap" in bench.names
    assert len(answers["asked"]) == 1


def test_between_the_curve_of_a_clip_and_silence_is_the_ground_of_the_clip(qtbot):
    strip = preview.ClipStrip()
    qtbot.addWidget(strip)
    strip.resize(300, 120)
    arch = np.sin(np.linspace(0.0, np.pi, 400))
    clip = preview.StripClip(start_s=0.0, duration_s=0.4, samples=arch)
    strip.show_lanes((preview.Lane(place=7, colour=0, clips=(clip,)),))
    image = strip.grab().toImage()
    # Through the arch and the line of silence.
    assert len({image.pixelColor(170, y).name() for y in range(8, 36)}) == 1
