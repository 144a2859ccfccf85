"""Exports: where to, how far, and what came of it."""

import logging
import math
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QMessageBox

from skinsource.errors import SkinSourceError, TooInaccurateError
from skinsource.export import export_field, export_levels, export_traces
from skinsource_gui.files.export_bar import ExportBar
from skinsource_gui.files.export_jobs import ExportJobs, ExportOrder, Write
from skinsource_gui.status.error_label import VISIBLE

if TYPE_CHECKING:
    from skinsource_gui.shell.window import MainWindow

_log = logging.getLogger(__name__)
_CSV, _NPZ = "CSV (*.csv)", "NumPy archive (*.npz)"
_Answer = QMessageBox.StandardButton


class ExportActions(QObject):
    """Exports the present design from ``window``, and shows there what becomes of it."""

    def __init__(self, window: "MainWindow") -> None:
        super().__init__(window)
        self._window = window
        self.jobs = ExportJobs(self)
        self.bar = ExportBar()
        window.statusBar().addPermanentWidget(self.bar)
        self.bar.hide()
        self.bar.cancel_wanted.connect(self.jobs.cancel)
        self.jobs.changed.connect(self.show_state)
        self.jobs.progressed.connect(self.bar.show_progress)
        self.jobs.written.connect(self._note_written)
        self.jobs.cancelled.connect(self._note_cancelled)
        self.jobs.failed.connect(self._note_failed)

    def traces(self) -> None:
        """Ask for a file, and export the traces of the selected outputs to it."""
        if not self._window.document.view.outputs:
            self._window.complain("No output is selected: select some on the skin map first.")
            return
        self._ask_and_add("Export traces", "traces.csv", _CSV, export_traces)

    def levels(self) -> None:
        """Ask for a file, and export the RMS of all outputs to it."""
        self._ask_and_add("Export RMS levels", "rms-levels.csv", _CSV, export_levels)

    def field(self) -> None:
        """Ask for a file, and export the field of all outputs and axes to it."""
        self._ask_and_add("Export whole field", "field.npz", _NPZ, export_field)

    def show_state(self) -> None:
        """Show what is being exported, if anything."""
        current, unfinished = self.jobs.current, len(self.jobs.unfinished)
        path = current.path if current else Path()
        self.bar.show_order(str(path) if current else "", path.name, max(unfinished - 1, 0))
        self._window.actions_by_name["cancel_export"].setEnabled(current is not None)

    def may_close(self) -> bool:
        """Whether the window may go: nothing is being exported, or the user gives it up."""
        names = ", ".join(order.path.name for order in self.jobs.unfinished)
        if not names:
            return True
        answer = QMessageBox.question(
            self._window,
            "An export is running",
            f"Not written yet: {names}. Stop exporting and close? No unfinished file is left.",
            _Answer.Yes | _Answer.Cancel,
            _Answer.Cancel,
        )
        return answer == _Answer.Yes

    def end(self) -> None:
        """Stop exporting for good; nothing unfinished is left."""
        if self.jobs.busy:
            # To clear away a gigabyte can take a second.
            self._window.hide()
        self.jobs.close()

    def _ask_and_add(self, title: str, name: str, kinds: str, write: Write) -> None:
        # What the user sees now, whatever happens while the dialog is open.
        document = self._window.document
        design, view = document.design, document.view
        path = self._window.files.ask_where(title, self._window.preferences.folder / name, kinds)
        if path:
            self.jobs.add(
                ExportOrder(write=write, path=path, design=design, view=view, largest_error=VISIBLE)
            )

    def _note_written(self, order: ExportOrder) -> None:
        self._window.files.note_written(order.path)

    def _note_cancelled(self, order: ExportOrder) -> None:
        self._window.files.done.emit(f"Export of {order.path.name} cancelled; nothing was written")

    def _note_failed(self, order: ExportOrder, error: Exception) -> None:
        if isinstance(error, TooInaccurateError):
            if self._is_accepted(order, error):
                self.jobs.add(replace(order, largest_error=math.inf))
        elif isinstance(error, SkinSourceError):
            self._window.complain(str(error))
        else:
            _log.error("an export failed", exc_info=error)
            self._window.complain(
                f"{order.path.name} was not exported: the studio made a mistake "
                f"({type(error).__name__}: {error}). Please report this."
            )

    def _is_accepted(self, order: ExportOrder, error: Exception) -> bool:
        answer = QMessageBox.question(
            self._window,
            "Inaccurate numbers",
            f"{order.path.name}: {error} Export it all the same?",
            _Answer.Yes | _Answer.Cancel,
            _Answer.Cancel,
        )
        return answer == _Answer.Yes
