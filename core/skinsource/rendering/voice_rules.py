"""Rules from voices to drives and lengths.

The edited voice is the one that the user works on.  It stands apart from the sum of the others, so
that a change of it leaves them alone.  No number depends on which one it is.
"""

import numpy as np

from skinsource.arrays import Booleans, Floats
from skinsource.chain import Actuation, Drive, refuse_unfollowed
from skinsource.job import Stop, stop_if
from skinsource.limb import Band, Limb
from skinsource.rendering.drives import active_samples
from skinsource.rendering.placed import Placed
from skinsource.rendering.remembered import Remembered
from skinsource.rendering.segments import length_at_once
from skinsource.voices import UnitVoice, Voice


def edited_voice(voices: tuple[Voice, ...], selected_input: int | None) -> Voice | None:
    """The voice that is being edited, if it is heard; ``selected_input`` is its id."""
    return next((one for one in voices if one.heard and one.id == selected_input), None)


def other_voices(voices: tuple[Voice, ...], selected_input: int | None) -> tuple[Voice, ...]:
    """All voices that are heard but the edited one."""
    return tuple(one for one in voices if one.heard and one.id != selected_input)


def unit_voices(voices: tuple[Voice, ...]) -> tuple[UnitVoice, ...]:
    """All voices, heard or not, without amplitude and start."""
    return tuple(one.unit for one in voices)


def edited_unit(edited_voice: Voice | None) -> UnitVoice | None:
    """The edited voice without amplitude and start."""
    return None if edited_voice is None else edited_voice.unit


def edited_delay(edited_voice: Voice | None) -> int:
    """Samples before the edited voice starts."""
    return 0 if edited_voice is None else edited_voice.start


def unit_drives(
    remembered: Remembered, unit_voices: tuple[UnitVoice, ...], sample_rate_hz: float, stop: Stop
) -> tuple[Drive, ...]:
    """What each voice plays, heard or not."""
    return tuple(_drawn(remembered, one, sample_rate_hz, stop) for one in unit_voices)


def input_waveforms(unit_drives: tuple[Drive, ...]) -> tuple[Floats, ...]:
    """What each input plays, muted or not, from its first clip on: (n_times,) each."""
    # Long ones are not held twice: most have a peak of exactly 1.
    return tuple(
        drive.samples if drive.factor in (0.0, 1.0) else drive.samples * drive.factor
        for drive in unit_drives
    )


def edited_drive(
    remembered: Remembered,
    edited_unit: UnitVoice | None,
    sample_rate_hz: float,
    band_hz: Band | None,
    actuation: Actuation | None,
    stop: Stop,
) -> Drive | None:
    """What the edited voice plays; refused where no actuator could follow it."""
    if edited_unit is None:
        return None
    drive = _drawn(remembered, edited_unit, sample_rate_hz, stop)
    refuse_unfollowed(actuation, drive, sample_rate_hz, band_hz, edited_unit.location)
    return drive


def others_placed(
    remembered: Remembered,
    other_voices: tuple[Voice, ...],
    sample_rate_hz: float,
    band_hz: Band | None,
    actuation: Actuation | None,
    stop: Stop,
) -> tuple[Placed, ...]:
    """The other voices with their drives."""
    found = []
    for one in other_voices:
        drive = _drawn(remembered, one.unit, sample_rate_hz, stop)
        refuse_unfollowed(actuation, drive, sample_rate_hz, band_hz, one.location)
        found.append(Placed(one, drive, one.start))
    return tuple(found)


def placed(
    voices: tuple[Voice, ...],
    others_placed: tuple[Placed, ...],
    edited_voice: Voice | None,
    edited_drive: Drive | None,
    edited_delay: int,
) -> tuple[Placed, ...]:
    """All voices that are heard with their drives, in their order."""
    found = {one.voice.id: one for one in others_placed}
    if edited_voice is not None and edited_drive is not None:
        found[edited_voice.id] = Placed(edited_voice, edited_drive, edited_delay)
    return tuple(found[one.id] for one in voices if one.id in found)


def stimulus_samples(
    others_placed: tuple[Placed, ...], edited_drive: Drive | None, edited_delay: int
) -> int:
    """Samples from time 0 to the end of the last voice; 1 where nothing is heard."""
    ends = [one.end for one in others_placed]
    if edited_drive is not None:
        ends.append(edited_delay + edited_drive.samples.size)
    return max([1, *ends])


def response_samples(stimulus_samples: int, driven_limb: Limb) -> int:
    """Samples of the response: the stimulus and one response more."""
    return stimulus_samples + driven_limb.n_taps - 1


def record_samples(stimulus_samples: int, limb_data: Limb) -> int:
    """Samples that levels of the whole record are over: without what actuators ring."""
    return stimulus_samples + limb_data.n_taps - 1


def n_fft(
    response_samples: int,
    others_placed: tuple[Placed, ...],
    edited_unit: UnitVoice | None,
    driven_limb: Limb,
) -> int | None:
    """Length of transforms; None where the response is too long to be transformed at once."""
    places = {one.voice.location for one in others_placed}
    if edited_unit is not None:
        places.add(edited_unit.location)
    return length_at_once(response_samples, len(places), driven_limb.n_outputs * driven_limb.n_axes)


def streamed(n_fft: int | None) -> bool:
    """Whether the response is computed block by block."""
    return n_fft is None


def others_active(
    others_placed: tuple[Placed, ...], response_samples: int, n_fft: int | None, driven_limb: Limb
) -> Booleans:
    """When any other voice can move the skin, (response_samples,); not for long responses."""
    played = np.zeros(0 if n_fft is None else response_samples, bool)
    for one in others_placed if played.size else ():
        played[one.start : one.end] |= one.drive.samples != 0.0
    return active_samples(played, driven_limb.n_taps)


def edited_active(
    edited_drive: Drive | None, response_samples: int, n_fft: int | None, driven_limb: Limb
) -> Booleans:
    """When the edited voice could if it started at time 0, as `others_active`."""
    played = np.zeros(0 if n_fft is None else response_samples, bool)
    if edited_drive is not None and played.size:
        played[: edited_drive.samples.size] = edited_drive.samples != 0.0
    return active_samples(played, driven_limb.n_taps)


def _drawn(remembered: Remembered, unit: UnitVoice, sample_rate_hz: float, stop: Stop) -> Drive:
    stop_if(stop)
    return remembered.drives.drawn(unit, sample_rate_hz)


RULES = (
    edited_voice,
    other_voices,
    unit_voices,
    edited_unit,
    edited_delay,
    unit_drives,
    input_waveforms,
    edited_drive,
    others_placed,
    placed,
    stimulus_samples,
    response_samples,
    record_samples,
    n_fft,
    streamed,
    others_active,
    edited_active,
)
