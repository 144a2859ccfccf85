"""The rig that is edited on the page, and the file it belongs to."""

from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from skinsource.actuators.measured_response import MeasuredResponse
from skinsource.actuators.rigs import Rig, RigChannel, open_rig, save_rig
from skinsource.base.errors import InvalidInputError, SkinSourceError
from skinsource.design.design import Design
from skinsource.limbs.own_limbs import facts_of


class RigDraft(QObject):
    """A rig, changed channel by channel; what cannot be is refused.

    Parameters
    ----------
    rig, path
        What is edited at first, and its file; None: a new one.
    design
        Its places are those that are wired first, and its limb has the others.

    Attributes
    ----------
    rig, path
        What is edited, and the file it came from or went to.
    """

    #: The row of the channel that is to be shown now.
    changed = Signal(int)
    #: What there is to say.
    said = Signal(str)

    def __init__(self, rig: Rig | None, path: Path | None, design: Design, parent: QObject) -> None:
        super().__init__(parent)
        driven = (one.location for one in design.inputs)
        every = range(1, facts_of(design.limb).n_inputs + 1)
        self._places = tuple(dict.fromkeys((*driven, *every)))
        self.rig = self._saved = rig or Rig()
        self.path = path

    @property
    def unsaved(self) -> bool:
        """Whether there are changes that are in no file."""
        return self.rig != self._saved

    def entitle(self, title: str) -> None:
        """Give it another title."""
        try:
            self.rig = replace(self.rig, title=title)
        except InvalidInputError as error:
            self.said.emit(str(error))

    def take_channel(self, row: int, channel: RigChannel) -> None:
        """Put another channel in the place of one."""
        channels = list(self.rig.channels)
        channels[row] = channel
        self._change(tuple(channels), row, row)

    def add(self, row: int) -> None:
        """Add a channel for the next place, of the design first, and output that are free."""
        there = self.rig.channels
        last = there[-1] if there else None
        places = {one.place for one in there}
        free = [place for place in self._places if place not in places]
        if not free:
            self.said.emit("All places are wired already.")
            return
        device = "" if last is None else last.device
        outputs = {one.output for one in there if one.device == device}
        output = next(k for k in range(1, len(there) + 2) if k not in outputs)
        if last is None:
            new = RigChannel(place=free[0], output=output)
        else:
            # Most channels of a rig are alike; what was measured is of one alone.
            new = replace(last, place=free[0], output=output, measured=None, measured_on="")
        self._change((*there, new), row, len(there))

    def remove(self, row: int) -> None:
        """Take a channel out."""
        left = tuple(one for k, one in enumerate(self.rig.channels) if k != row)
        self._change(left, row, max(row - 1, 0))

    def take_response(self, row: int, found: MeasuredResponse | None) -> None:
        """Let a channel answer as it was measured today; None: as if it was not."""
        if 0 <= row < len(self.rig.channels):
            today = "" if found is None else datetime.now(UTC).date().isoformat()
            changed = replace(self.rig.channels[row], measured=found, measured_on=today)
            self.take_channel(row, changed)

    def open(self, path: Path) -> None:
        """Edit the rig of a file."""
        try:
            self.rig = self._saved = open_rig(path)
        except SkinSourceError as error:
            self.said.emit(str(error))
            return
        self.path = path
        self.changed.emit(0)

    def save(self, path: Path) -> bool:
        """Write it to a file; whether that went well."""
        try:
            save_rig(path, self.rig)
        except SkinSourceError as error:
            self.said.emit(str(error))
            return False
        self.path, self._saved = path, self.rig
        return True

    def give_up(self) -> None:
        """Changes need not be kept."""
        self._saved = self.rig

    def _change(self, channels: tuple[RigChannel, ...], row: int, after: int) -> None:
        """Take over other channels; refused where they cannot be."""
        try:
            self.rig = replace(self.rig, channels=channels)
        except InvalidInputError as error:
            self.changed.emit(row)
            self.said.emit(str(error))
        else:
            self.changed.emit(after)
