"""The three hints of the first start, which come back only when they are asked for."""

from dataclasses import replace

from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QDockWidget, QMainWindow, QPushButton

import skinsource as ss
from skinsource_gui.shell.notices import HINTS, FirstHints, Notice
from skinsource_gui.state.document import Document
from skinsource_gui.state.preferences import Preferences


def window_of(qtbot):
    window = QMainWindow()
    qtbot.addWidget(window)
    window.statusBar()
    window.show()
    return window, Notice(window)


def document():
    return Document(ss.Design(limb="synthetic-1"))


def press(window, text):
    (button,) = [
        button
        for button in window.findChildren(QPushButton)
        if button.text() == text and button.isVisible()
    ]
    button.click()


def test_three_hints_come_once_one_after_the_other(qtbot, tmp_path):
    path = tmp_path / "studio.ini"
    window, notice = window_of(qtbot)
    FirstHints(Preferences(path), notice, document()).offer()
    for step, hint in enumerate(HINTS):
        assert notice.text == f"{step + 1} of 3: {hint}"
        press(window, "Done" if step == 2 else "Next")
        # Remembered at once: the first hint is enough, however the studio ends.
        assert Preferences(path).hinted
    assert notice.text == ""
    FirstHints(Preferences(path), notice, document()).offer()
    assert notice.text == ""
    # Something urgent goes first.
    new = Preferences(tmp_path / "new.ini")
    notice.say("Unsaved work was left", "warning")
    FirstHints(new, notice, document()).offer()
    assert notice.text == "Unsaved work was left"
    assert not new.hinted


def apply(document, **changes):
    document.edit("Change", replace(document.design, **changes))


def test_doing_what_a_hint_says_leads_to_the_next_one(qtbot, tmp_path):
    _, notice = window_of(qtbot)
    done = document()
    # As the window does: an edit outdates what is said.
    done.changed.connect(notice.be_quiet)
    FirstHints(Preferences(tmp_path / "a.ini"), notice, done).offer()
    apply(done, title="Mine")
    assert notice.text.startswith("1 of 3")
    apply(done, inputs=(ss.track(7, ss.waveforms.Impulse()),))
    assert notice.text.startswith("2 of 3")
    apply(done, inputs=(replace(done.design.inputs[0], amplitude=2.0),))
    assert notice.text.startswith("3 of 3")
    done.look(replace(done.view, outputs=(29,)))
    assert notice.text == ""
    apply(done, title="Later")
    assert notice.text == ""


def test_hints_are_put_away_while_somebody_presents_and_come_back_after(window, settle):
    window.do("show_first_steps")
    settle()
    press(window, "Next")
    # Where there is no hand to click on.
    window.do("arrange_presentation")
    assert window.notice.text == ""
    window.do("arrange_design")
    assert window.notice.text.startswith("2 of 3")
    window.notice.say("Other")
    window.workspaces.reset()
    assert window.notice.text == "Other"
    window.do("present")
    settle()
    assert window.notice.text.startswith("PgDown")
    stage = window.panel("stage")
    assert window.notice.card.height() <= stage.heading.mapTo(window, QPoint()).y()
    window.do("next_scene")
    settle()
    assert window.notice.text.startswith("Scene")
    window.notice.be_quiet()
    # As a scene would that shows what a hint says.
    apply(window.document, inputs=(ss.track(7, ss.waveforms.Impulse()),))
    settle()
    assert window.notice.text == ""
    window.do("present")
    settle()
    assert window.notice.text.startswith("The design is as it was before")
    window.notice.be_quiet()
    window.document.look(replace(window.document.view, playhead_s=0.1))
    assert window.notice.text == f"2 of 3: {HINTS[1]}"
    press(window, "No more hints")
    window.do("present")
    window.do("present")
    settle()
    assert window.notice.text == ""


def test_a_panel_that_is_docked_later_never_covers_a_notice(qtbot):
    window, notice = window_of(qtbot)
    notice.say("Unsaved work was found")
    window.addDockWidget(Qt.DockWidgetArea.BottomDockWidgetArea, QDockWidget("Timeline", window))
    middle = notice.card.geometry().center()
    qtbot.waitUntil(lambda: notice.card.isAncestorOf(window.childAt(middle)))
