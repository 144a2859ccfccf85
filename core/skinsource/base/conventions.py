"""What all rooms agree on: kinds of arrays, axes, input locations, and the published measurement.

The synthetic limbs have the same sizes as the published ones.  Computations take the sizes from
the limb that they are given, never from here.
"""

from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from skinsource.base.errors import InvalidInputError, quoted

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
#: Positions in an array.
Indices = NDArray[np.intp]
Complexes = NDArray[np.complex128]
Booleans = NDArray[np.bool_]

#: Lowest and highest frequency, Hz.  ``Band | None``: that of a limb, None where it is not known.
Band = tuple[float, float]

N_INPUTS, N_OUTPUTS, N_AXES, N_TAPS = 20, 72, 3, 522
SAMPLE_RATE_HZ = 1300.0
#: The band in which the responses were measured.
BAND_HZ: Band = (25.0, 600.0)
#: Time between the trigger and the pulse in the measured responses.
PRE_TRIGGER_DELAY_S = 0.052
#: Outputs on the palmar side: they are not on the dorsal map.
VOLAR_OUTPUTS = (61, 62, 63, 64, 65, 66)

#: The largest number that an input location or an output of any limb can have.
MOST_LOCATIONS = 10_000

#: Hand lengths of limbs 1 to 4, measured and synthetic.
HAND_LENGTHS_MM = (175.0, 165.0, 185.0, 165.0)
#: All limbs, installed or not, except those that a lab has imported.
LIMB_NAMES = tuple(f"{kind}-{k}" for kind in ("measured", "synthetic") for k in range(1, 5))

#: Largest velocity at which skin was found linear: third harmonics appear at twice this velocity.
LARGEST_VELOCITY_M_PER_S = 0.04

#: Axes along which outputs measure.
Axes = Literal["x", "y", "z", "xy", "xz", "yz", "xyz"]
AXES: tuple[Axes, ...] = get_args(Axes)
#: All axes that a limb has.
ALL_AXES: Axes = "xyz"


def axes_of(measured: Axes, axes: Axes) -> Axes:
    """Return the chosen axes of a limb; ``"xyz"`` chooses all that it has.

    Raises
    ------
    InvalidInputError
        The limb does not measure along one of them.

    Examples
    --------
    >>> axes_of("xz", "z"), axes_of("xz", "xyz")
    ('z', 'xz')
    """
    if axes in (ALL_AXES, measured):
        return measured
    missing = [axis for axis in axes if axis not in measured]
    if missing:
        raise InvalidInputError(
            f"axes is {quoted(axes)}, but this limb measures along {axes_text(measured)} only. "
            f"Choose {quoted(measured)}, or another limb."
        )
    return axes


def axis_numbers(axes: Axes, measured: Axes = ALL_AXES) -> tuple[int, ...]:
    """Return the positions of the chosen axes among those that a limb measures along."""
    return tuple(measured.index(axis) for axis in axes_of(measured, axes))


def axes_text(axes: str) -> str:
    """Return axes as they stand in a sentence: "x and z"."""
    return f"{', '.join(axes[:-1])} and {axes[-1]}" if len(axes) > 1 else axes


def check_input_location(location: int, n_inputs: int = N_INPUTS) -> None:
    """Raise `InvalidInputError` unless ``location`` is an integer from 1 to ``n_inputs``."""
    is_integer = isinstance(location, int | np.integer)
    is_other = isinstance(location, bool | np.timedelta64)
    if not is_integer or is_other or not 1 <= location <= n_inputs:
        raise InvalidInputError(
            f"input location {quoted(location)} does not exist: locations are the whole numbers 1 "
            f"to {n_inputs}. See skinsource.locations for the list."
        )
