"""Rules from drives and responses to vibrations: by the edited voice, by the others, and by all.

Long designs have one streamed vibration by all voices instead.  The gain that makes a snapshot as
loud as another one is applied here: to the vibration, and to no drive.
"""

from weakref import ref

import numpy as np

from skinsource.base.conventions import Booleans, Complexes
from skinsource.base.job import Stop
from skinsource.design.signal_path import Drive, UnitVoice, Voice
from skinsource.engine.drives import delayed
from skinsource.engine.gains import EngineMemory, Placed, Responses, Sounding
from skinsource.engine.spectra import ResponseSpectrum, TotalSpectrum, superpose
from skinsource.engine.streaming import StreamedVibration, Vibration
from skinsource.engine.transforms import Blocks, ChannelsOnDemand, Played, driven, rows_of
from skinsource.limbs.limb import Limb
from skinsource.limbs.scaling import Scaling


def responses(
    remembered: EngineMemory, driven_limb: Limb, scaling: Scaling, n_fft: int | None
) -> Responses:
    """Responses of the limb at the length of the transforms; nothing is read yet."""
    return Responses(remembered, driven_limb, scaling, n_fft)


def others_spectrum(
    responses: Responses, others_placed: tuple[Placed, ...], match_gain: float, stop: Stop
) -> Complexes | None:
    """Vibration by the other voices, (n_outputs, 3, n_bins); None: none of them moves anything."""
    n_fft = responses.n_fft
    moving = [] if n_fft is None else responses.moving(others_placed, stop)
    if n_fft is None or not moving:
        return None
    spectra = [
        delayed(responses.drive_spectrum(other.voice.unit, other.drive), other.start, n_fft)
        * (other.voice.amplitude * match_gain * gain)
        for other, _, gain in moving
    ]
    total = np.empty_like(moving[0][1].values)
    superpose([response for _, response, _ in moving], spectra, total)
    return total


def edited_sounding(
    responses: Responses, edited_unit: UnitVoice | None, edited_drive: Drive | None
) -> Sounding | None:
    """The edited voice with the responses to its place; None: it moves nothing, or plays long."""
    if responses.n_fft is None or edited_unit is None or edited_drive is None:
        return None
    if edited_drive.silent:
        return None
    [response] = responses.to([edited_unit.location])
    return Sounding(edited_unit, edited_drive, response)


def edited_response(edited_sounding: Sounding | None) -> ResponseSpectrum | None:
    """Responses to the place of the edited voice; None: it moves nothing."""
    return None if edited_sounding is None else edited_sounding.response


def edited_spectrum(responses: Responses, edited_sounding: Sounding | None) -> Complexes | None:
    """Spectrum of what the edited voice plays, from time 0 on, (n_bins,); None: silence."""
    if edited_sounding is None:
        return None
    return responses.drive_spectrum(edited_sounding.unit, edited_sounding.drive)


def edited_delayed_spectrum(
    edited_spectrum: Complexes | None, edited_delay: int, n_fft: int | None
) -> Complexes | None:
    """The same from its onset on."""
    if edited_spectrum is None or n_fft is None:
        return None
    return delayed(edited_spectrum, edited_delay, n_fft)


def edited_gain(responses: Responses, edited_sounding: Sounding | None, stop: Stop) -> float:
    """What the vibration by the edited voice is multiplied with at amplitude 1."""
    if edited_sounding is None:
        return 0.0
    [gain] = responses.gains([edited_sounding], stop)
    return gain


def edited_weight(edited_voice: Voice | None, edited_gain: float, match_gain: float) -> float:
    """What it is multiplied with at its own amplitude."""
    return 0.0 if edited_voice is None else edited_voice.amplitude * match_gain * edited_gain


def total_spectrum(
    responses: Responses,
    others_spectrum: Complexes | None,
    edited_response: ResponseSpectrum | None,
    edited_delayed_spectrum: Complexes | None,
    edited_weight: float,
) -> TotalSpectrum | None:
    """Spectrum of all voices together, made where it is asked for; None for long responses."""
    if responses.n_fft is None:
        return None
    limb = responses.limb
    return TotalSpectrum(
        shape=(limb.n_outputs, limb.n_axes, responses.n_fft // 2 + 1),
        n_fft=responses.n_fft,
        others=others_spectrum,
        response=edited_response,
        drive=edited_delayed_spectrum,
        weight=edited_weight,
    )


def others_channels(
    others_spectrum: Complexes | None, others_active: Booleans, n_fft: int | None
) -> ChannelsOnDemand | None:
    """Vibration by the other voices, to be brought back to time."""
    if others_spectrum is None or n_fft is None:
        return None
    return ChannelsOnDemand(
        lambda channels: rows_of(others_spectrum, channels), n_fft, others_active
    )


def edited_channels(
    responses: Responses,
    edited_sounding: Sounding | None,
    edited_spectrum: Complexes | None,
    edited_active: Booleans,
) -> ChannelsOnDemand | None:
    """Vibration by the edited voice at amplitude 1 and onset 0, to be brought back to time."""
    if edited_sounding is None or edited_spectrum is None:
        return None
    drive, response = edited_sounding.drive, edited_sounding.response
    values, taps, location = response.values, response.taps, edited_sounding.unit.location
    name = ref(responses.limb), location, responses.scaling == "probe"
    exact = responses.remembered.exact_spectra
    return ChannelsOnDemand(
        lambda channels: driven([values[at - 1, axis] for at, axis in channels], edited_spectrum),
        response.n_fft,
        edited_active,
        exact.of(drive.samples, taps, name, edited_active.size),
    )


def streamed_vibration(
    responses: Responses,
    placed: tuple[Placed, ...],
    response_samples: int,
    match_gain: float,
    stop: Stop,
) -> StreamedVibration | None:
    """Vibration by all voices where the response is too long to be transformed at once."""
    if responses.n_fft is not None:
        return None
    played = [
        Played(
            drive=player.drive,
            start=player.start,
            weight=player.voice.amplitude * match_gain * gain,
            location=player.voice.location,
        )
        for player, _, gain in responses.moving(placed, stop)
    ]
    stack = responses.stack(drive.location for drive in played)
    shape = responses.limb.n_outputs, responses.limb.n_axes, response_samples
    return StreamedVibration(played, stack, shape, Blocks(responses.limb.n_taps))


def vibration(
    response_samples: int,
    others_channels: ChannelsOnDemand | None,
    edited_channels: ChannelsOnDemand | None,
    edited_weight: float,
    edited_delay: int,
    streamed_vibration: StreamedVibration | None,
) -> Vibration:
    """Vibration by all voices, for the outputs that are looked at."""
    return Vibration(
        n_times=response_samples,
        others=others_channels,
        edited=edited_channels,
        weight=edited_weight,
        delay_samples=edited_delay,
        streamed=streamed_vibration,
    )
