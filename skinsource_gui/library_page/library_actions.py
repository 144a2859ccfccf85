"""Saving what is open to the library, and placing presets whose files are dropped."""

from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from skinsource.base.errors import SkinSourceError
from skinsource.design import edits
from skinsource.design.presets import presets
from skinsource_gui import library_page
from skinsource_gui.state.document import Document
from skinsource_gui.widgets.drop_place import DropPlace

if TYPE_CHECKING:
    from skinsource.design.presets.presets import Preset
    from skinsource_gui.library_page.save_page import SavePage


class LibraryActions(QObject):
    """Moves presets between the open design and files.

    Parameters
    ----------
    document
        What is open.
    window
        In front of which the page opens; also the parent.
    """

    failed = Signal(str)
    #: What went well, in a few words.
    done = Signal(str)

    def __init__(self, document: Document, window: QWidget) -> None:
        super().__init__(window)
        self._document, self._window = document, window

    def ask_and_save(self) -> "SavePage | None":
        """Open the page that asks for a name; None where there is nothing to keep."""
        found = library_page.choices(self._document.design, self._document.view)
        if not found:
            self.failed.emit("There is no clip to keep; place one first.")
            return None
        page = library_page.SavePage(found, self._window)

        def save(preset: "Preset") -> None:
            try:
                presets.save_preset(presets.users_folder(), preset)
            except SkinSourceError as error:
                page.show_problem(str(error))
                return
            self.done.emit(f"Saved “{preset.name}” to the library")
            page.accept()

        page.chosen.connect(save)
        page.open()
        return page

    def place_file(self, path: Path, place: DropPlace | None) -> None:
        """Place the preset of a file where it was dropped, or at the playhead."""
        try:
            preset = presets.read_preset(path)
        except SkinSourceError as error:
            self.failed.emit(str(error))
            return
        design, view = self._document.design, self._document.view
        where = place or DropPlace()
        named = where.input_id is not None or where.location is not None
        outcome = edits.place_fragment(
            design,
            view,
            preset.fragment,
            preset.name,
            where.onset_s if named else None,
            where.input_id,
            None if where.input_id is not None else where.location,
        )
        self._document.apply(outcome, None)
