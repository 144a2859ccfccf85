"""A studio window for the tests of a file, on the small built-in limb, and what they share."""

import gc
import threading
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from time import thread_time

import pytest
from PySide6.QtCore import QCoreApplication, QEvent
from PySide6.QtGui import QCursor
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QFileDialog, QMessageBox, QWidget

from skinsource_gui.pages.files import exports
from skinsource_gui.qt.theme import LIGHT, apply_theme, current_theme
from skinsource_gui.state.preferences import Preferences
from tests.gui.desk import Desk
from tests.gui.shared_window import SharedWindow, forget_changes, made_window, rest


class _Tidy:
    """Whether the test before made widgets."""

    due = True


_TIDY = _Tidy()
#: Of a thread; a search of what one test leaves takes a thousandth.
_LONG_SEARCH_S = 0.02


def _makes_widgets(request):
    return "qtbot" in request.fixturenames


@contextmanager
def _no_thread_left():
    """See that what is closed leaves no thread but that of the engine, which stays."""
    before = threading.enumerate()
    yield
    QApplication.processEvents()
    late = [thread for thread in threading.enumerate() if thread not in before]
    assert all(thread.name.startswith("skinsource-sums") for thread in late), late


@pytest.fixture(autouse=True, scope="session")
def _nothing_of_ours_outlives_python(qapp):
    """What was copied is kept by Qt, offscreen until after Python has ended, and then destroyed."""
    yield
    QApplication.clipboard().clear()


@pytest.fixture(autouse=True)
def _garbage_is_collected_in_this_thread(qapp, request):
    """As in the studio: elsewhere, widgets would be destroyed while this thread paints them.

    The window of the test before is let go of by pytest only now.  Modules are looked through once:
    not again and again those that were imported since, or that a test has thawed.
    """
    automatic = gc.isenabled()
    gc.disable()
    if _TIDY.due:
        began_s = thread_time()
        gc.collect()
        if thread_time() - began_s > _LONG_SEARCH_S:  # to ask how much there is takes as long
            gc.freeze()
        _TIDY.due = False
    yield
    _TIDY.due = _makes_widgets(request) or _TIDY.due
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    if automatic:
        gc.enable()


@pytest.fixture(autouse=True)
def _every_test_finds_the_same_desk(qapp):
    """Put the pointer into a corner, and back the colours and the font that windows change.

    No button is down either, whatever the test before left.
    """
    QCursor.setPos(0, 0)
    for button in QApplication.mouseButtons():
        QTest.mouseRelease(QWidget(), button)
    font = qapp.font()
    yield
    if current_theme() is not LIGHT:
        apply_theme(qapp, LIGHT)
    if qapp.font() != font:
        qapp.setFont(font)


@pytest.fixture(autouse=True)
def _operators_of_maps_are_built_once(tmp_path_factory, monkeypatch):
    """Share them among the tests of a run: hundreds of windows show the same map."""
    folder = tmp_path_factory.getbasetemp() / "operators"
    monkeypatch.setenv("SKINSOURCE_CACHE", str(folder))


@pytest.fixture
def use_theme(qapp):
    """Give all widgets a theme; after the test they have the usual one."""
    return partial(apply_theme, qapp)


@pytest.fixture
def preferences(user_data):
    return Preferences(user_data / "studio.ini")


@pytest.fixture(scope="module")
def _shared_window(qapp, tmp_path_factory):
    shared = SharedWindow(tmp_path_factory.mktemp("studio"))
    yield shared
    shared.end()


@pytest.fixture
def open_window(_shared_window, qtbot):
    """Start the window over that the tests of this file share, with a design and a view."""
    yield _shared_window.begin
    _shared_window.pause()


@pytest.fixture
def window(open_window):
    """The studio on its start design, with everything drawn."""
    return open_window()


@pytest.fixture
def active(window, qtbot):
    """The studio, with the keyboard."""
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    return window


@pytest.fixture
def make_window(qtbot, preferences):
    """Open studio windows of a test's own; close them, and see that no thread is left."""
    opened = []

    def make(design=None, view=None):
        window = made_window(preferences, design, view)
        qtbot.addWidget(window, before_close_func=forget_changes)
        opened.append(window)
        return window

    with _no_thread_left():
        yield make
        for window in opened:
            forget_changes(window)
            window.close()


@pytest.fixture
def new_window(make_window):
    """The studio on its start design, of this test alone."""
    return make_window()


@pytest.fixture
def make_desk(qtbot, preferences):
    """Make what pages stand in front of, without panels; see that no thread is left."""
    opened = []

    def make(design=None, view=None):
        desk = Desk(preferences, design, view)
        qtbot.addWidget(desk)
        opened.append(desk)
        desk.show()
        qtbot.waitExposed(desk)
        return desk

    with _no_thread_left():
        yield make
        for desk in opened:
            desk.end()


@pytest.fixture
def desk(make_desk):
    """A desk with the start design."""
    return make_desk()


@pytest.fixture
def answers(monkeypatch):
    """Answer dialogs, those for files with a name, questions with a button; note the questions."""
    given = {"open": "", "save": "", "question": QMessageBox.StandardButton.Cancel, "asked": []}

    def question(_window, _title, text, *_):
        given["asked"].append(text)
        return given["question"]

    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (given["open"], ""))
    monkeypatch.setattr(QFileDialog, "getOpenFileNames", lambda *_: (given["several"], ""))
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (given["save"], ""))
    monkeypatch.setattr(QMessageBox, "exec", lambda box: question(None, "", box.text()))
    for kind in ("question", "warning"):
        monkeypatch.setattr(QMessageBox, kind, question)
    return given


@pytest.fixture
def write_with(monkeypatch):
    """Have an export of the table written by another function."""

    def replace_write(name, write):
        table = tuple(
            replace(spec, write=write) if spec.name == name else spec for spec in exports.EXPORTS
        )
        monkeypatch.setattr(exports, "EXPORTS", table)

    return replace_write


@pytest.fixture
def settle(window):
    """Wait until the window shows the present design."""

    return partial(rest, window)


@pytest.fixture
def requests(window, monkeypatch):
    """What is asked of the engine from now on."""
    asked = []
    ask = window.engine.request
    monkeypatch.setattr(
        window.engine, "request", lambda request: (asked.append(request), ask(request))
    )
    return asked


@pytest.fixture(scope="module", autouse=True)
def _nothing_outlives_the_tests_of_a_file(qapp):
    """See that no window, dialog or thread is left once the tests of a file are done."""
    with _no_thread_left():
        yield
    left = [
        widget
        for widget in QApplication.topLevelWidgets()
        if widget.isVisible() and widget.parent() is None
    ]
    assert not left, f"windows outlive the tests of this file: {left}"
