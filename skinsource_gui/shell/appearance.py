"""Colours and size of words, in the whole studio."""

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QApplication

from skinsource_gui.state.preferences import Preferences
from skinsource_gui.theme import THEMES, apply_theme

#: One step of "Larger text", and how far it goes.
TEXT_STEP, SMALLEST_TEXT, LARGEST_TEXT = 1.1, 0.8, 3.0


class Appearance(QObject):
    """Applies theme and size of words to the application, and remembers them.

    Parameters
    ----------
    preferences
        Where they are remembered.
    """

    #: Theme or size of words is about to be another one.
    changing = Signal()
    #: Theme or size of words is another one.
    changed = Signal()

    def __init__(self, preferences: Preferences, parent: QObject) -> None:
        super().__init__(parent)
        self._preferences = preferences
        self._room_scale = 1.0
        QGuiApplication.styleHints().colorSchemeChanged.connect(self._follow_desktop)
        # Of widgets that are there before the first time some would keep their letters.
        self.apply()

    @property
    def text_scale(self) -> float:
        """Size of words, 1 as the desktop has it."""
        return min(self._preferences.text_scale * self._room_scale, LARGEST_TEXT)

    def use_theme(self, name: str) -> None:
        """Take over ``"light"``, ``"dark"`` or ``"system"``."""
        self._preferences.theme_name = name
        self.apply()

    def enlarge_text(self) -> None:
        """Make all words larger."""
        self._scale_text(self._preferences.text_scale * TEXT_STEP)

    def shrink_text(self) -> None:
        """Make all words smaller."""
        self._scale_text(self._preferences.text_scale / TEXT_STEP)

    def reset_text(self) -> None:
        """Make words as large as the desktop has them."""
        self._scale_text(1.0)

    def fit_room(self, scale: float) -> None:
        """Enlarge words by ``scale`` beside the chosen size, so that a room can read them."""
        if scale != self._room_scale:
            self._room_scale = scale
            self.apply()

    def apply(self) -> None:
        """Give the whole application theme and size of words."""
        self.changing.emit()
        dark = QGuiApplication.styleHints().colorScheme() == Qt.ColorScheme.Dark
        system = THEMES["dark" if dark else "light"]
        theme = THEMES.get(self._preferences.theme_name, system)
        application = QApplication.instance()
        if isinstance(application, QApplication):
            apply_theme(application, theme, self.text_scale)
        self.changed.emit()

    def _scale_text(self, scale: float) -> None:
        scale = min(max(scale, SMALLEST_TEXT), LARGEST_TEXT)
        # Up and down again ends where it began.
        self._preferences.text_scale = 1.0 if abs(scale - 1.0) < (TEXT_STEP - 1.0) / 2 else scale
        self.apply()

    def _follow_desktop(self) -> None:
        if self._preferences.theme_name == "system":
            self.apply()
