"""A studio window that the tests of a file share: each finds it as a new one."""

from pathlib import Path

from PySide6.QtCore import QCoreApplication, QEvent, QEventLoop, QSize, QTimer
from PySide6.QtWidgets import QApplication, QDialog, QWidget
from shiboken6 import isValid

from skinsource import Design, View, available_limbs
from skinsource_gui.shell.window import MainWindow
from skinsource_gui.state.document import NEW_VIEW
from skinsource_gui.state.preferences import Preferences, start_design

SIZE = 1366, 728
_LONGEST_MS = 30_000


def made_window(preferences: Preferences, design: Design | None, view: View | None) -> MainWindow:
    """Make a window as it begins, with everything drawn."""
    window = MainWindow(
        design or start_design("synthetic-1"),
        view=view,
        preferences=preferences,
        available_limbs=available_limbs(),
    )
    window.resize(*SIZE)
    # Before it is shown: docks that are in sight are laid out and painted once more.
    window.do("arrange_design")
    window.show()
    rest(window)
    return window


def rest(window: MainWindow) -> None:
    """Wait until nothing is computed."""
    loop, late = QEventLoop(), QTimer(singleShot=True, interval=_LONGEST_MS)
    window.engine.rested.connect(loop.quit)
    late.timeout.connect(loop.quit)
    late.start()
    while window.engine.busy and late.isActive():
        loop.exec()
    assert not window.engine.busy, "it still computes"
    QApplication.processEvents()


def forget_changes(window: MainWindow) -> None:
    """Have a window close without a modal question, which would wait for ever."""
    window.document.mark_saved(window.document.path)
    window.runner.close()


class SharedWindow:
    """Makes a window when it is first asked for, and starts it over from then on.

    What a test did to its docks, pages, words and settings is taken back.  A panel that was made
    stays made, and what was told of signals stays connected: who looks at that has a window of its
    own (`make_window`).
    """

    def __init__(self, folder: Path) -> None:
        self._folder, self._window = folder, None

    def begin(self, design: Design | None = None, view: View | None = None) -> MainWindow:
        """Give the window with a design, the start design by default."""
        window = self._window
        if window is None or not isValid(window) or not window.isVisible():
            self.end()
            preferences = Preferences(self._folder / "studio.ini")
            preferences.settings.clear()
            self._window = made_window(preferences, design, view)
        else:
            _tidy(window)
            design = design or start_design("synthetic-1")
            window.document.start_over(design, view or NEW_VIEW, None)
            rest(window)
        return self._window

    def pause(self) -> None:
        """Leave nothing in the window that would be kept while other tests run."""
        if self._window is not None and isValid(self._window):
            self._window.document.mark_saved(self._window.document.path)

    def end(self) -> None:
        """Close the window."""
        window, self._window = self._window, None
        if window is None or not isValid(window):
            return
        window.files.leave_file()
        forget_changes(window)
        window.close()
        window.deleteLater()
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)


def _tidy(window: MainWindow) -> None:
    """Take back what was done to a window, but for the design."""
    window.files.leave_file()
    window.document.mark_saved(None)
    _close_pages(window)
    if window.presenter.presenting:
        window.presenter.end()
    if window.presenter.covered:
        window.presenter.cover()
    for part in (window.imports, window.exports, window.playback.matching):
        part.end()
    window.playback.player.stop_at_once()
    window.files.suggested = None
    _arrange(window)
    window.notice.be_quiet()
    window.statusBar().clearMessage()
    window.limbs.look()
    window.setFocus()


def _close_pages(window: MainWindow) -> None:
    while (popup := QApplication.activePopupWidget()) is not None:
        popup.close()
    for page in window.findChildren(QDialog):
        page.done(QDialog.DialogCode.Rejected)
    docks = window.docks.values()
    for other in window.findChildren(QWidget):
        if other.isWindow() and other.isVisible() and other not in docks:
            other.close()
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)


def _arrange(window: MainWindow) -> None:
    """Have words, docks and preferences as they are at first."""
    preferences = window.preferences
    window.workspaces.close()
    moved = (
        preferences.own_arrangements
        or preferences.arrangement != "design"
        or window.size() != QSize(*SIZE)
    )
    words = window.appearance.text_scale, preferences.theme_name
    preferences.settings.clear()
    if words != (1.0, "system"):
        window.appearance.reset_text()
    if moved:
        window.setUpdatesEnabled(False)
        window.workspaces.leave_scene()
        window.showNormal()
        window.resize(*SIZE)
        preferences.settings.clear()
        window.workspaces.restore()
        window.setUpdatesEnabled(True)
    preferences.settings.clear()
    preferences.arrangement = "design"
