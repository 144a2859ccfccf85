"""Rules from the noise of responses to that in consecutive windows of a prediction."""

from dataclasses import replace

import numpy as np

from skinsource.analysis import Windows
from skinsource.analysis.noise import LEAST_ABOVE_NOISE_DB
from skinsource.analysis.windowed_noise import windowed_noise_energy
from skinsource.analysis_rules.noise_rules import (
    divided_by_pulse,
    noise_of_places,
    projected_rms,
    shaped_drives,
)
from skinsource.arrays import Floats
from skinsource.chain import Actuation
from skinsource.limb import Limb
from skinsource.rendering.projecting import Projection
from skinsource.scaling.response_scaling import Scaling

_LEAST_RATIO = 10.0 ** (LEAST_ABOVE_NOISE_DB / 20.0)


def noise_rms_of_windows(
    place_drives: tuple[tuple[int, Floats], ...],
    limb_data: Limb,
    scaling: Scaling,
    actuation: Actuation | None,
    match_gain: float,
    projection: Projection,
    windows: Windows,
) -> Floats | None:
    """RMS in each window of what is noise in each projected signal, (n_windows, n_outputs), m/s².

    None where there is none to tell, as for `noise_energy`.
    """
    noise = noise_of_places(place_drives, limb_data)
    if noise is None:
        return None
    n_taps = limb_data.n_taps
    late = n_taps // 2 if divided_by_pulse(limb_data, scaling) else 0
    later = replace(windows, first_sample=windows.first_sample + late)
    drives = shaped_drives(place_drives, limb_data, scaling, actuation)
    energy = windowed_noise_energy(drives, noise, n_taps, later)
    return match_gain * projected_rms(energy, projection, windows.window_samples)


def noisy_outputs_of_windows(
    rms_of_windows: Floats, noise_rms_of_windows: Floats | None
) -> tuple[tuple[int, ...], ...]:
    """Outputs that are mostly noise in each window; none where noise is not known."""
    if noise_rms_of_windows is None:
        return ((),) * len(rms_of_windows)
    noisy = rms_of_windows < _LEAST_RATIO * noise_rms_of_windows
    return tuple(tuple(int(k) + 1 for k in np.flatnonzero(one)) for one in noisy)


def windows_in_noise(
    rms_of_windows: Floats, noise_rms_of_windows: Floats | None, limb_data: Limb
) -> tuple[bool, ...]:
    """Whether all outputs on the map together are mostly noise in each window.

    How far such a window reaches is how the noise is spread.
    """
    if noise_rms_of_windows is None:
        return (False,) * len(rms_of_windows)
    placed = np.isfinite(limb_data.map.output_positions[:, 0])
    found, noise = (
        np.sqrt(np.sum(np.square(one[:, placed]), axis=1))
        for one in (rms_of_windows, noise_rms_of_windows)
    )
    return tuple(bool(one) for one in found < _LEAST_RATIO * noise)


RULES = (noise_rms_of_windows, noisy_outputs_of_windows, windows_in_noise)
