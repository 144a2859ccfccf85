"""Presenting: the window without its bars, scenes by one key, a map that can be covered."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import QByteArray, QEvent, QObject, Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QToolBar, QWidget
from shiboken6 import isValid

from skinsource.errors import SkinSourceError
from skinsource_gui.panels.skin.panel import SkinPanel
from skinsource_gui.shell.presenting.notes_window import NotesWindow
from skinsource_gui.shell.presenting.scene_list import Step, steps_of_folder, steps_of_paper

if TYPE_CHECKING:
    from skinsource_gui.shell.window import MainWindow

_ARRANGEMENT = "presentation"
#: What clickers send, beside the keys of the table of actions.
_NEXT, _PREVIOUS, _COVER = ("PgDown",), ("PgUp",), ("B", ".")


class Presenter(QObject):
    """Takes the bars away, and steps through scenes.

    Parameters
    ----------
    window
        What is presented in; also the parent.

    Attributes
    ----------
    presenting
        Whether the bars are away.
    covered
        Whether the map is.
    """

    def __init__(self, window: "MainWindow") -> None:
        super().__init__(window)
        self._window = window
        self.presenting = self.covered = False
        self._before, self._size = QByteArray(), window.size()
        self._focused: QWidget | None = None
        self._arranged = ""
        self._steps: tuple[Step, ...] = ()
        self._at = -1
        # Whether what is open is a scene that was opened here: what is turned in it is not kept.
        self._is_scene = self._opening = False
        self._notes: NotesWindow | None = None
        self._keys: list[QShortcut] = []
        window.document.jumped.connect(self._look)

    def toggle(self) -> None:
        """Begin to present, or end."""
        (self.end if self.presenting else self.begin)()

    def begin(self) -> None:
        """Take the bars away, and arrange the panels for people further off."""
        window = self._window
        self.presenting = True
        self._before, self._arranged = window.saveState(), window.preferences.arrangement
        self._size, self._focused = window.size(), window.focusWidget()
        window.arrangements.show(_ARRANGEMENT)
        for bar in self._bars():
            bar.hide()
        # Keys of menus that are away would be dead.
        window.addActions(list(window.actions_by_name.values()))
        window.setWindowState(window.windowState() | Qt.WindowState.WindowFullScreen)
        self._listen(window)

    def end(self) -> None:
        """Bring the bars back, the panels where they stood, and the map."""
        window = self._window
        self.presenting = False
        for action in window.actions_by_name.values():
            window.removeAction(action)
        for key in self._keys:
            key.setEnabled(False)
            key.deleteLater()
        self._keys.clear()
        window.setWindowState(window.windowState() & ~Qt.WindowState.WindowFullScreen)
        # What was told meanwhile would lie over what the line says.
        window.statusBar().clearMessage()
        for bar in self._bars():
            bar.show()
        window.arrangements.show(self._arranged)
        # Widths of columns are put back into a window as wide as it was, once it is.
        window.installEventFilter(self)
        self._put_back()
        if self._focused is not None and isValid(self._focused):
            self._focused.setFocus()
        if self.covered:
            self.cover()
        if self._notes is not None:
            self._notes.close()

    def cover(self) -> None:
        """Cover the map, so that people guess first; or reveal it."""
        self.covered = not self.covered
        for panel in self._window.panels:
            if isinstance(panel, SkinPanel):
                panel.cover(self.covered)

    def next_scene(self) -> None:
        """Go to the next scene."""
        self._go(1)

    def previous_scene(self) -> None:
        """Go to the scene before."""
        self._go(-1)

    def show_notes(self) -> None:
        """Show what the speaker reads, on another screen where there is one."""
        if self._notes is None:
            self._notes = NotesWindow(self._window)
            if self.presenting:
                self._listen(self._notes)
        self._show_notes()
        self._notes.show_beside(self._window)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.Resize:
            self._put_back()
        return super().eventFilter(watched, event)

    def _put_back(self) -> None:
        if self.presenting:
            self._window.removeEventFilter(self)
        elif self._window.size() == self._size:
            self._window.removeEventFilter(self)
            self._window.layout_of_docks.put(self._before.data())

    def _bars(self) -> list[QWidget]:
        window = self._window
        return [window.menuBar(), window.statusBar(), *window.findChildren(QToolBar, "setup")]

    def _listen(self, widget: QWidget) -> None:
        keys: tuple[tuple[tuple[str, ...], Callable[[], None]], ...] = (
            (_NEXT, self.next_scene),
            (_PREVIOUS, self.previous_scene),
            (_COVER, self.cover),
        )
        for texts, do in keys:
            for text in texts:
                key = QShortcut(QKeySequence(text), widget)
                key.activated.connect(do)
                self._keys.append(key)

    def _go(self, by: int) -> None:
        window = self._window
        if not self._is_scene and not window.files.may_lose_changes():
            return
        if not self._steps:
            path = window.document.path
            self._steps = (() if path is None else steps_of_folder(path.parent)) or steps_of_paper()
            titles = [one.title for one in self._steps]
            here = "" if path is None else path.stem
            self._at = titles.index(here) if here in titles else -1
        wanted = self._at + by
        if not 0 <= wanted < len(self._steps):
            window.files.done.emit(
                "This is the last scene" if by > 0 else "This is the first scene"
            )
            return
        self._open(wanted)

    def _open(self, number: int) -> None:
        window, step = self._window, self._steps[number]
        try:
            shown = step.open()
        except SkinSourceError as error:
            window.files.failed.emit(str(error))
            return
        self._at, self._opening = number, True
        window.document.start_over(shown.design, shown.view, None)
        window.files.leave_file()
        self._opening, self._is_scene = False, True
        for name in shown.panels:
            if name in window.docks:
                window.docks[name].bring_forward()
        window.files.done.emit(f"Scene {number + 1} of {len(self._steps)}: {step.title}")
        self._show_notes()

    def _look(self) -> None:
        # With another design the history is empty; with a step of it, it is not.
        if not self._opening and self._window.document.undo_stack.count() == 0:
            self._is_scene = False

    def _show_notes(self) -> None:
        if self._notes is None:
            return
        design, following = self._window.document.design, self._at + 1
        titles = [one.title for one in self._steps]
        heading = titles[self._at] if 0 <= self._at < len(titles) else design.title or "Notes"
        after = titles[following] if 0 < following < len(titles) else ""
        self._notes.show_scene(heading, design.notes, after)
