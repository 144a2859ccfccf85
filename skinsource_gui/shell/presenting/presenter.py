"""Presenting: the window without its bars, scenes by one key, maps that can be covered."""

from collections.abc import Callable, Mapping

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QAction, QKeySequence, QShortcut
from PySide6.QtWidgets import QMainWindow, QToolBar, QWidget
from shiboken6 import isValid

from skinsource.base.errors import SkinSourceError
from skinsource.studies import scenes
from skinsource_gui.files.file_actions import FileActions
from skinsource_gui.made_panels import MadePanels
from skinsource_gui.shell.docks.arrangement_spec import PRESENTATION
from skinsource_gui.shell.docks.arrangements import Arrangements
from skinsource_gui.shell.docks.dock_layout import DockLayout
from skinsource_gui.shell.presenting.chosen_colours import ChosenColours
from skinsource_gui.shell.presenting.notes_window import NotesWindow
from skinsource_gui.shell.presenting.presenting_keys import PresentingKeys, unless_dragging
from skinsource_gui.shell.presenting.scene_list import Step, steps_of_folder, steps_of_paper
from skinsource_gui.shell.presenting.whole_scene import WholeScene
from skinsource_gui.state.document import Document
from skinsource_gui.state.preferences import Preferences
from skinsource_gui.widgets.keys import KEYS, key_text, shortcut_text


