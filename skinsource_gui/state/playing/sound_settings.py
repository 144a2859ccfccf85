"""What this machine plays on: chosen once, kept, and never part of a design."""

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal

from skinsource.actuators import rigs
from skinsource.base.errors import InvalidInputError, SkinSourceError
from skinsource.lab.playing import devices
from skinsource.lab.playing.devices import Output, output_from_text
from skinsource_gui.state.playing.late_session import LateSession
from skinsource_gui.state.playing.sound_thread import SoundThread
from skinsource_gui.state.preferences import Preferences

if TYPE_CHECKING:
    from skinsource.actuators.rigs import Rig
    from skinsource.lab.playing.devices import Device


class SoundSettings(QObject):
    """The device, its rate and the channel map of this machine.

    Parameters
    ----------
    preferences
        Where they are kept.
    session, thread
        Who knows devices, and the thread that may ask it.

    Attributes
    ----------
    output
        What is played on.
    looked, devices, rates_hz
        Whether devices were looked for; those that were found, and the rates of the chosen one.
    missing
        Why there are none, or not the chosen one.
    rig, rig_problem
        What is wired to the device, None: not known; why the rig of this machine cannot be read.
    """

    #: Something else is known, or chosen.
    changed = Signal()
    #: What is played on was chosen anew.
    output_changed = Signal()
    #: Another device: what was loud enough for one may be too much for the other.
    device_changed = Signal()
    #: Why a rig was not taken.
    refused = Signal(str)

    def __init__(
        self, preferences: Preferences, session: LateSession, thread: SoundThread, parent: QObject
    ) -> None:
        super().__init__(parent)
        self._preferences, self._session, self._thread = preferences, session, thread
        self.output = _kept(preferences)
        self.looked = False
        self.devices: tuple[Device, ...] = ()
        self.rates_hz: tuple[int, ...] = ()
        self.missing = self._not_found = ""
        self.rig: Rig | None = None
        self.rig_title, self.rig_problem = "", ""
        self._rig_looked = False

    @property
    def rig_path(self) -> Path | None:
        """Where the rig of this machine is; None: there is none."""
        kept = self._preferences.rig_path
        return Path(kept) if kept else None

    @property
    def sensor_text(self) -> str:
        """What actuators are measured with on this machine, as the page of that wrote it."""
        return self._preferences.sensor_text

    @sensor_text.setter
    def sensor_text(self, text: str) -> None:
        self._preferences.sensor_text = text

    def look_for_rig(self) -> None:
        """Read the rig of this machine, when somebody first wants to know."""
        if self._rig_looked:
            return
        self._rig_looked = True
        if self._preferences.rig_path:
            try:
                self._take_rig(Path(self._preferences.rig_path))
            except SkinSourceError as error:
                self.rig_problem = f"The rig of this machine cannot be read: {error}"

    def rig_is_read(self) -> bool:
        """Whether what is wired is known, or nothing shall be; else it says why not."""
        self.look_for_rig()
        if self.rig_problem:
            self.refused.emit(f"{self.rig_problem} Choose another rig, or none.")
        return not self.rig_problem

    def choose_rig(self, path: Path | None) -> None:
        """Play for another rig from now on; None: nothing is known of what is wired."""
        self._rig_looked = True
        try:
            self._take_rig(path)
        except SkinSourceError as error:
            self.refused.emit(str(error))
            return
        self._preferences.rig_path = "" if path is None else str(path)
        self.output_changed.emit()
        self.changed.emit()
        # What is loud enough for one may be too much for another.
        self.device_changed.emit()

    def _take_rig(self, path: Path | None) -> None:
        found = None if path is None else rigs.open_rig(path)
        self.rig, self.rig_problem = found, ""
        self.rig_title = "" if found is None or path is None else found.title or path.stem

    def choose(self, output: Output) -> None:
        """Play on something else from now on."""
        before, self.output = self.output, output
        if before == output:
            return
        self._preferences.output_text = output.to_text()
        other = (before.device, before.host_api) != (output.device, output.host_api)
        if other:
            # What was wrong with the one before is nothing to this one.
            self.missing = self._not_found
            self._ask_rates()
        self.output_changed.emit()
        self.changed.emit()
        if other:
            self.device_changed.emit()

    def look(self) -> None:
        """Look for devices; what is played ends."""
        self._thread.do(self._session.made.devices, self._take_devices)

    def note_missing(self, reason: str) -> None:
        """Take over why nothing was heard; "": it was."""
        if reason != self.missing:
            self.missing = reason
            self.changed.emit()

    def _take_devices(
        self, found: "tuple[Device, ...] | None", error: SkinSourceError | None
    ) -> None:
        self.looked, self.devices, self.rates_hz = True, found or (), ()
        self.missing = self._not_found = "" if error is None else str(error)
        self._ask_rates()
        self.changed.emit()

    def _ask_rates(self) -> None:
        if not self.looked:
            return
        try:
            device = devices.device_of(self.output, self.devices)
        except SkinSourceError as error:
            self.missing = self.missing or str(error)
            return
        self._thread.do(partial(devices.rates_of, device), self._take_rates)

    def _take_rates(self, found: tuple[int, ...] | None, error: SkinSourceError | None) -> None:
        self.rates_hz = found or ()
        self.changed.emit()


def _kept(preferences: Preferences) -> Output:
    try:
        return output_from_text(preferences.output_text)
    except InvalidInputError:
        # Nothing is kept yet, or by another version of the studio.
        return Output()
