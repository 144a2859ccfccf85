"""What can be done with presets, as buttons and as a menu."""

from PySide6.QtWidgets import QMenu, QPushButton, QVBoxLayout, QWidget

from skinsource_gui.widgets.folding_row import FoldingRow
from skinsource_gui.widgets.keys import key_text

_PLACE = "library"


class LibraryButtons(QWidget):
    """Place, save, rename, delete."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.place = self._button(
            "Place",
            "preset_place",
            f"Place it at the playhead, on the selected track ({key_text(_PLACE, 'place')}); or "
            "drag it onto a place of the hand or a track",
        )
        self.save = self._button(
            "Save…", "preset_save", "Keep clips, or the whole design, in the library"
        )
        self.rename = self._button(
            "Rename", "preset_rename", f"Only your own ({key_text(_PLACE, 'rename')})"
        )
        self.delete = self._button(
            "Delete", "preset_delete", f"Only your own ({key_text(_PLACE, 'remove')})"
        )
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(FoldingRow((self.place, self.save, self.rename, self.delete), 4))
        self.show_current(False, False)

    def show_current(self, there: bool, own: bool) -> None:
        """Whether there is a preset to do it with, and whether it is the user's own."""
        self.place.setEnabled(there)
        self.rename.setEnabled(own)
        self.delete.setEnabled(own)

    def fill(self, menu: QMenu) -> None:
        """Add the same to ``menu``."""
        for button in (self.place, self.rename, self.delete):
            entry = menu.addAction(button.text(), button.click)
            entry.setEnabled(button.isEnabled())
        menu.addSeparator()
        menu.addAction(self.save.text(), self.save.click)

    def _button(self, text: str, name: str, hint: str) -> QPushButton:
        button = QPushButton(text)
        button.setObjectName(name)
        button.setToolTip(hint)
        return button
