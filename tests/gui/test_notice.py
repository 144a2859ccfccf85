import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QCursor
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel, QPushButton, QTabBar, QToolButton, QWidget

from skinsource.design.edits.edit import Refusal
from skinsource_gui.shell import notices

LONG = "A long reason that goes on and on. " * 20


def shown_docks(window):
    return [dock for dock in window.docks.values() if dock.isVisible()]


def lies_over(window, part):
    """Names of the panels that it covers."""
    return [dock.objectName() for dock in shown_docks(window) if dock.geometry().intersects(part)]


@pytest.mark.parametrize("text", ["short", LONG])
def test_a_notice_that_stays_gets_room_of_its_own(window, settle, text):
    places = [dock.geometry() for dock in shown_docks(window)]
    window.reports.complain(text)
    settle()
    label = window.findChild(QLabel, "notice")
    assert label.isVisible()
    assert label.height() >= label.heightForWidth(label.width())
    assert label.geometry().bottom() == window.height() - 1
    assert not lies_over(window, label.geometry())
    assert label.y() > window.statusBar().geometry().bottom()
    window.notice.be_quiet()
    settle()
    for dock, place in zip(shown_docks(window), places, strict=True):
        assert abs(dock.height() - place.height()) <= 1  # columns share what does not divide


def test_a_notice_that_passes_moves_nothing_and_lies_over_the_status_bar(window, settle):
    places = [dock.geometry() for dock in shown_docks(window)]
    window.reports.refuse("That cannot be.")
    settle()
    assert [dock.geometry() for dock in shown_docks(window)] == places
    label = window.findChild(QLabel, "notice")
    assert label.geometry() == window.statusBar().geometry()


def test_a_notice_while_presenting_covers_neither_a_panel_nor_the_name_of_one(window, settle):
    window.do("present")
    window.docks["regions"].bring_forward()
    window.docks["side_by_side"].bring_forward()
    settle()
    window.reports.refuse("That cannot be.")
    label = window.findChild(QLabel, "notice")
    assert label.isVisible()
    assert label.y() == 0
    assert label.geometry().right() == window.width() - 1
    for bar in window.findChildren(QTabBar):
        if bar.isVisible():
            tabs = bar.tabRect(bar.count() - 1).translated(bar.mapTo(window, QPoint()))
            assert bar.count() > 1
            assert not label.geometry().intersects(tabs)
    tops = [dock.widget().mapTo(window, QPoint()).y() for dock in shown_docks(window)]
    assert label.geometry().bottom() <= min(y for y in tops if y > 0)  # others lie behind as tabs
    window.do("present")
    window.reports.refuse("That cannot be.")
    settle()
    assert label.geometry() == window.statusBar().geometry()


@pytest.mark.parametrize("scale", [1.0, 2.0, 3.0])
def test_a_notice_while_presenting_is_one_line_high_in_letters_of_any_size(window, settle, scale):
    window.appearance._scale_text(scale)
    try:
        window.do("present")
        window.showNormal()
        window.resize(1366, 768)
        settle()
        window.reports.report("Scene 19 of 19: 5F · Separate and joint")
        label = window.findChild(QLabel, "notice")
        assert label.isVisible()
        assert label.height() < 2 * label.fontMetrics().lineSpacing()
        tops = [dock.widget().mapTo(window, QPoint()).y() for dock in shown_docks(window)]
        assert label.geometry().bottom() <= min(y for y in tops if y > 0)
    finally:
        window.appearance.reset_text()
        window.appearance.fit_room(1.0)


def test_a_click_on_the_words_reaches_nothing_else(window, settle):
    window.reports.refuse("That cannot be.")
    settle()
    label = window.findChild(QLabel, "notice")
    assert window.childAt(label.geometry().center()) is label


@pytest.fixture
def slow_hand(qapp):
    """Two clicks are one double click however long a busy machine takes between them."""
    usual = qapp.doubleClickInterval()
    qapp.setDoubleClickInterval(60_000)
    yield
    qapp.setDoubleClickInterval(usual)


def test_a_second_click_where_a_button_has_gone_reaches_nothing_else(
    window, settle, qtbot, slow_hand
):
    window.notice.say("Open it?", choices=(("Open", lambda: None),))
    settle()
    button = window.findChild(QPushButton, "notice_choice")
    middle = button.mapTo(window, button.rect().center())
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    settle()
    guard = window.childAt(middle)
    assert guard.objectName() == "click_guard"
    window.notice._guard.interval.start(1)
    qtbot.waitUntil(guard.isHidden)
    assert window.childAt(middle) is not guard


def test_the_time_for_a_second_click_begins_when_the_window_is_laid_out_anew(
    window, settle, qtbot, slow_hand
):
    window.notice.say("Read it?", choices=(("Done", lambda: None),))
    settle()
    QTest.mouseClick(window.findChild(QPushButton, "notice_choice"), Qt.MouseButton.LeftButton)
    left_ms = 59_000
    window.notice._guard.interval.start(left_ms)
    qtbot.waitUntil(lambda: window.notice._guard.interval.remainingTime() > left_ms, timeout=2000)


def test_a_notice_follows_the_window(window, settle):
    window.reports.complain("Something went wrong")
    window.resize(1100, 700)
    settle()
    label, buttons = window.findChild(QLabel, "notice"), window.notice.buttons
    assert label.width() == 1100
    assert label.geometry().contains(buttons.geometry())


def test_a_notice_goes_away_with_the_next_edit_but_not_with_a_look(window):
    window.reports.complain("Something went wrong")
    window.do("remove_delay")
    assert window.notice.text == "Something went wrong"
    window.do("mute_input")
    assert window.notice.text == ""


def test_a_notice_is_closed_with_its_button(window):
    window.reports.complain("Something went wrong")
    QTest.mouseClick(window.findChild(QToolButton, "close_notice"), Qt.MouseButton.LeftButton)
    assert window.notice.text == ""


def test_what_is_offered_is_done_once_and_the_notice_goes(window):
    done = []
    window.notice.say("Open it?", choices=(("Open", lambda: done.append("open")),))
    button = window.findChild(QPushButton, "notice_choice")
    assert window.notice.buttons.geometry().contains(
        button.mapTo(window, QPoint(button.width() // 2, button.height() // 2))
    )
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    assert done == ["open"]
    assert window.notice.text == ""
    window.notice.say("Something else")
    assert not [
        button for button in window.findChildren(QPushButton, "notice_choice") if button.isVisible()
    ]


def test_what_went_well_is_forgotten_when_another_design_is_begun(window):
    window.reports.report("Saved second.skinsource")
    window.do("new_design")
    assert "second" not in window.statusBar().currentMessage()


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


def test_a_click_where_a_button_was_reaches_nothing_until_the_pointer_has_moved(
    window, settle, monkeypatch, qtbot
):
    monkeypatch.setattr(QApplication, "doubleClickInterval", lambda: 10)
    window.notice.say("Done?", choices=(("Done", lambda: None),))
    settle()
    button = window.findChild(QPushButton, "notice_choice")
    QCursor.setPos(button.mapToGlobal(button.rect().center()))
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    guard = window.findChild(QWidget, "click_guard")
    rounds = []
    window.notice._guard.interval.timeout.connect(lambda: rounds.append(guard.isVisible()))
    qtbot.waitUntil(lambda: len(rounds) >= 2, timeout=2000)
    assert rounds[:2] == [True, True]
    QCursor.setPos(QCursor.pos() + QPoint(3, 0))
    qtbot.waitUntil(guard.isHidden, timeout=2000)
