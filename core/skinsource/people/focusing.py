"""A focus from one measured place: the person's own row, and what is quiet from other people."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from skinsource.base.arguments import checking
from skinsource.base.conventions import Axes
from skinsource.base.errors import InvalidInputError
from skinsource.inverse.designing import Focus
from skinsource.inverse.focusing import Wish, energy_of, loaded, quiet_of
from skinsource.inverse.responses import gram_of, power_db, responses_of
from skinsource.limbs.limb import Limb
from skinsource.people.others import check_same_places, people_of
from skinsource.people.partial_limb import PartialLimb


@checking
def focus(
    partial: PartialLimb,
    target: int,
    *,
    axes: Axes = "z",
    inputs: Sequence[int] | None = None,
    others: Sequence[Limb | str] | None = None,
    frequencies_hz: ArrayLike | None = None,
) -> Focus:
    """Return the drives that make a measured output of a person strong and others quiet.

    Contrasts are those to expect on the other people.  ``mean_contrast_db`` is of people whom the
    design knows; ``unseen_contrast_db`` and ``loudest_other_db`` of each whom it does not know, in
    turn, NaN where there is one alone.  Which output is loudest is not known: it is 0.

    Parameters
    ----------
    partial
        What was measured of the person.
    target
        Output, from 1.
    axes, inputs, frequencies_hz
        As of `skinsource.inverse.focus`; by default those inputs that were measured.
    others
        Limbs of other people, or their names; None: all measured ones, without the one that
        ``partial`` was cut out of.

    Raises
    ------
    InvalidInputError
        The target or an input was not measured, it is mostly noise, or others have other places.
    DatasetMissingError
        The measured dataset is needed, and not installed.

    Examples
    --------
    >>> import skinsource as ss
    >>> own = ss.people.partial("synthetic-1", [9])
    >>> others = ["synthetic-2", "synthetic-3"]
    >>> found = ss.people.focus(own, 9, others=others, frequencies_hz=[100.0, 200.0])
    >>> bool((found.unseen_contrast_db > 3.0).all())
    True
    """
    partial.check_measured(target)
    people = people_of(others, 1, but=partial.person)
    check_same_places(partial.limb, people[0])
    if inputs is None:
        usual = responses_of(partial.limb, axes=axes, frequencies_hz=frequencies_hz).inputs
        inputs = [place for place in usual if place in partial.inputs]
    elif not {*inputs} <= {*partial.inputs}:
        raise InvalidInputError(
            f"inputs are {list(inputs)}, but {partial.person} was measured from "
            f"{list(partial.inputs)}. Choose among them."
        )
    theirs = [
        responses_of(limb, axes=axes, inputs=inputs, frequencies_hz=frequencies_hz)
        for limb in people
    ]
    quiet = quiet_of(theirs[0], [target], None)
    wish = Wish.of(partial.limb, [target], quiet, axes, inputs, theirs[0].frequencies_hz)
    grams = np.stack([gram_of(each.rows(quiet)) for each in theirs])
    drives, beta = loaded(wish.row, grams.mean(axis=0))
    seen = np.stack([energy_of(each, drives) for each in theirs])
    unseen = np.full_like(seen, np.nan)
    for k in range(len(theirs) if len(theirs) > 1 else 0):
        # The design does not know the one whose energy it is.
        tried, _ = loaded(wish.row, np.delete(grams, k, axis=0).mean(axis=0))
        unseen[k] = energy_of(theirs[k], tried)
    seen, unseen = (energy[..., np.array(quiet) - 1] for energy in (seen, unseen))
    return replace(
        wish.solved(drives, beta, lambda: wish.gram),
        gram=grams.mean(axis=0),
        mean_contrast_db=-power_db(seen.mean(axis=(0, 2))),
        loudest_other_db=-power_db(unseen.max(axis=2).mean(axis=0)),
        loudest_other=np.zeros(len(drives), dtype=np.int64),
        unseen=lambda: -power_db(unseen.mean(axis=(0, 2))),
    )
