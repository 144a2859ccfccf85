"""The matching page: keys, what is heard, what is stored, and what is said where nothing is."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QPushButton

from skinsource.actuators.prediction import Limits
from skinsource.actuators.rigs import Rig, RigChannel, save_rig
from tests.core.matching.test_matching import rows_of
from tests.core.playing.synthetic_sound import SyntheticSoundLibrary, use


@pytest.fixture
def sound(monkeypatch):
    return use(monkeypatch, SyntheticSoundLibrary(Eight=8))


@pytest.fixture
def no_sound(monkeypatch):
    return use(monkeypatch, SyntheticSoundLibrary())


@pytest.fixture
def page(desk, qtbot, tmp_path):
    desk.playback.matching.show()
    yield filled(desk.playback.matching.page, qtbot, tmp_path)
    desk.playback.matching.end()


def filled(page, qtbot, tmp_path):
    """The page with a plan of four matches."""
    qtbot.waitExposed(page)
    page.form.field("person").setText("Anna")
    page.form.field("frequencies").setText("60")
    page.form.field("places").setText("3; 12")
    page.form.table.setText(str(tmp_path / "matches.csv"))
    press(page, "arm")
    return page


def press(page, name):
    page.findChild(QPushButton, f"matching_{name}").click()


def begin(page, qtbot, name="begin"):
    press(page, name)
    qtbot.waitUntil(lambda: page.player.now is not None, timeout=20_000)


def is_stopped_at_once(stream):
    """Whether it is asked to stop, or has stopped already: it plays in a thread of its own."""
    return stream.queue.panic or stream.queue.ending.reason == "panic"


def test_arrow_keys_and_enter_make_a_row(sound, page, qtbot, tmp_path):
    begin(page, qtbot)
    start_db = page.run.level_db
    QTest.keyClick(page, Qt.Key.Key_Up)
    QTest.keyClick(page, Qt.Key.Key_Up)
    QTest.keyClick(page, Qt.Key.Key_Down)
    assert page.run.level_db == pytest.approx(start_db + 1.0)
    QTest.keyClick(page, Qt.Key.Key_Return)
    (row,) = rows_of(tmp_path / "matches.csv")
    assert row["person"] == "Anna"
    assert float(row["matched_db"]) == pytest.approx(start_db + 1.0)
    assert page.run.done == 1
    assert "Match 2 of 4" in page.view.progress.text()
    assert page.player.playing


def test_nothing_is_played_before_it_is_armed_and_disarming_stops_at_once(sound, page, qtbot):
    press(page, "arm")
    press(page, "begin")
    assert page.run is None
    press(page, "arm")
    begin(page, qtbot)
    stream = page.player.now.stream
    press(page, "arm")
    assert is_stopped_at_once(stream)
    QTest.keyClick(page, Qt.Key.Key_Space)
    assert not page.player.playing
    assert "Arm" in page.view.note.text()


def test_reference_and_test_are_lit_in_turn(sound, page, qtbot):
    begin(page, qtbot)
    lit_places = set()

    def both():
        lit_places.add(page.view.lit)
        return {"reference", "test"} <= lit_places

    qtbot.waitUntil(both, timeout=20_000)
    assert sound.streams[0].samples[:2].any()


def test_esc_stops_at_once_and_a_second_in_a_hurry_closes_nothing(sound, page, qtbot, monkeypatch):
    monkeypatch.setattr("skinsource_gui.pages.matching._HURRY_S", 60.0)  # also for a busy machine
    begin(page, qtbot)
    stream = page.player.now.stream
    QTest.keyClick(page, Qt.Key.Key_Escape)
    assert not page.player.playing
    assert is_stopped_at_once(stream)
    QTest.keyClick(page, Qt.Key.Key_Escape)
    assert page.isVisible()
    level_db, trial = page.run.level_db, page.run.trial
    for which in (Qt.Key.Key_Up, Qt.Key.Key_Return):
        QTest.keyClick(page, which)
    assert (page.run.level_db, page.run.trial) == (level_db, trial)
    QTest.keyClick(page, Qt.Key.Key_Space)
    qtbot.waitUntil(lambda: page.player.now is not None, timeout=20_000)
    QTest.keyClick(page, Qt.Key.Key_Up)
    assert page.run.level_db == pytest.approx(level_db + 1.0)


def test_without_a_device_it_is_a_rehearsal_and_nothing_is_stored(no_sound, page, qtbot, tmp_path):
    begin(page, qtbot)
    assert "Nothing is heard" in page.view.note.text()
    assert "nothing is stored" in page.view.note.text()
    QTest.keyClick(page, Qt.Key.Key_Return)
    assert page.run.done == 1
    assert not (tmp_path / "matches.csv").exists()


@pytest.mark.parametrize(
    ("name", "text", "reason"),
    [
        ("person", "", "person"),
        ("frequencies", "fifty", "is not a number"),
        ("places", "7.5", "whole numbers"),
        ("frequencies", "1e400", "Frequencies"),
    ],
)
def test_what_cannot_be_matched_is_said_and_nothing_begins(sound, page, name, text, reason):
    page.form.field(name).setText(text)
    press(page, "begin")
    assert reason in page.message.text()
    assert page.run is None
    assert not sound.streams


def test_a_table_that_cannot_be_written_stops_and_keeps_the_trial(sound, page, qtbot, tmp_path):
    page.form.table.setText(str(tmp_path / "nowhere" / "matches.csv"))
    begin(page, qtbot)
    trial = page.run.trial
    QTest.keyClick(page, Qt.Key.Key_Return)
    assert page.run.trial == trial
    assert "nowhere" in page.view.note.text()
    assert not page.player.playing


def test_the_rig_of_the_machine_holds_while_matching(sound, desk, qtbot, tmp_path):
    limits = Limits(peak_voltage_v=1e-3)
    channel = RigChannel(place=7, output=5, full_scale_v=1.0, limits=limits)
    save_rig(tmp_path / "bench.rig", Rig(channels=(channel,)))
    desk.playback.player.settings.choose_rig(tmp_path / "bench.rig")
    desk.playback.matching.show()
    page = desk.playback.matching.page
    page.form.field("person").setText("Anna")
    page.form.field("places").setText("7")
    press(page, "arm")
    press(page, "rehearse")
    qtbot.waitUntil(lambda: "rig" in page.view.note.text(), timeout=20_000)
    assert not page.player.playing
    desk.playback.matching.end()
