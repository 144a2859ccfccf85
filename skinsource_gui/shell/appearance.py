"""Theme and text size of the studio; place, title and full screen of its window."""

from collections.abc import Sequence

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QMargins, QObject, QRect, Qt, QTimer, Signal

from skinsource.base.errors import printable
from skinsource.design.comparing import stored_name
from skinsource.limbs.own_limbs import missing_limb
from skinsource.studies import scenes
from skinsource_gui.qt.theme import THEMES, apply_theme
from skinsource_gui.qt.windows import application, fitted
from skinsource_gui.state.document import Document
from skinsource_gui.state.preferences import Preferences

#: One step of "Larger text", and how far it goes.
TEXT_STEP, SMALLEST_TEXT, LARGEST_TEXT = 1.1, 0.8, 3.0


class Appearance(QObject):
    """Applies theme and size of words to the application, and remembers them.

    Parameters
    ----------
    preferences
        Where they are remembered.
    """

    #: Theme or size of words is another one.
    changed = Signal()

    def __init__(self, preferences: Preferences, parent: QObject) -> None:
        super().__init__(parent)
        self._preferences = preferences
        QtGui.QGuiApplication.styleHints().colorSchemeChanged.connect(self._follow_desktop)
        # Some widgets that are made before the first time would keep their font.
        self.apply()

    @property
    def text_scale(self) -> float:
        """Size of words, 1 as the desktop has it."""
        return min(self._preferences.text_scale, LARGEST_TEXT)

    def use_theme(self, name: str) -> None:
        """Take over ``"light"``, ``"dark"`` or ``"system"``."""
        self._preferences.theme_name = name
        self.apply()

    def enlarge_text(self, steps: str) -> None:
        """Make all words larger; "-1": smaller."""
        self._scale_text(self._preferences.text_scale * TEXT_STEP ** int(steps))

    def reset_text(self) -> None:
        """Make words as large as the desktop has them."""
        self._scale_text(1.0)

    def apply(self) -> None:
        """Give the whole application theme and size of words."""
        dark = QtGui.QGuiApplication.styleHints().colorScheme() == Qt.ColorScheme.Dark
        system = THEMES["dark" if dark else "light"]
        theme = THEMES.get(self._preferences.theme_name, system)
        apply_theme(application(), theme, self.text_scale)
        self.changed.emit()

    def _scale_text(self, scale: float) -> None:
        scale = min(max(scale, SMALLEST_TEXT), LARGEST_TEXT)
        # Up and down again ends where it began.
        self._preferences.text_scale = 1.0 if abs(scale - 1.0) < (TEXT_STEP - 1.0) / 2 else scale
        self.apply()

    def _follow_desktop(self) -> None:
        if self._preferences.theme_name == "system":
            self.apply()


# Some desktops move windows themselves, a moment after they have told, and leave an edge in sight.
_DESKTOP_MS = 400
# A window stays where it is if at least this share of it is in sight.
_SEEN_SHARE = 0.5
# Desktops move maximised and full-screen windows themselves.
_WHOLE = Qt.WindowState.WindowFullScreen | Qt.WindowState.WindowMaximized


class WindowsInSight(QObject):
    """Looks after the window, its dialogs, its notes and its floating panels.

    Parameters
    ----------
    window
        That of the studio; also the parent.
    """

    def __init__(self, window: QtWidgets.QWidget) -> None:
        super().__init__(window)
        self._window = window
        self._timer = QTimer(self, interval=_DESKTOP_MS, singleShot=True)
        self._timer.timeout.connect(self.bring)
        application().screenRemoved.connect(self._follow)

    def bring(self) -> None:
        """Move what is out of sight onto the screen that is nearest."""
        rooms = [screen.availableGeometry() for screen in QtGui.QGuiApplication.screens()]
        for window in (self._window, *self._window.findChildren(QtWidgets.QWidget)):
            whole = window.windowState() & _WHOLE
            if window.isWindow() and window.isVisible() and not whole:
                _bring(window, rooms)

    def _follow(self, _gone: QtGui.QScreen) -> None:
        self._timer.start()


def place_in_sight(frame: QRect, rooms: Sequence[QRect]) -> QRect:
    """Where a window with this frame stands: the same place where most of it is seen there.

    Else it is the nearest place on the nearest of the screens, whose ``rooms`` these are, no larger
    than that.
    """
    shared = [_area(room.intersected(frame)) for room in rooms]
    if not rooms or max(shared) >= _SEEN_SHARE * _area(frame):
        return frame
    room = min(rooms, key=lambda screen: (screen.center() - frame.center()).manhattanLength())
    return fitted(frame, room, QMargins())


def _bring(window: QtWidgets.QWidget, rooms: Sequence[QRect]) -> None:
    frame = window.frameGeometry()
    target = place_in_sight(frame, rooms)
    if target == frame:
        return
    edges = frame.size() - window.size()
    window.resize(target.size() - edges)
    window.move(target.topLeft())


def _area(of: QRect) -> int:
    return max(of.width(), 0) * max(of.height(), 0)


class WindowFrame(QObject):
    """Closes ``window``, lays it over the whole screen, and names ``document`` in its title."""

    def __init__(self, window: QtWidgets.QWidget, document: Document) -> None:
        super().__init__(window)
        self._window, self._document = window, document
        WindowsInSight(window)
        document.title_changed.connect(self._show_title)
        document.changed.connect(self._follow_title)
        self._shown_title = ("", "")
        self._show_title()

    def close(self) -> None:
        """Close it, as its button does."""
        self._window.close()

    def toggle_full_screen(self) -> None:
        """Lay it over the whole screen, or back."""
        # Not showNormal: a maximised window shall be one afterwards.
        self._window.setWindowState(self._window.windowState() ^ Qt.WindowState.WindowFullScreen)

    def _follow_title(self) -> None:
        if self._title() != self._shown_title:
            self._show_title()

    def _title(self) -> tuple[str, str]:
        """Return the title of the design, and which snapshot it is."""
        design = self._document.design
        # The list of scenes is not read before a scene is open.
        title = scenes.title_of(design) if design.title else ""
        return title, stored_name(self._document.view.snapshots, design)

    def _show_title(self) -> None:
        path, design = self._document.path, self._document.design
        self._shown_title = title, snapshot = self._title()
        # A scene has a title, or a name among others, and no file.
        name = printable(title or self._document.scene).strip() or "Untitled"
        recovered = self._document.recovered_from
        if path:
            name = path.stem
        elif recovered:
            name = f"{printable(recovered.stem)} (recovered)"
        # Qt puts its mark of unsaved work at one that stands alone.
        name = name.replace("[*]", "[*][*]")
        missing = missing_limb(design.limb, design.limb_digest)
        read_only = self._document.read_only or missing
        about = "".join(
            f" ({each})" for each in (snapshot, "read-only" if read_only else "") if each
        )
        self._window.setWindowTitle(f"{name}[*]{about} – SkinSource studio")
        self._window.setWindowModified(self._document.modified)
