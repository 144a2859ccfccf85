"""The chip that says whether a design keeps the conditions of the measurement, and its card."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QPushButton

from skinsource.design.edits.edit import Edit
from skinsource.perception.validity import Finding
from skinsource_gui.shell.conditions import ConditionsCard, ConditionsChip, chip_text
from skinsource_gui.state.engine import FIRST_SLOT

FINDINGS = (
    Finding(name="band", state="left", sentence="Outside.", repair="band_limit"),
    Finding(name="drive", state="unknown", sentence="Unknown.", repair="probe_scaling"),
    Finding(name="noise", state="kept", sentence="Fine.", outputs=(1, 2, 3, 4, 5)),
    Finding(name="limb", state="left", sentence="Synthetic."),
)


@pytest.fixture
def window(new_window):
    """A studio of each test's own."""
    return new_window


def state_of(window, name):
    states = {finding.name: finding.state for finding in window.conditions.chip.findings}
    return states.get(name)


def edit(window, amplitude):
    document = window.document
    design = document.design.with_input(0, amplitude=amplitude)
    document.apply(Edit(label="Louder", design=design, view=document.view))


@pytest.mark.parametrize(
    ("states", "text"),
    [
        (("left", "unknown", "kept"), "⚠ Outside the measured band"),
        (("left", "kept", "left"), "⚠ Outside the measured band, 1 more"),
        (("kept", "kept", "left"), "⚠ 5 outputs near the noise"),
        (("kept", "unknown", "kept"), "✓ Within known limits"),
        (("kept", "kept", "kept"), "✓ Within measured limits"),
        ((), "Limits not checked"),
    ],
)
def test_the_chip_names_what_a_design_leaves(qtbot, states, text):
    findings = tuple(
        replace(finding, state=state) for finding, state in zip(FINDINGS, states, strict=False)
    )
    assert chip_text(findings) == text
    chip = ConditionsChip()
    qtbot.addWidget(chip)
    chip.show_findings(FINDINGS)
    assert chip.worst == "band"
    described = "frequency range: caution\nprobe velocity: unknown\nnoise: OK"
    assert chip.accessibleDescription() == described


@pytest.mark.parametrize("by_key", [False, True])
def test_conditions_are_explained_and_repaired_from_the_chip(window, qtbot, by_key):
    chip = window.conditions.chip
    qtbot.waitUntil(lambda: state_of(window, "drive") == "kept", timeout=30_000)
    edit(window, 60.0)
    qtbot.waitUntil(lambda: state_of(window, "drive") == "left", timeout=30_000)
    if by_key:
        chip.setFocus()
        QTest.keyClick(chip, Qt.Key.Key_Space)
    else:
        QTest.mouseClick(chip, Qt.MouseButton.LeftButton)
    card = window.findChild(ConditionsCard)
    assert "mm/s" in card.findChild(QLabel, "validity_drive").text()
    card.findChild(QPushButton, "mend_drive").click()
    qtbot.waitUntil(lambda: state_of(window, "drive") == "kept", timeout=30_000)
    assert window.document.undo_stack.undoText() == "Limit to 40 mm/s"
    qtbot.waitUntil(lambda: window.findChild(ConditionsCard) is None)


def awaits(chip):
    """Whether it is pale, or will be: it waits for what replaces its findings."""
    return chip._staleness.is_stale or chip._staleness._timer.isActive()


def test_findings_are_pale_only_until_what_they_depend_on_is_judged_anew(window, qtbot, settle):
    chip, document = window.conditions.chip, window.document
    qtbot.waitUntil(lambda: state_of(window, "drive") == "kept", timeout=30_000)
    settle()
    assert not awaits(chip)
    window.do("store_snapshot_1")
    document.look(replace(document.view, outputs=(3, 4)))
    assert not awaits(chip)
    edit(window, 60.0)
    assert awaits(chip)
    document.undo_stack.undo()
    assert not awaits(chip)
    document.undo_stack.redo()
    qtbot.waitUntil(lambda: state_of(window, "drive") == "left", timeout=30_000)
    assert not awaits(chip)


def test_a_hidden_window_costs_nothing_and_the_map_hatches_noise(window, qtbot, settle):
    qtbot.waitUntil(lambda: bool(window.conditions.chip.findings), timeout=30_000)
    runs = window.engine._graphs[FIRST_SLOT].runs
    before = runs["validity"]
    window.hide()
    edit(window, 0.3)
    settle()
    window.conditions._idle.timeout.emit()
    settle()
    assert runs["validity"] == before
    skin = window.panel("skin")
    plain = skin.map.grab().toImage()
    skin.show_noisy((67, 68, 61))
    assert skin.map.grab().toImage() != plain
    skin.show_noisy(())
    assert skin.map.grab().toImage() == plain
    # What can be seen of it is in pictures too.
    before = skin.picture(300, 500)
    skin.show_noisy((67, 68, 61))
    assert skin.picture(300, 500) != before


def test_the_card_offers_a_button_only_where_something_can_be_done(qtbot):
    card = ConditionsCard(FINDINGS, "band", None)
    card.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose, False)
    qtbot.addWidget(card)
    names = {button.objectName() for button in card.findChildren(QPushButton)}
    assert names == {"mend_band", "mend_drive"}
    card.open_above(QPoint(50, 500))
    repairs = []
    card.repair_requested.connect(repairs.append)
    card.findChild(QPushButton, "mend_drive").click()
    assert repairs == [FINDINGS[1]]
