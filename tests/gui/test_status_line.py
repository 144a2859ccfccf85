"""What the status bar tells of results, times and error; notices; the chip of conditions."""

from dataclasses import replace
from itertools import pairwise

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel, QPushButton

from skinsource.design.design import track
from skinsource.design.edits.edit import Refusal
from skinsource.design.panel_settings import with_settings
from skinsource.design.waveforms import Chirplet
from skinsource.perception.validity import Finding
from skinsource_gui.panels.skin.settings import SENSATION, SkinSettings
from skinsource_gui.shell import notices
from skinsource_gui.shell.conditions import ConditionsCard, ConditionsChip, chip_text
from skinsource_gui.shell.status import summary
from skinsource_gui.state.engine import FIRST_SLOT
from tests.gui.shared_window import rest


@pytest.fixture
def wait_for(window, qtbot):
    """Wait until the status line has a text."""
    return lambda text: qtbot.waitUntil(lambda: window.status_line.text() == text, timeout=10_000)


def edit(window, **changes):
    window.document.edit("a", window.document.design.with_input(0, **changes))


SHOWN = "Predicted acceleration, back of the hand"


def test_the_middle_says_what_the_skin_shows_and_how_many_inputs_are_felt(window, wait_for):
    wait_for(SHOWN)
    inputs = (track(location=3, muted=True), track(location=4, colour=1))
    window.document.edit("a", replace(window.document.design, inputs=inputs))
    wait_for(f"{SHOWN} · 1 of 2 inputs play")
    view, settings = window.document.view, SkinSettings(quantity=SENSATION)
    window.document.look(with_settings(view, "skin", settings))
    wait_for("Predicted sensation level, back of the hand · 1 of 2 inputs play")
    # Above half the rate nothing can be played.
    inputs = (track(3), track(4, Chirplet(600.0), colour=1), track(5, muted=True, colour=2))
    window.document.edit("a", replace(window.document.design, inputs=inputs))
    wait_for("Predicted sensation level, back of the hand · 1 of 3 inputs play")
    window.document.edit("a", replace(window.document.design, inputs=()))
    wait_for("No input yet")


def test_while_results_are_awaited_it_says_so(window, wait_for, monkeypatch):
    edit(window, amplitude=2.0)
    wait_for(SHOWN)
    asked = []
    with monkeypatch.context() as patch:
        patch.setattr(window.engine, "request", asked.append)
        edit(window, amplitude=3.0)
        wait_for(f"{SHOWN} · computing…")
    window.engine.request(asked[-1])
    wait_for(SHOWN)


def test_a_message_is_shown_in_the_middle_and_goes_while_the_chip_stays(window, wait_for):
    chip = window.conditions.chip
    assert chip.x() < window.status_line.x() < 200
    window.reports.report("Snapshot 1 is shown")
    assert window.status_line.text() == "Snapshot 1 is shown"
    assert chip.isVisible()
    window.statusBar().clearMessage()
    wait_for(SHOWN)


def test_a_long_message_stays_longer_and_is_shown_whole(window, monkeypatch):
    stays, bar, show = [], window.statusBar(), window.statusBar().showMessage
    monkeypatch.setattr(bar, "showMessage", lambda text, ms: stays.append(ms) or show(text, ms))
    texts = "Stored", "Stored snapshot 2 in place of another, which Undo brings back", "Word " * 80
    for text in texts:
        window.reports.report(text)
        assert text in (window.status_line.text(), window.notice.text)
    assert 4000 < stays[0] < 5000 < stays[1] < stays[2]
    assert bar.currentMessage() == ""


def test_times_are_summed_up_by_median_95_percent_and_slowest():
    seconds = (0.004, 0.008, 0.3)
    assert summary(seconds) == "Last 3 edits: median 8.0 ms, 95 % within 300 ms, slowest 300 ms."
    assert summary(()) == ""
    assert "95 % within 95 ms" in summary(tuple(k * 1e-3 for k in range(1, 101)))


