"""Panel of the library."""

from pathlib import Path
from typing import ClassVar

from PySide6.QtCore import QPoint, QSize, Qt
from PySide6.QtGui import QHideEvent, QResizeEvent, QShowEvent
from PySide6.QtWidgets import QBoxLayout, QLabel, QMenu, QMessageBox, QVBoxLayout, QWidget

from skinsource.base.work import counted
from skinsource.design import edits
from skinsource.design.design import Design
from skinsource.design.presets.presets import Entry, matching
from skinsource.design.view import View
from skinsource_gui.panel import Panel
from skinsource_gui.panels.library.buttons import LibraryButtons
from skinsource_gui.panels.library.preset_list import PresetList
from skinsource_gui.panels.library.preset_preview import PresetPreview
from skinsource_gui.panels.library.presets_model import PresetsModel
from skinsource_gui.panels.library.search_row import SearchRow
from skinsource_gui.panels.library.shelves import Shelves
from skinsource_gui.theme import UNIT_PX, set_tone
from skinsource_gui.widgets.asking import agreed

_WIDE_PX, _HIGH_PX = 340, 440
_NOTHING = "No preset is like that. Search for other words, or choose all tags."
_NO = QMessageBox.StandardButton.No


class LibraryPanel(Panel):
    """Presets by name and tag; what they play; placed by Enter, a double click, or dragging."""

    title: ClassVar[str] = "Library"
    name: ClassVar[str] = "library"

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._design: Design | None = None
        self._view = View()
        self.shelves = Shelves(self)
        self.model = PresetsModel(self)
        self.search, self.rows = SearchRow(), PresetList(self.model)
        self.preview, self.buttons = PresetPreview(), LibraryButtons()
        self.faults = QLabel()
        self.faults.setObjectName("library_faults")
        set_tone(self.faults, "warning")
        self.faults.setWordWrap(True)
        self.faults.hide()
        column = QVBoxLayout(self)
        column.setContentsMargins(UNIT_PX, UNIT_PX // 2, UNIT_PX, UNIT_PX // 2)
        column.setSpacing(UNIT_PX // 2)
        column.addWidget(self.search)
        self._body = QBoxLayout(QBoxLayout.Direction.TopToBottom)
        self._body.setSpacing(UNIT_PX // 2)
        self._body.addWidget(self.rows, 3)
        self._body.addWidget(self.preview, 2)
        column.addLayout(self._body, 1)
        column.addWidget(self.faults)
        column.addWidget(self.buttons)
        self.rows.setMinimumSize(140, 110)
        self.setMinimumWidth(248)
        self.setFocusProxy(self.rows)
        self.rows.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.preview.hide()
        self._connect()

    def sizeHint(self) -> QSize:
        return QSize(280, 560)

    def show_state(self, design: Design, view: View) -> None:
        self._design, self._view = design, view
        self.preview.show_limb(design.limb)

    def show_playhead(self, view: View) -> None:
        self._view = view

    def showEvent(self, event: QShowEvent) -> None:
        # What happened to the files meanwhile is not known.
        self.shelves.read()
        super().showEvent(event)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        # Where there is little height and some width, the preview stands beside the list.
        beside = self.width() >= _WIDE_PX and self.height() < _HIGH_PX
        way = QBoxLayout.Direction
        self._body.setDirection(way.LeftToRight if beside else way.TopToBottom)

    def hideEvent(self, event: QHideEvent) -> None:
        self.shelves.rest()
        super().hideEvent(event)

    def place(self, entry: Entry | None) -> None:
        """Place a preset at the playhead, on the selected track."""
        if entry is not None and self._design is not None:
            preset = entry.preset
            self.edited.emit(
                edits.place_fragment(self._design, self._view, preset.fragment, preset.name), None
            )

    def _connect(self) -> None:
        self.shelves.changed.connect(self._show_presets)
        self.shelves.failed.connect(self.failed)
        self.search.changed.connect(self._show_presets)
        self.search.accepted.connect(self._place_current)
        self.search.left_downwards.connect(self.rows.setFocus)
        self.rows.place_wanted.connect(self.place)
        self.rows.delete_wanted.connect(self._delete)
        self.rows.search_wanted.connect(self._search)
        self.rows.looked_at.connect(self._look)
        self.rows.customContextMenuRequested.connect(self._open_menu)
        self.model.rename_wanted.connect(self._rename)
        self.buttons.place.clicked.connect(self._place_current)
        self.buttons.save.clicked.connect(self._save)
        self.buttons.rename.clicked.connect(self.rows.rename)
        self.buttons.delete.clicked.connect(self._delete_current)

    def _show_presets(self, at: Path | None = None) -> None:
        """List what was found; the keys stay where they were, or go to the file ``at``."""
        before = self.rows.current
        wanted = at or (before.path if before is not None else None)
        everything = self.shelves.entries
        self.search.show_tags(tag for entry, _ in everything for tag in entry.preset.tags)
        own = {entry.path for entry, is_own in everything if is_own}
        found = matching((entry for entry, _ in everything), self.search.words, self.search.tag)
        self.model.show_entries(tuple((entry, entry.path in own) for entry in found))
        row = next((k for k, entry in enumerate(found) if entry.path == wanted), 0)
        self.rows.show_words("" if found else _NOTHING)
        if found:
            self.rows.go_to(row)
        self._look(self.rows.current)
        faults = self.shelves.faults
        self.faults.setVisible(bool(faults))
        if faults:
            others = counted(len(faults) - 1, "other")
            more = f" Left out as well: {others}." if faults[1:] else ""
            self.faults.setText(f"Left out: {faults[0].sentence}{more}")
            self.faults.setToolTip("\n".join(fault.sentence for fault in faults))

    def _look(self, entry: Entry | None) -> None:
        self.preview.show_preset(None if entry is None else entry.preset)
        self.buttons.show_current(self.rows.current is not None, self.rows.current_is_own)

    def _search(self) -> None:
        self.search.line.setFocus()
        self.search.line.selectAll()

    def _save(self) -> None:
        self.action_wanted.emit("save_to_library")

    def _place_current(self) -> None:
        self.place(self.rows.current)

    def _delete_current(self) -> None:
        if self.rows.current is not None:
            self._delete(self.rows.current)

    def _rename(self, entry: Entry, name: str) -> None:
        self._show_presets(self.shelves.rename(entry, name))

    def _delete(self, entry: Entry) -> None:
        question = (
            f"Delete “{entry.preset.name}” from your library? It cannot be taken back; designs in "
            "which it was placed keep it."
        )
        if agreed(self, "Delete from the library", question, otherwise=_NO):
            self.shelves.delete(entry)

    def _open_menu(self, at: QPoint) -> None:
        if self.rows.current is None:
            return
        menu = QMenu(self)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.buttons.fill(menu)
        menu.popup(self.rows.viewport().mapToGlobal(at))
