"""The three hints of the first start, which never come back."""

from PySide6.QtCore import QByteArray
from PySide6.QtWidgets import QMainWindow, QPushButton

from skinsource_gui.shell.first_start import HINTS, FirstStart
from skinsource_gui.shell.notice import Notice
from skinsource_gui.state.preferences import Preferences


def window_of(qtbot):
    window = QMainWindow()
    qtbot.addWidget(window)
    window.statusBar()
    window.show()
    return window, Notice(window)


def press(window, words):
    (button,) = [
        one for one in window.findChildren(QPushButton) if one.text() == words and one.isVisible()
    ]
    button.click()


def test_three_hints_come_once_one_after_the_other(qtbot, tmp_path):
    path = tmp_path / "studio.ini"
    window, notice = window_of(qtbot)
    FirstStart(Preferences(path), notice).offer()
    for step, hint in enumerate(HINTS):
        assert notice.text == f"{step + 1} of 3: {hint}"
        press(window, "Done" if step == 2 else "Next")
    assert notice.text == ""
    FirstStart(Preferences(path), notice).offer()
    assert notice.text == ""


def test_who_wants_no_more_of_them_or_just_ends_the_studio_is_left_alone(qtbot, tmp_path):
    window, notice = window_of(qtbot)
    FirstStart(Preferences(tmp_path / "a.ini"), notice).offer()
    press(window, "No more hints")
    assert notice.text == ""
    # Remembered at once: the first hint is enough, however the studio ends.
    assert Preferences(tmp_path / "a.ini").hinted


def test_a_studio_that_was_used_before_or_has_something_urgent_to_say_hints_nothing(
    qtbot, tmp_path
):
    _, notice = window_of(qtbot)
    used = Preferences(tmp_path / "used.ini")
    used.geometry = QByteArray(b"somewhere")
    FirstStart(used, notice).offer()
    assert notice.text == ""
    new = Preferences(tmp_path / "new.ini")
    notice.say("Unsaved work was left", "warning")
    FirstStart(new, notice).offer()
    assert notice.text == "Unsaved work was left"
    assert not new.hinted
