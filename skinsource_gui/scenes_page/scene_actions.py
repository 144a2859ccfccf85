"""Opening scenes in the window, in the arrangement that shows them."""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from skinsource.base.errors import SkinSourceError
from skinsource.design.design_file import SUFFIX
from skinsource.design.labels import limb_word
from skinsource.studies import scenes
from skinsource_gui import scenes_page
from skinsource_gui.files.file_actions import FileActions
from skinsource_gui.state.document import Document
from skinsource_gui.state.installed_limbs import InstalledLimbs
from skinsource_gui.state.preferences import Preferences
from skinsource_gui.widgets.map.level_look import coloured_like

if TYPE_CHECKING:
    from skinsource_gui.scenes_page.page import ScenesPage


class SceneActions(QObject):
    """Shows the gallery, and opens what is chosen there.

    Parameters
    ----------
    document, preferences, files, limbs
        What is open, where and how it is saved, and which limbs there are.
    arrange
        Takes up the arrangement of a name, with the panels of some names in sight.
    window
        In front of which the gallery opens; also the parent.
    """

    failed = Signal(str)
    #: The name of a scene that was opened.
    opened = Signal(str)
    #: What went well, in a few words.
    done = Signal(str)

    def __init__(
        self,
        document: Document,
        preferences: Preferences,
        files: FileActions,
        limbs: InstalledLimbs,
        arrange: Callable[[str, Sequence[str]], None],
        window: QWidget,
    ) -> None:
        super().__init__(window)
        self._document, self._files, self._limbs = document, files, limbs
        self._preferences, self._arrange = preferences, arrange
        self._window = window
        self._last = self._last_limb = ""

    def show(self) -> "ScenesPage":
        """Open the gallery; the scene that was opened last is selected."""
        page = scenes_page.ScenesPage(
            self._limbs.names, self._last, self._window, limb=self._last_limb
        )
        page.chosen.connect(self.open)
        page.open()
        return page

    def open(self, name: str, limb: str = "") -> None:
        """Open a scene in place of what is open, which is asked for if it is not saved.

        Levels stay in the colours that were chosen.  ``limb`` is the one that it is played on;
        empty: those of the paper.
        """
        try:
            opened = scenes.open_scene(name, available=self._limbs.names, limb=limb)
        except SkinSourceError as error:
            self.failed.emit(str(error))
            return
        if not self._files.may_lose_changes():
            return
        view = coloured_like(opened.view, self._document.view)
        self._document.start_over(opened.design, view, None, scene=opened.scene.title)
        self._files.leave_file()
        self._files.suggested = self._preferences.folder / f"{opened.scene.name}{SUFFIX}"
        self._last, self._last_limb = opened.scene.name, limb
        self._arrange(opened.scene.arrangement, opened.scene.panels)
        self.opened.emit(name)
        words = f"Opened {opened.scene.heading}"
        if opened.synthetic:
            words += ", on a SYNTHETIC limb"
        elif limb:
            words += f", on {limb_word(limb).title}"
        self.done.emit(words)
