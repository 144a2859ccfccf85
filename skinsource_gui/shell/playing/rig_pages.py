"""Opens the page on which a rig is described."""

import importlib
from typing import Any

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QWidget

from skinsource_gui.shell.appearance import Appearance
from skinsource_gui.state.document import Document
from skinsource_gui.state.playing.sound_settings import SoundSettings


class RigPages(QObject):
    """Few describe a rig: the page is imported when it is first wanted.

    Parameters
    ----------
    document
        What can be predicted through a rig.
    settings
        What this machine plays for.
    window
        In front of which the page opens; also the parent.
    """

    def __init__(self, document: Document, settings: SoundSettings, window: QWidget) -> None:
        super().__init__(window)
        self._document, self._settings, self._window = document, settings, window
        self._appearance: Appearance | None = None

    def use(self, appearance: Appearance) -> None:
        """Take colours from there."""
        self._appearance = appearance

    def show(self) -> None:
        """Open the page."""
        appearance = self._appearance
        if appearance is None:
            return
        module: Any = importlib.import_module("skinsource_gui.rig_page.page")
        module.RigPage(
            self._document, self._settings, lambda: appearance.theme, self._window
        ).open()
