"""What the parts of a window share."""

from dataclasses import dataclass

from PySide6 import QtWidgets

from skinsource_gui.state.document import Document
from skinsource_gui.state.engine import Engine
from skinsource_gui.state.job_runner import JobRunner
from skinsource_gui.state.panel import PanelRegistry
from skinsource_gui.state.preferences import InstalledLimbs, Preferences


@dataclass(frozen=True, slots=True, kw_only=True)
class Services:
    """What one window has one of; its parts get it as one value.

    Attributes
    ----------
    window
        Parent of its parts, and of the dialogs that they open.
    document, engine, panels
        The open design, what predicts it, and what shows it.
    runner
        Runs long jobs.
    preferences, limbs
        What the user chose, and which limbs are installed.
    """

    window: QtWidgets.QMainWindow
    document: Document
    engine: Engine
    panels: PanelRegistry
    runner: JobRunner
    preferences: Preferences
    limbs: InstalledLimbs
