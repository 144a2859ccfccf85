"""Presenting: the window without its bars, scenes by one key, maps that can be covered, notes."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QObject, Qt, Signal
from shiboken6 import isValid

from skinsource.base.errors import SkinSourceError
from skinsource.design.design import Design
from skinsource.design.design_file import SUFFIX, open_design
from skinsource.design.view import View
from skinsource.studies import scenes
from skinsource_gui.pages.files.file_actions import FileActions
from skinsource_gui.plots.small_map import level_style, with_colours
from skinsource_gui.qt.keys import KEYS, key_text, meaning_of, shortcut_text
from skinsource_gui.qt.layouts import in_column
from skinsource_gui.qt.theme import UNIT_PX
from skinsource_gui.shell.focus import KeyboardFilter
from skinsource_gui.shell.workspaces import Workspaces
from skinsource_gui.state.document import Document
from skinsource_gui.state.services import Services


class ChosenColours:
    """Keeps the level colours that were chosen in the window through a show.

    Parameters
    ----------
    view
        What is open.
    """

    def __init__(self, view: View) -> None:
        self._opened, self._chosen = level_style(view).colours, ""

    def forget(self, view: View) -> None:
        """Begin another show: something else was opened by hand."""
        self._opened, self._chosen = level_style(view).colours, ""

    def on(self, view: View, left: View, *, of_file: bool) -> View:
        """The next view in the colours of this show, unless it has some itself.

        ``left`` is what is left for it.  Scenes of the paper have none: they take those of
        whatever was open.  ``of_file``: colours that another file brought go with that.
        """
        now = level_style(left).colours
        if now != self._opened:
            self._chosen = now
        colours = self._chosen if of_file else now
        shown = with_colours(view, colours) if colours else view
        self._opened = level_style(shown).colours
        return shown


_LARGE = 1.6
_SIZE = 560, 420


class NotesWindow(QtWidgets.QWidget):
    """Title, notes, and what comes next.

    Parameters
    ----------
    window
        What is presented in: keys pressed here are meant for it.
    """

    #: It was closed by hand.
    closed = Signal()

    def __init__(self, window: QtWidgets.QWidget) -> None:
        super().__init__(window, Qt.WindowType.Window)
        self.setObjectName("notes_window")
        self.setWindowTitle("Notes – SkinSource studio")
        self.heading, self.next = QtWidgets.QLabel(self), QtWidgets.QLabel(self)
        self.notes = QtWidgets.QTextBrowser(self)
        self.notes.setOpenExternalLinks(True)
        large = QtGui.QFont(self.font())
        large.setPointSizeF(self.font().pointSizeF() * _LARGE)
        for part in (self.heading, self.notes, self.next):
            part.setFont(large)
        self.heading.setWordWrap(True)
        self.next.setWordWrap(True)
        bold = QtGui.QFont(large)
        bold.setBold(True)
        self.heading.setFont(bold)
        in_column(self.heading, (self.notes, 1), self.next, of=self, margins=2 * UNIT_PX)
        self.resize(*_SIZE)

    def show_scene(self, heading: str, notes: str, following: str) -> None:
        """Show what belongs to a scene, and the title of the one after it."""
        self.heading.setText(heading)
        self.notes.setPlainText(notes or "No notes: a design carries them, see its properties.")
        self.next.setText(f"Next: {following}" if following else "This is the last one.")

    def show_beside(self, window: QtWidgets.QWidget) -> None:
        """Show it on another screen than ``window``, where there is one."""
        others = [
            screen for screen in QtGui.QGuiApplication.screens() if screen is not window.screen()
        ]
        if others:
            self.move(others[0].availableGeometry().center() - self.rect().center())
        self.show()

    def closeEvent(self, event: QtGui.QCloseEvent) -> None:
        super().closeEvent(event)
        self.closed.emit()


_OVERRIDE, _PRESSED = QEvent.Type.ShortcutOverride, QEvent.Type.KeyPress
# Widgets that have the keyboard by chance, after a mouse edit: the key of Play plays there.
_PUSHED = (QtWidgets.QAbstractButton, QtWidgets.QComboBox, QtWidgets.QAbstractItemView)
# These widgets decide whether Esc gives up what is typed.
_TEXTS = (QtWidgets.QLineEdit, QtWidgets.QPlainTextEdit, QtWidgets.QTextEdit)


class PresentingKeys(KeyboardFilter):
    """Takes keys from the widget that has the keyboard, until its end.

    Clickers send Page Down and Page Up: plots go through time with them and numbers take large
    steps; a shortcut of the window would come after those.  The key of Play plays, also on a list,
    and Esc leaves, also on a map whose outputs it would unselect: here too shortcuts of the window
    come after.  What is typed or dragged has both first.

    Parameters
    ----------
    handlers
        What is done by the keys of "next", "previous" and "leave".
    play
        What is done by its shortcut, where no shortcut of the window is asked.
    parent
        Its owner.
    """

    def __init__(
        self,
        handlers: Mapping[str, Callable[[], None]],
        play: QtGui.QAction,
        parent: QObject,
    ) -> None:
        super().__init__(parent)
        self._play = play
        self._handlers = {**handlers, "play": play.trigger}
        self.follow(True)

    def end(self) -> None:
        """Leave the keys to the widget that has the keyboard."""
        self.follow(False)
        self.deleteLater()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() not in (_OVERRIDE, _PRESSED) or not isinstance(event, QtGui.QKeyEvent):
            return super().eventFilter(watched, event)
        plays = QtGui.QKeySequence(event.keyCombination()) in self._play.shortcuts()
        meaning = "play" if plays else meaning_of("presenting", event)
        do = self._handlers.get(meaning)
        elsewhere = (
            QtWidgets.QApplication.activeModalWidget() or QtWidgets.QApplication.activePopupWidget()
        )
        if do is None or elsewhere or not _belongs_to_presenter(watched, meaning):
            return super().eventFilter(watched, event)
        if event.type() == _PRESSED:
            do()
        elif meaning in ("play", "leave"):
            # `EscapeTwice` and a shortcut of the window get the event too.
            return super().eventFilter(watched, event)
        event.accept()
        return True


def _belongs_to_presenter(watched: QObject, meaning: str) -> bool:
    """Return whether a key is not for the widget with the keyboard."""
    if meaning == "play":
        return isinstance(watched, _PUSHED)
    if meaning == "leave":
        return not isinstance(watched, _TEXTS) and not QtWidgets.QApplication.mouseButtons()
    return True


#: One scene of a list: the file of a design, or the name of a scene of the paper.
Step = Path | str


def steps_of_folder(folder: Path) -> tuple[Step, ...]:
    """Return the designs of a folder in the order of their names."""
    try:
        return tuple(sorted(path for path in folder.iterdir() if path.suffix == SUFFIX))
    except OSError:
        return ()


def steps_of_paper() -> tuple[Step, ...]:
    """Return the scenes of the paper, in the order of the figures."""
    return tuple(scene.name for scene in scenes.all_scenes())


def step_title(step: Step) -> str:
    """Return what a scene of a list is called."""
    return step.stem if isinstance(step, Path) else scenes.scene(step).heading


@dataclass(frozen=True, slots=True)
class WholeScene:
    """A design, and those of the snapshots beside it by their numbers: levels match by themselves.

    Attributes
    ----------
    design, snapshots
        As they were.
    title
        What scene or file is called.
    """

    design: Design
    snapshots: dict[int, Design]
    title: str

    @classmethod
    def of(cls, document: Document) -> "WholeScene":
        """Return the scene that is open now."""
        snapshots = {snapshot.number: snapshot.design for snapshot in document.view.snapshots}
        file = "" if document.path is None else document.path.stem
        return cls(document.design, snapshots, document.scene or file)

    def left(self, document: Document) -> str:
        """Return the note for leaving it, if it has changes that no file holds."""
        if not document.modified or self == WholeScene.of(document):
            return ""
        return f"; changes to {self.title.partition(' · ')[0]} are not kept"


class Presenter(QObject):
    """Hides the bars of the window, and steps through scenes.

    Parameters
    ----------
    window
        What is presented in; also the parent.
    document
        Scenes are opened into it.
    panels
        Their maps are covered.
    files
        Asks what becomes of unsaved work.
    actions
        Returns the actions by name, whose keys work while the menus are hidden.

    Attributes
    ----------
    presenting
        Whether the bars are away.
    covered
        Whether the maps are, in all panels.
    """

    #: A message on a scene, or on how to leave.
    done = Signal(str)
    #: Why a scene does not open.
    failed = Signal(str)
    #: Whether it presents: emitted before the bars hide, and after they are back.
    presenting_changed = Signal(bool)

    def __init__(
        self,
        services: Services,
        files: FileActions,
        workspaces: Workspaces,
        actions: Callable[[], Mapping[str, QtGui.QAction]],
    ) -> None:
        window, document, panels = services.window, services.document, services.panels
        super().__init__(window)
        self._window, self._document = window, document
        self._files, self._actions = files, actions
        self._workspaces = workspaces
        self.presenting = self.covered = False
        self._made = panels
        panels.each(lambda panel: panel.show_covered(self.covered))
        self._focused: QtWidgets.QWidget | None = None
        self._steps: tuple[Step, ...] = ()
        self._at = -1
        self._panels: tuple[str, ...] = ()
        # The scene that is open, as it was when it was presented: what is turned in it meanwhile is
        # not kept.  None: there is work in it that is asked about.
        self._unchanged: WholeScene | None = None
        self._opening = False
        self._colours = ChosenColours(document.view)
        self._notes: NotesWindow | None = None
        self._keys: list[QtGui.QShortcut] = []
        self._presenting_keys: PresentingKeys | None = None
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
        self._unchanged = WholeScene.of(self._document) if whole else None
        self._focused = window.focusWidget()
        self.presenting_changed.emit(True)
        self._workspaces.begin_show(self._panels)
        for bar in self._bars():
            bar.hide()
        # Keys of menus that are away would be dead.
        window.addActions(list(self._actions().values()))
        window.setWindowState(window.windowState() | Qt.WindowState.WindowFullScreen)
        for keyboard in (window, self._notes):
            if keyboard is not None:
                self._listen(keyboard)
        handlers = {"next": self.next_scene, "previous": self.previous_scene, "leave": self.end}
        self._presenting_keys = PresentingKeys(handlers, self._actions()["play"], self)
        following = KEYS["presenting"].gestures["next"].shown
        cover = key_text("presenting", "cover")
        leave = f"{shortcut_text('present')} or {key_text('presenting', 'leave')}"
        self.done.emit(f"{following}: next scene · {cover}: cover the maps · {leave}: leave")

    def end(self) -> None:
        """Bring back bars, panels where they stood, with those of the scene, and the map."""
        window = self._window
        self.presenting, self._unchanged = False, None
        for action in self._actions().values():
            window.removeAction(action)
        for key in self._keys:
            key.setEnabled(False)
            key.deleteLater()
        self._keys.clear()
        if self._presenting_keys is not None:
            self._presenting_keys.end()
            self._presenting_keys = None
        window.setWindowState(window.windowState() & ~Qt.WindowState.WindowFullScreen)
        # What was told meanwhile would lie over what the line says.
        window.statusBar().clearMessage()
        for bar in self._bars():
            bar.show()
        self.presenting_changed.emit(False)
        self._workspaces.end_show(self._panels)
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
        self._at = [scene.name for scene in scenes.all_scenes()].index(name)
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

    def _bars(self) -> list[QtWidgets.QWidget]:
        return [self._window.menuWidget(), self._window.statusBar()]

    def _end_unless_dragging(self) -> None:
        # During a drag Esc is meant for what is dragged.
        if not QtWidgets.QApplication.mouseButtons():
            self.end()

    def _listen(self, widget: QtWidgets.QWidget) -> None:
        doing: dict[str, Callable[[], None]] = {
            "next": self.next_scene,
            "previous": self.previous_scene,
            "cover": self.cover,
            "leave": self._end_unless_dragging,
        }
        for name, do in doing.items():
            for text in KEYS["presenting"].gestures[name].keys:
                key = QtGui.QShortcut(QtGui.QKeySequence(text), widget)
                key.activated.connect(do)
                self._keys.append(key)

    def _go(self, by: int) -> None:
        if not self._steps:
            path = self._document.path
            self._steps = (() if path is None else steps_of_folder(path.parent)) or steps_of_paper()
            stems = [step_title(step) for step in self._steps]
            here = "" if path is None else path.stem
            self._at = stems.index(here) if here in stems else -1
        target = self._at + by
        if not 0 <= target < len(self._steps):
            self.done.emit("This is the last scene" if by > 0 else "This is the first scene")
            return
        # In front of an audience no question is asked on changes that are never saved.
        if self._unchanged is not None or self._files.may_lose_changes():
            self._open(target)

    def _open(self, number: int) -> None:
        step = self._steps[number]
        title = step_title(step)
        arrangement = ""
        panels: tuple[str, ...] = ()
        try:
            if isinstance(step, Path):
                content = open_design(step)
                design, view = content.design, content.view
            else:
                opened = scenes.open_scene(step)
                design, view = opened.design, opened.view
                arrangement, panels = opened.scene.arrangement, opened.scene.panels
        except SkinSourceError as error:
            self.failed.emit(str(error))
            return
        left = "" if self._unchanged is None else self._unchanged.left(self._document)
        self._at, self._opening = number, True
        # Colours chosen in front of an audience stay, unless a file has others.
        view = self._colours.on(view, self._document.view, of_file=isinstance(step, Path))
        self._document.start_over(design, view, None, scene=title)
        self._files.leave_file()
        self._opening, self._panels = False, panels
        self._unchanged = WholeScene.of(self._document) if self.presenting else None
        if arrangement:
            self._workspaces.show_scene(arrangement, panels)
        self.done.emit(f"Scene {number + 1} of {len(self._steps)}: {title}{left}")
        self._show_notes()

    def _look(self) -> None:
        # With another design the history is empty; with a step of it, it is not.
        if not self._opening and self._document.undo_stack.count() == 0:
            self._unchanged, self._steps, self._at, self._panels = None, (), -1, ()
            self._colours.forget(self._document.view)

    def _show_notes(self) -> None:
        if self._notes is None:
            return
        design, following = self._document.design, self._at + 1
        titles = [step_title(step) for step in self._steps]
        heading = titles[self._at] if 0 <= self._at < len(titles) else design.title or "Notes"
        after = titles[following] if 0 < following < len(titles) else ""
        self._notes.show_scene(heading, design.notes, after)
