"""The field of a rig: none, the present one, or another file."""

from pathlib import Path

from PySide6.QtCore import Signal

from skinsource.actuators import rigs
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.qt.questions import ask_open
from skinsource_gui.qt.resources import choice_of

_SPEC = choice_of("rig")
_PRESENT = "kept"
#: Filter of file dialogs for a measured response.
RESPONSE_FILES = (
    "Tables and sounds (*.csv *.txt *.npy *.npz *.mat *.h5 *.wav *.flac);;All files (*)"
)


class RigField(ChoiceField):
    """A drop-down list of no rig, the present rig, and another file."""

    #: The file that the user chooses, `Path`, or None for no rig.
    rig_chosen = Signal(object)

    def __init__(self) -> None:
        super().__init__(_SPEC)
        #: Where the dialog begins.
        self.folder = Path.home()
        self._title: str | None = None
        self.edited.connect(self._choose_rig)

    def show_rig(self, title: str | None) -> None:
        """Show the title of the present rig; None: there is none."""
        self._title = title
        index = self.findData(_PRESENT)
        if title is None and index >= 0:
            self.removeItem(index)
        elif title is not None and index < 0:
            self.insertItem(1, title, _PRESENT)
        elif title is not None:
            self.setItemText(index, title)
        self.set_value("none" if title is None else _PRESENT)

    def _choose_rig(self, option: str) -> None:
        if option == "file":
            kinds = f"Rigs (*{rigs.SUFFIX});;All files (*)"
            path = ask_open(self, "Choose a rig", kinds, self.folder)
            # The present rig stays until the file is read.
            self.show_rig(self._title)
            if path is not None:
                self.folder = path.parent
                self.rig_chosen.emit(path)
        elif option == "none":
            self.rig_chosen.emit(None)
