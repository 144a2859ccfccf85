"""Presenting: the window without its bars, scenes by one key, maps that can be covered, notes."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, cast

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QObject, Qt, Signal
from shiboken6 import isValid

from skinsource.base.errors import DesignFileError, SkinSourceError
from skinsource.design.design import Design, View
from skinsource.design.design_file import SUFFIX, ShowEntry, UnreadEntry, open_design, open_show
from skinsource.design.panel_settings import STAGE, StageSettings, settings_of, with_settings
from skinsource.design.presets.presets import by_number
from skinsource.studies import scenes
from skinsource_gui import pages
from skinsource_gui.pages.files.file_actions import FileActions
from skinsource_gui.plots.small_map import with_colours_of
from skinsource_gui.qt.buttons import page_label
from skinsource_gui.qt.keys import KEYS, key_text, meaning_of, shortcut_text
from skinsource_gui.qt.layouts import in_column
from skinsource_gui.qt.theme import UNIT_PX, scaled
from skinsource_gui.shell.focus import KeyboardFilter
from skinsource_gui.shell.workspaces import PRESENTATION, Workspaces
from skinsource_gui.state.panel import Panel
from skinsource_gui.state.services import Services

if TYPE_CHECKING:
    from skinsource_gui.pages.show import ShowPage
    from skinsource_gui.panels.compare.maps import MapsPanel
    from skinsource_gui.panels.compare.stage import StagePanel

Entry = ShowEntry | UnreadEntry

_LARGE = 1.6
_SIZE = 560, 420
# What keys do on the stage.
_HINTS = (
    "{next} or {previous}: other scene · {motion}{fit}: fit scales · "
    "{cover}: cover · {compare}: compare · {arm}: arm · {snapshots}"
    "{more}: all keys · {end} or {leave}: leave"
)
_MOVING, _LEVELS = "{hold}: pause · {levels}: levels · ", "{levels}: motion · "
_SNAPSHOTS = "{other}: other snapshot · "


class NotesWindow(QtWidgets.QWidget):
    """Title, notes, and what comes next.

    Parameters
    ----------
    window
        What is presented in: keys pressed here are meant for it.
    """

    def __init__(self, window: QtWidgets.QWidget) -> None:
        super().__init__(window, Qt.WindowType.Window)
        self.setObjectName("notes_window")
        self.setWindowTitle("Notes – SkinSource studio")
        self.heading, self.next = page_label("notes_heading"), page_label("notes_next")
        self.notes = QtWidgets.QTextBrowser(self)
        self.notes.setOpenExternalLinks(True)
        large = scaled(self.font(), _LARGE)
        for part in (self.heading, self.notes, self.next):
            part.setFont(large)
        large.setBold(True)
        self.heading.setFont(large)
        in_column(self.heading, (self.notes, 1), self.next, of=self, margins=2 * UNIT_PX)
        self.resize(*_SIZE)

    def show_scene(self, heading: str, notes: str, following: str) -> None:
        """Show what belongs to a scene, and the title of the one after it."""
        self.heading.setText(heading)
        self.notes.setPlainText(notes or "No notes. File > Show… adds them.")
        self.next.setText(f"Next: {following}" if following else "This is the last one.")

    def show_beside(self, window: QtWidgets.QWidget) -> None:
        """Show it on another screen than ``window``, where there is one."""
        others = [each for each in QtGui.QGuiApplication.screens() if each is not window.screen()]
        if others:
            self.move(others[0].availableGeometry().center() - self.rect().center())
        self.show()


_OVERRIDE, _PRESSED = QEvent.Type.ShortcutOverride, QEvent.Type.KeyPress
# These widgets decide whether Esc and Space are for what is typed.
_TEXTS = (QtWidgets.QLineEdit, QtWidgets.QPlainTextEdit, QtWidgets.QTextEdit)


class PresentingKeys(KeyboardFilter):
    """Takes keys from the widget that has the keyboard.

    Clickers send Page Down and Page Up, with which a dial takes large steps; and Space and Esc mean
    something to lists, buttons and maps.  What is typed or dragged has Esc and Space first.

    Parameters
    ----------
    handlers
        Returns what is done by keys of their meanings, for the widget that has the keyboard.
    parent
        Its owner.
    """

    def __init__(
        self, handlers: Callable[[QObject], Mapping[str, Callable[[], None]]], parent: QObject
    ) -> None:
        super().__init__(parent)
        self._handlers = handlers
        self.follow(True)

    def wanted(self, focused: QtWidgets.QWidget | None) -> QtWidgets.QWidget | None:
        return focused or QtWidgets.QApplication.activeWindow()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() not in (_OVERRIDE, _PRESSED) or not isinstance(event, QtGui.QKeyEvent):
            return super().eventFilter(watched, event)
        meaning = meaning_of("presenting", event)
        do = self._handlers(watched).get(meaning)
        elsewhere = (
            QtWidgets.QApplication.activeModalWidget() or QtWidgets.QApplication.activePopupWidget()
        )
        if do is None or elsewhere or not _belongs_to_presenter(watched, meaning):
            return super().eventFilter(watched, event)
        if event.type() == _PRESSED:
            do()
        elif meaning == "leave":
            # `EscapeTwice` gets the event too.
            return super().eventFilter(watched, event)
        event.accept()
        return True


def _belongs_to_presenter(watched: QObject, meaning: str) -> bool:
    """Return whether a key is not for the widget with the keyboard."""
    if meaning in ("next", "previous"):
        return True
    # A number counts as a text only while it is typed.
    typing = (
        isinstance(watched, _TEXTS)
        and not watched.isReadOnly()
        and getattr(watched, "editing", True)
    )
    # Where a file was chosen by a double click, a button counts as pressed that is up.
    under_mouse = isinstance(watched, QtWidgets.QWidget) and watched.underMouse()
    return not (typing or (under_mouse and QtWidgets.QApplication.mouseButtons()))


@dataclass(frozen=True, slots=True)
class Step:
    """One scene of a list.

    Attributes
    ----------
    title
        What it is called before it is opened.
    opened
        Returns design and view.
    path
        Its file, into which it is saved; None: it has none.
    """

    title: str
    opened: Callable[[], tuple[Design, View]]
    path: Path | None = None


def steps_of_folder(folder: Path) -> tuple[Step, ...]:
    """Return the designs of a folder in the natural order of their names: 1, 2, 10."""

    def opened(path: Path) -> tuple[Design, View]:
        content = open_design(path)
        return content.design, content.view

    try:
        paths = [path for path in folder.iterdir() if path.suffix == SUFFIX]
    except OSError:
        return ()
    paths.sort(key=lambda path: by_number(path.stem))
    return tuple(Step(at.stem, partial(opened, at), at) for at in paths)


def steps_of_show(entries: Sequence[Entry]) -> tuple[Step, ...]:
    """Return the designs of a show; one that cannot be read says why when it is opened."""

    def opened(entry: Entry) -> tuple[Design, View]:
        if isinstance(entry, UnreadEntry):
            raise DesignFileError(entry.problem)
        return entry.presented

    return tuple(
        Step(getattr(entry, "title", "An entry that cannot be read"), partial(opened, entry))
        for entry in entries
    )


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
        self._workspaces, self._preferences = workspaces, services.preferences
        self._show_path: Path | None = None
        self._page: ShowPage | None = None
        self.presenting = self.covered = False
        self._made = panels
        panels.each(self._meet)
        self._focused: QtWidgets.QWidget | None = None
        self._steps: tuple[Step, ...] = ()
        self._entries: tuple[Entry, ...] = ()
        self._at = -1
        # Steps of the history when the design was put on the stage: what is turned there is taken
        # back.  Whether there is work in it from elsewhere.
        self._begun, self._worked = 0, False
        self._opening = False
        self._notes: NotesWindow | None = None
        document.jumped.connect(self._look)
        files.saving.connect(self._keep_comparison)
        document.undo_stack.indexChanged.connect(self._note_step)

    def toggle(self) -> None:
        """Begin to present, or end."""
        (self.end if self.presenting else self.begin)()

    def begin(self) -> None:
        """Take the bars away, and arrange the panels for people further off."""
        window = self._window
        self.presenting = True
        if self._document.path is not None:
            self._worked = self._worked or self._document.modified
        self._begun = self._document.undo_stack.index()
        self._focused = window.focusWidget()
        self._keep_comparison()
        self.presenting_changed.emit(True)
        self._workspaces.begin_show()
        for bar in self._bars():
            bar.hide()
        # Keys of menus that are away would be dead; here Space moves no actuator.
        window.addActions([each for name, each in self._actions().items() if name != "play"])
        window.setWindowState(window.windowState() | Qt.WindowState.WindowFullScreen)
        keys = {name: key_text("presenting", name) for name in KEYS["presenting"].gestures}
        more, end = map(shortcut_text, ("show_keys", "present"))
        stage = cast("StagePanel", self._made[STAGE])
        motion = (_MOVING if stage.moves else _LEVELS).format(**keys) * stage.kind.moves
        snapshots = _SNAPSHOTS.format(**keys) * bool(self._document.view.snapshots)
        texts = {"motion": motion, "snapshots": snapshots, "more": more, "end": end}
        self.done.emit(_HINTS.format(**keys, **texts))

    def end(self) -> None:
        """Bring back bars, panels where they stood, with those of the scene, and the map."""
        window = self._window
        self.presenting = False
        turned, self._begun = self._take_back(), 0
        for action in self._actions().values():
            window.removeAction(action)
        window.setWindowState(window.windowState() & ~Qt.WindowState.WindowFullScreen)
        # What was told meanwhile would lie over what the line says.
        window.statusBar().clearMessage()
        for bar in self._bars():
            bar.show()
        self.presenting_changed.emit(False)
        self._workspaces.end_show()
        if self._focused is not None and isValid(self._focused):
            self._focused.setFocus()
        if self.covered:
            self.cover()
        if self._notes is not None:
            self._notes.close()
        if turned:
            self.done.emit("The design is as it was before; Redo brings back what was turned")

    def _take_back(self) -> bool:
        """Take back what was turned on the stage, unless it was saved; return whether it was."""
        document, stack = self._document, self._document.undo_stack
        turned = document.design
        saved = self._begun <= stack.cleanIndex() <= stack.index()
        document.go_to(stack.cleanIndex() if saved else self._begun)
        return turned != document.design and not document.holds(turned)

    def cover(self) -> None:
        """Cover the maps, so that people guess first; or reveal them."""
        self.covered = not self.covered
        for panel in self._made:
            panel.show_covered(self.covered)

    def open_file(self, path: Path) -> None:
        """Open a show: its first design on the stage, the others come after it."""
        try:
            entries = open_show(path)
        except SkinSourceError as error:
            self.failed.emit(str(error))
            return
        if self._page is not None:
            self._page.reject()
        if self._page is None and entries and self._may_leave():
            self._files.note_used(path)
            self._open_show(path, entries, 0)

    def make_show(self) -> "ShowPage":
        """Open the page on which the show that is open, or a new one, is changed."""
        page = self._page
        if page is None:
            of_show = self._show_path, self._entries
            page = pages.ShowPage(self._shown_entry, self._preferences, self._window, *of_show)
            page.presented.connect(self._present)
            # It comes back with what is not saved.
            self.presenting_changed.connect(page.setHidden)
            page.saved.connect(self._note_saved)
            page.finished.connect(self._forget_page)
            self._page = page
        page.show()
        page.raise_()
        page.activateWindow()
        return page

    def _present(self, entries: Sequence[Entry], at: int) -> None:
        if entries and self._may_leave():
            if not self.presenting:
                self.begin()
            self._open_show(self._show_path, entries, at)

    def _open_show(self, path: Path | None, entries: Sequence[Entry], at: int) -> None:
        self._show_path, self._entries = path, tuple(entries)
        self._steps = steps_of_show(entries)
        self._open(at)

    def note_scene(self, name: str) -> None:
        """A scene of the paper was opened elsewhere: the next one comes after it."""
        self._steps, self._entries, self._show_path = self._steps_of_paper(), (), None
        self._at = [scene.name for scene in scenes.all_scenes()].index(name)
        self._made[STAGE].setFocus()

    def show_notes(self) -> None:
        """Show what the speaker reads, on another screen where there is one."""
        if self._notes is None:
            self._notes = NotesWindow(self._window)
            self._notes.addAction(self._actions()["present"])
        self._show_notes()
        self._notes.show_beside(self._window)

    @property
    def _document_name(self) -> str:
        """What the design is called among scenes or files."""
        path = self._document.path or self._document.recovered_from
        return self._document.scene or ("Untitled" if path is None else path.stem)

    def _keep_comparison(self) -> None:
        """Have the stage show what the Compare panel compares, if that is in sight."""
        document, view = self._document, self._document.view
        if "compare" in self._made and (panel := self._made["compare"]).isVisible():
            maps = cast("MapsPanel", panel)
            several = maps.kind.is_several(maps.settings, document.design, view)
            stage = replace(settings_of(view, STAGE, StageSettings), compared=several)
            if several and maps.kind.moves:
                stage = replace(stage, moves=maps.moves)
            document.look(with_settings(view, STAGE, stage))

    def _shown_entry(self) -> ShowEntry:
        """Return the entry of a show that the design in the window is now."""
        self._keep_comparison()
        design, name = self._document.design, self._document_name
        return ShowEntry.of(design, self._document.view, design.title or name)

    def _bars(self) -> list[QtWidgets.QWidget]:
        return [self._window.menuWidget(), self._window.statusBar()]

    def _note_saved(self, path: Path | None, entries: tuple[Entry, ...]) -> None:
        self._at = min(self._at, len(entries) - 1) if self._entries else -1
        self._show_path, self._entries, self._steps = path, entries, steps_of_show(entries)
        if path is not None:
            self._files.note_used(path)

    def _forget_page(self) -> None:
        self._page = None

    def _meet(self, panel: Panel) -> None:
        panel.show_covered(self.covered)
        if panel.name == STAGE:
            cast("StagePanel", panel).named = lambda: self._document_name
            PresentingKeys(self._handlers, self)

    def _handlers(self, watched: QObject) -> dict[str, Callable[[], None]]:
        stage = cast("StagePanel", self._made[STAGE])
        moves, still = stage.kind.moves, partial(self.done.emit, "Time windows do not move")
        on_stage: dict[str, Callable[[], None]] = {
            "next": partial(self.go, "1"),
            "previous": partial(self.go, "-1"),
            "cover": self.cover,
            "hold": stage.hold if moves else still,
            "levels": stage.show_levels if moves else still,
            "fit": stage.fit,
            "compare": stage.compare,
            "arm": stage.show_arm,
        }
        if not self.presenting:
            at = cast(QtWidgets.QWidget, watched)
            page = self._preferences.arrangement == PRESENTATION and at.window() is self._window
            here = page or watched is self._window or stage.isAncestorOf(at)
            return on_stage if here and stage.isVisible() else {}
        return {"leave": self.end, **on_stage}

    def go(self, by: str) -> None:
        """Go to the next scene; "-1": to the one before."""
        if not self._steps:
            path = self._document.path
            beside = () if path is None else steps_of_folder(path.parent)
            self._steps, title = beside or self._steps_of_paper(), self._document.design.title
            here = [step.path == path for step in beside]
            # A scene of a show that was given up is still one of the paper.
            here = here or [scene.title in title for scene in scenes.all_scenes()]
            self._at = here.index(True) if any(here) else -1
        target = self._at + int(by)
        if not 0 <= target < len(self._steps):
            self.done.emit("This is the last scene" if int(by) > 0 else "This is the first scene")
            return
        if self._may_leave():
            self._open(target)

    def _may_leave(self) -> bool:
        return not self._asks() or self._files.may_lose_changes()

    def _asks(self) -> bool:
        """Return whether it is asked what becomes of changes.

        What was turned on the stage of a scene is never saved, nor what is in front of an audience.
        """
        is_file = self._document.path is not None
        return self._worked or not (self.presenting if is_file else self._at >= 0)

    def _note_step(self) -> None:
        """Note work that is done where more than the stage is seen, or something else."""
        # The history is emptied once more when it is deleted.
        if not self.presenting and isValid(self._document.undo_stack):
            shown = [panel.name for panel in self._made if panel.isVisible()]
            self._worked = self._worked or (shown != [STAGE] and self._document.modified)

    def _steps_of_paper(self) -> tuple[Step, ...]:
        """Return the scenes of the paper, in the order of the figures."""

        def opened(name: str) -> tuple[Design, View]:
            scene = scenes.open_scene(name)
            # Colours chosen in front of an audience stay.
            view = with_colours_of(scene.view, self._document.view)
            return scene.design, replace(view, slow_motion=0.0)

        return tuple(
            Step(scene.heading, partial(opened, scene.name)) for scene in scenes.all_scenes()
        )

    def _open(self, number: int) -> None:
        step = self._steps[number]
        # One that does not open is passed by with the next key.
        self._at = number
        try:
            design, view = step.opened()
        except SkinSourceError as error:
            self.failed.emit(f"Scene {number + 1}: {error}")
            return
        title = (scenes.title_of(design) if design.title else "") or step.title
        document, left = self._document, ""
        if (self.presenting or not self._asks()) and self._take_back():
            left = f"; changes to {self._document_name.partition(' · ')[0]} are not saved"
        self._opening = True
        read_only = self._files.leave_file(step.path) is not None
        scene = "" if step.path else title
        document.start_over(design, view, step.path, read_only=read_only, scene=scene)
        self._opening = False
        self._begun, self._worked = 0, False
        self._workspaces.show_scene()
        # What was paused is another scene.
        cast("StagePanel", self._made[STAGE]).clock.held = False
        self.done.emit(f"Scene {number + 1} of {len(self._steps)}: {title}{left}")
        self._show_notes()

    def _look(self) -> None:
        # With another design the history is empty; with a step of it, it is not.
        if not self._opening and self._document.undo_stack.count() == 0:
            self._begun, self._worked = 0, False
            self._steps, self._entries, self._show_path, self._at = (), (), None, -1

    def _show_notes(self) -> None:
        if self._notes is None:
            return
        design, following = self._document.design, self._at + 1
        titles = [step.title for step in self._steps]
        heading = titles[self._at] if 0 <= self._at < len(titles) else design.title or "Notes"
        after = titles[following] if 0 < following < len(titles) else ""
        self._notes.show_scene(heading, design.notes, after)
