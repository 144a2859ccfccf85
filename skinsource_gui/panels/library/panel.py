"""The library panel: search, list, preview and buttons for presets."""

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import ClassVar

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QObject, QPoint, QSize, Qt, Signal

from skinsource.base.errors import SkinSourceError, counted
from skinsource.design import edits
from skinsource.design.design import Design, View
from skinsource.design.presets import presets
from skinsource.design.presets.presets import Entry, Fault, PresetFolder, matching
from skinsource_gui.fields.choice_field import DropDown
from skinsource_gui.panels.library.list import PresetList, PresetPreview, PresetsModel
from skinsource_gui.qt.buttons import page_button, page_label, passing_menu
from skinsource_gui.qt.fitting import FoldingRow
from skinsource_gui.qt.keys import KEYS, key_text
from skinsource_gui.qt.layouts import in_column, in_row, named
from skinsource_gui.qt.questions import ask_yes
from skinsource_gui.qt.theme import UNIT_PX
from skinsource_gui.qt.windows import application
from skinsource_gui.state.panel import Panel

_PLACE = "library"
_AT = "At the playhead, on the selected track, or on several new ones"


class LibraryButtons(FoldingRow):
    """Buttons that place, save, rename and delete presets."""

    def __init__(self) -> None:
        keys = {name: key_text(_PLACE, name) for name in ("place", "rename", "remove")}
        buttons = (
            page_button(f"preset_{name}", text, hint)
            for name, text, hint in (
                ("place", "Place", f"{_AT} ({keys['place']})"),
                ("save", "Save…", "Save clips or the whole design to the library"),
                ("rename", "Rename", f"Only your own ({keys['rename']})"),
                ("delete", "Delete", f"Only your own ({keys['remove']})"),
            )
        )
        place, save, rename, delete = buttons
        super().__init__((place, save, rename, delete), 4)
        self.place, self.save, self.rename, self.delete = place, save, rename, delete
        self.show_current(False, False)

    def show_current(self, exists: bool, own: bool) -> None:
        """Enable the buttons for a preset that ``exists`` and may be the user's ``own``."""
        self.place.setEnabled(exists)
        self.rename.setEnabled(own)
        self.delete.setEnabled(own)

    def fill(self, menu: QtWidgets.QMenu) -> None:
        """Add the same actions to ``menu``."""
        for button in (self.place, self.rename, self.delete):
            entry = menu.addAction(button.text(), button.click)
            entry.setEnabled(button.isEnabled())
        menu.addSeparator()
        menu.addAction(self.save.text(), self.save.click)


_ALL = "All tags"


class SearchRow(QtWidgets.QWidget):
    """A line to type in, and a choice of tags."""

    changed = Signal()
    #: Down was pressed.
    left_downwards = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.line, self.tags = QtWidgets.QLineEdit(), DropDown()
        places = f"{KEYS['library'].gestures['place'].shown} places"
        hint = f"Words of the name, tags, description or source; {places}"
        named(self.line, "preset_search", "Search presets", hint).setPlaceholderText("Search")
        self.line.setClearButtonEnabled(True)
        self.line.textChanged.connect(self.changed)
        self.line.installEventFilter(self)
        named(self.tags, "preset_tags", "Tag", "Only presets with this tag")
        self.tags.addItem(_ALL)
        self.tags.currentIndexChanged.connect(self.changed)
        in_row((self.line, 3), (self.tags, 2), of=self, margins=0)

    @property
    def text(self) -> str:
        """The text to search for."""
        return self.line.text()

    @property
    def tag(self) -> str:
        """The chosen tag, or ""."""
        return self.tags.currentText() if self.tags.currentIndex() > 0 else ""

    def show_tags(self, tags: Iterable[str]) -> None:
        """Offer these tags; the chosen one stays if it is among them."""
        offered, chosen = [_ALL, *sorted(set(tags), key=str.casefold)], self.tag
        if offered == [self.tags.itemText(k) for k in range(self.tags.count())]:
            return
        self.tags.blockSignals(True)
        self.tags.clear()
        self.tags.addItems(offered)
        self.tags.setCurrentIndex(offered.index(chosen, 1) if chosen in offered[1:] else 0)
        self.tags.blockSignals(False)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.KeyPress and isinstance(event, QtGui.QKeyEvent):
            if event.key() == Qt.Key.Key_Down:
                self.left_downwards.emit()
                return True
            if event.key() == Qt.Key.Key_Escape and self.text:
                self.line.clear()
                return True
        return super().eventFilter(watched, event)


