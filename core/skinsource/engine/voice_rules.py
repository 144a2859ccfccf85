"""Rules from voices to drives and lengths.

The edited voice is the one that the user works on.  The others are summed without it, so that their
sum stays when it changes.  No number depends on which voice is edited.
"""

from collections.abc import Sequence
from weakref import WeakKeyDictionary

import numpy as np

from skinsource.actuators.actuation import Actuation
from skinsource.base.conventions import Booleans, Floats
from skinsource.base.errors import InvalidInputError
from skinsource.base.job import Stop, stop_if
from skinsource.design.signal_path import Drive, UnitVoice, UnplayableInput, Voice
from skinsource.engine.drives import active_samples
from skinsource.engine.gains import CheckedVoice, EngineMemory, Placed, checked_voice
from skinsource.engine.transforms import length_at_once
from skinsource.limbs.limb import Limb


def edited_voice(voices: tuple[Voice, ...], edited_input: int | None) -> Voice | None:
    """The voice that is being edited, if it is heard; ``edited_input`` is its id."""
    return next((voice for voice in voices if voice.audible and voice.id == edited_input), None)


def other_voices(voices: tuple[Voice, ...], edited_input: int | None) -> tuple[Voice, ...]:
    """All voices that are heard but the edited one."""
    return tuple(voice for voice in voices if voice.audible and voice.id != edited_input)


def unit_voices(voices: tuple[Voice, ...]) -> tuple[UnitVoice, ...]:
    """All voices, heard or not, without amplitude and start."""
    return tuple(voice.unit for voice in voices)


def edited_unit(edited_voice: Voice | None) -> UnitVoice | None:
    """The edited voice without amplitude and start."""
    return None if edited_voice is None else edited_voice.unit


def edited_delay(edited_voice: Voice | None) -> int:
    """Samples before the edited voice starts."""
    return 0 if edited_voice is None else edited_voice.start


def heard_voices(voices: tuple[Voice, ...]) -> tuple[bool, ...]:
    """Whether each voice is heard."""
    return tuple(voice.audible for voice in voices)


def unit_drives(
    remembered: EngineMemory,
    unit_voices: tuple[UnitVoice, ...],
    heard_voices: tuple[bool, ...],
    sample_rate_hz: float,
    leave_out_unplayable: bool,
    stop: Stop,
) -> tuple[Drive | None, ...]:
    """What each voice plays, heard or not; None: it cannot be sampled, and need not be."""
    drives: list[Drive | None] = []
    for unit, heard in zip(unit_voices, heard_voices, strict=True):
        stop_if(stop)
        try:
            drives.append(remembered.drives.drawn(unit, sample_rate_hz))
        except InvalidInputError:
            if heard and not leave_out_unplayable:
                raise
            drives.append(None)
    return tuple(drives)


def input_waveforms(unit_drives: tuple[Drive | None, ...]) -> tuple[Floats | None, ...]:
    """What each input plays, muted or not, from its first clip on: (n_times,) each, or None."""
    return tuple(None if drive is None else _unscaled(drive) for drive in unit_drives)


# Kept as long as their drives: what an edit leaves alone stays the same array.
_UNSCALED: WeakKeyDictionary[Drive, Floats] = WeakKeyDictionary()


def _unscaled(drive: Drive) -> Floats:
    # Most long drives have a peak of exactly 1, and are not copied.
    if drive.factor in (0.0, 1.0):
        return drive.samples
    samples = _UNSCALED.get(drive)
    if samples is None:
        samples = _UNSCALED[drive] = drive.samples * drive.factor
    return samples


def edited_checked(
    remembered: EngineMemory,
    edited_unit: UnitVoice | None,
    limb_data: Limb,
    actuation: Actuation | None,
    leave_out_unplayable: bool,
    stop: Stop,
) -> CheckedVoice | None:
    """What the edited voice plays, or why it cannot be played."""
    if edited_unit is None:
        return None
    stop_if(stop)
    return checked_voice(
        remembered, edited_unit, limb_data, actuation, leave_out=leave_out_unplayable
    )


