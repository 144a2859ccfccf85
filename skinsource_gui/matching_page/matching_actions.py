"""Opens the matching page."""

import importlib
from typing import Any

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QWidget

from skinsource_gui.state.document import Document
from skinsource_gui.state.playing.player import Player
from skinsource_gui.state.preferences import Preferences


class MatchingActions(QObject):
    """One page at a time, in front of the window.

    Parameters
    ----------
    document, preferences, player
        Whose limb is played; where tables lie; what it is played on, and how loud.
    window
        In front of which it opens; also the parent.

    Attributes
    ----------
    page
        The page, while it is open.
    """

    def __init__(
        self, document: Document, preferences: Preferences, player: Player, window: QWidget
    ) -> None:
        super().__init__(window)
        self._document, self._preferences = document, preferences
        self._player, self._window = player, window
        self.page: Any = None

    def show(self) -> None:
        """Open the page; what the window plays ends."""
        settings = self._player.settings
        if not settings.rig_is_read():
            return
        # Few match anything; the start of the studio shall not wait for it.
        module = importlib.import_module("skinsource_gui.matching_page.page")
        gain_db = self._player.gain.gain_db
        self._player.stop()
        page = module.MatchingPage(
            self._document.design.limb,
            self._preferences.folder,
            settings.output,
            settings.rig,
            gain_db,
            self._window,
        )
        page.finished.connect(self._forget)
        self.page = page
        page.open()

    def end(self) -> None:
        """Close the page, and let go of the device."""
        if self.page is not None:
            self.page.done(0)

    def _forget(self) -> None:
        self.page = None
