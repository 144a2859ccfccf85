"""The designs that are checked, and the buttons that choose them and their recordings."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QFileDialog, QHBoxLayout, QVBoxLayout, QWidget

from skinsource.base.errors import SkinSourceError
from skinsource.base.quoting import printable
from skinsource.design.design_file import open_design
from skinsource.studies.checking import Condition
from skinsource_gui.checking_page.checking import Row
from skinsource_gui.checking_page.table import CheckTable
from skinsource_gui.state.preferences import Preferences
from skinsource_gui.theme import UNIT_PX
from skinsource_gui.widgets.page_button import page_button

_RECORDINGS = "Recordings (*.csv *.tsv *.txt *.npy *.npz *.mat *.h5 *.hdf5);;All files (*)"
_DESIGNS = "Designs (*.skinsource);;All files (*)"


class CheckList(QWidget):
    """Rows that are checked.

    Parameters
    ----------
    rows
        Those at the start.
    preferences
        Know where files were taken from last.

    Attributes
    ----------
    rows, table
        The rows, and what shows them.
    bar
        Where the buttons stand; others can be put beside them.
    """

    #: Other rows, or other results.
    changed = Signal()
    #: Why a file was not taken.
    failed = Signal(str)
    #: What was taken, and what comes next.
    took = Signal(str)

    def __init__(self, rows: Sequence[Row], preferences: Preferences) -> None:
        super().__init__()
        self.rows, self._preferences = tuple(rows), preferences
        self.table = CheckTable()
        recording = page_button(
            "choose_recording", "Recording…", "Choose what was recorded of the selected design"
        )
        add = page_button("add_design", "Add design…", "Check another design as well")
        remove = page_button("remove_design", "Remove", "Take the selected design off")
        self._of_row, self._add = (recording, remove), add
        self.bar = QHBoxLayout()
        for button in (recording, add, remove):
            self.bar.addWidget(button)
        self.bar.addStretch(1)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(UNIT_PX)
        column.addLayout(self.bar)
        column.addWidget(self.table, 1)
        recording.clicked.connect(self._ask_recording)
        add.clicked.connect(self._ask_design)
        remove.clicked.connect(self._take_off)
        self.show_running(False)

    @property
    def conditions(self) -> tuple[Condition, ...]:
        """What was found of the designs that could be checked."""
        return tuple(row.result for row in self.rows if isinstance(row.result, Condition))

    def add_design(self, path: Path) -> None:
        """Check the design of a file as well."""
        try:
            design = open_design(path).design
        except SkinSourceError as error:
            self.failed.emit(str(error))
            return
        self._put((*self.rows, Row(name=path.name, design=design)))
        self.table.setCurrentCell(len(self.rows) - 1, 0)

    def take_recording(self, path: Path) -> None:
        """Take a recording of the selected design."""
        rows, chosen = list(self.rows), self.table.currentRow()
        if 0 <= chosen < len(rows):
            rows[chosen] = replace(rows[chosen], recording=path, result=None)
            self._put(tuple(rows))
            name = printable(path.name)
            self.took.emit(f"{name} is chosen for {rows[chosen].name}. Now press Check.")

    def take_results(self, results: Sequence[Condition | str]) -> None:
        """Take over what was found of each row."""
        pairs = zip(self.rows, results, strict=True)
        self._put(tuple(replace(row, result=result) for row, result in pairs))

    def forget_results(self) -> None:
        """What was found was found of something else."""
        if any(row.result is not None for row in self.rows):
            self._put(tuple(replace(row, result=None) for row in self.rows))

    def show_running(self, runs: bool) -> None:
        """While they are checked the rows stay as they are."""
        self._add.setEnabled(not runs)
        for button in self._of_row:
            button.setEnabled(bool(self.rows) and not runs)
        self.table.show_rows(self.rows)

    def _ask_recording(self) -> None:
        folder = str(self._preferences.folder)
        name, _ = QFileDialog.getOpenFileName(self, "Choose a recording", folder, _RECORDINGS)
        if name:
            self.take_recording(Path(name))

    def _ask_design(self) -> None:
        folder = str(self._preferences.folder)
        name, _ = QFileDialog.getOpenFileName(self, "Add a design", folder, _DESIGNS)
        if name:
            self.add_design(Path(name))

    def _take_off(self) -> None:
        chosen = self.table.currentRow()
        self._put(tuple(row for k, row in enumerate(self.rows) if k != chosen))

    def _put(self, rows: tuple[Row, ...]) -> None:
        self.rows = rows
        self.show_running(False)
        self.changed.emit()
