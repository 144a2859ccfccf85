"""Three axes of one acceleration as one signal: which ones belong together, and DFT321."""

import re

import numpy as np
import scipy

from skinsource.arrays import Floats
from skinsource.errors import InvalidInputError
from skinsource.recordings.found import Found, Series

N_AXES = 3
_AXIS = re.compile(r"^(.*?)([xyz])([^a-z]*)$", re.IGNORECASE)


def dft321(axes: Floats) -> Floats:
    """Return one signal with the energy of three at each frequency, (n,).

    Its spectrum has the magnitude sqrt(|X|² + |Y|² + |Z|²) and the phase of X + Y + Z: DFT321 of
    Landin, Romano, McMahan and Kuchenbecker, "Dimensional reduction of high-frequency
    accelerations for haptic rendering", EuroHaptics 2010.  The skin above some tens of hertz feels
    how strong a vibration is, and hardly in which direction.

    Parameters
    ----------
    axes : (3, n)
        The axes, in one unit; the transform is that of all n samples.

    Raises
    ------
    InvalidInputError
        They are not three rows of one or more finite numbers.
    """
    axes = np.asarray(axes, dtype=np.float64)
    if axes.ndim != 2 or axes.shape[0] != N_AXES or not axes.shape[1]:
        raise InvalidInputError(
            f"axes have the shape {axes.shape}, expected (3, n) with one sample or more; give three"
        )
    if not np.isfinite(axes).all():
        raise InvalidInputError("axes hold numbers that are not finite, expected none; leave out")
    spectra = scipy.fft.rfft(axes, axis=1)
    together = spectra.sum(axis=0)
    size = np.abs(together)
    # Where the axes cancel their sum has no phase: 0 is as good as any.
    turn = np.divide(together, size, out=np.ones_like(together), where=size > 0.0)
    magnitude = np.sqrt(np.sum(np.abs(spectra) ** 2, axis=0))
    return scipy.fft.irfft(magnitude * turn, axes.shape[1])


def other_axes(found: Found, series: Series) -> tuple[Series, ...]:
    """Return the two axes that belong to ``series``; empty where the file does not tell.

    They are as long, in the same unit and of the same group, and their names are those of x, y and
    z; without such names, a file that holds just three such signals holds three axes.
    """
    alike = [one for one in found.signals() if _likeness(one) == _likeness(series)]
    name = _AXIS.match(series.name)
    if name is not None:
        around = (name[1], name[3])
        axes = [one for one in alike if (m := _AXIS.match(one.name)) and (m[1], m[3]) == around]
        letters = {_AXIS.match(one.name)[2].lower() for one in axes}  # type: ignore[index]
        if len(axes) == N_AXES and len(letters) == N_AXES:
            return tuple(one for one in axes if one.key != series.key)
    if len(alike) == N_AXES:
        return tuple(one for one in alike if one.key != series.key)
    return ()


def _likeness(one: Series) -> tuple[object, ...]:
    return one.n_samples, one.unit, one.rate_hz, one.key.rpartition("/")[0]