def others_checked(
    remembered: EngineMemory,
    other_voices: tuple[Voice, ...],
    limb_data: Limb,
    actuation: Actuation | None,
    leave_out_unplayable: bool,
    stop: Stop,
) -> tuple[CheckedVoice, ...]:
    """What the other voices play, or why they cannot be played."""
    checked = []
    for voice in other_voices:
        stop_if(stop)
        checked.append(
            checked_voice(
                remembered, voice.unit, limb_data, actuation, leave_out=leave_out_unplayable
            )
        )
    return tuple(checked)


def checked_voices(
    voices: tuple[Voice, ...],
    edited_voice: Voice | None,
    edited_checked: CheckedVoice | None,
    other_voices: tuple[Voice, ...],
    others_checked: tuple[CheckedVoice, ...],
) -> tuple[tuple[Voice, CheckedVoice], ...]:
    """All voices that are heard, in their order, and what each plays."""
    checked = {voice.id: each for voice, each in zip(other_voices, others_checked, strict=True)}
    if edited_voice is not None and edited_checked is not None:
        checked[edited_voice.id] = edited_checked
    return tuple((voice, checked[voice.id]) for voice in voices if voice.id in checked)


def edited_drive(edited_checked: CheckedVoice | None) -> Drive | None:
    """What the edited voice plays; None where it cannot be played."""
    return None if edited_checked is None else edited_checked.played


def others_placed(
    other_voices: tuple[Voice, ...], others_checked: tuple[CheckedVoice, ...]
) -> tuple[Placed, ...]:
    """The other voices with their drives, without those that cannot be played."""
    return tuple(
        Placed(voice, checked.played, voice.start)
        for voice, checked in zip(other_voices, others_checked, strict=True)
        if checked.played is not None
    )


def unplayable_inputs(
    checked_voices: tuple[tuple[Voice, CheckedVoice], ...],
) -> tuple[UnplayableInput, ...]:
    """Inputs that are heard and cannot be played; nothing is predicted of them."""
    return tuple(
        UnplayableInput(voice.id, checked.problem, voice.location)
        for voice, checked in checked_voices
        if checked.problem
    )


def sampled_voices(checked_voices: tuple[tuple[Voice, CheckedVoice], ...]) -> tuple[Placed, ...]:
    """Voices that are heard, with their drives, also those that no actuator can follow."""
    return tuple(
        Placed(voice, checked.drive, voice.start)
        for voice, checked in checked_voices
        if checked.drive is not None
    )


def placed(
    voices: tuple[Voice, ...],
    others_placed: tuple[Placed, ...],
    edited_voice: Voice | None,
    edited_drive: Drive | None,
    edited_delay: int,
) -> tuple[Placed, ...]:
    """All voices that are heard with their drives, in their order."""
    by_id = {other.voice.id: other for other in others_placed}
    if edited_voice is not None and edited_drive is not None:
        by_id[edited_voice.id] = Placed(edited_voice, edited_drive, edited_delay)
    return tuple(by_id[voice.id] for voice in voices if voice.id in by_id)


def moving_places(placed: Sequence[Placed]) -> tuple[int, ...]:
    """Places at which anything moves the skin, each once."""
    return tuple(dict.fromkeys(each.voice.location for each in placed if each.moves))


def stimulus_samples(
    others_placed: tuple[Placed, ...], edited_drive: Drive | None, edited_delay: int
) -> int:
    """Samples from time 0 to the end of the last voice; 1 where nothing is heard."""
    ends = [other.end for other in others_placed]
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
    edited_drive: Drive | None,
    driven_limb: Limb,
) -> int | None:
    """Length of transforms; None where the response is too long to be transformed at once."""
    places = {other.voice.location for other in others_placed}
    if edited_unit is not None and edited_drive is not None:
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
    for other in others_placed if played.size else ():
        played[other.start : other.end] |= other.drive.samples != 0.0
    return active_samples(played, driven_limb.n_taps)


def edited_active(
    edited_drive: Drive | None, response_samples: int, n_fft: int | None, driven_limb: Limb
) -> Booleans:
    """When the edited voice could if it started at time 0, as `others_active`."""
    played = np.zeros(0 if n_fft is None else response_samples, bool)
    if edited_drive is not None and played.size:
        played[: edited_drive.samples.size] = edited_drive.samples != 0.0
    return active_samples(played, driven_limb.n_taps)
