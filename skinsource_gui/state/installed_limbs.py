"""Which limbs can be loaded."""

from PySide6.QtCore import QEvent, QObject, Signal
from PySide6.QtWidgets import QWidget

from skinsource.limbs.catalogue import available_limbs
from skinsource.limbs.own_limbs import facts_of
from skinsource_gui.state.document import Document

#: Titles of the jobs that install limbs: from a folder, and by download.
INSTALLATIONS = ("Installing the measured limbs", "Downloading the measured limbs")


class InstalledLimbs(QObject):
    """Looks again when the user comes back to the window, perhaps from an installation.

    And when a design is shown whose limb was not there: its file may have come back since.

    Parameters
    ----------
    names
        The limbs there are at the start.
    document
        Whose design that is.
    window
        Looks whenever this becomes the active window; also the parent.
    """

    #: Limbs came or went.
    changed = Signal()

    def __init__(self, names: tuple[str, ...], document: Document, window: QWidget) -> None:
        super().__init__(window)
        self.names = names
        # A limb may be imported anew, or mirrored, under its name.
        self._shown = tuple(facts_of(name) for name in names)
        self._document = document
        document.changed.connect(self._follow)
        window.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.WindowActivate:
            self.look()
        return super().eventFilter(watched, event)

    def _follow(self) -> None:
        if self._document.design.limb not in self.names:
            self.look()

    def look(self) -> None:
        """Look which limbs are there now."""
        found = available_limbs()
        shown = tuple(facts_of(name) for name in found)
        if shown != self._shown:
            self.names, self._shown = found, shown
            self.changed.emit()
