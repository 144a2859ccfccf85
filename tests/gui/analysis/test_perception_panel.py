"""Levels above threshold: in their panel and on the map."""

from dataclasses import replace
from itertools import groupby

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QPushButton

from skinsource.design.edits.edit import Edit
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.engine.analysis_rules import Sensation
from skinsource.perception.sensation import LIMITS
from skinsource.perception.thresholds import PerceptionSettings
from skinsource.perception.validity import Finding
from skinsource.signals.analysis.wave_speed import travelling_wave
from skinsource_gui.panels.analysis.perception import (
    contact_list,
    contact_table,
    contact_text,
    rows,
    tab_separated,
)
from skinsource_gui.panels.analysis.wave import wave_text
from skinsource_gui.panels.skin.settings import SkinSettings
from skinsource_gui.qt.theme import DARK
from skinsource_gui.shell.validity_lamps import ValidityCard, ValidityLamps
from skinsource_gui.state.engine import FIRST_SLOT
from tests.gui.analysis.analysis_bench import analysis, copied

OUTPUTS = (29, 33, 57)


def test_the_panel_shows_levels_limits_and_the_contact(window, settle, tmp_path):
    document = window.document
    document.look(replace(document.view, outputs=OUTPUTS))
    analysis(window, "perception")
    settle()
    panel = window.panel("analysis").view
    assert panel.table.model().rowCount() == 3
    assert panel.limits.text() == f"{LIMITS} What lies from 25 to 600 Hz counts."
    assert "not perception" in panel.contact.text()
    assert "place 7" in panel.contact.text()
    numbers, contacts = copied(window).split("\n\n")
    lines = numbers.splitlines()
    assert [line.split("\t")[0] for line in lines] == ["output", "29", "33", "57"]
    labels = [line.split("\t")[0] for line in contacts.splitlines() if line[0] != "#"]
    assert labels == ["place", "7"]
    path = tmp_path / "mine.csv"
    path.write_text("frequency_hz,threshold_m_per_s2\n25,0.1\n600,0.1\n")
    panel.import_thresholds(path)
    settle()
    held = settings_of(document.view, "perception", PerceptionSettings)
    assert held.thresholds == ((25.0, 0.1), (600.0, 0.1))
    assert panel.table.model().columnCount() == 3
    assert "your table" in panel.limits.text()
    path.write_text("nonsense")
    messages = []
    panel.failed.connect(messages.append)
    panel.import_thresholds(path)
    assert "line 1" in messages[0]
    panel.model.click()
    settle()
    assert panel.table.model().columnCount() == 5
    document.look(replace(document.view, outputs=()))
    settle()
    assert not panel.table.isVisible()
    assert "on the skin map" in panel.message


@pytest.mark.parametrize("style", ["interpolated", "sensors"])
def test_the_map_shows_levels_above_threshold_with_their_limits(window, settle, style):
    document, skin = window.document, window.panel("skin")
    level = skin.content.values
    settings = SkinSettings(quantity="sensation", map_style=style)
    document.look(with_settings(document.view, "skin", settings))
    settle()
    assert skin.content.values is not level
    assert (skin.content.field_values is None) == (style == "sensors")
    assert skin.note.text().startswith("Thresholds are of glabrous skin")
    skin.note.resize(4000, 20)
    assert skin.note.shown == skin.note.text()
    skin.note.resize(300, 40)
    assert skin.note.shown.startswith(
        "Thresholds of glabrous skin: compare designs on one limb only."
    )
    assert "people differ" in skin.note.toolTip()
    assert "threshold" in skin.content.quantity.titles[0]
    skin.picture(300, 500)
    relative = replace(document.design, scaling="upstream")
    document.apply(Edit(label="Scaling", design=relative, view=document.view))
    settle()
    assert "Probe acceleration" in skin.content.message
    assert skin.content.coloured_values is None
    document.look(with_settings(document.view, "skin", SkinSettings()))
    settle()
    assert skin.content.message == ""
    assert skin.content.quantity.name == "levels"


def test_of_many_contacts_the_largest_is_said_and_all_are_listed():
    weighted = tuple((place, 0.5 + 0.1 * (place == 4)) for place in range(1, 21))
    text = contact_text(weighted)
    assert "largest 0.6 m\u2060/\u2060s² RMS at place 4, of 20 places" in text
    assert contact_list(weighted).count("place ") == 20
    assert contact_table(weighted).splitlines()[5] == "4\t0.6"
    few = weighted[:2]
    assert "place 1: 0.5 m\u2060/\u2060s², place 2: 0.5" in contact_text(few)
    assert contact_list(few) == ""
    assert contact_table(None) == contact_table(()) == contact_text(()) == ""


