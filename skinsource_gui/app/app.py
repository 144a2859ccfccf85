"""Starts and ends the studio, and collects garbage in the GUI thread."""

import gc
import linecache
import os
import signal
import socket
import sys
from functools import partial
from pathlib import Path

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QObject, QSocketNotifier, Qt, QTimer, Signal

from skinsource.base.allocation import give_freed_memory_back, keep_freed_memory
from skinsource.base.assets import user_folder
from skinsource.base.crash_log import CrashLog
from skinsource.base.files import make_folder
from skinsource.engine.evaluation import forget_evaluated
from skinsource.limbs.catalog import available_limbs, default_limb
from skinsource_gui.qt.accessible import tell_items
from skinsource_gui.qt.resources import resource_folder
from skinsource_gui.qt.windows import fit_by_guess
from skinsource_gui.shell.window import MainWindow
from skinsource_gui.state.playing import device_is_stuck
from skinsource_gui.state.preferences import Preferences, settings_path, start_design

_SIGNALS = ("SIGINT", "SIGTERM", "SIGHUP")


class EndSignals(QObject):
    """Tells when the system asks the studio to end.

    Python handles signals between two of its own steps only, and there are none while Qt waits
    for events: a byte that arrives at a socket wakes it.
    """

    #: The studio shall end.
    received = Signal()

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._ours, theirs = socket.socketpair()
        self._theirs = theirs
        for end in (self._ours, theirs):
            end.setblocking(False)
        signal.set_wakeup_fd(theirs.fileno(), warn_on_full_buffer=False)
        for name in _SIGNALS:
            number = getattr(signal, name, None)  # Windows has no SIGHUP
            if number is not None:
                signal.signal(number, lambda *_: None)
        self._notifier = QSocketNotifier(self._ours.fileno(), QSocketNotifier.Type.Read, self)
        self._notifier.activated.connect(self._receive)

    def _receive(self) -> None:
        self._ours.recv(64)
        self.received.emit()


def end_if_stuck(result: int) -> None:
    """End the process where a device is stuck: Python, and PortAudio, would wait for it for ever.

    What is to be kept must have been written.
    """
    if device_is_stuck():
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(result)


_LOOK_EVERY_MS = 1000
#: It takes milliseconds, and so does the edit after it, which gets new pages from the system.
_GIVE_BACK_EVERY_MS = 2000
#: Exports evaluate beside the engine, and import modules; PySide reads the source of each module
#: that imports another, and Python keeps all of it.
_FORGET_EVERY_MS = 3_000
#: As Python has it: so many new objects are looked through, and of so many times one time older
#: ones too.
_NEW_OBJECTS, _TIMES = 700, 10
_YOUNG, _MIDDLE, _OLD = range(3)


def manage_garbage_collection(owner: QObject) -> None:
    """Collect garbage from now on, except in what stands now.

    Modules, menus and panels live as long as the window.  To look through them again takes the
    collector fifty milliseconds.

    Parameters
    ----------
    owner
        Garbage is collected until it ends.
    """
    gc.collect()
    gc.freeze()
    GarbageCollector(owner)


class GarbageCollector(QObject):
    """Collects garbage from a timer, instead of wherever Python happens to make an object.

    Python's own collector runs in any thread.  In the worker's it would destroy widgets and plots,
    which are full of cycles, while the GUI thread paints; and in the GUI thread it would look
    through everything in the middle of a drag.
    """

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        gc.disable()
        for interval_ms, work in (
            (_LOOK_EVERY_MS, self.collect_what_is_due),
            (_FORGET_EVERY_MS, linecache.clearcache),
            (_FORGET_EVERY_MS, forget_evaluated),
            (_GIVE_BACK_EVERY_MS, give_freed_memory_back),
        ):
            timer = QTimer(self, interval=interval_ms)
            timer.timeout.connect(work)
            timer.start()

    def collect_what_is_due(self) -> int | None:
        """Collect; return up to which generation, or None where too little is new."""
        new, young, middle = gc.get_count()
        if new < _NEW_OBJECTS:
            return None
        generation = _YOUNG
        if young >= _TIMES:
            # The oldest take long: they wait for the end of a drag.
            dragged = QtWidgets.QApplication.mouseButtons() != Qt.MouseButton.NoButton
            generation = _MIDDLE if middle < _TIMES or dragged else _OLD
        gc.collect(generation)
        return generation


#: While the worker computes, the window gets its turn after this time, and so does a device that
#: plays, which asks every 5 ms (Python's own is 5 ms).
_SWITCH_INTERVAL_S = 5e-4
#: After the first results: by then they are painted; and where no panel wants any.
_SETTLED_MS, _SETTLED_ANYWAY_MS = 200, 5000


def make_application() -> QtWidgets.QApplication:
    """Return the application object, named."""
    # Qt hands a scaled picture to threads in slices of 64 lines; to wait for those of a map takes
    # twice as long as to paint it, and twenty times as long where other programs are busy.
    os.environ.setdefault("QT_NO_GUI_THREADPOOL", "1")
    # And before it paints it waits 5 ms for more to paint; what belongs together is told together.
    os.environ.setdefault("QT_QPA_UPDATE_IDLE_TIME", "0")
    application = QtWidgets.QApplication(sys.argv[:1])
    application.setApplicationName("SkinSource studio")
    application.setDesktopFileName("skinsource-studio")
    application.setWindowIcon(QtGui.QIcon(str(resource_folder() / "icons/skinsource-studio.svg")))
    sys.setswitchinterval(_SWITCH_INTERVAL_S)
    keep_freed_memory()
    tell_items()
    return application


def make_window(path: Path | None, preferences: Preferences) -> MainWindow:
    """Return the window on the start design, or on the design in ``path``."""
    window = MainWindow(
        start_design(default_limb()), preferences=preferences, available_limbs=available_limbs()
    )
    if path is not None:
        window.files.open(path)
    return window


def run(path: Path | None) -> int:
    """Open the studio and stay until it is closed."""
    application = make_application()
    make_folder(user_folder())
    log = CrashLog(user_folder())
    log.open()
    preferences = Preferences(settings_path())
    window = make_window(path, preferences)
    if not window.workspaces.is_placed:
        # The size that it has once it is not maximised any more.
        fit_by_guess(window)
        window.setWindowState(Qt.WindowState.WindowMaximized)
    end_signals = EndSignals(window)

    def end() -> None:
        if not window.keeping.end_unasked():
            sys.stderr.write("skinsource-gui: unsaved work is lost: no copy could be written\n")
        # A window that waits for an answer cannot be closed.
        while (question := QtWidgets.QApplication.activeModalWidget()) and question.close():
            pass
        QTimer.singleShot(0, window.close_unasked)

    end_signals.received.connect(end)
    window.keeping.offer(window.notice)
    window.show()
    window.hints.offer()
    settled = QTimer(window, singleShot=True, interval=_SETTLED_ANYWAY_MS)
    settled.timeout.connect(partial(manage_garbage_collection, window))
    settled.start()

    def settle_soon() -> None:
        window.engine.finished.disconnect(settle_soon)
        if settled.isActive():
            settled.start(_SETTLED_MS)

    window.engine.finished.connect(settle_soon)
    result = application.exec()
    log.close()
    preferences.flush()
    end_if_stuck(result)
    return result
