"""A list to choose a rig file with."""

from pathlib import Path

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QFileDialog, QWidget

from skinsource.actuators import rigs
from skinsource.specs.spec import ChoiceSpec
from skinsource_gui.fields.choice_field import ChoiceField

_SPEC = ChoiceSpec(
    label="Rig",
    options=(("none", "None"), ("file", "Choose a rig file…")),
    hint="What is wired to what: polarity, volts, limits, calibration",
)
_KEPT = "kept"
#: What a measured response is opened from, as file dialogs want it.
RESPONSE_FILES = (
    "Tables and sounds (*.csv *.txt *.npy *.npz *.mat *.h5 *.wav *.flac);;All files (*)"
)


class RigField(ChoiceField):
    """Offers none, the rig that there is, and another file."""

    #: The file that is wanted, `Path`, or None.
    wanted = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(_SPEC)
        if parent is not None:
            self.setParent(parent)
        self._title: str | None = None
        self.chosen.connect(self._want)

    def show_rig(self, title: str | None) -> None:
        """Show the rig that there is, by its title; None: there is none."""
        self._title = title
        index = self.findData(_KEPT)
        if title is None and index >= 0:
            self.removeItem(index)
        elif title is not None and index < 0:
            self.insertItem(1, title, _KEPT)
        elif title is not None:
            self.setItemText(index, title)
        self.set_value("none" if title is None else _KEPT)

    def _want(self, option: str) -> None:
        if option == "file":
            name, _ = QFileDialog.getOpenFileName(
                self, "Choose a rig", "", f"Rigs (*{rigs.SUFFIX});;All files (*)"
            )
            # What there was stays until the file is read.
            self.show_rig(self._title)
            if name:
                self.wanted.emit(Path(name))
        elif option == "none":
            self.wanted.emit(None)
