"""Whether what is sent to a rig stays within its limits."""

from collections.abc import Sequence
from dataclasses import dataclass
from dataclasses import fields as dataclass_fields

import numpy as np
from numpy.typing import ArrayLike

from skinsource.actuators import (
    Breach,
    Limits,
    MeasuredResponse,
    breaches,
    names,
    predicted,
    profile,
    shape_names,
)
from skinsource.arguments import finite_array
from skinsource.errors import InvalidInputError
from skinsource.quoting import quoted
from skinsource.rigs.channel import RigChannel
from skinsource.rigs.rig import Rig
from skinsource.rigs.sending import volts_of

# Where nothing is known of the motion, volts can be looked at all the same.
_UNMOVED = MeasuredResponse(((1.0, 1.0, 0.0), (1000.0, 1.0, 0.0)))


@dataclass(frozen=True, slots=True)
class RigBreach:
    """A limit of a rig that would be passed.

    Attributes
    ----------
    place
        Input place of the channel.
    breach
        Which limit, and by how much.
    """

    place: int
    breach: Breach

    def __str__(self) -> str:
        return f"place {self.place}: {self.breach}"


def strictest(*several: Limits) -> Limits:
    """For each limit the least of those that are known."""
    found = {}
    for one in dataclass_fields(Limits):
        known = [value for limits in several if (value := getattr(limits, one.name)) is not None]
        found[one.name] = min(known, default=None)
    return Limits(**found)


def limits_of(channel: RigChannel) -> Limits:
    """Limits of the channel, and of the actuator that it names where the library knows it."""
    if channel.actuator in (*names(), *shape_names()):
        return strictest(channel.limits, profile(channel.actuator).limits)
    return channel.limits


def rig_breaches(
    rig: Rig, places: Sequence[int], samples: ArrayLike, sample_rate_hz: int
) -> tuple[RigBreach, ...]:
    """Limits that samples would pass when they are sent to a rig.

    Parameters
    ----------
    places
        Input place of each channel of the samples.
    samples : (n_channels, n_times)
        As they are sent, -1 to 1.
    sample_rate_hz
        A whole number of hertz.

    Returns
    -------
    In order of the places; none: nothing is passed, so far as the rig knows its limits.  Of a
    channel without volts at full scale only the duration and the duty can be told, and of one
    without a model no displacement.

    Raises
    ------
    InvalidInputError
        A place is not wired, or samples and places do not fit together.
    """
    rows = finite_array("samples", samples, "finite numbers, (n_channels, n_times)")
    if rows.ndim != 2 or len(rows) != len(places):
        raise InvalidInputError(
            f"samples have the shape {rows.shape}, expected ({len(places)} places, n_times)"
        )
    found = []
    for place, row in zip(places, rows, strict=True):
        channel = rig.channel_of(place)
        if channel is None:
            raise InvalidInputError(
                f"place {place} is not wired in the rig {quoted(rig.title)}; add a channel for it"
            )
        found += [RigBreach(place, one) for one in _of_channel(channel, row, sample_rate_hz)]
    return tuple(found)


def _of_channel(channel: RigChannel, row: np.ndarray, sample_rate_hz: int) -> tuple[Breach, ...]:
    limits = limits_of(channel)
    if not row.size or limits == Limits():
        return ()
    known_volts, model = channel.full_scale_v is not None, channel.moves_as
    volts = volts_of(channel, row) if known_volts else row
    # A measured response knows no current, the model does.
    flowing = channel.model if channel.model is not None else model
    (told,) = predicted(volts, sample_rate_hz, flowing or _UNMOVED, thermal=channel.thermal)
    passed = {one.name: one for one in breaches(told, limits)}
    if model is not flowing and model is not None:
        (moved,) = predicted(volts, sample_rate_hz, model)
        passed.pop("displacement_m", None)
        passed |= {one.name: one for one in breaches(moved, limits) if one.name == "displacement_m"}
    unknown = (
        set()
        if known_volts
        else {one.name for one in dataclass_fields(Limits)} - {"duration_s", "duty"}
    )
    unknown |= set() if model is not None else {"displacement_m"}
    return tuple(one for name, one in passed.items() if name not in unknown)