class Presenter(QObject):
    """Takes the bars away, and steps through scenes.

    Parameters
    ----------
    window
        What is presented in; also the parent.
    document
        What scenes are opened into.
    panels
        Cover the maps that they draw.
    preferences
        Say how the panels stand.
    files
        Ask what becomes of the present design.
    arrangements, layout
        Where the panels stand.
    actions
        What has a key, once it is known.

    Attributes
    ----------
    presenting
        Whether the bars are away.
    covered
        Whether the maps are, in all panels.
    """

    #: What shall be said: of a scene, or how to leave.
    done = Signal(str)
    #: Why a scene does not open.
    failed = Signal(str)
    #: Whether somebody presents: as the bars go, and once they are back.
    presenting_changed = Signal(bool)

    def __init__(
        self,
        window: QMainWindow,
        document: Document,
        panels: MadePanels,
        preferences: Preferences,
        files: FileActions,
        arrangements: Arrangements,
        layout: DockLayout,
        actions: Callable[[], Mapping[str, QAction]],
    ) -> None:
        super().__init__(window)
        self._window, self._document, self._preferences = window, document, preferences
        self._files, self._actions = files, actions
        self._arrangements, self._layout = arrangements, layout
        self.presenting = self.covered = False
        self._made = panels
        panels.each(lambda panel: panel.show_covered(self.covered))
        self._before, self._size = b"", window.size()
        self._focused: QWidget | None = None
        self._arranged = ""
        self._steps: tuple[Step, ...] = ()
        self._at = -1
        self._panels: tuple[str, ...] = ()
        # The scene that is open, as it was when it was presented: what is turned in it meanwhile is
        # not kept.  None: there is work in it that is asked about.
        self._whole: WholeScene | None = None
        self._opening = False
        self._colours = ChosenColours(document.view)
        self._notes: NotesWindow | None = None
        self._keys: list[QShortcut] = []
        self._taken: PresentingKeys | None = None
        document.jumped.connect(self._look)

    def toggle(self) -> None:
        """Begin to present, or end."""
        (self.end if self.presenting else self.begin)()

    def begin(self) -> None:
        """Take the bars away, and arrange the panels for people further off."""
        window = self._window
        self.presenting = True
        is_scene = self._at >= 0 or self._document.path is not None
        whole = is_scene and not self._document.modified
        self._whole = WholeScene.of(self._document) if whole else None
        self._layout.hold()
        self._before, self._arranged = self._layout.own(), self._preferences.arrangement
        self._size, self._focused = window.size(), window.focusWidget()
        self.presenting_changed.emit(True)
        for bar in self._bars():
            bar.hide()
        self._layout.show_scene(PRESENTATION, self._panels)
        # Keys of menus that are away would be dead.
        window.addActions(list(self._actions().values()))
        window.setWindowState(window.windowState() | Qt.WindowState.WindowFullScreen)
        for keyboard in (window, self._notes):
            if keyboard is not None:
                self._listen(keyboard)
        steps = self.next_scene, self.previous_scene
        self._taken = PresentingKeys(*steps, self._actions()["play"], self.end, self)
        following = KEYS["presenting"].gestures["next"].shown
        cover = key_text("presenting", "cover")
        leave = f"{shortcut_text('present')} or {key_text('presenting', 'leave')}"
        self.done.emit(f"{following}: next scene · {cover}: cover the maps · {leave}: leave")

    def end(self) -> None:
        """Bring back bars, panels where they stood, with those of the scene, and the map."""
        window = self._window
        self.presenting, self._whole = False, None
        self._layout.release()
        for action in self._actions().values():
            window.removeAction(action)
        for key in self._keys:
            key.setEnabled(False)
            key.deleteLater()
        self._keys.clear()
        if self._taken is not None:
            self._taken.end()
            self._taken = None
        window.setWindowState(window.windowState() & ~Qt.WindowState.WindowFullScreen)
        # What was told meanwhile would lie over what the line says.
        window.statusBar().clearMessage()
        for bar in self._bars():
            bar.show()
        self.presenting_changed.emit(False)
        self._arrangements.show(self._arranged)
        for panel in self._panels:
            self._arrangements.bring(panel)
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
        """Cover the maps, so that people guess first; or reveal them."""
        self.covered = not self.covered
        for panel in self._made:
            panel.show_covered(self.covered)

    def next_scene(self) -> None:
        """Go to the next scene."""
        self._go(1)

    def previous_scene(self) -> None:
        """Go to the scene before."""
        self._go(-1)

    def note_scene(self, name: str) -> None:
        """A scene of the paper was opened elsewhere: the next one comes after it."""
        self._steps = steps_of_paper()
        self._at = [one.name for one in scenes.all_scenes()].index(name)
        self._panels = scenes.scene(name).panels

    def show_notes(self) -> None:
        """Show what the speaker reads, on another screen where there is one."""
        if self._notes is None:
            self._notes = NotesWindow(self._window)
            self._notes.addAction(self._actions()["present"])
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
            self._layout.put(self._before)
            self._layout.settling.refit()

    def _bars(self) -> list[QWidget]:
        window = self._window
        return [window.menuBar(), window.statusBar(), *window.findChildren(QToolBar, "setup")]

    def _listen(self, widget: QWidget) -> None:
        doing: dict[str, Callable[[], None]] = {
            "next": self.next_scene,
            "previous": self.previous_scene,
            "cover": self.cover,
            "leave": unless_dragging(self.end),
        }
        for name, do in doing.items():
            for text in KEYS["presenting"].gestures[name].keys:
                key = QShortcut(QKeySequence(text), widget)
                key.activated.connect(do)
                self._keys.append(key)

    def _go(self, by: int) -> None:
        if not self._steps:
            path = self._document.path
            self._steps = (() if path is None else steps_of_folder(path.parent)) or steps_of_paper()
            titles = [one.title for one in self._steps]
            here = "" if path is None else path.stem
            self._at = titles.index(here) if here in titles else -1
        wanted = self._at + by
        if not 0 <= wanted < len(self._steps):
            self.done.emit("This is the last scene" if by > 0 else "This is the first scene")
            return
        # Nobody is asked, in front of an audience, for what will not be.
        if self._whole is not None or self._files.may_lose_changes():
            self._open(wanted)

    def _open(self, number: int) -> None:
        step = self._steps[number]
        try:
            shown = step.open()
        except SkinSourceError as error:
            self.failed.emit(str(error))
            return
        left = "" if self._whole is None else self._whole.left(self._document)
        self._at, self._opening = number, True
        # What was chosen in front of an audience stays, unless a file says something else.
        view = self._colours.on(shown.view, self._document.view, of_file=shown.of_file)
        self._document.start_over(shown.design, view, None, scene=step.title)
        self._files.leave_file()
        self._opening, self._panels = False, shown.panels
        self._whole = WholeScene.of(self._document) if self.presenting else None
        if shown.arrangement:
            self._layout.show_scene(shown.arrangement, shown.panels)
        self.done.emit(f"Scene {number + 1} of {len(self._steps)}: {step.title}{left}")
        self._show_notes()

    def _look(self) -> None:
        # With another design the history is empty; with a step of it, it is not.
        if not self._opening and self._document.undo_stack.count() == 0:
            self._whole, self._steps, self._at, self._panels = None, (), -1, ()
            self._colours.forget(self._document.view)

    def _show_notes(self) -> None:
        if self._notes is None:
            return
        design, following = self._document.design, self._at + 1
        titles = [one.title for one in self._steps]
        heading = titles[self._at] if 0 <= self._at < len(titles) else design.title or "Notes"
        after = titles[following] if 0 < following < len(titles) else ""
        self._notes.show_scene(heading, design.notes, after)
