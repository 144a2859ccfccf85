"""A limb behind actuators: its responses are to the drives, not to the probe."""

import scipy

from skinsource.arrays import Floats
from skinsource.chain import Actuation, transfers_of
from skinsource.errors import InvalidInputError
from skinsource.limb import Limb
from skinsource.rendering.response_spectra import scaled_taps
from skinsource.scaling.response_scaling import Scaling
from skinsource.work import tally


def actuated_limb(limb: Limb, actuation: Actuation, scaling: Scaling) -> Limb:
    """Return ``limb`` as it answers through actuators.

    Its responses are those of the limb, calibrated to the acceleration of the probe, convolved with
    what equaliser and actuator of the place make of an impulse: longer, and from before time 0 on.
    Nothing is read yet.

    Raises
    ------
    InvalidInputError
        Drives are not accelerations or volts under this scaling, or an actuator rings for longer
        than can be predicted.
    """
    if scaling != "probe":
        raise InvalidInputError(
            "Predict through the actuator needs drives that are accelerations or volts, and under "
            f"this scaling, {scaling}, they are none. Choose the scaling Probe acceleration, or "
            "switch it off."
        )
    transfers = transfers_of(actuation, limb.sample_rate_hz, limb.band_hz)
    first = next(iter(transfers.values()))
    n_taps = limb.n_taps + first.samples.size - 1

    def read(location: int) -> Floats:
        transfer = transfers[actuation.at(location).place]
        taps = scaled_taps(limb, location, "probe")
        n_fft = scipy.fft.next_fast_len(n_taps, real=True)
        tally(forward_transforms=taps.shape[0] * taps.shape[1])
        spectra = scipy.fft.rfft(taps, n_fft)
        spectra *= scipy.fft.rfft(transfer.samples, n_fft)
        tally(inverse_transforms=taps.shape[0] * taps.shape[1])
        found: Floats = scipy.fft.irfft(spectra, n_fft)
        return found[..., :n_taps].copy()

    return Limb(
        name=limb.name,
        hand_length_mm=limb.hand_length_mm,
        synthetic=limb.synthetic,
        map=limb.map,
        read_response=read,
        sample_rate_hz=limb.sample_rate_hz,
        axes=limb.axes,
        pre_trigger_delay_s=limb.pre_trigger_delay_s,
        band_hz=limb.band_hz,
        per_unit_drive=True,
        note=limb.note,
        shape=(limb.n_inputs, limb.n_outputs, limb.n_axes, n_taps),
        lead_samples=first.lead,
    )
