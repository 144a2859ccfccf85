"""Lamps of validity: what they say, what they mend, what they cost."""

from dataclasses import replace
from itertools import groupby

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QPushButton, QWidget

from skinsource.design.edits.edit import Edit
from skinsource.perception.validity import Finding
from skinsource_gui.qt.theme import DARK, scaled
from skinsource_gui.shell.validity_lamps import ValidityCard, ValidityLamps, _lamp_text
from skinsource_gui.state.engine import FIRST_SLOT

FINDINGS = (
    Finding(name="band", state="left", sentence="Outside.", repair="band_limit"),
    Finding(name="drive", state="unknown", sentence="Unknown.", repair="probe_scaling"),
    Finding(name="noise", state="kept", sentence="Fine."),
    Finding(name="limb", state="left", sentence="Synthetic."),
)


def state_of(window, name):
    states = {finding.name: finding.state for finding in window.validity.lamps.findings}
    return states.get(name)


@pytest.fixture
def lamps(qtbot):
    lamps = ValidityLamps()
    qtbot.addWidget(lamps)
    lamps.show_findings(FINDINGS)
    return lamps


def test_a_lamp_is_called_in_its_explanation_as_beside_it():
    heads = [_lamp_text(finding).splitlines()[0] for finding in FINDINGS[:3]]
    assert heads == ["Band: caution", "Drive: unknown", "SNR: kept"]


def test_lamps_follow_the_size_of_letters_there_and_back(qtbot):
    host = QWidget()
    qtbot.addWidget(host)
    usual = host.font()
    host.setFont(scaled(usual, 2.0))
    lamps = ValidityLamps(host)
    lamps.show_findings(FINDINGS)
    large = lamps.sizeHint()
    host.setFont(usual)
    assert lamps.sizeHint().height() < 0.7 * large.height()
    host.setFont(scaled(usual, 2.0))
    assert lamps.sizeHint() == large


def test_lamps_are_explained_and_mended_with_one_click(window, qtbot):
    validity = window.validity
    qtbot.waitUntil(lambda: state_of(window, "drive") == "kept", timeout=30_000)
    document = window.document
    loud = document.design.with_input(0, amplitude=60.0)
    document.apply(Edit(label="Louder", design=loud, view=document.view))
    qtbot.waitUntil(lambda: state_of(window, "drive") == "left", timeout=30_000)
    place = next(p for lamp, p in validity.lamps.places if lamp.name == "drive")
    QTest.mouseClick(validity.lamps, Qt.MouseButton.LeftButton, pos=place.center().toPoint())
    card = window.findChild(ValidityCard)
    assert "mm/s" in card.findChild(QLabel, "validity_drive").text()
    card.findChild(QPushButton, "mend_drive").click()
    qtbot.waitUntil(lambda: state_of(window, "drive") == "kept", timeout=30_000)
    assert document.undo_stack.undoText() == "Play within 40 mm/s"
    qtbot.waitUntil(lambda: window.findChild(ValidityCard) is None)


def awaits(lamps):
    """Whether lamps are pale, or will be: they wait for what replaces them."""
    return lamps._staleness.is_stale or lamps._staleness._timer.isActive()


def test_lamps_are_pale_only_until_what_they_depend_on_is_judged_anew(window, qtbot, settle):
    lamps, document = window.validity.lamps, window.document
    qtbot.waitUntil(lambda: state_of(window, "drive") == "kept", timeout=30_000)
    settle()
    assert not awaits(lamps)
    window.do("store_snapshot_1")
    assert not awaits(lamps)
    document.look(replace(document.view, outputs=(3, 4)))
    assert not awaits(lamps)
    loud = document.design.with_input(0, amplitude=60.0)
    document.apply(Edit(label="Louder", design=loud, view=document.view))
    assert awaits(lamps)
    document.undo_stack.undo()
    assert not awaits(lamps)
    document.undo_stack.redo()
    assert awaits(lamps)
    qtbot.waitUntil(lambda: state_of(window, "drive") == "left", timeout=30_000)
    assert not awaits(lamps)


def test_hidden_lamps_cost_nothing_and_the_map_hatches_noise(window, qtbot, settle):
    qtbot.waitUntil(lambda: bool(window.validity.lamps.findings), timeout=30_000)
    runs = window.engine._graphs[FIRST_SLOT].runs
    before = runs["validity"]
    window.statusBar().hide()
    document = window.document
    quieter = document.design.with_input(0, amplitude=0.3)
    document.apply(Edit(label="Quieter", design=quieter, view=document.view))
    settle()
    window.validity._idle.timeout.emit()
    settle()
    assert runs["validity"] == before
    skin = window.panel("skin")
    plain = skin.map.grab().toImage()
    skin.show_noisy((67, 68, 61))
    hatched = skin.map.grab().toImage()
    assert hatched != plain
    skin.show_noisy(())
    assert skin.map.grab().toImage() == plain
    # What can be seen of it is in pictures too.
    before = skin.picture(300, 500)
    skin.show_noisy((67, 68, 61))
    assert skin.picture(300, 500) != before


def written_names(lamps):
    """Names of the lamps that have words."""
    return [lamp.name for lamp, place in lamps.places if place.width() > 9]


def test_lamps_have_words_as_there_is_room_and_the_worst_one_always(lamps, use_theme):
    assert [lamp.name for lamp in lamps.row.lamps] == ["band", "drive", "noise"]
    assert lamps.accessibleDescription() == "band: caution; drive: unknown; SNR: kept"
    assert lamps.accessibleName() == "Validity of the prediction: 1 caution"
    wide, narrow = lamps.sizeHint(), lamps.minimumSizeHint()
    rows = []
    for width in range(wide.width(), narrow.width() - 1, -1):
        lamps.resize(width, wide.height())
        rows.append(written_names(lamps))
        assert all(place.right() <= width for _, place in lamps.places)
    assert [group for group, _ in groupby(rows)] == [
        ["band", "drive", "noise"],
        ["band", "drive"],
        ["band"],
    ]
    lamps.show_findings(tuple(replace(finding, state="kept") for finding in FINDINGS))
    lamps.resize(lamps.minimumSizeHint())
    assert written_names(lamps) == []
    use_theme(DARK)
    lamps.grab()


def test_lamps_answer_the_keyboard_and_each_place(lamps, qtbot):
    lamps.resize(lamps.sizeHint())
    lamps.show()
    chosen = []
    lamps.chosen.connect(lambda name, place: chosen.append(name))
    QTest.keyClick(lamps, Qt.Key.Key_Return)
    for _, place in lamps.places:
        QTest.mouseClick(lamps, Qt.MouseButton.LeftButton, pos=place.center().toPoint())
    assert chosen == ["band", "band", "drive", "noise"]


def test_the_card_offers_a_button_only_where_something_can_be_done(qtbot):
    card = ValidityCard(FINDINGS, "band", None)
    card.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose, False)
    qtbot.addWidget(card)
    names = {button.objectName() for button in card.findChildren(QPushButton)}
    assert names == {"mend_band", "mend_drive"}
    card.open_above(QPoint(50, 500))
    card.grab()
    repairs = []
    card.repair_requested.connect(repairs.append)
    card.findChild(QPushButton, "mend_drive").click()
    assert repairs == [FINDINGS[1]]
