"""Lamps and buttons that belong to an older design."""

from skinsource_gui.qt.questions import CopyButton
from skinsource_gui.shell.validity_lamps import ValidityLamps, _lamp_text
from tests.gui.analysis.test_validity_lamps import FINDINGS


def test_lamps_that_are_late_say_so(qtbot):
    lamps = ValidityLamps()
    qtbot.addWidget(lamps)
    lamps.show_findings(FINDINGS)
    assert "updating" not in lamps.accessibleDescription()
    lamps.set_stale(True)
    qtbot.waitUntil(lambda: lamps.accessibleDescription().startswith("updating: of an older"))
    assert "updating" in _lamp_text(FINDINGS[0], stale=True).splitlines()[0]
    lamps.set_stale(False)
    assert "updating" not in lamps.accessibleDescription()


def test_numbers_that_are_there_are_copied_once_they_are_not_late_any_more(qtbot):
    button = CopyButton("made_up", str)
    qtbot.addWidget(button)
    for late, there in ((True, True), (True, False), (False, False), (False, True)):
        button.show_staleness(late)
        button.offer(there)
        assert button.isEnabled() is (there and not late)
        button.show_staleness(not late)
        assert button.isEnabled() is (there and late)
        button.show_staleness(late)
