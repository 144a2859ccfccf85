"""Which few inputs make places of the skin strong and others quiet: actuators to mount."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from skinsource.base.arguments import checking, integer
from skinsource.base.conventions import Axes, Complexes, Floats, Indices
from skinsource.base.errors import InvalidInputError
from skinsource.inverse.focusing import checked_beta
from skinsource.inverse.responses import Responses, gram_of, inverse_of, loading, responses_of
from skinsource.limbs.catalog import limb_of
from skinsource.limbs.limb import PUBLISHED, Limb

#: Places of the published limbs on one fingertip, which cannot carry two actuators.
SAME_FINGERTIP = tuple((place, place + 5) for place in range(1, 6))
# Frequencies of the score; largest number of inputs and of sets that are tried one by one.
_AT_HZ = np.geomspace(50.0, 300.0, 12)
_EXACT_COUNT, _MOST_SETS = 3, 5000


@dataclass(frozen=True, slots=True, kw_only=True)
class Placement:
    """Inputs that were chosen.

    Attributes
    ----------
    inputs
        Places, from 1, rising.
    score_db
        Mean over targets, limbs and frequencies of what the contrast would be if drives cost as
        much as λ says.
    exhaustive
        Whether all sets of so many inputs were tried; else inputs were added one by one, and
        exchanged as long as that helped.
    """

    inputs: tuple[int, ...]
    score_db: float
    exhaustive: bool


@checking
def place(
    limb: Limb | str | Sequence[Limb | str],
    targets: Sequence[int],
    count: int,
    *,
    candidates: Sequence[int] | None = None,
    axes: Axes = "z",
    beta: float = 0.3,
    keep_apart: bool = True,
) -> Placement:
    """Return the inputs with which each of some outputs, alone, is best made strong.

    Up to three inputs every set is tried.

    Parameters
    ----------
    limb
        From `load_limb`, its name, or several: what is good for all of them.
    targets
        Outputs, from 1.
    count
        Number of inputs.
    candidates
        Places to choose from; None: all.
    axes, beta
        As of `focus`.
    keep_apart
        Whether no fingertip of the published limbs gets two inputs.

    Raises
    ------
    InvalidInputError
        There is no such place or output, fewer candidates than inputs, or a target is mostly noise.

    Examples
    --------
    >>> import skinsource as ss
    >>> ss.inverse.place("synthetic-1", [30], 1).inputs
    (7,)
    """
    limbs = [limb_of(each) for each in ([limb] if isinstance(limb, Limb | str) else limb)]
    if not limbs or not len(targets):
        raise InvalidInputError("No limb or no target is named. Name one of each.")
    beta = checked_beta(beta)
    places = range(1, limbs[0].n_inputs + 1) if candidates is None else candidates
    count = integer("count", count, 1, len(places))
    each = [
        responses_of(one, axes=axes, inputs=places, frequencies_hz=_frequencies_of(one))
        for one in limbs
    ]
    used = each[0].inputs
    apart = keep_apart and all(one.name in PUBLISHED for one in limbs)
    pairs = [set(pair) for pair in SAME_FINGERTIP if apart]

    def allowed(chosen: Sequence[int]) -> bool:
        numbers = {used[k] for k in chosen}
        return not any(pair <= numbers for pair in pairs)

    scorers = [_scorer(responses, targets, beta) for responses in each]

    def scores(sets: Indices) -> Floats:
        return np.mean([scorer(sets) for scorer in scorers], axis=0)

    found = _found(len(used), count, allowed, scores)
    if found is None:
        raise InvalidInputError(
            f"No {count} of the candidates are on different fingertips. Name more, or fewer inputs."
        )
    chosen, score_db, exhaustive = found
    return Placement(
        inputs=tuple(sorted(used[k] for k in chosen)), score_db=score_db, exhaustive=exhaustive
    )


def _frequencies_of(limb: Limb) -> Floats:
    if limb.name in PUBLISHED or limb.band_hz is None:
        return _AT_HZ
    (low, high), at_hz = limb.band_hz, _AT_HZ
    return at_hz[(at_hz >= low) & (at_hz <= high)]


Scores = Callable[[Indices], Floats]


def _found(
    n: int, count: int, allowed: Callable[[Sequence[int]], bool], scores: Scores
) -> tuple[tuple[int, ...], float, bool] | None:
    """Return the best set of positions that was found, its score, and whether all were tried."""
    if count <= _EXACT_COUNT and sum(1 for _ in combinations(range(n), count)) <= _MOST_SETS:
        sets = [each for each in combinations(range(n), count) if allowed(each)]
        return (*_best(sets, scores), True) if sets else None
    chosen: tuple[int, ...] = ()
    score_db = -np.inf
    while len(chosen) < count:
        sets = [(*chosen, k) for k in range(n) if k not in chosen and allowed((*chosen, k))]
        if not sets:
            return None
        chosen, score_db = _best(sets, scores)
    while True:
        swaps = [
            (*(k for k in chosen if k != out), new)
            for out in chosen
            for new in range(n)
            if new not in chosen
        ]
        better, higher_db = _best([chosen, *filter(allowed, swaps)], scores)
        if higher_db <= score_db:
            return chosen, score_db, False
        chosen, score_db = better, higher_db


def _best(sets: Sequence[tuple[int, ...]], scores: Scores) -> tuple[tuple[int, ...], float]:
    values = scores(np.array(sets))
    best = int(values.argmax())
    return sets[best], float(values[best])


def _scorer(responses: Responses, targets: Sequence[int], beta: float) -> Scores:
    """Return a function from sets, (n_sets, count), to scores, (n_sets,), dB."""
    checked = [responses.check_target(target) for target in targets]
    gram = gram_of(responses.rows(responses.others))
    load = beta * loading(gram)
    rows = responses.values[:, np.array(checked) - 1]
    among = np.isin(checked, responses.others)
    n_quiet = len(responses.others) - among

    def scores(sets: Indices) -> Floats:
        count = sets.shape[1]
        of_sets = gram[:, sets[:, :, None], sets[:, None, :]]
        inverse = inverse_of(of_sets + load[:, None, None, None] * np.eye(count))
        total = np.zeros(len(sets))
        for target in range(len(checked)):
            of_target = np.moveaxis(rows[:, target][..., sets], 1, 2)
            reached = of_target @ inverse @ of_target.conj().swapaxes(2, 3)
            largest = _largest(reached)
            if among[target]:
                # R holds the rows of the target as well; taken out they give this.
                largest = largest / (1.0 - largest)
            total += np.log10(n_quiet[target] * largest).mean(axis=0)
        return 10.0 * total / len(checked)

    return scores


def _largest(matrices: Complexes) -> Floats:
    if matrices.shape[-1] == 1:
        return matrices[..., 0, 0].real
    return np.linalg.eigvalsh(matrices)[..., -1].astype(np.float64, copy=False)
