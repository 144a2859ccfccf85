"""Rules from the noise of responses to that in predictions."""

import numpy as np
import scipy

from skinsource.analysis.noise import noise_rms, predicted_noise_energy, tells_noise
from skinsource.arrays import Floats
from skinsource.chain import Actuation, transfers_of
from skinsource.job import Stop
from skinsource.limb import Limb
from skinsource.rendering.placed import Placed
from skinsource.rendering.projecting import Projection
from skinsource.rendering.responses import Responses
from skinsource.scaling.calibration import per_probe_acceleration
from skinsource.scaling.response_scaling import Scaling


def place_drives(
    responses: Responses, placed: tuple[Placed, ...], stop: Stop
) -> tuple[tuple[int, Floats], ...]:
    """What is played at each place, (place, (n_times,)), as the responses to it are scaled.

    In probe scaling that is the acceleration of the probe, m/s².
    """
    moving = [one for one in placed if one.moves]
    to_places = responses.to(one.voice.location for one in moving)
    gains = responses.gains(
        [one.sounding(to) for one, to in zip(moving, to_places, strict=True)], stop
    )
    length = max((one.end for one in moving), default=0)
    found: dict[int, Floats] = {}
    for one, gain in zip(moving, gains, strict=True):
        total = found.setdefault(one.voice.location, np.zeros(length))
        total[one.start : one.end] += one.voice.amplitude * gain * one.drive.samples
    return tuple(found.items())


def noise_energy(
    place_drives: tuple[tuple[int, Floats], ...],
    limb_data: Limb,
    scaling: Scaling,
    actuation: Actuation | None,
    match_gain: float,
) -> Floats | None:
    """Energy of the noise of the responses in the prediction, (n_outputs, n_axes).

    None where there is none to tell: in silence, and where `place_noise` knows of none.
    """
    noise = noise_of_places(place_drives, limb_data)
    if noise is None:
        return None
    drives = shaped_drives(place_drives, limb_data, scaling, actuation)
    return match_gain**2 * predicted_noise_energy(drives, noise, limb_data.n_taps)


def output_noise_rms(
    noise_energy: Floats | None, projection: Projection, record_samples: int
) -> Floats | None:
    """RMS over the whole record of what is noise in each projected signal, (n_outputs,)."""
    if noise_energy is None:
        return None
    return projected_rms(noise_energy, projection, record_samples)


def above_noise_db(record_rms: Floats, output_noise_rms: Floats | None) -> Floats | None:
    """Level of each output above that of its noise, (n_outputs,), dB; None: nothing is known."""
    if output_noise_rms is None:
        return None
    ratio = np.divide(
        record_rms, output_noise_rms, out=np.zeros_like(record_rms), where=output_noise_rms > 0.0
    )
    with np.errstate(divide="ignore"):
        level: Floats = 20.0 * np.log10(ratio)
    return np.maximum(level, -200.0)


RULES = (place_drives, noise_energy, output_noise_rms, above_noise_db)


def place_noise(limb: Limb, place: int) -> Floats | None:
    """RMS of the noise in the responses to a place, (n_outputs, n_axes); None: not known.

    Synthetic limbs have none, and some of one's own too few samples before the pulse.
    """
    rate, before_s = limb.sample_rate_hz, limb.pre_trigger_delay_s
    if limb.synthetic or not tells_noise(rate, before_s):
        return None
    return noise_rms(limb.response_to(place), rate, before_s)


def noise_of_places(
    place_drives: tuple[tuple[int, Floats], ...], limb: Limb
) -> dict[int, Floats] | None:
    """Noise of the responses to each place that plays; None: nothing does, or one is not known."""
    found = {place: place_noise(limb, place) for place, _ in place_drives}
    noise = {place: one for place, one in found.items() if one is not None}
    return noise if noise and len(noise) == len(found) else None


def projected_rms(energy: Floats, projection: Projection, n_times: int) -> Floats:
    """RMS over ``n_times`` along a projection, of energies along the axes, (..., n_axes)."""
    chosen = energy[..., list(projection.axis_numbers)]
    if projection.directions is not None:
        chosen = chosen * np.square(projection.directions)
    return np.sqrt(chosen.sum(axis=-1) / n_times)


def divided_by_pulse(limb: Limb, scaling: Scaling) -> bool:
    """Whether responses are divided by the measuring pulse, their noise with them."""
    return scaling == "probe" and not limb.per_unit_drive


def probe_inverse(n_taps: int, sample_rate_hz: float) -> Floats:
    """What a response is convolved with to be one per probe acceleration, (n_taps,)."""
    pulse = np.zeros(n_taps)
    pulse[n_taps // 2] = 1.0
    return per_probe_acceleration(pulse, sample_rate_hz)


def noise_path(limb: Limb, scaling: Scaling, actuation: Actuation | None, place: int) -> Floats:
    """Impulse response that the noise in the responses to a place goes through, (n,).

    In probe scaling that is the inverse pulse, with its middle at half of its length; through an
    actuator, it is followed by what equaliser and actuator of the place make of a drive.
    """
    rate = limb.sample_rate_hz
    path = np.ones(1)
    if divided_by_pulse(limb, scaling):
        path = probe_inverse(limb.n_taps, rate)
    if actuation is None:
        return path
    transfers = transfers_of(actuation, rate, limb.band_hz)
    return scipy.signal.oaconvolve(path, transfers[actuation.at(place).place].samples)


def shaped_drives(
    place_drives: tuple[tuple[int, Floats], ...],
    limb: Limb,
    scaling: Scaling,
    actuation: Actuation | None,
) -> dict[int, Floats]:
    """What the noise of the responses is convolved with, by place: see `noise_path`."""
    return {
        place: scipy.signal.oaconvolve(played, noise_path(limb, scaling, actuation, place))
        for place, played in place_drives
    }
