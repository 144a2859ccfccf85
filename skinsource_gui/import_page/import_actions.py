"""Importing recordings: asks for a file, opens the page, and places what was chosen."""

import importlib
from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QFileDialog, QWidget

from skinsource.design.edits import Edit
from skinsource.limbs.own_limbs import facts_of
from skinsource_gui.state.document import Document
from skinsource_gui.state.preferences import Preferences
from skinsource_gui.widgets.drop_place import DropPlace


class ImportActions(QObject):
    """Imports recordings into the open design.

    Parameters
    ----------
    document, preferences
        Where recordings go; where files were last looked for.
    window
        In front of which pages open; also the parent.
    """

    #: What went well, in a few words.
    done = Signal(str)
    #: What follows might end the studio: unsaved work is to be kept now.
    risk_ahead = Signal()

    def __init__(
        self,
        document: Document,
        preferences: Preferences,
        window: QWidget,
    ) -> None:
        super().__init__(window)
        self._document, self._preferences = document, preferences
        self._window = window
        self._pages: list[Any] = []

    @property
    def pages(self) -> tuple[Any, ...]:
        """The pages that are open."""
        return tuple(self._pages)

    def ask_and_import(self) -> None:
        """Ask for a file, and open the page on it."""
        readers = importlib.import_module("skinsource.readers.readers")
        kinds = " ".join(f"*{ending}" for ending in readers.endings())
        name, _ = QFileDialog.getOpenFileName(
            self._window,
            "Import a recording",
            str(self._preferences.folder),
            f"Recordings ({kinds});;All files (*)",
        )
        if name:
            self.open_page(Path(name))

    def open_page(self, path: Path, place: DropPlace | None = None) -> None:
        """Open the page on a file that shall go to ``place``, or where the user says."""
        self.risk_ahead.emit()
        # Few import anything; the start of the studio shall not wait for it.
        page_module = importlib.import_module("skinsource_gui.import_page.page")
        placing = importlib.import_module("skinsource_gui.import_page.placing")
        places = placing.options(self._document.design, self._document.view, place)
        limb = facts_of(self._document.design.limb)
        page = page_module.ImportPage(path, limb, places, self._window)

        def put(recording: Any, option: str) -> None:
            design, view = self._document.design, self._document.view
            onset_s = place.onset_s if place else view.playhead_s
            outcome = placing.placed(design, view, option, onset_s, recording)
            self._document.apply(outcome, None)
            self._preferences.folder = path.absolute().parent
            if isinstance(outcome, Edit):
                self.done.emit(f"Imported {path.name}")

        page.chosen.connect(put)
        page.finished.connect(lambda: self._pages.remove(page))
        self._pages.append(page)
        page.show()

    def end(self) -> None:
        """Close all pages."""
        for page in self.pages:
            page.reject()
