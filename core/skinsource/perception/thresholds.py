"""Thresholds of detection of the psychophysical channels, in closed form.

Displacements in dB re 1 µm peak, at the thenar eminence, with a contactor of 2.9 cm²; the shape
follows Bolanowski, Gescheider, Verrillo and Checkosky, "Four channels mediate the mechanical
aspects of touch", J. Acoust. Soc. Am. 84, 1988, doi:10.1121/1.397184; the anchors are rounded.
"""

from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from skinsource.arguments import one_of, positive_number, real_array
from skinsource.arrays import Floats
from skinsource.errors import InvalidInputError

#: ``"P"``: Pacinian, high frequencies, adds up over the area.  ``"NP I"``: below it.
Channel = Literal["P", "NP I"]
CHANNELS: tuple[Channel, ...] = get_args(Channel)

#: Contactor that the thresholds are for.
REFERENCE_AREA_CM2 = 2.9
_MICROMETRE_M = 1e-6


def threshold_rms(
    frequency_hz: ArrayLike, channel: Channel | None = None, *, area_cm2: float = REFERENCE_AREA_CM2
) -> Floats:
    """Return the acceleration that is just detected, as RMS.

    Parameters
    ----------
    frequency_hz : (...,)
        Positive.
    channel
        Of which channel; None: of the more sensitive one.
    area_cm2
        Contactor.  Smaller ones raise the threshold of P by 3 dB for each halving; waves that
        spread far from the contact move a large area, and count as the reference.

    Returns
    -------
    (...,), in m/s².

    Raises
    ------
    InvalidInputError
        A frequency or the area is not positive, or there is no such channel.
    """
    frequency = real_array("frequency_hz", frequency_hz)
    if frequency.size and not (frequency.min() > 0.0 and np.isfinite(frequency.max())):
        raise InvalidInputError("frequency_hz holds values that are not positive, expected hertz")
    area = positive_number("area_cm2", area_cm2)
    chosen = CHANNELS if channel is None else (one_of("channel", channel, CHANNELS),)
    displacement_db = np.min([_SHAPES[one](frequency, area) for one in chosen], axis=0)
    peak_m = _MICROMETRE_M * 10.0 ** (displacement_db / 20.0)
    acceleration: Floats = (2.0 * np.pi * frequency) ** 2 * peak_m / np.sqrt(2.0)
    return acceleration


def _pacinian_db(frequency: Floats, area_cm2: float) -> Floats:
    below = 12.0 * np.log2(250.0 / np.minimum(frequency, 250.0))
    above = 10.0 * np.log2(np.maximum(frequency, 300.0) / 300.0)
    smaller = 10.0 * np.log10(REFERENCE_AREA_CM2 / area_cm2)
    found: Floats = -20.0 + below + above + smaller
    return found


def _non_pacinian_1_db(frequency: Floats, _: float) -> Floats:
    # No more sensitive than the channel that takes over below 3 Hz.
    below = 5.0 * np.log2(30.0 / np.clip(frequency, 3.0, 30.0))
    above = 6.0 * np.log2(np.maximum(frequency, 60.0) / 60.0)
    found: Floats = 10.0 + below + above
    return found


_SHAPES = {"P": _pacinian_db, "NP I": _non_pacinian_1_db}
