"""The people who were measured, and how strongly their skin answers in octaves."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
import scipy

from skinsource.base.conventions import ALL_AXES, LIMB_NAMES, Axes, Band, Floats, axis_numbers
from skinsource.base.errors import InvalidInputError
from skinsource.inverse.responses import HAND_OUTPUTS, bins_of, n_fft_of, power_db, responses_of
from skinsource.limbs.catalog import limb_of
from skinsource.limbs.limb import PUBLISHED, Limb

#: Bands in which rows of responses are compared.
OCTAVES_HZ: tuple[Band, ...] = ((30.0, 60.0), (60.0, 120.0), (120.0, 240.0), (240.0, 400.0))


def people_of(limbs: Iterable[Limb | str] | None, fewest: int, but: str = "") -> list[Limb]:
    """Return the limbs of several people, who have the same places.

    Parameters
    ----------
    limbs
        Limbs, or their names; None: all measured ones.
    fewest
        How many there must be.
    but
        Name of the person who is left out where ``limbs`` is None.

    Raises
    ------
    InvalidInputError
        They are too few, one comes twice, or they do not have the same places and axes.
    DatasetMissingError
        The measured dataset is needed, and not installed.
    """
    if limbs is None:
        limbs = [name for name in LIMB_NAMES if name.startswith("measured") and name != but]
    people = [limb_of(limb) for limb in limbs]
    if len(people) < fewest or len({limb.name for limb in people}) < len(people):
        raise InvalidInputError(
            f"limbs are {[limb.name for limb in people]}, expected {fewest} people or more, each "
            "once. Name others."
        )
    for limb in people:
        check_same_places(people[0], limb)
    return people


def check_same_places(limb: Limb, other: Limb) -> None:
    """Raise `InvalidInputError` where two limbs do not have the same places, axes and drives."""
    if _layout(limb) != _layout(other):
        raise InvalidInputError(
            f"{limb.name} and {other.name} differ in their places, axes, sample rates or drives. "
            "Choose limbs that were measured alike."
        )


def _layout(limb: Limb) -> tuple[object, ...]:
    places = limb.n_inputs, limb.n_outputs, limb.axes
    return *places, limb.sample_rate_hz, limb.band_hz, limb.per_unit_drive


def hand_outputs(limb: Limb) -> tuple[int, ...]:
    """Return the outputs on the hand, from 1; of an own limb those above their noise."""
    return HAND_OUTPUTS if limb.name in PUBLISHED else responses_of(limb, axes=limb.axes).others


def band_levels_db(
    limb: Limb,
    inputs: Sequence[int],
    bands_hz: Sequence[Band] = OCTAVES_HZ,
    axes: Axes = ALL_AXES,
) -> Floats:
    """Return the mean level of responses in each band, (n_bands, n_outputs, n_inputs), in dB.

    Energies are summed over the chosen axes.  Outputs that were not measured have -infinity; bands
    above half the sample rate are left out.
    """
    n_fft, numbers = n_fft_of(limb.n_taps), axis_numbers(axes, limb.axes)
    at_hz = bins_of(n_fft, limb.sample_rate_hz)
    within = [(at_hz >= low) & (at_hz < high) for low, high in bands_hz if high <= at_hz[-1]]
    energies = [
        np.square(np.abs(scipy.fft.rfft(limb.response_to(place)[:, numbers], n_fft))).sum(axis=1)
        for place in inputs
    ]
    means = [[energy[:, bins].mean(axis=1) for energy in energies] for bins in within]
    return power_db(np.swapaxes(means, 1, 2))
