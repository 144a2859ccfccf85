"""Saving what a benchmark has written, where the user says."""

from pathlib import Path

from PySide6.QtWidgets import QFileDialog, QWidget

from skinsource.errors import SkinSourceError
from skinsource.files import is_there
from skinsource_gui.accuracy_page.bench_run import BenchRun
from skinsource_gui.state.preferences import Preferences
from skinsource_gui.widgets.asking import may_replace


def ask_and_save(run: BenchRun, preferences: Preferences, window: QWidget) -> str:
    """Ask for a folder, and save there; return what came of it, nothing when it was given up."""
    start = str(preferences.folder)
    chosen = QFileDialog.getExistingDirectory(window, "Save the benchmark in a folder", start)
    if not chosen:
        return ""
    folder = Path(chosen)
    names = [path.name for path in run.files]
    there = [folder / name for name in names if is_there(folder / name)]
    if there and not may_replace(window, there):
        return ""
    try:
        run.save(folder)
    except SkinSourceError as error:
        return str(error)
    preferences.folder = folder
    return f"Saved in {folder}: {', '.join(names)}."