class PresetFolders(QObject):
    """Reads the folders of presets; renames and deletes in the user's."""

    changed = Signal()
    #: Why something was not done.
    failed = Signal(str)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._shipped: PresetFolder | None = None
        self._own = PresetFolder()

    @property
    def folder(self) -> Path:
        """Folder of the user's presets."""
        return presets.users_folder()

    @property
    def entries(self) -> tuple[tuple[Entry, bool], ...]:
        """All entries, the user's own first, each with whether it is the user's own."""
        shipped = self._shipped or PresetFolder()
        own = tuple((entry, True) for entry in self._own.entries)
        return (*own, *((entry, False) for entry in shipped.entries))

    @property
    def faults(self) -> tuple[Fault, ...]:
        """Files that could not be read."""
        return (*self._own.faults, *(self._shipped or PresetFolder()).faults)

    def read(self) -> None:
        """Read both folders again."""
        if self._shipped is None:
            self._shipped = presets.read_preset_folder(presets.shipped_folder())
        self._own = presets.read_preset_folder(self.folder)
        self.changed.emit()

    def rename(self, entry: Entry, name: str) -> Path:
        """Rename a preset of the user; return its file."""
        return self._changed(lambda: presets.rename_preset(self.folder, entry.path, name), entry)

    def delete(self, entry: Entry) -> None:
        """Delete a preset of the user."""
        self._changed(lambda: presets.delete_preset(self.folder, entry.path), entry)

    def _changed(self, change: Callable[[], Path | None], entry: Entry) -> Path:
        """Return the file of a preset after a change."""
        path = None
        try:
            path = change()
        except SkinSourceError as error:
            self.failed.emit(str(error))
        self.read()
        return path or entry.path


_WIDE_PX, _HIGH_PX = 340, 440
_NOTHING = "No matches. Search for other words, or choose all tags."
_NO = QtWidgets.QMessageBox.StandardButton.No