def test_nothing_in_the_status_bar_is_clipped(window, wait_for):
    window.resize(1366, 768)
    edit(window, amplitude=2.0)
    wait_for(SHOWN)
    QApplication.processEvents()
    shown = window.conditions.chip, window.status_line, window._get_limbs
    assert window.statusBar().height() <= 24
    places = sorted((label.mapTo(window, QPoint()).x(), label.width()) for label in shown)
    for (left, width), (following, _) in pairwise(places):
        assert left + width <= following


LONG = "A long reason that goes on and on. " * 20


def shown_docks(window):
    return [dock for dock in window.docks.values() if dock.isVisible()]


def test_a_notice_that_stays_is_a_card_over_the_map_and_moves_nothing(window, settle):
    places = [dock.geometry() for dock in shown_docks(window)]
    window.reports.complain(LONG)
    settle()
    card, label = window.notice.card, window.findChild(QLabel, "notice_text")
    assert label.isVisible()
    assert label.height() >= label.heightForWidth(label.width())
    assert card.geometry().left() <= 10
    assert card.geometry().bottom() < window.statusBar().y()
    assert card.geometry().top() > window.menuWidget().height()
    assert window.docks["skin"].geometry().intersects(card.geometry())
    colours = window.panel("skin").colour_bar
    assert card.geometry().bottom() < colours.mapTo(window, QPoint()).y()
    assert [dock.geometry() for dock in shown_docks(window)] == places
    window.notice.be_quiet()
    assert not card.isVisible()


def test_a_notice_that_passes_moves_nothing_and_lies_over_the_status_bar(window, settle):
    places = [dock.geometry() for dock in shown_docks(window)]
    window.reports.refuse("That cannot be.")
    settle()
    assert [dock.geometry() for dock in shown_docks(window)] == places
    assert window.notice.card.geometry() == window.statusBar().geometry()


def test_a_notice_while_presenting_is_one_line_high_in_the_largest_letters(window, settle):
    window.appearance._scale_text(3.0)
    try:
        window.do("present")
        window.showNormal()
        window.resize(1366, 768)
        settle()
        window.reports.report("Scene 19 of 19: 5F · Separate and joint")
        label = window.findChild(QLabel, "notice_text")
        assert label.isVisible()
        assert label.height() < 2 * label.fontMetrics().lineSpacing()
    finally:
        window.appearance.reset_text()


def test_a_notice_goes_away_with_the_next_edit_but_not_with_a_look(window):
    window.reports.complain("Something went wrong")
    window.do("remove_delay")
    assert window.notice.text == "Something went wrong"
    window.do("mute_input")
    assert window.notice.text == ""


