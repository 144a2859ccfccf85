"""Play > Check wiring…: outputs buzz, are named, timed by a cable, and put right in the rig."""

import numpy as np
import pytest
from PySide6.QtWidgets import QMessageBox
from shiboken6 import isValid

import skinsource as ss
from skinsource.actuators.rigs import Rig, RigChannel, open_rig, save_rig
from skinsource.lab.playing.devices import Output
from skinsource_gui.pages.rig.wiring_page import WiringPage
from tests.core.playing.synthetic_sound import SyntheticSoundLibrary, use
from tests.core.rig_measuring.bench_top import Duplex

WAIT = {"timeout": 30_000}


class Card(SyntheticSoundLibrary):
    """Output 1 of it is wired to input 1."""

    paths, output, noise, offset = (np.eye(1, 8192)[0],), 1, 0.0, 0.0
    pulled_after, loses_at = 100_000, -1

    @property
    def rows(self):
        return tuple((name, 0, n, 2, 48_000.0) for name, n in self.outputs.items())

    def Stream(self, **asked):  # as sounddevice calls it
        return self.open(Duplex(self, asked))


@pytest.fixture
def sound(monkeypatch):
    modules = "playing.devices", "playing.stream", "rig_measuring.duplex"
    return use(monkeypatch, Card(Two=2), modules)


@pytest.fixture
def rig_path(tmp_path):
    path = tmp_path / "bench.skinrig"
    channels = tuple(RigChannel(place=6 + output, output=output) for output in (1, 2))
    save_rig(path, Rig(title="Bench", channels=channels))
    return path


@pytest.fixture
def page(sound, open_window, rig_path, qtbot):
    window = open_window(ss.Design(limb="synthetic-1", inputs=(ss.track(7),)))
    settings = window.playback.player.settings
    settings.choose_rig(rig_path)
    window.do("check_wiring")
    page = window.findChild(WiringPage)
    qtbot.waitUntil(lambda: settings.searched, **WAIT)
    yield page
    if isValid(page):
        page._saved = page.check
        page.reject()
    settings.choose_rig(None)
    settings.choose(Output())


def cells(page, row):
    return [page.table.item(row, column).text() for column in range(page.table.columnCount())]


def test_an_armed_output_buzzes_and_nothing_else_does(page, sound, qtbot):
    assert not page.buzz.isEnabled()
    page.arm.click()
    page.table.selectRow(1)
    page.buzz.click()
    qtbot.waitUntil(lambda: any(stream.samples.any() for stream in sound.streams), **WAIT)
    assert "Output 2 buzzes" in page.message.text()
    page.stop.click()
    qtbot.waitUntil(lambda: not any(stream.active for stream in sound.streams), **WAIT)
    first, second = sound.streams[-1].samples
    assert not first.any()
    assert second.any()


def test_swapped_places_are_noted_row_after_row_and_put_right_in_the_rig(page, rig_path, qtbot):
    page.arm.click()
    for place in (8, 7):
        # Nobody can say where an output is felt that did not buzz.
        assert not page.felt.isEnabled()
        page.buzz.click()
        qtbot.waitUntil(page.felt.isEnabled, **WAIT)
        page.place.choose(f"{place}")
        page.felt.click()
    assert cells(page, 0)[:3] == ["1", "7", "8"]
    assert "Output 1 moves place 8, and the rig says place 7." in page.message.text()
    page.correct.click()
    assert [each.place for each in open_rig(rig_path).channels] == [8, 7]
    assert "Check it once more" in page.message.text()
    assert cells(page, 0)[:3] == ["1", "8", "not checked"]


def test_correcting_the_rig_keeps_what_else_was_found_and_asks_before_it_is_lost(
    page, qtbot, monkeypatch
):
    assert not page.correct.isEnabled()
    page.arm.click()
    page.loop.click()
    qtbot.waitUntil(lambda: "ms" in cells(page, 0)[5], **WAIT)
    # A delay is nothing that places and polarities could put right.
    assert not page.correct.isEnabled()
    page.buzz.click()
    qtbot.waitUntil(page.felt.isEnabled, **WAIT)
    page.place.choose("9")
    page.felt.click()
    page.correct.click()
    assert cells(page, 0)[:3] == ["1", "9", "not checked"]
    assert cells(page, 0)[5] == "10.000 ms"
    page.table.selectRow(0)
    assert not page.felt.isEnabled()
    asked = []

    def question(*said):
        asked.append(said[2])
        return QMessageBox.StandardButton.Cancel

    monkeypatch.setattr(QMessageBox, "question", question)
    page.reject()
    assert asked == ["What was found is not saved. Save it?"]


def test_a_cable_tells_delay_and_jitter_of_its_output(page, qtbot):
    page.arm.click()
    page.loop.click()
    qtbot.waitUntil(lambda: "ms" in cells(page, 0)[5], **WAIT)
    assert cells(page, 0)[5:] == ["10.000 ms", "0.000 ms"]
    # No cable leads from the second output.
    page.table.selectRow(1)
    page.loop.click()
    qtbot.waitUntil(lambda: "Check the cable" in page.message.text(), **WAIT)


def test_what_was_found_is_saved_as_a_page_before_it_is_lost(
    page, answers, tmp_path, qtbot, monkeypatch
):
    page.arm.click()
    page.loop.click()
    qtbot.waitUntil(lambda: "ms" in cells(page, 0)[5], **WAIT)
    asked = []

    def question(*said):
        asked.append(said[2])
        return QMessageBox.StandardButton.Cancel

    monkeypatch.setattr(QMessageBox, "question", question)
    page.reject()
    assert asked == ["What was found is not saved. Save it?"]
    assert page.isVisible()
    answers["save"] = str(tmp_path / "wiring.svg")
    page.save.click()
    assert "10.000 ms" in (tmp_path / "wiring.svg").read_text()
    page.reject()
    assert len(asked) == 1


def test_without_a_device_nothing_is_armed(open_window, rig_path, monkeypatch, qtbot):
    use(monkeypatch, Card())
    window = open_window(ss.Design(limb="synthetic-1", inputs=(ss.track(7),)))
    settings = window.playback.player.settings
    settings.choose_rig(rig_path)
    window.do("check_wiring")
    page = window.findChild(WiringPage)
    qtbot.waitUntil(lambda: settings.searched and not settings.devices, **WAIT)
    page.arm.click()
    assert not page.arm.isChecked()
    assert "No audio device was found" in page.message.text()
    page.reject()
    settings.choose_rig(None)


def test_without_a_rig_it_says_where_to_choose_one(sound, open_window, qtbot):
    window = open_window(ss.Design(limb="synthetic-1"))
    window.playback.player.settings.choose_rig(None)
    window.do("check_wiring")
    page = window.findChild(WiringPage)
    assert "No rig is chosen" in page.message.text()
    assert not page.felt.isEnabled()
    page.reject()
