"""Where on the hand a row was measured: it is compared with the rows of other people."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from skinsource.base.arguments import checking
from skinsource.base.conventions import Floats
from skinsource.limbs.limb import Limb
from skinsource.people.others import band_levels_db, check_same_places, hand_outputs, people_of
from skinsource.people.partial_limb import PartialLimb

#: By how much another place must be more alike: chosen for 5 % false alarms on four people, with
#: three axes and with one.
MARGIN, MARGIN_OF_ONE_AXIS = 0.21, 0.4


@checking
def likeliest_place(
    partial: PartialLimb, output: int, others: Sequence[Limb | str] | None = None
) -> int:
    """Return the output that a sensor was probably on.

    It is the claimed one unless another is clearly more alike; ``docs/people.md`` says how often
    that is right.

    Parameters
    ----------
    partial
        What was measured of the person.
    output
        Where the sensor is said to have been, from 1.
    others
        As of `focus`; two or more.

    Raises
    ------
    InvalidInputError
        The output was not measured, or others are too few or have other places.
    DatasetMissingError
        The measured dataset is needed, and not installed.

    Examples
    --------
    >>> import skinsource as ss
    >>> own, others = ss.people.partial("synthetic-1", [9]), ["synthetic-2", "synthetic-3"]
    >>> ss.people.likeliest_place(own, 9, others)
    9
    """
    partial.check_measured(output)
    people = people_of(others, 2, but=partial.person)
    check_same_places(partial.limb, people[0])
    every_db = [
        band_levels_db(limb, partial.inputs, axes=partial.axes) for limb in (partial.limb, *people)
    ]
    row_db, theirs_db = every_db[0][:, output - 1], np.stack(every_db[1:])
    candidates = np.array(sorted({*hand_outputs(people[0]), output}))
    unlike = unlikeness(row_db[:, None], theirs_db[:, :, candidates - 1])[0]
    margin = MARGIN_OF_ONE_AXIS if len(partial.axes) == 1 else MARGIN
    return int(candidates[probably_on(unlike, int(np.searchsorted(candidates, output)), margin)])


def probably_on(unlike: Floats, claimed: int, margin: float = MARGIN) -> int:
    """Return the output that a row is of, from 0: the claimed one unless another is clearly it."""
    best = int(unlike.argmin())
    return best if unlike[claimed] - unlike[best] > margin else claimed


def unlikeness(rows_db: Floats, theirs_db: Floats) -> Floats:
    """Return how unlike rows are to those of others, (n_rows, n_outputs): 1 is usual of people.

    It is the mean of squared differences in units of the variance between the others.

    Parameters
    ----------
    rows_db : (n_octaves, n_rows, n_inputs)
        Levels of rows.
    theirs_db : (n_people, n_octaves, n_outputs, n_inputs)
        Levels of the others.
    """
    variance = theirs_db.var(axis=0, ddof=1).mean(axis=(1, 2), keepdims=True)[..., None]
    difference = rows_db[:, :, None] - theirs_db.mean(axis=0)[:, None]
    return (np.square(difference) / variance).mean(axis=(0, 3))