class LibraryPanel(Panel):
    """Presets by name and tag, with a preview; placed by Enter, a double click, or dragging."""

    title: ClassVar[str] = "Library"
    name: ClassVar[str] = "library"

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.folders = PresetFolders(self)
        self.model = PresetsModel(self)
        self.search, self.rows = SearchRow(), PresetList(self.model)
        self.preview, self.buttons = PresetPreview(), LibraryButtons()
        self.faults = page_label("library_faults", tone="warning")
        self.faults.hide()
        self._body = in_column((self.rows, 3), (self.preview, 2), gap_px=UNIT_PX // 2)
        parts = self.search, (self._body, 1), self.faults, self.buttons
        edges = (UNIT_PX, UNIT_PX // 2, UNIT_PX, UNIT_PX // 2)
        in_column(*parts, of=self, margins=edges, gap_px=UNIT_PX // 2)
        self.rows.setMinimumSize(140, 110)
        self.setMinimumWidth(248)
        self.setFocusProxy(self.rows)
        self.rows.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.preview.hide()
        application().focusWindowChanged.connect(self._look_again)
        self.folders.changed.connect(self._show_presets)
        self.folders.failed.connect(self.failed)
        self.search.changed.connect(self._show_presets)
        self.search.line.returnPressed.connect(lambda: self.place(self.rows.current))
        self.search.left_downwards.connect(self.rows.setFocus)
        self.rows.place_requested.connect(self.place)
        self.rows.delete_requested.connect(self._delete)
        self.rows.search_requested.connect(self._search)
        self.rows.preview_changed.connect(self._preview)
        self.rows.customContextMenuRequested.connect(self._open_menu)
        self.model.rename_requested.connect(self._rename)
        self.buttons.place.clicked.connect(lambda: self.place(self.rows.current))
        self.buttons.save.clicked.connect(lambda: self.action_requested.emit("save_to_library"))
        self.buttons.rename.clicked.connect(self.rows.rename)
        self.buttons.delete.clicked.connect(self._delete_current)

    def sizeHint(self) -> QSize:
        return QSize(560, 236)

    def show_state(self, design: Design, view: View) -> None:
        self._design, self._view = design, view
        self.preview.show_limb(design.limb)

    def show_playhead(self, view: View) -> None:
        self._view = view

    def showEvent(self, event: QtGui.QShowEvent) -> None:
        # The files may have changed while the panel was hidden.
        self.folders.read()
        super().showEvent(event)

    def _look_again(self) -> None:
        # Another window, or another program, may have written presets meanwhile.
        if self.isVisible():
            self.folders.read()

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        # In a low and wide panel the preview lies beside the list.
        is_wide = self.width() >= _WIDE_PX and self.height() < _HIGH_PX
        way = QtWidgets.QBoxLayout.Direction
        self._body.setDirection(way.LeftToRight if is_wide else way.TopToBottom)

    def place(self, entry: Entry | None) -> None:
        """Place a preset at the playhead, on the selected track."""
        if entry is not None:
            preset = entry.preset
            self.edited.emit(
                edits.place_fragment(self._design, self._view, preset.fragment, preset.name), None
            )

    def _show_presets(self, at: Path | None = None) -> None:
        """List the matches; the cursor stays at its file, or goes to the file ``at``."""
        before = self.rows.current
        path = at or (before.path if before is not None else None)
        everything = self.folders.entries
        self.search.show_tags(tag for entry, _ in everything for tag in entry.preset.tags)
        own = {entry.path for entry, is_own in everything if is_own}
        matches = matching((entry for entry, _ in everything), self.search.text, self.search.tag)
        self.model.show_entries(tuple((entry, entry.path in own) for entry in matches))
        row = next((k for k, entry in enumerate(matches) if entry.path == path), 0)
        self.rows.show_message("" if matches else _NOTHING)
        if matches:
            self.rows.go_to(row)
        self._preview(self.rows.current)
        faults = self.folders.faults
        self.faults.setVisible(bool(faults))
        if faults:
            others = counted(len(faults) - 1, "other")
            more = f" Left out as well: {others}." if faults[1:] else ""
            self.faults.setText(f"Left out: {faults[0].sentence}{more}")
            self.faults.setToolTip("\n".join(fault.sentence for fault in faults))

    def _preview(self, entry: Entry | None) -> None:
        self.preview.show_preset(None if entry is None else entry.preset)
        self.buttons.show_current(self.rows.current is not None, self.rows.current_is_own)

    def _search(self) -> None:
        self.search.line.setFocus()
        self.search.line.selectAll()

    def _delete_current(self) -> None:
        if self.rows.current is not None:
            self._delete(self.rows.current)

    def _rename(self, entry: Entry, name: str) -> None:
        self._show_presets(self.folders.rename(entry, name))

    def _delete(self, entry: Entry) -> None:
        question = (
            f"Delete “{entry.preset.name}” from your library? This cannot be undone; designs that "
            "use it are not changed."
        )
        if ask_yes(self, "Delete from the library", question, otherwise=_NO):
            self.folders.delete(entry)

    def _open_menu(self, at: QPoint) -> None:
        if self.rows.current is None:
            return
        menu = passing_menu(self)
        self.buttons.fill(menu)
        menu.popup(self.rows.viewport().mapToGlobal(at))
