"""The distance that a vibration reaches from the contact."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from skinsource.base.arguments import checking, finite_array
from skinsource.base.conventions import Floats, check_input_location
from skinsource.base.errors import InvalidInputError, quoted
from skinsource.limbs.catalog import limb_of
from skinsource.limbs.limb import Limb

_ENERGY_SHARE = 0.9


@dataclass(frozen=True, slots=True, kw_only=True)
class Extent:
    """How a vibration is spread over the outputs that have a place on the map.

    With w the share of an output in the sum of all squared RMS, and d its distance from the
    contact on the map:

    Attributes
    ----------
    mean_distance_mm
        Sum of w d.
    share_above_12_db, share_above_20_db
        Share of the outputs, from 0 to 1, that are less than 12 or 20 dB below the loudest.
    d90_mm
        The smallest distance within which 90 % of the energy lies.
    participation
        1 / sum of w²: how many equally loud outputs would be spread as much.
    """

    mean_distance_mm: float
    share_above_12_db: float
    share_above_20_db: float
    d90_mm: float
    participation: float


@checking
def extent(rms: ArrayLike, limb: Limb | str, location: int | Sequence[int]) -> Extent:
    """Return how far a vibration reaches from where the skin is touched.

    Parameters
    ----------
    rms : (n_outputs,)
        RMS of each output, m/s² or any other unit.
    limb
        What says where outputs and input places are, or its name.  Outputs without a place on its
        map (61 to 66 of the published limbs) take no part.
    location
        Input place that plays; of several, distances are to the nearest.

    Raises
    ------
    InvalidInputError
        ``rms`` does not fit the limb, is negative or not finite, or is zero throughout: nothing
        has an extent then; or the limb has no such place.

    Examples
    --------
    >>> import skinsource as ss
    >>> import numpy as np
    >>> reach = ss.extent(np.linspace(0.0, 1.0, 72), "synthetic-1", 7)
    >>> print(f"{reach.d90_mm:.0f} mm")
    405 mm
    """
    limb = limb_of(limb)
    values = finite_array("rms", rms)
    if values.shape != (limb.n_outputs,):
        raise InvalidInputError(
            f"rms has shape {values.shape}, expected one value for each of the {limb.n_outputs} "
            f"outputs of {limb.name}"
        )
    if (values < 0.0).any():
        raise InvalidInputError(f"rms holds {values.min():g}, expected values of 0 or more")
    distance_mm = distances_mm(limb, location)
    if not values[np.isfinite(distance_mm)].any():
        raise InvalidInputError(
            "rms is zero at all outputs with a place on the map, so it has no extent. Choose a "
            "window in which the skin moves."
        )
    return Extent(**{name: float(value) for name, value in spread(values, distance_mm).items()})


def spread(rms: Floats, distance_mm: Floats) -> dict[str, Floats]:
    """Compute how far vibrations reach, from the distance of each output to the contact.

    Parameters
    ----------
    rms : (..., n_outputs)
        Of each vibration; at least one output with a distance moves.
    distance_mm : (n_outputs,)
        Outputs whose distance is NaN take no part.

    Returns
    -------
    What `Extent` holds, by name, (...) each.
    """
    shown = np.isfinite(distance_mm)
    values, distance_mm = rms[..., shown], distance_mm[shown]
    relative = values / values.max(axis=-1, keepdims=True)
    energy = np.square(relative)
    share = energy / energy.sum(axis=-1, keepdims=True)
    return {
        "mean_distance_mm": np.vecdot(share, distance_mm),
        "share_above_12_db": _share_above(relative, 12.0),
        "share_above_20_db": _share_above(relative, 20.0),
        "d90_mm": _distance_of_share(share, distance_mm),
        "participation": 1.0 / np.square(share).sum(axis=-1),
    }


def distances_mm(limb: Limb, location: int | Sequence[int]) -> Floats:
    """Return each output's distance from the nearest place, (n_outputs,), mm; NaN: not mapped."""
    places = [location] if isinstance(location, int) else list(location)
    if not places:
        raise InvalidInputError(f"location is {quoted(location)}, expected an input place")
    for place in places:
        check_input_location(place, limb.n_inputs)
    contacts = limb.map.input_positions[np.array(places) - 1]
    offset = limb.map.output_positions[:, None] - contacts[None]
    distance_px = np.hypot(offset[..., 0], offset[..., 1]).min(axis=1)
    return distance_px * (limb.hand_length_mm / limb.map.hand_length_px)


def _share_above(relative: Floats, below_db: float) -> Floats:
    return np.mean(relative > 10.0 ** (-below_db / 20.0), axis=-1)


def _distance_of_share(share: Floats, distance_mm: Floats) -> Floats:
    order = np.argsort(distance_mm, kind="stable")
    reached = np.cumsum(share[..., order], axis=-1)
    # The last sum may be a little less than 1, but never less than nine tenths.
    return distance_mm[order][np.argmax(reached >= _ENERGY_SHARE, axis=-1)]
