"""From levels at some places of a person to those at the others, and which places to measure.

A Gaussian process carries the difference to the mean of other people.  Its kernels come from the
others alone: places, and inputs, are the nearer the more their mean levels are alike.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from skinsource.base.arguments import checking, integer
from skinsource.base.conventions import Floats
from skinsource.limbs.limb import Limb
from skinsource.people.others import band_levels_db, hand_outputs, people_of

#: Variances, dB²: of all levels together, by input, by place, by both, and of what is not carried.
_ALL, _BY_INPUT, _BY_PLACE, _BY_BOTH, _NOISE = 2.0, 4.0, 4.0, 8.0, 4.0
#: Length of the kernels, in medians of the squared distances.
_LENGTH = 0.6


def carried(
    theirs_db: Floats, own_db: Floats, rows: Sequence[int], columns: Sequence[int]
) -> tuple[Floats, Floats]:
    """Return the likeliest levels of a person at all places, dB, and what is not known of them.

    That is which part of the deviation from the mean of people remains, 0 to 1.  Both are
    (n_outputs, n_inputs).

    Parameters
    ----------
    theirs_db : (n_people, n_outputs, n_inputs)
        Levels of the others.
    own_db : (n_rows, n_columns)
        Levels of the person.
    rows, columns
        Which outputs and inputs these are, from 0.
    """
    mean_db = theirs_db.mean(axis=0)
    by_place, by_input = _kernel(mean_db), _kernel(mean_db.T)
    known = np.ix_(rows, columns)
    n_known = own_db.size

    def covariance(places: Floats, inputs: Floats) -> Floats:
        place, source = places[:, None, :, None], inputs[None, :, None, :]
        together = _ALL + _BY_INPUT * source + _BY_PLACE * place + _BY_BOTH * place * source
        return together.reshape(-1, n_known)

    within = covariance(by_place[np.ix_(rows, rows)], by_input[np.ix_(columns, columns)])
    onward = covariance(by_place[:, rows], by_input[:, columns])
    solved = np.linalg.solve(within + _NOISE * np.eye(n_known), onward.T)
    difference = (own_db - mean_db[known]).ravel() @ solved
    prior = _ALL + _BY_INPUT + _BY_PLACE + _BY_BOTH + _NOISE
    known_share = np.einsum("ij,ji->i", onward, solved) / prior
    remaining = np.sqrt(1.0 - known_share)
    return mean_db + difference.reshape(mean_db.shape), remaining.reshape(mean_db.shape)


def _kernel(levels_db: Floats) -> Floats:
    """Return how alike rows of levels are, (n, n), from 0 to 1."""
    distances = _distances(levels_db)
    median = np.median(distances[~np.eye(len(distances), dtype=bool)])
    return np.exp(-distances / (_LENGTH * median))


def _distances(rows: Floats) -> Floats:
    return np.square(rows[:, None] - rows).sum(axis=-1)


@checking
def suggested_places(limbs: Sequence[Limb | str] | None, count: int) -> tuple[int, ...]:
    """Return the outputs to measure of a person, the most useful first.

    The first is the loudest, each other one the most unlike those before it.

    Parameters
    ----------
    limbs
        Limbs of other people, or their names; None: all measured ones.
    count
        How many.

    Raises
    ------
    InvalidInputError
        There are not as many outputs, or limbs differ in their places.
    DatasetMissingError
        The measured dataset is needed, and not installed.

    Examples
    --------
    >>> import skinsource as ss
    >>> ss.people.suggested_places(["synthetic-1", "synthetic-2"], 3)
    (14, 41, 28)
    """
    people = people_of(limbs, 1)
    outputs = hand_outputs(people[0])
    count = integer("count", count, 1, len(outputs))
    inputs = range(1, people[0].n_inputs + 1)
    levels_db = np.mean([band_levels_db(limb, inputs) for limb in people], axis=0)
    return tuple(outputs[row] for row in far_apart(levels_db[:, np.array(outputs) - 1], count))


def far_apart(levels_db: Floats, count: int) -> list[int]:
    """Return outputs, from 0, the loudest first, of levels (n_octaves, n_outputs, n_inputs)."""
    distances = _distances(np.concatenate([*levels_db], axis=1))
    chosen = [int((10.0 ** (levels_db / 10.0)).mean(axis=(0, 2)).argmax())]
    while len(chosen) < count:
        chosen.append(int(distances[:, chosen].min(axis=1).argmax()))
    return chosen
