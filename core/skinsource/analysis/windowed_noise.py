"""How much of the noise of responses lies in consecutive windows of a prediction."""

from collections.abc import Mapping

import numpy as np

from skinsource.analysis.noise import refuse_unknown
from skinsource.analysis.windows import Windows
from skinsource.arrays import Floats, Indices


def windowed_noise_energy(
    drives: Mapping[int, Floats], noise: Mapping[int, Floats], n_taps: int, windows: Windows
) -> Floats:
    """Return how much energy within windows of a prediction is noise of its responses.

    Of `skinsource.analysis.noise.predicted_noise_energy` the part that falls into each window: at
    an instant the noise has the variance sigma² times the energy that was played during the n taps
    up to it.  Parameters and errors are the same.

    Returns
    -------
    (n_windows, n_outputs, n_axes), sum of squares, m²/s⁴.
    """
    refuse_unknown(drives, noise)
    edges = windows.first_sample + windows.window_samples * np.arange(windows.count + 1)
    energy = np.zeros((windows.count, *next(iter(noise.values())).shape))
    for place, played in drives.items():
        until = _played_until(played, edges) - _played_until(played, edges - n_taps)
        # Where nothing is played rounding may leave a little less than nothing.
        energy += np.maximum(np.diff(until), 0.0)[:, None, None] * np.square(noise[place])
    return energy


def _played_until(played: Floats, instants: Indices) -> Floats:
    """Sum over all samples before each instant, of the energy played up to and with them."""
    energy = np.cumsum(np.square(played))
    summed = np.concatenate([[0.0], np.cumsum(energy)])
    after = np.maximum(instants - played.size, 0) * energy[-1]
    found: Floats = summed[np.clip(instants, 0, played.size)] + after
    return found
