"""The table of regions: snapshots, people, mean and spread, and what it costs."""

from dataclasses import replace

import numpy as np
import pytest

from skinsource import Design, decibels, evaluate, track
from skinsource.design.comparing import Snapshot, region_levels_db
from skinsource.design.edits.edit import Edit
from skinsource_gui.panels.analysis.regions import columns_of_people, table_text
from skinsource_gui.panels.analysis.table import OutputTable, TableRow
from skinsource_gui.state.compared import Compared
from skinsource_gui.state.engine import Slot
from tests.gui.analysis.analysis_bench import analysis, copied


def test_people_and_snapshots_stand_side_by_side_and_cost_nothing_while_hidden(
    window, qtbot, settle
):
    document, graphs = window.document, window.engine._graphs
    settle()
    assert not any("limb" in slot.name for slot in graphs)
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
    louder = document.design.with_input(0, amplitude=2.0)
    document.apply(Edit(label="Louder", design=louder, view=document.view))
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
    qtbot.waitUntil(lambda: Slot("limb synthetic-3") not in graphs)
    quieter = document.design.with_input(0, amplitude=0.1)
    document.apply(Edit(label="Quieter", design=quieter, view=document.view))
    settle()
    assert not any("limb" in slot.name for slot in graphs)


def test_matched_levels_of_snapshots_are_said_above_the_table_and_never_copied(
    window, qtbot, settle
):
    document = window.document
    panel = analysis(window, "regions")
    document.look(replace(document.view, levels_matched=True))
    settle()
    assert "levels matched" not in panel.about.whole
    window.do("store_snapshot_1")
    louder = document.design.with_input(0, amplitude=2.0)
    document.apply(Edit(label="Louder", design=louder, view=document.view))
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
    copied = table_text([mean, spread]).splitlines()[1:]
    assert {tuple(line.split("\t")[1:]) for line in copied} == {("", "")}
    *_, mean, spread = columns_of_people([person(1, loud), person(2, loud)])
    assert set(mean.texts()) == set(spread.texts()) == {"0.0"}


def test_what_is_copied_says_whether_limbs_were_measured_and_what_is_a_deviation():
    def person(limb):
        snapshot = Snapshot(number=1, design=Design(limb=limb, inputs=(track(7),)))
        return Compared(snapshot=snapshot, values={"output_levels_db": np.zeros(72)})

    people = [person(limb) for limb in ("measured-1", "measured-2", "synthetic-1")]
    head = table_text(columns_of_people(people)).splitlines()[0]
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
