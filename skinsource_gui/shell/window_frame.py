"""What is done with the window as a whole, and what its title says."""

from PySide6.QtCore import QObject, Qt
from PySide6.QtWidgets import QWidget

from skinsource.base.quoting import printable
from skinsource.design.design import Design
from skinsource.limbs.own_limbs import missing_limb
from skinsource.studies import scenes
from skinsource_gui.shell.windows_in_sight import WindowsInSight
from skinsource_gui.state.document import Document


class WindowFrame(QObject):
    """Closes ``window``, lays it over the whole screen, and names ``document`` in its title."""

    def __init__(self, window: QWidget, document: Document) -> None:
        super().__init__(window)
        self._window, self._document = window, document
        WindowsInSight(window)
        document.title_changed.connect(self._show_title)
        document.changed.connect(self._follow_title)
        self._said = ""
        self._show_title()

    def close(self) -> None:
        """Close it, as its button does."""
        self._window.close()

    def toggle_full_screen(self) -> None:
        """Lay it over the whole screen, or back."""
        # Not showNormal: a maximised window shall be one afterwards.
        self._window.setWindowState(self._window.windowState() ^ Qt.WindowState.WindowFullScreen)

    def _follow_title(self) -> None:
        if _title_of(self._document.design) != self._said:
            self._show_title()

    def _show_title(self) -> None:
        path, design = self._document.path, self._document.design
        self._said = title = _title_of(design)
        # A scene has a title, or a name among others, and no file.
        name = printable(title or self._document.scene).strip() or "Untitled"
        recovered = self._document.recovered_from
        if path:
            name = path.stem
        elif recovered:
            name = f"{printable(recovered.stem)} (recovered)"
        # Qt puts its mark of unsaved work at one that stands alone.
        name = name.replace("[*]", "[*][*]")
        missing = missing_limb(design.limb, design.limb_digest)
        read_only = self._document.read_only or missing
        locked = " (read-only)" if read_only else ""
        self._window.setWindowTitle(f"{name}[*]{locked} – SkinSource studio")
        self._window.setWindowModified(self._document.modified)


def _title_of(design: Design) -> str:
    # What knows the scenes is not read before one is open.
    return scenes.title_of(design) if design.title else ""
