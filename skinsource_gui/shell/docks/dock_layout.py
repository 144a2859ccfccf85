"""Where the docks of a window stand: between sessions, and in the files of designs."""

from collections.abc import Mapping, Sequence

from PySide6.QtCore import QByteArray, QEvent, QObject, QTimer, Signal
from PySide6.QtGui import QGuiApplication, QScreen
from PySide6.QtWidgets import QMainWindow

from skinsource_gui.shell.docks.arrangement_spec import PRESENTATION, ArrangementSpec
from skinsource_gui.shell.docks.arrangements import Arrangements
from skinsource_gui.shell.docks.dock import Dock
from skinsource_gui.shell.docks.settling import Settling
from skinsource_gui.state.preferences import Preferences

_AS_AT_FIRST = "Panels as at first; {key} again brings yours back"
_AS_LEFT = "Panels as you had them; {key} again shows them as at first"


class DockLayout(QObject):
    """Brings back what the window was like, and remembers it, for each arrangement.

    Parameters
    ----------
    window
        Whose docks; also the parent.
    docks, arrangements
        Its docks, and what arranges them.
    preferences
        Where it is remembered between sessions.

    Attributes
    ----------
    settling
        Knows whether somebody has moved the docks.
    """

    #: How the panels stand now, where that may surprise.
    done = Signal(str)

    def __init__(
        self,
        window: QMainWindow,
        docks: Mapping[str, Dock],
        arrangements: Arrangements,
        preferences: Preferences,
    ) -> None:
        super().__init__(window)
        self._window, self._docks, self._preferences = window, docks, preferences
        self._arrangements = arrangements
        self.settling = Settling(window, docks, arrangements)
        arrangements.chosen.connect(self._note_arrangement)
        self._present: ArrangementSpec | None = None
        # By arrangement, what the user made of it.
        self._own: dict[str, bytes] = {}
        # What the user had before a scene took up its arrangement: its name, and where the docks
        # stood if they were moved; None: no scene has.
        self._before_scene: tuple[str, bytes] | None = None
        # Place of the window, arrangement and docks before they were presented; None: they are not.
        self._held: tuple[QByteArray, str, bytes] | None = None

    def choose(self, name: str) -> None:
        """Take up an arrangement as it was left; the present one as at first, and again as left.

        Nothing that the user made of an arrangement is lost by its key.
        """
        before, touched = self._present, bool(self._kept())
        self._before_scene = None
        own = self._own.get(name, b"")
        again = before is not None and before.name == name
        self._arrangements.show(name)
        if own and not (again and touched):
            self.put(own)
        self._arrangements.keyboard.settle()
        if own and self._present is not None:
            words = _AS_AT_FIRST if again and touched else _AS_LEFT
            self.done.emit(words.format(key=self._present.keys[0]))

    def show_scene(self, arrangement: str, panels: Sequence[str]) -> None:
        """Take up the arrangement of a scene, as at first, and bring its panels in sight.

        It is the same whatever was in sight before; `leave_scene` takes it back.  While scenes are
        presented they stand as people further off can read them.

        Parameters
        ----------
        arrangement
            Its name.
        panels
            Names of panels; the last of several in one place comes to the front.
        """
        if self._held is not None:
            self._arrangements.show(PRESENTATION)
        else:
            kept = self._kept()
            if self._before_scene is None and self._present is not None:
                self._before_scene = (self._present.name, kept)
            self._arrangements.show(arrangement)
        for panel in panels:
            if panel in self._docks:
                self._docks[panel].bring_forward()

    def leave_scene(self) -> None:
        """Put the docks where the user had them before a scene took up its arrangement.

        While they are presented they stay as people further off can read them.
        """
        if self._before_scene is None or self._held is not None:
            return
        self._kept()
        (name, content), self._before_scene = self._before_scene, None
        self._arrangements.show(name)
        self.put(content)
        self._arrangements.keyboard.settle()

    def hold(self) -> None:
        """Remember how all is now for the next session; what comes is for an audience."""
        self._held = self._window.saveGeometry(), self._preferences.arrangement, self.own()

    def release(self) -> None:
        """Remember again what comes."""
        self._held = None

    def content(self) -> bytes:
        """What `put` and `show_panels` take back."""
        return bytes(self._window.saveState().data())

    def own(self) -> bytes:
        """What `put` takes back; empty where nobody moved a dock: it will be arranged again."""
        return b"" if self.settling.untouched else self.content()

    def put(self, content: bytes) -> None:
        """Put the docks where they stood in this very window, if anything is said about it."""
        if content:
            self._window.restoreState(QByteArray(content))
            self.settling.forget()

    def show_panels(self, content: bytes) -> None:
        """Show and hide the panels that were shown and hidden, if anything is said about it.

        Of panels that share a place, one that was in sight comes to the front.

        Where they stand and how large they are stays: that belongs to this window and its screen,
        not to the one in which a file was saved.
        """
        before = self._window.saveState()
        if not content or not self._window.restoreState(QByteArray(content)):
            return
        docks = self._docks.values()
        hidden = {dock: dock.isHidden() for dock in docks}
        in_sight = [dock for dock in docks if dock.isVisible() and dock.in_sight]
        self._window.restoreState(before)
        for dock, hide in hidden.items():
            if dock.isHidden() != hide:
                dock.setHidden(hide)
        for dock in in_sight:
            if not dock.in_sight:
                dock.raise_()
        self._arrangements.keyboard.settle()

    def restore(self) -> None:
        """Bring back the last session; its sizes only where its screen is there."""
        screen, layout = self._preferences.screen, self._preferences.layout
        fits = not screen or screen in map(screen_words, QGuiApplication.screens())
        if fits:
            self._window.restoreGeometry(self._preferences.geometry)
        # With the arrangement come its large words; where its docks were moved, they stand there.
        self._arrangements.show(self._preferences.arrangement)
        self._own = self._preferences.own_arrangements if fits else {}
        (self.put if fits else self.show_panels)(bytes(layout.data()))
        self._window.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if watched is self._window and event.type() == QEvent.Type.Show:
            watched.removeEventFilter(self)
            # Qt shows the window itself after this event.
            QTimer.singleShot(0, self, self._show_floating)
        return super().eventFilter(watched, event)

    def close(self) -> None:
        """Remember this session for the next one; the window closes."""
        now = self._window.saveGeometry(), self._preferences.arrangement, self.own()
        # The next session begins without an audience, and without a scene.
        geometry, arrangement, content = self._held or now
        arrangement, content = self._before_scene or (arrangement, content)
        self._preferences.geometry, self._preferences.arrangement = geometry, arrangement
        self._preferences.layout = QByteArray(content)
        self._preferences.screen = screen_words(self._window.screen())
        self._preferences.own_arrangements = self._own
        self._preferences.flush()
        for dock in self._docks.values():
            # A panel in a window of its own does not close with this one on every desktop.
            if dock.isFloating():
                dock.hide()

    def _kept(self) -> bytes:
        """Keep what the user made of the present arrangement; empty where nothing was moved."""
        if self._present is None or self.settling.untouched:
            return b""
        content = self._own[self._present.name] = self.content()
        return content

    def _note_arrangement(self, spec: ArrangementSpec) -> None:
        self._preferences.arrangement = spec.name
        self._present = spec

    def _show_floating(self) -> None:
        """Show panels out of the window once more, now that there is one to be in front of.

        A desktop keeps a window in front of its parent only if that was shown first.
        """
        for dock in self._docks.values():
            if dock.isFloating() and dock.isVisible():
                dock.hide()
                dock.show()
        # The window is as large as its screen lets it be.
        self.settling.refit()


def screen_words(screen: QScreen) -> str:
    """What sizes of windows depend on: the room on a screen and its scale."""
    room = screen.availableGeometry()
    return f"{room.width()} x {room.height()} at {screen.devicePixelRatio():g}"
