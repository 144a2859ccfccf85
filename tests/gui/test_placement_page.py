"""The page that places actuators: its question, ranked layouts, and the target that takes one."""

import numpy as np
import pytest
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QPushButton

from skinsource import Design, View, edits, inverse
from skinsource.base.job import stop_if
from skinsource.design.target import target_in
from skinsource.inverse.placement import FINGERTIPS
from skinsource_gui.pages import placement as page_module
from skinsource_gui.pages.placement import PlacementPage
from skinsource_gui.state.preferences import InstalledLimbs

PLAIN = Design(limb="synthetic-1")
PEOPLE = tuple(f"synthetic-{k}" for k in range(1, 5))


def painted(*outputs):
    return edits.paint_target(PLAIN, View(), list(outputs)).design


@pytest.fixture
def open_page(make_desk, qtbot):
    def open_it(design=PLAIN):
        desk = make_desk(design)
        limbs = InstalledLimbs(PEOPLE, desk.document, desk)
        page = PlacementPage(desk.runner, limbs, desk.document, desk)
        page.open()
        page.desk = desk
        return page

    return open_it


def settle(page, qtbot):
    qtbot.waitUntil(lambda: not page.run.busy, timeout=30_000)


def button(page, name):
    return page.findChild(QPushButton, name)


def test_layouts_for_what_is_painted_are_ranked_with_their_loss_on_each_limb_and_copied(
    open_page, qtbot
):
    page = open_page(painted(30))
    settle(page, qtbot)
    found = inverse.place("synthetic-1", [30], 3)
    assert page.of.value == "strong"
    assert page.table.rowCount() == len(found.ranked)
    for row, each in enumerate(found.ranked):
        losses = [inverse.layout(name, [30], each.inputs).loss_db for name in PEOPLE]
        numbers = [each.score_db, each.loss_db, *losses]
        texts = [page.table.item(row, k).text() for k in range(page.table.columnCount())]
        assert texts[0] == ", ".join(map(str, each.inputs))
        assert texts[2:] == [f"{number:.1f}".replace("-", "−") for number in numbers]
    assert page.message.text().startswith("Every set was tried. ")
    button(page, "copy_layouts").click()
    heads, first, *_ = QApplication.clipboard().text().splitlines()
    values = dict(zip(heads.split("\t"), first.split("\t"), strict=True))
    there = inverse.layout("synthetic-2", [30], found.inputs)
    assert float(values["Score on Synthetic 2, dB"]) == there.score_db
    assert float(values["Loss on Synthetic 2, dB"]) == there.loss_db


def test_the_chosen_layout_is_on_the_hand_and_compared_with_the_best_of_each_limb(open_page, qtbot):
    page = open_page(painted(30))
    settle(page, qtbot)
    best_db = [inverse.place(name, [30], 3).score_db for name in PEOPLE]
    ranked = page.answer.placement.ranked
    for row, each in ((0, ranked[0]), (len(ranked) - 1, ranked[-1])):
        page.table.selectRow(row)
        assert tuple(mark.site for mark in page.hand.stage.state.marks) == each.inputs
        there = [inverse.layout(name, [30], each.inputs).score_db for name in PEOPLE]
        behind_db = max(np.subtract(best_db, there))
        assert f"at most {behind_db:.1f} dB below the best" in page.message.text()


def test_without_a_target_it_asks_for_the_fingertips_and_typed_outputs_are_a_path(open_page, qtbot):
    page = open_page()
    assert (page.of.value, page.which.value) == ("tips", FINGERTIPS)
    page.which.line.setFocus()
    page.which.line.selectAll()
    QTest.keyClicks(page.which.line, "32, 33, 30")
    settle(page, qtbot)
    assert page.of.value == "path"
    found = inverse.place("synthetic-1", [32, 33, 30], 3)
    assert page.answer.placement == found
    button(page, "use_inputs").click()
    target = target_in(page.desk.document.design)[1]
    assert (target.strong, target.inputs) == ((32, 33, 30), found.inputs)


def test_a_path_starts_with_the_strong_outputs(open_page, qtbot):
    page = open_page(painted(30, 32))
    page.of.set_value("path")
    page.of.edited.emit("path", 1)
    assert page.which.value == (30, 32)


def test_the_layout_can_be_good_for_all_limbs_and_have_more_inputs(open_page, qtbot):
    page = open_page(painted(30))
    page.on.set_value("people")
    page.count.set_value(16)
    page.ask()
    settle(page, qtbot)
    assert "different fingertips" in page.message.text()
    page.pairs.click()
    settle(page, qtbot)
    found = inverse.place(PEOPLE, [30], 16, keep_apart=False)
    assert page.answer.placement == found
    assert "a better set may exist" in page.message.text()


def test_the_target_takes_the_chosen_inputs_in_one_step(open_page, qtbot):
    page = open_page(painted(30))
    settle(page, qtbot)
    page.table.selectRow(1)
    inputs = page.answer.placement.ranked[1].inputs
    document = page.desk.document
    button(page, "use_inputs").click()
    target = target_in(document.design)[1]
    assert (target.strong, target.inputs) == ((30,), inputs)
    document.undo_stack.undo()
    assert target_in(document.design)[1].inputs == ()


@pytest.mark.parametrize("how", ["stop", "close"])
def test_placing_ends_when_nobody_wants_it_any_more(open_page, qtbot, monkeypatch, how):
    def never_ending(*_, stop, **__):
        while True:
            stop_if(stop)

    monkeypatch.setattr(page_module, "place", never_ending)
    page = open_page(painted(30))
    assert button(page, "find_places").text() == "Stop"
    button(page, "find_places" if how == "stop" else "close_page").click()
    runner = page.desk.runner
    qtbot.waitUntil(lambda: not runner.busy, timeout=30_000)
    if how == "stop":
        assert page.message.text() == "Stopped."
        assert button(page, "find_places").text() == "Find"
