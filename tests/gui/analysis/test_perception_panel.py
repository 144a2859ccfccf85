"""Levels above threshold, in their panel and on the map; the table of regions."""

from dataclasses import replace

import numpy as np
import pytest

from skinsource import Design, decibels, evaluate, track
from skinsource.design.comparing import region_levels_db
from skinsource.design.design import Snapshot
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.engine.analysis_rules import Sensation
from skinsource.perception.thresholds import LIMITS, PerceptionSettings
from skinsource.signals.analysis.wave_speed import travelling_wave
from skinsource_gui.panels.analysis.perception import (
    contact_list,
    contact_table,
    contact_text,
    rows,
    table_text,
)
from skinsource_gui.panels.analysis.regions import columns_of_people
from skinsource_gui.panels.analysis.regions import table_text as table_of_regions
from skinsource_gui.panels.analysis.table import OutputTable, TableRow
from skinsource_gui.panels.analysis.wave import wave_text
from skinsource_gui.panels.skin.map import numbers_text
from skinsource_gui.panels.skin.settings import SkinSettings
from skinsource_gui.state.compared import Compared
from tests.gui.analysis.analysis_bench import analysis, copied

OUTPUTS = (29, 33, 57)


def test_the_panel_shows_levels_limits_and_the_contact(window, settle, tmp_path):
    document = window.document
    document.look(replace(document.view, outputs=OUTPUTS))
    analysis(window, "perception")
    settle()
    panel = window.panel("analysis").view
    assert panel.table.model().rowCount() == 3
    assert panel.limits.text() == f"{LIMITS} Only 25 to 600 Hz counts."
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
    panel.model.click()
    settle()
    assert panel.table.model().columnCount() == 5


@pytest.mark.parametrize("style", ["interpolated", "sensors"])
def test_the_map_shows_levels_above_threshold_with_their_limits(window, settle, style):
    document, skin = window.document, window.panel("skin")
    level = skin.content.values
    settings = SkinSettings(quantity="sensation", map_style=style)
    document.look(with_settings(document.view, "skin", settings))
    settle()
    assert skin.content.values is not level
    assert (skin.content.field_values is None) == (style == "sensors")
    assert "people differ" in skin.note.toolTip()
    assert "threshold" in skin.content.quantity.unit
    skin.picture(300, 500)
    assert numbers_text(skin.content).startswith("output\tplace\tabove_threshold_db\n")
    document.edit("Scaling", replace(document.design, scaling="upstream"))
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
    assert all(
        "from its first to its last motion: " in contact_text(each) for each in (few, weighted)
    )
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
    _, silent, loud = (line.split("\t") for line in table_text(sensation, (1, 2)).splitlines())
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
OUT_OF_STEP = "No speed: delays do not grow with the distance"


@pytest.mark.parametrize(
    ("changes", "begin"),
    [
        ({}, "Speed 10.0 ± "),
        # A speed that is less sure than itself is none.
        ({"speed_m_per_s": 688.1, "speed_deviation_m_per_s": 3090.9}, OUT_OF_STEP),
        ({"speed_m_per_s": -20.0, "speed_deviation_m_per_s": 30.0}, "No speed"),
        ({**NOTHING, "straight": 0.2}, "No speed: the selected outputs do not form a line · att"),
        ({**NOTHING, "explained": 0.4}, OUT_OF_STEP),
        (NOTHING, "No speed: farther outputs are not reached later"),
    ],
)
def test_a_speed_is_said_only_where_delays_grow_with_the_way(changes, begin):
    assert wave_text(replace(the_wave(), **changes)).startswith(begin)


def test_one_output_above_the_noise_has_neither_speed_nor_attenuation():
    counted = np.array([True, False, False, False])
    text = wave_text(replace(the_wave(), counted=counted, timed=counted))
    assert text == "fewer than two outputs are more than noise"


def test_people_and_snapshots_stand_side_by_side_and_cost_nothing_while_hidden(
    window, qtbot, settle
):
    document, graphs = window.document, window.engine._graphs
    settle()
    assert not any("limb" in slot for slot in graphs)
    panel = analysis(window, "regions")
    qtbot.waitUntil(lambda: len(panel.columns) == 6, timeout=60_000)
    titles = [column.title for column in panel.columns]
    assert titles == [*(f"Synthetic {number}" for number in range(1, 5)), "Mean", "± dB"]
    people = []
    for k in range(1, 5):
        design = document.design.__class__(limb=f"synthetic-{k}", inputs=document.design.inputs)
        rms = evaluate(design, "output_rms", view=document.view)["output_rms"]
        people.append(list(region_levels_db(rms).values()))
    for column, expected in zip(panel.columns, people, strict=False):
        assert column.numbers == pytest.approx(expected, abs=1e-6)
    assert panel.columns[4].numbers == pytest.approx(np.mean(people, axis=0), abs=1e-6)
    assert panel.columns[5].numbers == pytest.approx(np.std(people, axis=0, ddof=1), abs=1e-6)
    document.look(replace(document.view, levels_matched=False))
    window.do("store_snapshot_1")
    document.edit("Louder", document.design.with_input(0, amplitude=2.0))
    window.do("store_snapshot_2")
    qtbot.waitUntil(lambda: len(panel.columns) == 8, timeout=60_000)
    settle()
    qtbot.waitUntil(
        lambda: np.isfinite([column.numbers for column in panel.columns]).all(), timeout=60_000
    )
    quiet, second = panel.columns[0].numbers, panel.columns[1].numbers
    assert np.subtract(second, quiet) == pytest.approx(np.full(len(quiet), 6.0206), abs=1e-3)
    assert panel.table.columnCount() == 8
    dock = window.docks["analysis"]
    dock.setFloating(True)
    dock.resize(900, 420)
    qtbot.waitUntil(
        lambda: (
            not panel.table.horizontalScrollBar().maximum()
            and dock.widget().verticalScrollBar().maximum() == 0
        )
    )
    dock.setFloating(False)
    dock.bring_forward()
    # What comes into sight anew is computed anew, and cannot be copied until it is there.
    qtbot.waitUntil(window.panel("analysis").copy.isEnabled, timeout=60_000)
    assert copied(window).splitlines()[1].startswith("Digit I\t")
    assert "RMS in dB re 1 m/s²" in panel.about.whole
    panel.grab()
    window.docks["analysis"].toggleViewAction().trigger()
    settle()
    qtbot.waitUntil(lambda: "limb synthetic-3" not in graphs)
    document.edit("Quieter", document.design.with_input(0, amplitude=0.1))
    settle()
    assert not any("limb" in slot for slot in graphs)


