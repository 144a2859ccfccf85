"""Saving what a benchmark has written, where the user says."""

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtWidgets import QFileDialog, QMessageBox, QWidget

from skinsource.errors import SkinSourceError
from skinsource_gui.accuracy_page.bench_run import BenchRun
from skinsource_gui.state.preferences import Preferences

_Answer = QMessageBox.StandardButton


def ask_and_save(run: BenchRun, preferences: Preferences, window: QWidget) -> str:
    """Ask for a folder, and save there; return what came of it, nothing when it was given up."""
    start = str(preferences.folder)
    chosen = QFileDialog.getExistingDirectory(window, "Save the benchmark in a folder", start)
    if not chosen:
        return ""
    folder = Path(chosen)
    names = [path.name for path in run.files]
    there = [name for name in names if (folder / name).exists()]
    if there and not _may_replace(there, window):
        return ""
    try:
        run.save(folder)
    except SkinSourceError as error:
        return str(error)
    preferences.folder = folder
    return f"Saved in {folder}: {', '.join(names)}."


def _may_replace(names: Sequence[str], window: QWidget) -> bool:
    answer = QMessageBox.question(
        window,
        "Replace the files?",
        f"{', '.join(names)}: in that folder already. Replace?",
        _Answer.Yes | _Answer.Cancel,
        _Answer.Cancel,
    )
    return answer == _Answer.Yes
