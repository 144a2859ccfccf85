"""The page on which a show is made: its designs in their order, and what is said of each."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

from PySide6 import QtWidgets
from PySide6.QtCore import Qt, Signal

from skinsource.base.errors import SkinSourceError, sentence
from skinsource.design.design import View
from skinsource.design.design_file import (
    SENTENCE,
    SHOW_SUFFIX,
    SUFFIX,
    ShowEntry,
    UnreadEntry,
    open_design,
    save_show,
)
from skinsource.design.panel_settings import ALL, CONTROL
from skinsource.studies import scenes
from skinsource_gui.fields.choice_field import ChoiceField
from skinsource_gui.pages.page import ToolPage
from skinsource_gui.panels.compare.stage import MOST_OFFERED, knob_options
from skinsource_gui.qt.buttons import page_label
from skinsource_gui.qt.fitting import FoldingRow
from skinsource_gui.qt.layouts import add_row, in_column, in_row, named, tooltip
from skinsource_gui.qt.questions import ask_to_save
from skinsource_gui.qt.theme import UNIT_PX
from skinsource_gui.state.preferences import Preferences

TITLE = "Show"
_SIZE_PX = 960, 560
_SHOWS, _DESIGNS = f"Shows (*{SHOW_SUFFIX})", f"SkinSource designs (*{SUFFIX})"
_ABOUT = "A show presents designs one after another, each with a sentence and one knob to turn."
_ENTRY = Qt.ItemDataRole.UserRole

Entry = ShowEntry | UnreadEntry


class ShowPage(ToolPage):
    """Lists the designs of a show; what is said of the selected one stands beside the list.

    Parameters
    ----------
    open_entry
        Returns the entry of the design in the window.
    preferences
        The folder of the files.
    path
        File of the show; None: it has none yet.
    entries
        Designs that it holds at first.
    """

    #: Entries of a show, and which of them is to be presented first.
    presented = Signal(object, int)
    #: `Path` (None: it has none) and entries of a show that was saved, or of which other changes
    #: are given up.
    saved = Signal(object, object)

    def __init__(
        self,
        open_entry: Callable[[], ShowEntry],
        preferences: Preferences,
        parent: QtWidgets.QWidget,
        path: Path | None = None,
        entries: Sequence[Entry] = (),
    ) -> None:
        super().__init__(parent, "show_page", TITLE, _SIZE_PX)
        self._open_entry, self._preferences, self._path = open_entry, preferences, path
        self.list = named(QtWidgets.QListWidget(), "show_list", "Designs in their order")
        self.list.setDragDropMode(QtWidgets.QAbstractItemView.DragDropMode.InternalMove)
        self.heading, self.sentence = QtWidgets.QLineEdit(), QtWidgets.QLineEdit()
        self.sentence.setMaxLength(int(SENTENCE.longest))
        self.knob, self.notes = ChoiceField(CONTROL), QtWidgets.QPlainTextEdit()
        self._knobs: dict[str, tuple[str, View]] = {}
        self.notes.setTabChangesFocus(True)
        self._lay_out()
        self._add(entries)
        self.list.currentRowChanged.connect(self._show)
        self.list.doubleClicked.connect(
            lambda at: self.once_released(partial(self._present, at.row()))
        )
        self.list.model().rowsMoved.connect(lambda *_: self._show(self.list.currentRow()))
        self.heading.textEdited.connect(lambda text: self._change(title=text.strip()))
        self.sentence.textEdited.connect(lambda text: self._change(sentence=text.strip()))
        self.knob.edited.connect(lambda title, _: self._turn(title))
        self.notes.textChanged.connect(self._change_notes)
        self._saved = self.entries
        self.list.setCurrentRow(0)
        self._show(self.list.currentRow())

    @property
    def entries(self) -> tuple[Entry, ...]:
        """What the show holds now."""
        items = (self.list.item(row) for row in range(self.list.count()))
        return tuple(item.data(_ENTRY) for item in items)

    def add_open_design(self) -> None:
        """Add the design in the window, as it is now."""
        self._add([self._open_entry()])

    def add_files(self) -> None:
        """Ask for design files, and add them in the order of the dialog."""
        folder = str(self._preferences.folder)
        names, _ = QtWidgets.QFileDialog.getOpenFileNames(self, "Add designs", folder, _DESIGNS)
        self.say("")
        entries, problems = [], []
        for path in map(Path, names):
            try:
                content = open_design(path)
            except SkinSourceError as error:
                problems.append(sentence(str(error)))
                continue
            title = content.design.title or path.stem
            entries.append(ShowEntry.of(content.design, content.view, title))
        self._add(entries)
        if problems:
            self.complain(" ".join(problems))

    def add_scene(self, name: str) -> None:
        """Add a scene of the paper, on the limbs that there are."""
        opened = scenes.open_scene(name)
        view = replace(opened.view, slow_motion=0.0)
        self._add([ShowEntry.of(opened.design, view, opened.scene.title)])

    def shift(self, by: int) -> None:
        """Move the selected design up or down."""
        row = self.list.currentRow()
        if row >= 0 and 0 <= row + by < self.list.count():
            self.list.insertItem(row + by, self.list.takeItem(row))
            self.list.setCurrentRow(row + by)

    def remove(self) -> None:
        """Remove the selected design from the show."""
        self.list.takeItem(self.list.currentRow())
        self._show(self.list.currentRow())

    def save(self) -> bool:
        """Save where it was saved before, or ask; return whether it is saved now."""
        path = self._path or self.ask_save(
            "Save the show", _SHOWS, self._preferences.folder / f"lecture{SHOW_SUFFIX}"
        )
        if path is None:
            return False
        write = partial(save_show, path, self.entries)
        if not self.save_as(path, write, self._preferences):
            return False
        self._path, self._saved = path, self.entries
        self.saved.emit(path, self._saved)
        return True

    def reject(self) -> None:
        question = "The show has changes that are not saved. Save them?"
        if self.entries == self._saved or ask_to_save(self, "Unsaved show", question, self.save):
            if self.entries != self._saved:
                self.saved.emit(self._path, self._saved)
            super().reject()

    def _lay_out(self) -> None:
        self.add = QtWidgets.QPushButton("Add")
        menu = QtWidgets.QMenu(self.add)
        menu.addAction("This design", self.add_open_design)
        menu.addAction("Designs of files…", self.add_files)
        of_paper = menu.addMenu("Scene")
        for scene in scenes.all_scenes():
            of_paper.addAction(scene.heading, partial(self.add_scene, scene.name))
        self.add.setMenu(menu)
        up = self.add_button("show_up", "Move up", "Show it earlier", partial(self.shift, -1))
        down = self.add_button("show_down", "Move down", "Show it later", partial(self.shift, 1))
        remove = self.add_button("show_remove", "Remove", "Remove it from the show", self.remove)
        form = QtWidgets.QFormLayout()
        for label, field in (
            ("Title", self.heading),
            ("Sentence", self.sentence),
            ("Knob", self.knob),
            ("Notes", self.notes),
        ):
            add_row(form, f"show_{label.lower()}", label, field)
        self._about = page_label("show_about", _ABOUT, tone="dim")
        in_column(self._about, None, of=self.list.viewport())
        buttons = FoldingRow((self.add, up, down, remove), UNIT_PX // 2, left=True)
        left = in_column((self.list, 1), buttons)
        hint, first = "Show it from its first design", partial(self._present, 0)
        present = self.add_button("show_present", "Present", hint, first)
        save = self.add_button("show_save", "Save", "Write the show to its file", self.save)
        close = self.add_button("show_close", "Close", "", self.reject)
        foot = in_row((self.message, 1), present, save, close)
        in_column((in_row((left, 1), (form, 2)), 1), foot, of=self)
        self._of_entry = up, down, remove, present

    def _add(self, entries: Sequence[Entry]) -> None:
        row = self.list.currentRow() + 1
        for k, entry in enumerate(entries):
            item = QtWidgets.QListWidgetItem()
            item.setData(_ENTRY, entry)
            self._name(item)
            self.list.insertItem(row + k, item)
        self.list.setCurrentRow(row + len(entries) - 1)

    def _name(self, item: QtWidgets.QListWidgetItem) -> None:
        entry = item.data(_ENTRY)
        unread = isinstance(entry, UnreadEntry)
        item.setText("Cannot be read" if unread else entry.title or "Untitled")
        item.setToolTip(entry.problem if unread else entry.sentence)

    def _show(self, row: int) -> None:
        """Show what is said of the selected design."""
        item = self.list.item(row)
        entry = None if item is None else item.data(_ENTRY)
        known = isinstance(entry, ShowEntry)
        for part in (self.heading, self.sentence, self.knob, self.notes):
            part.setEnabled(known)
        self._about.setVisible(item is None)
        for button in self._of_entry:
            button.setEnabled(item is not None)
        if isinstance(entry, UnreadEntry):
            self.complain(entry.problem)
        elif self.message.property("tone") == "error":
            self.say("")
        self.heading.setText(entry.title if known else "")
        self.sentence.setText(entry.sentence if known else "")
        self.sentence.setCursorPosition(0)
        self.notes.setPlainText(entry.notes if known else "")
        if known:
            self._knobs = knob_options(entry.design, entry.view)
            self.knob.set_options((title, title) for title in self._knobs)
            n = len(entry.design.inputs)
            more = f"The first {MOST_OFFERED} of {n} inputs, and the one selected in the design"
            about = CONTROL.label, CONTROL.hint, more if n > MOST_OFFERED else ""
            self.knob.setToolTip(tooltip(*about))
            # Automatic is the first of an input, and stands for what it does not have.
            fitting = (ALL, entry.view), (entry.knob, entry.view)
            self.knob.set_value([title for title, to in self._knobs.items() if to in fitting][-1])

    def _turn(self, title: str) -> None:
        """Choose what the knob of the selected design turns."""
        knob, view = self._knobs[title]
        self._change(knob=knob, view=view)

    def _change(self, **changes: str | View) -> None:
        item = self.list.currentItem()
        if item is not None:
            item.setData(_ENTRY, replace(item.data(_ENTRY), **changes))
            self._name(item)

    def _change_notes(self) -> None:
        item, notes = self.list.currentItem(), self.notes.toPlainText()
        entry = None if item is None else item.data(_ENTRY)
        if isinstance(entry, ShowEntry) and entry.notes != notes:
            self._change(notes=notes)

    def _present(self, row: int) -> None:
        self.presented.emit(self.entries, row)
