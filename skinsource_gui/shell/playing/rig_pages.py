"""Opens the page on which a rig is described, and responses that were measured."""

import importlib
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QFileDialog, QWidget

from skinsource.actuators import measuring
from skinsource.base.errors import SkinSourceError
from skinsource.base.quoting import printable
from skinsource.design.edits import Refusal, predict_through
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.engine import actuator_demand
from skinsource_gui.state.document import Document
from skinsource_gui.state.playing.sound_settings import SoundSettings
from skinsource_gui.state.playing.sound_thread import SoundThread
from skinsource_gui.widgets.rig_field import RESPONSE_FILES

if TYPE_CHECKING:
    from skinsource.actuators.measured_response import MeasuredResponse

# The panel that it is looked at in, and the longest title there.
_PANEL, _LONGEST_TITLE = "actuator", 100


class RigPages(QObject):
    """Few describe a rig: the page is imported when it is first wanted.

    Parameters
    ----------
    document
        What can be predicted through a rig.
    settings
        What this machine plays for.
    window
        In front of which the page opens; also the parent.
    """

    #: Why a response was not opened.
    failed = Signal(str)
    #: What was opened, in words.
    opened = Signal(str)

    def __init__(self, document: Document, settings: SoundSettings, window: QWidget) -> None:
        super().__init__(window)
        self._document, self._settings, self._window = document, settings, window
        self._thread = SoundThread(self)

    def show(self) -> None:
        """Open the page."""
        module: Any = importlib.import_module("skinsource_gui.rig_page.page")
        module.RigPage(self._document, self._settings, self._window).open()

    def open_response(self) -> None:
        """Ask for a response that was measured, and look at it in the actuator's panel."""
        name, _ = QFileDialog.getOpenFileName(
            self._window, "Response of the actuator", "", RESPONSE_FILES
        )
        if name:
            path = Path(name)
            self._thread.do(partial(measuring.open_response, path), partial(self._look_at, path))

    def end(self) -> None:
        """Open nothing more."""
        self._thread.end(lambda: None)

    def _look_at(
        self, path: Path, found: "MeasuredResponse | None", error: SkinSourceError | None
    ) -> None:
        if found is None:
            self.failed.emit(str(error))
            return
        design, view = self._document.design, self._document.view
        before = settings_of(view, _PANEL, actuator_demand.ActuatorSettings)
        after = before.with_measured(found, path.stem[:_LONGEST_TITLE])
        view = with_settings(view, _PANEL, after)
        through = design.actuated
        if through is None or through != actuator_demand.actuation_of(
            actuator_demand.settings_through(before, through)
        ):
            self._document.look(view)
        else:
            # What is predicted goes with what the panel shows.
            outcome = predict_through(design, view, actuator_demand.actuation_of(after))
            if isinstance(outcome, Refusal):
                self.failed.emit(outcome.sentence)
                return
            self._document.apply(outcome)
        self.opened.emit(f"Opened {printable(path.name)}.")
