"""Rules from responses to transfer functions, and from traces to waves along a line."""

from dataclasses import dataclass

import numpy as np
import scipy

from skinsource.analysis.noise import LEAST_ABOVE_NOISE_DB
from skinsource.analysis.transfer import Transfer, transfer_function
from skinsource.analysis.travelling import (
    TravellingWave,
    line_distances_mm,
    straightness,
    travelling_wave,
)
from skinsource.analysis_rules.noise_rules import divided_by_pulse, noise_path, place_noise
from skinsource.arrays import Floats
from skinsource.chain import Actuation
from skinsource.job import Stop
from skinsource.limb import Limb
from skinsource.rendering.vibration import Vibration
from skinsource.scaling.calibration import per_probe_acceleration
from skinsource.scaling.response_scaling import Scaling
from skinsource.voices import Voice


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LineWave:
    """A wave along the selected outputs.

    Attributes
    ----------
    outputs
        Those with a place on the map, in the order in which they were selected.
    wave
        Its delays and levels along ``axis``.
    axis
        ``"z"``, or the last axis of a limb that has no z.
    """

    outputs: tuple[int, ...]
    wave: TravellingWave
    axis: str = "z"


def transfer_place(voices: tuple[Voice, ...], selected_input: int | None) -> int:
    """Input place that the transfer function is from: of the input selected last, or the first.

    0 where there is no input.
    """
    chosen = next((one.location for one in voices if one.id == selected_input), None)
    return chosen or next((one.location for one in voices), 0)


def transfer(
    limb_data: Limb,
    driven_limb: Limb,
    transfer_place: int,
    shown_outputs: tuple[int, ...],
    axis_numbers: tuple[int, ...],
    scaling: Scaling,
    actuation: Actuation | None,
) -> Transfer | None:
    """From one input place to the selected outputs; None where there is neither.

    In probe scaling per m/s² of the probe; otherwise per sample of 1 of the drive.
    """
    if not (transfer_place and shown_outputs):
        return None
    rows = [output - 1 for output in shown_outputs]
    rate, n_taps = driven_limb.sample_rate_hz, driven_limb.n_taps
    response = driven_limb.response_to(transfer_place)[rows][:, list(axis_numbers)]
    if divided_by_pulse(driven_limb, scaling):
        response = per_probe_acceleration(response, rate)
    noise = place_noise(limb_data, transfer_place)
    sigma = np.zeros(response.shape[:2]) if noise is None else noise[rows][:, list(axis_numbers)]
    path = noise_path(limb_data, scaling, actuation, transfer_place)
    # Behind an actuator responses are longer than what was measured, and so noisy.
    share = limb_data.n_taps / n_taps
    gain = np.sqrt(share) * np.abs(scipy.fft.rfft(path, n_taps))
    return transfer_function(response, rate, sigma, gain, band_hz=driven_limb.band_hz)


def line_wave(
    vibration: Vibration,
    shown_outputs: tuple[int, ...],
    limb_data: Limb,
    above_noise_db: Floats | None,
    sample_rate_hz: float,
    stop: Stop,
) -> LineWave | None:
    """Wave along the selected outputs, taken as a line; None: fewer than two have a place.

    Along z, the one axis that means the same at every sensor.
    """
    limb_map = limb_data.map
    places = limb_map.output_positions
    outputs = tuple(k for k in shown_outputs if np.isfinite(places[k - 1]).all())
    if len(outputs) < 2:
        return None
    rows = [output - 1 for output in outputs]
    mm_per_px = limb_data.hand_length_mm / limb_map.hand_length_px
    # A limb of one's own may lack z: its last axis then.
    axis = limb_data.axes.index("z") if "z" in limb_data.axes else limb_data.n_axes - 1
    traces = vibration.traces(outputs, (axis,), stop)[:, 0]
    trusted = None if above_noise_db is None else above_noise_db[rows] >= LEAST_ABOVE_NOISE_DB
    distance_mm = line_distances_mm(places[rows], mm_per_px)
    wave = travelling_wave(
        traces, distance_mm, sample_rate_hz, trusted, stop, straight=straightness(places[rows])
    )
    return LineWave(outputs=outputs, wave=wave, axis=limb_data.axes[axis])


RULES = (transfer_place, transfer, line_wave)
