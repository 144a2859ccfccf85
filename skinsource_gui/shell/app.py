"""Starts Qt and the window."""

import os
import sys
from functools import partial
from pathlib import Path

from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication

from skinsource.base.allocation import keep_freed_memory
from skinsource.base.assets import user_folder
from skinsource.base.crash_log import CrashLog
from skinsource.base.files import make_folder
from skinsource.limbs.catalogue import available_limbs, default_limb
from skinsource_gui.shell.ending import EndSignals, end_if_stuck
from skinsource_gui.shell.garbage import take_over_collection
from skinsource_gui.shell.window import MainWindow
from skinsource_gui.state.preferences import Preferences, settings_path
from skinsource_gui.state.start_design import start_design
from skinsource_gui.widgets.screen_fit import ScreenFit

#: While the worker computes, the window gets its turn after this time, and so does a device that
#: plays, which asks every 5 ms (Python's own is 5 ms).
_SWITCH_INTERVAL_S = 5e-4
#: After the first results: by then they are painted; and where no panel wants any.
_SETTLED_MS, _SETTLED_ANYWAY_MS = 200, 5000


def make_application() -> QApplication:
    """Return the application object, named."""
    # Qt hands a scaled picture to threads in slices of 64 lines; for one of a map's size to wait
    # for them takes twice as long as to paint it, and twenty times where other programs are busy.
    os.environ.setdefault("QT_NO_GUI_THREADPOOL", "1")
    # And before it paints it waits 5 ms for more to paint; what belongs together is told together.
    os.environ.setdefault("QT_QPA_UPDATE_IDLE_TIME", "0")
    application = QApplication(sys.argv[:1])
    application.setApplicationName("SkinSource studio")
    application.setDesktopFileName("skinsource-studio")
    sys.setswitchinterval(_SWITCH_INTERVAL_S)
    keep_freed_memory()
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
    ScreenFit(window).guess()
    end_signals = EndSignals(window)

    def end() -> None:
        if not window.keeping.end_unasked():
            sys.stderr.write("skinsource-gui: unsaved work is lost: no copy could be written\n")
        window.close_unasked()

    end_signals.received.connect(end)
    window.keeping.offer(window.notice)
    window.show()
    window.hints.offer()
    settled = QTimer(window, singleShot=True, interval=_SETTLED_ANYWAY_MS)
    settled.timeout.connect(partial(take_over_collection, window))
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
