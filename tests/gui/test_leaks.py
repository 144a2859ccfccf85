"""What comes and goes leaves nothing behind: no actions, timers, widgets, threads, no garbage."""

import gc
import linecache
import os
import sys
import threading
import weakref
from collections import Counter

import numpy as np
import pytest
from PySide6.QtCore import QAbstractAnimation, QCoreApplication, QEvent, QObject, Qt, QTimer
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QApplication, QDialog, QMenu, QWidget

import skinsource as ss
from skinsource.base.run_limited import resident_bytes
from skinsource_gui.app.app import GarbageCollector

#: What each leaves behind is there so many times.
OPENINGS = 4
PAGES = (
    "find_action",
    "show_keys",
    "show_manual",
    "show_dataset",
    "show_about",
    "show_accuracy",
    "place_actuators",
    "export",
)
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


class Cycle:
    """Something that only a collection frees; it tells in which thread."""

    def __init__(self, threads):
        self.itself = self
        self.threads = threads

    def __del__(self):
        self.threads.append(threading.current_thread())


@pytest.fixture
def collector(qapp):
    owner = QObject()
    gc.collect()
    yield GarbageCollector(owner)
    owner.deleteLater()


def make_garbage(threads, count=1000):
    for _ in range(count):
        Cycle(threads)


def test_a_worker_that_makes_garbage_does_not_collect_it(collector, qtbot):
    threads = []
    worker = threading.Thread(target=make_garbage, args=(threads,))
    worker.start()
    worker.join()
    assert threads == []
    qtbot.waitUntil(lambda: len(threads) == 1000)
    assert set(threads) == {threading.main_thread()}


def test_where_nothing_is_new_nothing_is_looked_through(collector):
    gc.collect()
    assert collector.collect_what_is_due() is None


def test_older_objects_are_looked_through_seldom_and_never_while_something_is_dragged(
    collector, monkeypatch
):
    # Not the real buttons: tests before this one may have left another one down.
    pressed = [Qt.MouseButton.NoButton]
    monkeypatch.setattr(QApplication, "mouseButtons", lambda: pressed[0])
    generations = []

    def collect(times):
        for _ in range(times):
            make_garbage([])
            generations.append(collector.collect_what_is_due())

    collect(120)
    assert (generations.count(0), generations.count(1), generations.count(2)) == (110, 10, 0)
    pressed[0] = Qt.MouseButton.LeftButton
    collect(22)
    assert 2 not in generations
    pressed[0] = Qt.MouseButton.NoButton
    collect(11)
    assert generations[-11:].count(2) == 1


def test_what_exports_evaluated_and_sources_that_imports_read_are_dropped_in_time(collector):
    limb = weakref.ref(ss.evaluate(ss.Design(limb="synthetic-1"), "limb_data")["limb_data"])
    assert limb() is not None
    assert linecache.getlines(__file__)
    for timer in collector.findChildren(QTimer):
        timer.timeout.emit()
    gc.collect()
    assert limb() is None
    assert not linecache.cache


def test_a_window_that_was_closed_is_freed_with_its_panels_graphs_and_worker(make_window):
    window = make_window()
    engine = window.engine
    held = [weakref.ref(owner) for owner in (window, engine, window.document, *window.panels)]
    graphs = [weakref.ref(graph) for graph in engine._graphs.values()]
    assert graphs
    window.document.mark_saved(window.document.path)
    window.close()
    window.deleteLater()
    opened = gc.get_referrers(window)
    for referrer in opened:
        if isinstance(referrer, list) and window in referrer:
            referrer.remove(window)
    del window, engine, opened, referrer
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    QApplication.processEvents()
    gc.collect()
    assert [ref() for ref in graphs] == [None]
    assert [type(ref()).__name__ for ref in held if ref() is not None] == []


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="only glibc keeps freed memory")
def test_memory_that_was_freed_goes_back_to_the_system_though_nothing_is_new(collector):
    blocks = [np.ones(2**13) for _ in range(3000)]
    kept = blocks[::2]
    before = resident_bytes(os.getpid())
    del blocks
    for timer in collector.findChildren(QTimer):
        timer.timeout.emit()
    assert resident_bytes(os.getpid()) < before - 50e6
    assert len(kept) == 1500
