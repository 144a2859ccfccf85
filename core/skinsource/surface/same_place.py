"""Sites so near to each other that they are one, and the refusal of two values for one place."""

import numpy as np
import scipy

from skinsource.arrays import Floats, Indices
from skinsource.errors import InvalidInputError

#: Sites no farther apart than this part of the size of all are one site.
NEAR_DUPLICATE = 1e-9

Pairs = tuple[tuple[int, int], ...]


def first_at_same_place(sites: Floats, size: float) -> Indices:
    """Index of the first site at the place of each, (n_sites,): its own where it lies alone.

    Parameters
    ----------
    sites : (n_sites, 2)
        Finite coordinates.
    size
        Extent of what they are part of; `NEAR_DUPLICATE` of it counts as no distance.
    """
    every = np.arange(len(sites))
    near = scipy.spatial.KDTree(sites).query_pairs(NEAR_DUPLICATE * size, output_type="ndarray")
    if not len(near):
        return every
    joined = scipy.sparse.coo_array((np.ones(len(near)), tuple(near.T)), shape=2 * every.shape)
    _, group = scipy.sparse.csgraph.connected_components(joined, directed=False)
    _, first = np.unique(group, return_index=True)
    return np.asarray(first[group], dtype=np.intp)


def pairs_at_same_place(sites: Floats, size: float) -> Pairs:
    """Each site that shares its place, with the first one there; sites without a place are NaN."""
    placed = np.flatnonzero(np.isfinite(sites).all(axis=1))
    first = placed[first_at_same_place(sites[placed], size)]
    second = first != placed
    return tuple(zip(first[second].tolist(), placed[second].tolist(), strict=True))


def refuse_two_values_for_one_place(values: Floats, pairs: Pairs) -> None:
    """Raise where two outputs at one place were given different values.

    Parameters
    ----------
    values : (n_outputs, ...)
        Given values.
    pairs
        From `pairs_at_same_place`.

    Raises
    ------
    InvalidInputError
        Names both outputs and their values.
    """
    for one, other in pairs:
        differ = np.argwhere(np.atleast_1d(values[one] != values[other]))
        if len(differ):
            at = tuple(differ[0])
            found = (np.atleast_1d(values[k])[at] for k in (one, other))
            raise InvalidInputError(
                f"outputs {one + 1} and {other + 1} lie at the same place of the map, but were "
                "given {:g} and {:g}; expected one value for one place. Move one of the two, or "
                "give both the same value.".format(*found)
            )
