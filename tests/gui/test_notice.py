from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QPushButton

from skinsource.design.edits.edit import Refusal
from skinsource_gui.shell import notices

LONG = "A long reason that goes on and on. " * 20


def shown_docks(window):
    return [dock for dock in window.docks.values() if dock.isVisible()]


def lies_over(window, part):
    """Names of the panels that it covers."""
    return [dock.objectName() for dock in shown_docks(window) if dock.geometry().intersects(part)]


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
    assert "skin" in lies_over(window, card.geometry())
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