def test_what_is_not_felt_has_no_strength():
    levels = {"P": np.array([-200.0, 12.0]), "NP I": np.array([-200.0, 3.0])}
    sensation = Sensation(
        level_db=np.array([-200.0, 12.0]), by_channel=levels, strength=np.array([0.0, 1.5])
    )
    silent, loud = rows(sensation, (1, 2))
    assert silent.texts[1:] == ("–",) * 4
    assert loud.texts[1:] == ("12.0", "12.0", "3.0", "1.5")
    _, silent, loud = (line.split("\t") for line in tab_separated(sensation, (1, 2)).splitlines())
    assert silent[2:] == [""] * 4
    assert loud[2:] == ["12.0", "12.0", "3.0", "1.5"]


def test_why_a_table_was_refused_is_said_until_thresholds_are_taken(window, settle, tmp_path):
    panel = analysis(window, "perception")
    wrong, right = tmp_path / "wrong.csv", tmp_path / "right.csv"
    wrong.write_text("nonsense")
    right.write_text("frequency_hz,threshold_m_per_s2\n25,0.1\n600,0.1\n")
    for repair, source in (
        (lambda: panel.import_thresholds(right), "right.csv"),
        (panel.model.click, "the model"),
    ):
        panel.import_thresholds(wrong)
        settle()
        assert "line 1" in window.notice.text
        repair()
        assert window.notice.text == ""
        assert window.statusBar().currentMessage() == f"Thresholds are those of {source}"


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


def test_lamps_are_pale_only_until_what_they_depend_on_is_judged_anew(window, qtbot):
    lamps, document = window.validity.lamps, window.document
    qtbot.waitUntil(lambda: state_of(window, "drive") == "kept", timeout=30_000)
    qtbot.waitUntil(lambda: not awaits(lamps), timeout=30_000)
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


def the_wave():
    """A tone burst that passes four points at 10 m/s."""
    rate, way_mm = 4000.0, np.array([0.0, 20.0, 40.0, 60.0])
    time = np.arange(2000) / rate
    burst = [np.exp(-(((time - 0.2 - d / 1e4) * 60.0) ** 2)) for d in way_mm]
    carried = [
        b * np.sin(2 * np.pi * 150.0 * (time - d / 1e4)) for b, d in zip(burst, way_mm, strict=True)
    ]
    return travelling_wave(np.array(carried), way_mm, rate)


NOTHING = {"speed_m_per_s": np.nan, "speed_deviation_m_per_s": np.nan}
OUT_OF_STEP = "No speed: delays do not grow in step with the distance"


@pytest.mark.parametrize(
    ("changes", "begin"),
    [
        ({}, "Speed 10.0 ± "),
        # A speed that is less sure than itself is none.
        ({"speed_m_per_s": 688.1, "speed_deviation_m_per_s": 3090.9}, OUT_OF_STEP),
        ({"speed_m_per_s": -20.0, "speed_deviation_m_per_s": 30.0}, "No speed"),
        ({**NOTHING, "straight": 0.2}, "No speed: the selected outputs do not go one way · att"),
        ({**NOTHING, "explained": 0.4}, OUT_OF_STEP),
        (NOTHING, "No speed: the arrival is not later farther away"),
    ],
)
def test_a_speed_is_said_only_where_delays_grow_with_the_way(changes, begin):
    assert wave_text(replace(the_wave(), **changes)).startswith(begin)


def test_one_output_above_the_noise_has_neither_speed_nor_attenuation():
    counted = np.array([True, False, False, False])
    text = wave_text(replace(the_wave(), counted=counted, timed=counted))
    assert text == "fewer than two outputs are more than noise"


def test_a_line_through_two_outputs_is_said_to_have_no_uncertainty():
    assert "two outputs: no uncertainty" not in wave_text(the_wave())
    two = replace(
        the_wave(),
        timed=np.array([True, True, False, False]),
        speed_deviation_m_per_s=float("nan"),
    )
    assert wave_text(two).startswith("Speed 10.0 m/s ")
    assert wave_text(two).endswith("two outputs: no uncertainty")