def test_matched_levels_of_snapshots_are_said_above_the_table_and_never_copied(
    window, qtbot, settle
):
    document = window.document
    panel = analysis(window, "regions")
    document.look(replace(document.view, levels_matched=True))
    settle()
    assert "levels matched" not in panel.about.whole
    window.do("store_snapshot_1")
    document.edit("Louder", document.design.with_input(0, amplitude=2.0))
    window.do("store_snapshot_2")

    qtbot.waitUntil(window.panel("analysis").copy.isEnabled, timeout=12_000)
    qtbot.waitUntil(lambda: "−6.0 dB" in panel.columns[1].hint, timeout=12_000)
    assert "snapshots: 2: −6.0 dB, matched" in panel.about.whole
    assert panel.columns[0].numbers == pytest.approx(panel.columns[1].numbers)
    text = copied(window)
    assert text.splitlines()[0].split("\t")[1:4] == ["1, synthetic", "2, synthetic", "Synthetic 1"]
    quiet, second = np.array([row.split("\t")[1:3] for row in text.splitlines()[1:3]], float).T
    assert second - quiet == pytest.approx(20.0 * np.log10(2.0))
    settle()
    assert "snapshots: 2: −6.0 dB, matched" in panel.about.whole
    window.do("match_levels")
    settle()
    assert "matched" not in panel.about.whole
    assert copied(window) == text


def test_silence_has_no_spread():
    def person(k, rms):
        snapshot = Snapshot(number=k, design=Design(limb=f"synthetic-{k}"))
        return Compared(snapshot=snapshot, values={"output_levels_db": decibels(rms)})

    quiet, loud = np.zeros(72), np.ones(72)
    *_, mean, spread = columns_of_people([person(1, quiet), person(2, quiet)])
    assert set(mean.texts()) == set(spread.texts()) == {"–"}
    copied = table_of_regions([mean, spread]).splitlines()[1:]
    assert {tuple(line.split("\t")[1:]) for line in copied} == {("", "")}
    *_, mean, spread = columns_of_people([person(1, loud), person(2, loud)])
    assert set(mean.texts()) == set(spread.texts()) == {"0.0"}


def test_what_is_copied_says_whether_limbs_were_measured_and_what_is_a_deviation():
    def person(limb):
        snapshot = Snapshot(number=1, design=Design(limb=limb, inputs=(track(7),)))
        return Compared(snapshot=snapshot, values={"output_levels_db": np.zeros(72)})

    people = [person(limb) for limb in ("measured-1", "measured-2", "synthetic-1")]
    head = table_of_regions(columns_of_people(people)).splitlines()[0]
    assert head.split("\t") == [
        "region_db_re_1_m_per_s2",
        "Limb 1, measured",
        "Limb 2, measured",
        "Synthetic 1",
        "Mean over 3 people",
        "Standard deviation over 3 people, dB",
    ]


@pytest.fixture
def figures(qtbot):
    """A table of names and of one number each, as wide as it is made."""
    table = OutputTable("figures", "Figures")
    qtbot.addWidget(table)
    rows = [
        TableRow(output=number, texts=(f"{number}  {name}", "0.123"))
        for number, name in ((8, "hand V"), (12, "IV middle ulnar"))
    ]
    table.show_rows((("Output", ""), ("RMS", "")), rows)
    table.resize(900, 200)
    table.show()
    qtbot.waitExposed(table)
    return table


def test_where_there_is_little_room_names_take_what_numbers_leave(figures, qtbot):
    header = figures.horizontalHeader()
    assert header.length() < 400
    figures.resize(120, 200)
    qtbot.waitUntil(lambda: header.length() == figures.viewport().width())
    assert header.sectionSize(0) == figures.viewport().width() - header.sectionSize(1)
    figures.resize(900, 200)
    qtbot.waitUntil(lambda: header.length() < 400)
