import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QComboBox, QLineEdit, QMenu

from skinsource.design.waveforms.pulses import Noise
from skinsource.design.waveforms.tones import Tone
from skinsource_gui.shell.playing import EscapeTwice
from tests.gui.analysis.analysis_bench import analysis

LEFT = Qt.MouseButton.LeftButton
SPACE, ESCAPE = Qt.Key.Key_Space, Qt.Key.Key_Escape


@pytest.fixture
def pressed(studio, monkeypatch, qtbot):
    """How often Space has played."""
    qtbot.waitUntil(studio.isActiveWindow)
    played = []
    studio.actions_by_name["play"].triggered.connect(lambda: played.append(1))
    monkeypatch.setattr(studio.playback.player, "_begin", lambda *_: None)
    return played


def test_space_plays_from_pictures_lists_and_cards_and_letters_choose_no_row(studio, pressed):
    for name in ("hand", "timeline"):
        studio.panel(name).setFocus()
        QTest.keyClick(QApplication.focusWidget(), SPACE)
    rows, table = studio.panel("library").rows, analysis(studio, "statistics").table
    card = studio.panel("compare").cards[0]
    for name, widget in (("analysis", table), ("compare", card), ("library", rows)):
        studio.docks[name].bring_forward()
        QTest.mouseClick(widget.viewport() if hasattr(widget, "viewport") else widget, LEFT)
        QTest.keyClick(widget, SPACE)
    assert len(pressed) == 5
    rows.go_to(1)
    QTest.keyClicks(rows, "bt")
    assert rows.currentIndex().row() == 1


def test_on_the_skin_map_space_selects_once_keys_are_used_there(studio, pressed):
    skin = studio.panel("skin")
    skin.setFocus()
    widget = QApplication.focusWidget()
    QTest.keyClick(widget, Qt.Key.Key_Down)
    QTest.keyClick(widget, SPACE)
    assert pressed == []
    assert len(studio.document.view.outputs) == 1
    QTest.mouseClick(widget.viewport() if hasattr(widget, "viewport") else widget, LEFT)
    QTest.keyClick(widget, SPACE)
    assert pressed == [1]


def test_a_space_that_is_typed_is_a_space(studio, pressed):
    line = QLineEdit(studio)
    line.show()
    line.setFocus()
    QTest.keyClicks(line, "a b")
    assert line.text() == "a b"
    assert pressed == []


def test_escape_twice_is_heard_wherever_the_keyboard_is(studio, qtbot):
    qtbot.waitUntil(studio.isActiveWindow)
    escape = EscapeTwice(studio)
    presses = []
    escape.pressed.connect(lambda: presses.append(1))
    escape.listen(True)

    def heard(*keys):
        for key in keys:
            QTest.keyClick(QApplication.focusWidget(), key)
        return len(presses)

    for times, name in enumerate(("hand", "timeline")):
        studio.panel(name).setFocus()
        assert (heard(ESCAPE), heard(ESCAPE)) == (times, times + 1)
    assert heard(ESCAPE, Qt.Key.Key_A, ESCAPE) == 2
    escape.listen(False)
    assert heard(ESCAPE, ESCAPE) == 2


def test_escape_twice_stops_what_plays(sound, studio, player, qtbot, listen):
    qtbot.waitUntil(studio.isActiveWindow)
    now = listen(loops=True)
    studio.panel("timeline").setFocus()
    widget = QApplication.focusWidget()
    QTest.keyClick(widget, ESCAPE)
    QTest.keyClick(widget, ESCAPE)
    qtbot.waitUntil(lambda: not player.playing, timeout=20_000)
    assert now.stream.queue.ending.reason == "panic"


@pytest.fixture
def kind(studio, pressed):
    field = studio.panel("inspector").findChild(QComboBox, "kind_field")
    field.setFocus()
    return field


def choose(kind, name):
    menu = next(menu for menu in kind.findChildren(QMenu, "kind_menu") if menu.isVisible())
    menu.setActiveAction(next(action for action in menu.actions() if name in action.text()))
    QTest.keyClick(menu, Qt.Key.Key_Return)


def test_space_plays_after_a_list_was_clicked_and_opens_one_reached_by_key(studio, pressed, kind):
    QTest.mouseClick(kind, LEFT)
    choose(kind, "Noise")
    assert isinstance(studio.document.design.inputs[0].clips[0].waveform, Noise)
    kind = studio.panel("inspector").findChild(QComboBox, "kind_field")
    assert kind.hasFocus()
    QTest.keyClick(kind, SPACE)
    QTest.keyClick(kind, SPACE)
    assert pressed == [1, 1]
    studio.panel("hand").setFocus()
    kind.setFocus()
    for name in ("Chirp", "Tone"):
        QTest.keyClick(kind, SPACE)
        choose(kind, name)
    assert pressed == [1, 1]
    assert isinstance(studio.document.design.inputs[0].clips[0].waveform, Tone)


def test_space_plays_once_a_place_is_chosen_from_a_list_that_was_clicked(studio, pressed, qtbot):
    place = studio.panel("inspector").findChild(QComboBox, "location_field")
    QTest.mouseClick(place, LEFT)
    QTest.keyClick(place.view(), Qt.Key.Key_Return)
    studio.activateWindow()
    qtbot.waitUntil(place.hasFocus)
    QTest.keyClick(place, SPACE)
    assert pressed == [1]
