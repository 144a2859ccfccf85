"""Energy of the loudest window: projected signals of all outputs, some at a time."""

import numpy as np

from skinsource.arrays import Floats
from skinsource.job import Stop, stop_if
from skinsource.loudest_window import LoudestEnergy, loudest_energy
from skinsource.rendering.projecting import Projection
from skinsource.rendering.streaming import StreamedVibration
from skinsource.rendering.total_spectrum import TotalSpectrum
from skinsource.rendering.transforms import inverse

# Outputs that are held in time together: 12 MB at the longest.
_OUTPUTS_AT_ONCE = 18


def loudest_energies(
    total: TotalSpectrum, projection: Projection, n_window: int, stop: Stop
) -> Floats:
    """Largest energy of any window of the projected signal of each output, (n_outputs,)."""
    found = []
    for first in range(0, total.shape[0], _OUTPUTS_AT_ONCE):
        stop_if(stop)
        outputs = np.arange(first, min(first + _OUTPUTS_AT_ONCE, total.shape[0]))
        here = projection.at(outputs)
        spectra = total.rows(outputs, projection.axis_numbers)
        # A projection is linear, so that it comes before the way back to time; a length is not.
        if here.directions is None:
            signals = here.signals(inverse(spectra, total.n_fft))
        else:
            signals = inverse(here.spectra(spectra), total.n_fft)
        found.append(loudest_energy(signals, n_window))
    return np.concatenate(found)


def loudest_energies_streamed(
    streamed: StreamedVibration,
    projection: Projection,
    n_outputs: int,
    n_window: int,
    stop: Stop,
) -> Floats:
    """The same of voices that play long, block by block."""
    loudest = LoudestEnergy((n_outputs,), n_window)
    every = range(1, n_outputs + 1)
    for first, block in streamed.blocks_of(every, projection.axis_numbers, stop):
        loudest.add(first, projection.signals(block))
    return loudest.energy
