"""A focus from one measured place: the person's own row, and what is quiet from other people."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from skinsource.base.arguments import checking
from skinsource.base.conventions import Axes, Floats
from skinsource.base.errors import InvalidInputError
from skinsource.inverse.focusing import Focus, energy_of, loaded, quiet_of, target_row
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
    at_hz = theirs[0].frequencies_hz
    own = responses_of(partial.limb, axes=axes, inputs=inputs, frequencies_hz=at_hz)
    row = target_row(own, own.check_target(target))
    quiet = quiet_of(theirs[0], [target], None)
    grams = np.stack([gram_of(each.rows(quiet)) for each in theirs])
    drives, beta = loaded(row, grams.mean(axis=0))
    chosen = np.array(quiet) - 1

    def energies(of: int, but: int | None = None) -> Floats:
        """Return the energy of quiet outputs of one of the others, whom the design may not know."""
        known = grams if but is None else np.delete(grams, but, axis=0)
        tried = drives if but is None else loaded(row, known.mean(axis=0))[0]
        return energy_of(theirs[of], tried)[:, chosen]

    everyone = range(len(theirs))
    seen = np.stack([energies(k) for k in everyone])
    unseen = np.full_like(seen, np.nan)
    if len(theirs) > 1:
        unseen = np.stack([energies(k, but=k) for k in everyone])
    one = np.ones(len(row))
    everywhere = np.zeros((len(row), partial.limb.n_inputs), complex)
    everywhere[:, np.array(own.inputs) - 1] = drives
    return Focus(
        limb=own.limb,
        target=target,
        inputs=own.inputs,
        frequencies_hz=own.frequencies_hz,
        drives=everywhere,
        beta=beta,
        row=row,
        gram=grams.mean(axis=0),
        mean_contrast_db=power_db(one, seen.mean(axis=(0, 2))),
        loudest_other_db=power_db(one, unseen.max(axis=2).mean(axis=0)),
        loudest_other=np.zeros(len(row), dtype=np.int64),
        spread_db=np.zeros(len(row)),
        unseen=lambda: power_db(one, unseen.mean(axis=(0, 2))),
    )
