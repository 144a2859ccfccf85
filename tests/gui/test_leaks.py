"""What comes and goes leaves nothing behind: no actions, dialogs, timers, widgets, threads."""

import gc
import threading
from collections import Counter

import pytest
from PySide6.QtCore import QAbstractAnimation, QCoreApplication, QEvent, QObject, Qt, QTimer
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QApplication, QDialog, QMenu, QWidget

#: What each leaves behind is there so many times.
OPENINGS = 4
PAGES = ("find_action", "show_keys", "show_dataset", "show_about", "show_accuracy", "export")
THERE_AND_BACK = (
    *("duplicate_input", "remove_input", "undo", "redo"),
    *("arrange_analysis", "arrange_presentation", "arrange_design"),
    *("use_dark_theme", "use_light_theme"),
)


@pytest.fixture
def window(new_window):
    """A studio of each test's own."""
    return new_window


@pytest.fixture
def alive(window, qtbot):
    """Give a function that counts what the window, and all other windows, own."""

    def moving() -> bool:
        running = QAbstractAnimation.State.Running
        return any(
            animation.state() == running for animation in window.findChildren(QAbstractAnimation)
        )

    def count() -> Counter:
        # Docks move to their new places for a fifth of a second, and longer on a busy machine.
        qtbot.waitUntil(lambda: not moving(), timeout=30_000)
        # What the status bar says has a timer as long as it is said.
        window.statusBar().clearMessage()
        for _ in range(3):
            QApplication.processEvents()
            QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
        gc.collect()
        counts = Counter()
        for kind in (QAction, QDialog, QMenu, QTimer, QWidget, QObject):
            counts[kind.__name__] = len(window.findChildren(kind))
        counts["top-level widgets"] = len(QApplication.topLevelWidgets())
        counts["threads"] = threading.active_count()
        return counts

    return count


def open_and_close(window, qtbot, name) -> None:
    window.actions_by_name[name].trigger()
    dialog = next(dialog for dialog in window.findChildren(QDialog) if dialog.isVisible())
    qtbot.waitExposed(dialog)
    qtbot.keyClick(dialog, Qt.Key.Key_Escape)
    qtbot.waitUntil(lambda: not any(dialog.isVisible() for dialog in window.findChildren(QDialog)))


def test_a_page_that_was_opened_again_and_again_leaves_nothing(window, qtbot, alive):
    for name in PAGES:
        open_and_close(window, qtbot, name)  # what is made once and kept
        before = alive()
        for _ in range(OPENINGS):
            open_and_close(window, qtbot, name)
        assert (name, alive() - before) == (name, Counter())


def test_a_menu_that_was_opened_again_and_again_leaves_nothing(window, qtbot, alive):
    menus = window.menuBar().findChildren(QMenu)

    def open_and_close_menu(menu: QMenu) -> None:
        menu.popup(window.mapToGlobal(window.rect().center()))
        qtbot.waitUntil(menu.isVisible)
        menu.close()

    for where in ("Edit", "View", "File"):
        menu = next(menu for menu in menus if menu.title().replace("&", "") == where)
        open_and_close_menu(menu)
        before = alive()
        for _ in range(OPENINGS):
            open_and_close_menu(menu)
        assert (where, alive() - before) == (where, Counter())


def test_edits_workspaces_and_themes_that_come_and_go_leave_nothing(window, settle, alive):
    window.do("duplicate_input")
    # The thread that keeps copies of unsaved work lives as long as the window.
    assert window.keeping.autosave.keep_now()

    def there_and_back() -> None:
        for name in THERE_AND_BACK:
            window.actions_by_name[name].trigger()
            settle()

    for _ in range(2):
        there_and_back()
    before = alive()
    for _ in range(2):
        there_and_back()
    assert alive() - before == Counter()
