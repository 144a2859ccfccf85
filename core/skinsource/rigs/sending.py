"""Between the samples that are sent to a rig and the volts at its actuators."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from skinsource.arguments import finite_array
from skinsource.arrays import Floats
from skinsource.errors import InvalidInputError
from skinsource.rigs.channel import RigChannel
from skinsource.rigs.rig import Rig

#: What is said where no rig is known.
UNCALIBRATED = "uncalibrated: no rig says how many volts, and how many m/s², a sample of 1 is"


def calibration_words(rig: Rig | None, places: Sequence[int]) -> str:
    """What an export or the player says about these places.

    ``"calibrated"``, where volts and measured responses of all of them are known, with the date of
    the oldest measurement where it is; else what is missing, beginning with ``"uncalibrated"``.
    """
    if rig is None:
        return UNCALIBRATED
    missing = []
    for place in places:
        channel = rig.channel_of(place)
        if channel is None:
            missing.append(f"place {place} is not wired")
        elif channel.full_scale_v is None:
            missing.append(f"place {place} has no volts at full scale")
        elif channel.measured is None:
            missing.append(f"place {place} has no measured response")
    if missing:
        return f"uncalibrated: {', '.join(missing)}"
    dates = [channel.measured_on for one in places if (channel := rig.channel_of(one))]
    known = [one for one in dates if one]
    return f"calibrated, measured on {min(known)}" if known else "calibrated"


def volts_of(channel: RigChannel, samples: ArrayLike) -> Floats:
    """Volts at the actuator for samples from -1 to 1, of the shape of ``samples``.

    Raises
    ------
    InvalidInputError
        The channel does not say its volts at full scale.
    """
    found: Floats = finite_array("samples", samples) * _volts(channel)
    return found


def samples_for(channel: RigChannel, volts: ArrayLike) -> Floats:
    """Samples that give these volts at the actuator, of the shape of ``volts``.

    Raises
    ------
    InvalidInputError
        The channel does not say its volts at full scale, or they do not suffice.
    """
    wanted = finite_array("volts", volts)
    full = _volts(channel)
    peak = float(np.abs(wanted).max(initial=0.0))
    if peak > abs(full):
        raise InvalidInputError(
            f"place {channel.place}: {peak:.4g} V are needed, and output {channel.output} gives at "
            f"most {abs(full):.4g} V; lower the amplitude, or raise the gain of the amplifier"
        )
    return wanted / full


def _volts(channel: RigChannel) -> float:
    full = channel.volts_at_full_scale
    if full is None:
        raise InvalidInputError(
            f"place {channel.place}: the rig does not say the volts at full scale; measure them "
            "with a tone at full scale and a voltmeter"
        )
    return full