def test_what_is_offered_is_done_once_and_the_notice_goes(window):
    done = []
    window.notice.say("Open it?", choices=(("Open", lambda: done.append("open")),))
    button = window.findChild(QPushButton, "notice_choice")
    assert window.notice.card.geometry().contains(
        button.mapTo(window, QPoint(button.width() // 2, button.height() // 2))
    )
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    assert done == ["open"]
    assert window.notice.text == ""
    window.notice.say("Something else")
    assert not [
        button for button in window.findChildren(QPushButton, "notice_choice") if button.isVisible()
    ]


def refusal(window, qtbot, stands_ms):
    """A refusal that has stood for so long."""
    window.document.apply(Refusal(sentence="That cannot be."))
    timer = window.notice._passing
    assert window.notice.text == "That cannot be."
    timer.start(timer.interval())
    qtbot.waitUntil(lambda: timer.interval() - timer.remainingTime() >= stands_ms)
    return timer


def test_a_refusal_goes_by_itself_after_time_to_read_it(window, qtbot):
    timer = refusal(window, qtbot, 0)
    assert timer.interval() >= 4000
    timer.start(1)
    qtbot.waitUntil(lambda: window.notice.text == "")


def test_a_refusal_goes_with_the_next_click_but_not_with_the_one_that_caused_it(window, qtbot):
    below = window.panel("hand")
    refusal(window, qtbot, 0)
    QTest.mouseClick(below, Qt.MouseButton.LeftButton, pos=QPoint(3, 3))
    assert window.notice.text == "That cannot be."
    refusal(window, qtbot, notices._FRESH_MS)
    QTest.mouseClick(below, Qt.MouseButton.LeftButton, pos=QPoint(3, 3))
    assert window.notice.text == ""


def test_what_failed_stays_through_clicks_also_after_a_refusal(window, qtbot):
    refusal(window, qtbot, notices._FRESH_MS)
    window.reports.complain("The disk is full.")
    QTest.mouseClick(window.panel("hand"), Qt.MouseButton.LeftButton, pos=QPoint(3, 3))
    assert window.notice.text == "The disk is full."
    assert not window.notice._passing.isActive()


FINDINGS = (
    Finding(name="band", state="left", sentence="Outside.", repair="band_limit"),
    Finding(name="drive", state="unknown", sentence="Unknown.", repair="probe_scaling"),
    Finding(name="noise", state="kept", sentence="Fine.", outputs=(1, 2, 3, 4, 5)),
    Finding(name="limb", state="left", sentence="Synthetic."),
)


def state_of(window, name):
    states = {finding.name: finding.state for finding in window.conditions.chip.findings}
    return states.get(name)


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


def test_the_hint_of_the_chip_has_one_line_before_anything_is_found(qtbot):
    chip = ConditionsChip()
    qtbot.addWidget(chip)
    assert chip.toolTip() == "Click to see what can be done."


@pytest.mark.parametrize("by_key", [False, True])
def test_conditions_are_explained_and_repaired_from_the_chip(new_window, qtbot, by_key):
    chip = new_window.conditions.chip
    qtbot.waitUntil(lambda: state_of(new_window, "drive") == "kept", timeout=30_000)
    edit(new_window, amplitude=60.0)
    qtbot.waitUntil(lambda: state_of(new_window, "drive") == "left", timeout=30_000)
    if by_key:
        chip.setFocus()
        QTest.keyClick(chip, Qt.Key.Key_Space)
    else:
        QTest.mouseClick(chip, Qt.MouseButton.LeftButton)
    card = new_window.findChild(ConditionsCard)
    assert "mm/s" in card.findChild(QLabel, "validity_drive").text()
    card.findChild(QPushButton, "mend_drive").click()
    qtbot.waitUntil(lambda: state_of(new_window, "drive") == "kept", timeout=30_000)
    assert new_window.document.undo_stack.undoText() == "Limit to 40 mm/s"
    qtbot.waitUntil(lambda: new_window.findChild(ConditionsCard) is None)


def test_noisy_outputs_are_offered_to_be_deselected_only_where_one_is_selected(new_window):
    noise = replace(FINDINGS[2], state="left", repair="deselect", outputs=(61,))
    new_window.conditions.chip.show_findings((noise,))
    new_window.conditions._explain()
    assert new_window.findChild(ConditionsCard).findChild(QPushButton) is None


def awaits(chip):
    """Whether it is pale, or will be: it waits for what replaces its findings."""
    return chip._staleness.is_stale or chip._staleness._timer.isActive()


def test_findings_are_pale_only_until_what_they_depend_on_is_judged_anew(new_window, qtbot):
    chip, document = new_window.conditions.chip, new_window.document
    qtbot.waitUntil(lambda: state_of(new_window, "drive") == "kept", timeout=30_000)
    rest(new_window)
    assert not awaits(chip)
    new_window.do("store_snapshot_1")
    document.look(replace(document.view, outputs=(3, 4)))
    assert not awaits(chip)
    edit(new_window, amplitude=60.0)
    assert awaits(chip)
    document.undo_stack.undo()
    assert not awaits(chip)
    document.undo_stack.redo()
    qtbot.waitUntil(lambda: state_of(new_window, "drive") == "left", timeout=30_000)
    assert not awaits(chip)


def test_a_hidden_window_costs_nothing_and_the_map_hatches_noise(new_window, qtbot):
    qtbot.waitUntil(lambda: bool(new_window.conditions.chip.findings), timeout=30_000)
    runs = new_window.engine._graphs[FIRST_SLOT].runs
    before = runs["validity"]
    new_window.hide()
    edit(new_window, amplitude=0.3)
    rest(new_window)
    new_window.conditions._idle.timeout.emit()
    rest(new_window)
    assert runs["validity"] == before
    skin = new_window.panel("skin")
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
