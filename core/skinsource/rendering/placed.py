"""Voices with their drives, or why they cannot be played."""

from dataclasses import dataclass

from skinsource.chain import Actuation, Drive, refuse_unfollowed
from skinsource.errors import InvalidInputError
from skinsource.limb import Limb
from skinsource.rendering.gains import Sounding
from skinsource.rendering.remembered import Remembered
from skinsource.rendering.response_spectra import ResponseSpectrum
from skinsource.voices import UnitVoice, Voice


@dataclass(frozen=True, slots=True)
class Placed:
    """A voice, what it plays, and the sample at which it starts."""

    voice: Voice
    drive: Drive
    start: int

    @property
    def end(self) -> int:
        """Sample after its last one."""
        return self.start + self.drive.samples.size

    @property
    def moves(self) -> bool:
        """Whether the skin moves at all because of it."""
        return self.voice.amplitude != 0.0 and not self.drive.silent

    def sounding(self, response: ResponseSpectrum) -> Sounding:
        """The same without amplitude and start, with the responses to its place."""
        return Sounding(self.voice.unit, self.drive, response)


@dataclass(frozen=True, slots=True, eq=False)
class CheckedVoice:
    """What a voice plays.

    Attributes
    ----------
    drive
        None: it cannot be sampled.
    problem
        Why it cannot be played, as the error says it; empty: it can.
    """

    drive: Drive | None
    problem: str = ""

    @property
    def played(self) -> Drive | None:
        """The drive, unless the voice cannot be played."""
        return None if self.problem else self.drive


def checked_voice(
    remembered: Remembered,
    unit: UnitVoice,
    limb: Limb,
    actuation: Actuation | None,
    *,
    leave_out: bool,
) -> CheckedVoice:
    """Return what a voice plays.

    Parameters
    ----------
    leave_out
        Whether a voice that cannot be played is returned with the reason, instead of an error.

    Raises
    ------
    InvalidInputError
        It cannot be sampled, the limb does not have its place, there is no actuator at its place,
        or that cannot follow it.
    """
    drive = None
    try:
        drive = remembered.drives.drawn(unit, limb.sample_rate_hz)
        if not drive.silent:
            limb.check_place(unit.location)
            if actuation is not None:
                actuation.at(unit.location)
        refuse_unfollowed(actuation, drive, limb.sample_rate_hz, limb.band_hz, unit.location)
    except InvalidInputError as error:
        if not leave_out:
            raise
        return CheckedVoice(drive, str(error))
    return CheckedVoice(drive)
