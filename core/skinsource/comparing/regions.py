"""Levels by region, and how people differ."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from skinsource.arguments import finite_array
from skinsource.arrays import Floats
from skinsource.decibels import decibels
from skinsource.errors import InvalidInputError
from skinsource.limb import N_OUTPUTS
from skinsource.locations import DIGITS, OUTPUTS

#: Names of regions and the outputs in them.  No sensor lies on the palm itself.
REGION_OUTPUTS: dict[str, tuple[int, ...]] = {
    **{
        f"Digit {digit}": tuple(one.number for one in OUTPUTS if one.region == f"digit {digit}")
        for digit in DIGITS
    },
    "Digits": tuple(one.number for one in OUTPUTS if one.region.startswith("digit")),
    "Back of the hand": tuple(one.number for one in OUTPUTS if one.region == "hand"),
    "Wrist": tuple(one.number for one in OUTPUTS if (one.region, one.side) == ("wrist", "dorsal")),
    "Wrist, palm side": tuple(
        one.number for one in OUTPUTS if (one.region, one.side) == ("wrist", "volar")
    ),
    "Forearm": tuple(one.number for one in OUTPUTS if one.region == "forearm"),
    "Elbow": tuple(one.number for one in OUTPUTS if one.region == "elbow"),
}


def region_levels_db(rms: ArrayLike) -> dict[str, float]:
    """Return the level of each region: the root of the mean square over its outputs, dB re 1 m/s².

    Parameters
    ----------
    rms : (72,)
        RMS of each output, m/s².

    Raises
    ------
    InvalidInputError
        There are not the 72 outputs of the published limbs: where others lie is not known.
    """
    values = finite_array("rms", rms)
    if values.shape != (N_OUTPUTS,):
        raise InvalidInputError(
            f"rms has shape {values.shape}, expected ({N_OUTPUTS},): regions are known of the "
            "published limbs only"
        )
    power = np.square(values)
    return {
        name: float(decibels(np.sqrt(power[np.array(outputs) - 1].mean())))
        for name, outputs in REGION_OUTPUTS.items()
    }


def mean_and_spread(levels_db: Sequence[float]) -> tuple[float, float]:
    """Return the mean of levels in dB and their standard deviation, that of a sample.

    The deviation of fewer than two is NaN.
    """
    values: Floats = finite_array("levels_db", levels_db)
    if values.ndim != 1 or not values.size:
        raise InvalidInputError(f"levels_db has shape {values.shape}, expected (n_people,)")
    return float(values.mean()), float(values.std(ddof=1)) if values.size > 1 else float("nan")
