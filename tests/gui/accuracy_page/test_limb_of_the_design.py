"""The benchmark on the limb of the design: chosen beside the button that starts it."""

from dataclasses import replace

import pytest
from PySide6.QtWidgets import QComboBox, QLabel

from skinsource.method_comparison.compared_limb import limb_called
from skinsource.method_comparison.table import Row
from skinsource.own_limbs import facts_of
from skinsource_gui.accuracy_page.bench_table import BenchTable, verdict
from tests.core.own_limbs.lab_bench import installed
from tests.gui.accuracy_page.bench import find, hang, measure, press, words


@pytest.fixture
def own(window, page):
    """The design is on an own limb."""
    installed()
    choose_limb(window, "lab-1")
    return page


def choose_limb(window, name):
    digest = facts_of(name).digest
    design = replace(window.document.design, limb=name, limb_digest=digest)
    window.document.edit("Limb", design)


def choice(page):
    return find(page, QComboBox, "bench_limb")


def row(**changes):
    values = {"scene": "S7", "engine": "this program", "precision": "float64", "setting": "exact"}
    sizes = {"inputs": 7, "inputs_changed": 1, "samples": 8089, "reference": "S3"}
    found = {"t_min_ms": 2.0, "err_window": 1e-12, "err_silence": 0.0, "promise": "kept"}
    return Row(limb=limb_called("lab-1"), **{**values, **sizes, **found, **changes})


def test_made_up_responses_are_measured_unless_the_limb_is_chosen(window, own, child, qtbot):
    given = child("work").with_name("limb")
    assert [choice(own).itemText(k) for k in range(2)] == ["Made-up responses", "Lab 1"]
    measure(own, qtbot)
    assert given.read_text() == ""
    choice(own).setCurrentIndex(1)
    measure(own, qtbot)
    assert given.read_text() == "--limb lab-1"


def test_the_choice_follows_the_design(window, own):
    choice(own).setCurrentIndex(1)
    choose_limb(window, "synthetic-2")
    assert choice(own).currentText() == "Synthetic 2 (165 mm)"


def test_a_limb_that_is_another_one_is_one_sentence_and_nothing_is_started(own, qtbot):
    choice(own).setCurrentIndex(1)
    installed(hand_length_mm=150.0)
    press(own, "measure")
    assert words(own).startswith("The limb 'lab-1' here is another one than that of this design")
    assert not own.run.running
    choice(own).setCurrentIndex(0)
    press(own, "measure")
    assert own.run.running
    own.run.cancel()
    qtbot.waitUntil(lambda: not own.run.running, timeout=20_000)


def test_it_is_not_chosen_anew_while_it_is_measured(own, child, qtbot):
    hang(own, child, qtbot)
    assert not choice(own).isVisible()
    press(own, "cancel_measuring")
    qtbot.waitUntil(lambda: not own.run.running, timeout=20_000)
    assert choice(own).isVisible()


def test_table_verdict_and_figures_say_on_which_limb(own):
    table = BenchTable()
    table.show_rows([row()])
    assert table.index(0, 0).data() == "S7: 1 of 7 inputs changed, 2 s"
    assert verdict([row()]) == "This program keeps its promises in 1 of 1 rows on Lab 1."
    assert "rows on Lab 1; the first: S7" in verdict([row(promise="broken: late")])
    own._figures.show_rows([row()])
    assert find(own, QLabel, "now_window").text() == "1.0e-12 in the benchmark on Lab 1"
    assert find(own, QLabel, "now_silence").text() == "exactly 0 in the benchmark on Lab 1"
