"""The limbs that were imported, and what can be done with each."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

from PySide6.QtCore import Signal
from PySide6.QtWidgets import (
    QFileDialog,
    QHBoxLayout,
    QLabel,
    QListWidget,
    QVBoxLayout,
    QWidget,
)

from skinsource.base.errors import SkinSourceError
from skinsource.base.job import Job
from skinsource.limbs.limb_layout import export_limb
from skinsource.limbs.own_limbs import facts_of, mirror_limb, own_limb_names, remove_limb
from skinsource_gui.limb_page.asking import may_remove
from skinsource_gui.theme import UNIT_PX
from skinsource_gui.widgets.page_button import page_button

_NONE = "No limb was imported yet."
_DAMAGED = "Damaged: import it again."


class OwnList(QWidget):
    """Lists them; mirrors, exports and removes the chosen one."""

    #: Other limbs are there now, or one looks different.
    changed = Signal()
    #: A `Job`.
    job_wanted = Signal(object)
    #: A sentence.
    failed = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.list, self.words = QListWidget(), QLabel()
        self.list.setObjectName("own_limbs")
        self.list.setAccessibleName("Imported limbs")
        self.list.setMaximumHeight(96)
        self.words.setObjectName("own_limb_words")
        self.words.setWordWrap(True)
        self._mirror = page_button("mirror_limb", "Mirror", "Show a left hand as a right one")
        self._export = page_button("export_limb", "Export…", "Write it as docs/limbs.md says")
        self._remove = page_button("remove_limb", "Remove", "Delete it from this computer")
        row = QHBoxLayout()
        for button, wanted in (
            (self._mirror, self._turn),
            (self._export, self._ask_and_export),
            (self._remove, self._delete),
        ):
            button.clicked.connect(wanted)
            row.addWidget(button)
        row.addStretch(1)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(UNIT_PX // 2)
        column.addWidget(self.list)
        column.addWidget(self.words)
        column.addLayout(row)
        self.list.currentRowChanged.connect(self._show_chosen)
        self.show_limbs()

    @property
    def chosen(self) -> str:
        """Name of the chosen limb; empty: none."""
        names, row = own_limb_names(), self.list.currentRow()
        return names[row] if 0 <= row < len(names) else ""

    def show_limbs(self, name: str = "") -> None:
        """List them anew, and choose ``name``."""
        names = own_limb_names()
        self.list.clear()
        for one in names:
            facts = facts_of(one)
            self.list.addItem(f"{facts.title} ({one})" if facts.title != one else one)
        self.list.setVisible(bool(names))
        if names:
            self.list.setCurrentRow(names.index(name) if name in names else 0)
        self._show_chosen()

    def _turn(self) -> None:
        # All of it is written again.
        name = self.chosen
        turned = not facts_of(name).mirrored
        self.job_wanted.emit(Job(f"Mirroring {name}", partial(mirror_limb, name, turned)))

    def _delete(self) -> None:
        name = self.chosen
        if not may_remove(self, name):
            return
        self._try(lambda: remove_limb(name))
        self.show_limbs()

    def _ask_and_export(self) -> None:
        name = self.chosen
        path, _ = QFileDialog.getSaveFileName(self, "Export limb", f"{name}.h5", "HDF5 (*.h5)")
        if path:
            self.job_wanted.emit(Job(f"Exporting {name}", partial(export_limb, name, Path(path))))

    def _try(self, work: Callable[[], object]) -> None:
        try:
            work()
        except SkinSourceError as error:
            self.failed.emit(str(error))
        self.changed.emit()

    def _show_chosen(self) -> None:
        name = self.chosen
        facts = facts_of(name) if name else None
        self.words.setText(_NONE if facts is None else facts.sentence or _DAMAGED)
        for button in (self._mirror, self._export, self._remove):
            button.setEnabled(facts is not None and (facts.known or button is self._remove))
        mirrored = facts is not None and facts.mirrored
        self._mirror.setText("Do not mirror" if mirrored else "Mirror")
