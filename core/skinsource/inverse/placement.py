"""Which few inputs make places of the skin strong and others quiet: actuators to mount."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import combinations
from math import comb

import numpy as np

from skinsource.base.arguments import checking, integer
from skinsource.base.conventions import Axes, Floats, Indices
from skinsource.base.errors import InvalidInputError
from skinsource.base.job import Stop, never, stop_if
from skinsource.inverse.focusing import checked_beta
from skinsource.inverse.responses import Responses, gram_of, inverse_of, loading, responses_of
from skinsource.limbs.catalog import limb_of
from skinsource.limbs.limb import PUBLISHED, Limb

#: Places of the published limbs on one fingertip, which cannot carry two actuators.
SAME_FINGERTIP = tuple((place, place + 5) for place in range(1, 6))
#: Outputs of the published limbs on the last phalanx of each digit, from the thumb on.
FINGERTIPS = (41, 28, 19, 10, 1)
# Frequencies of the score; largest number of inputs and of sets that are tried one by one.
_AT_HZ = np.geomspace(50.0, 300.0, 12)
_EXACT_COUNT, _MOST_SETS = 3, 5000
# How many layouts are ranked; how many are judged at once: of 20 inputs, each takes 80 kB.
_RANKED, _AT_ONCE = 8, 256


@dataclass(frozen=True, slots=True, kw_only=True)
class Layout:
    """Inputs, and how well they serve.

    Attributes
    ----------
    inputs
        Places, from 1, rising.
    score_db
        Mean over targets, limbs and frequencies of what the contrast would be if drives cost as
        much as λ says.
    loss_db
        By how much it is below the score of all candidates together.
    """

    inputs: tuple[int, ...]
    score_db: float
    loss_db: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Placement:
    """Inputs that were chosen.

    Attributes
    ----------
    ranked
        The best layouts of those that were tried, the chosen one first.
    exhaustive
        Whether all sets of so many inputs were tried; else inputs were added one by one, and
        exchanged as long as that helped.  The others in the ranking are one exchange away then.
    """

    ranked: tuple[Layout, ...]
    exhaustive: bool

    @property
    def inputs(self) -> tuple[int, ...]:
        """The inputs of the best layout."""
        return self.ranked[0].inputs

    @property
    def score_db(self) -> float:
        """The score of the best layout."""
        return self.ranked[0].score_db


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
    stop: Stop = never,
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
    stop
        Asked now and then whether to stop.

    Raises
    ------
    InvalidInputError
        There is no such place or output, fewer candidates than inputs, or a target is mostly noise.
    Stopped
        ``stop`` returned True.

    Examples
    --------
    >>> import skinsource as ss
    >>> found = ss.inverse.place("synthetic-1", [30], 1)
    >>> found.inputs, found.exhaustive
    ((7,), True)
    """
    limbs = _limbs_of(limb)
    used, scores = _judges(limbs, targets, candidates, axes, beta, stop)
    count = integer("count", count, 1, len(used))
    apart = keep_apart and all(one.name in PUBLISHED for one in limbs)
    pairs = [set(pair) for pair in SAME_FINGERTIP if apart]

    def allowed(chosen: Sequence[int]) -> bool:
        numbers = {used[k] for k in chosen}
        return not any(pair <= numbers for pair in pairs)

    found = _found(len(used), count, allowed, scores)
    if found is None:
        raise InvalidInputError(
            f"No {count} of the candidates are on different fingertips. Name more, or fewer inputs."
        )
    sets, values, exhaustive = found
    whole_db = _of_all(used, scores)
    ranked = zip(sets[:_RANKED], values, strict=False)
    return Placement(
        ranked=tuple(_layout([used[k] for k in each], db, whole_db) for each, db in ranked),
        exhaustive=exhaustive,
    )


@checking
def layout(
    limb: Limb | str | Sequence[Limb | str],
    targets: Sequence[int],
    inputs: Sequence[int],
    *,
    candidates: Sequence[int] | None = None,
    axes: Axes = "z",
    beta: float = 0.3,
) -> Layout:
    """Return how well inputs that are chosen already serve, such as those of another person.

    Parameters
    ----------
    limb, targets, candidates, axes, beta
        As of `place`.
    inputs
        Places, all of them candidates.

    Raises
    ------
    InvalidInputError
        An input is no candidate, or as of `place`.

    Examples
    --------
    >>> import skinsource as ss
    >>> chosen = ss.inverse.place("synthetic-1", [30], 3)
    >>> there = ss.inverse.layout("synthetic-2", [30], chosen.inputs)
    >>> print(f"{chosen.ranked[0].loss_db:.1f} dB, on another person {there.loss_db:.1f} dB")
    0.5 dB, on another person 0.4 dB
    """
    used, scores = _judges(_limbs_of(limb), targets, candidates, axes, beta)
    if not len(inputs) or not set(inputs) <= set(used):
        raise InvalidInputError(
            f"inputs are {list(inputs)}, expected some of the candidates. Name others."
        )
    positions = np.array([[used.index(each) for each in inputs]])
    return _layout(inputs, float(scores(positions)[0]), _of_all(used, scores))


def _layout(inputs: Sequence[int], score_db: float, whole_db: float) -> Layout:
    return Layout(
        inputs=tuple(sorted(inputs)), score_db=float(score_db), loss_db=float(whole_db - score_db)
    )


def _limbs_of(limb: Limb | str | Sequence[Limb | str]) -> list[Limb]:
    return [limb_of(each) for each in ([limb] if isinstance(limb, Limb | str) else limb)]


Scores = Callable[[Indices], Floats]


def _judges(
    limbs: Sequence[Limb],
    targets: Sequence[int],
    candidates: Sequence[int] | None,
    axes: Axes,
    beta: float,
    stop: Stop = never,
) -> tuple[tuple[int, ...], Scores]:
    """Return the candidates, and a function from sets of their positions to scores on all limbs."""
    if not limbs or not len(targets):
        raise InvalidInputError("No limb or no target is named. Name one of each.")
    beta = checked_beta(beta)
    places = range(1, limbs[0].n_inputs + 1) if candidates is None else candidates
    each = [
        responses_of(one, axes=axes, inputs=places, frequencies_hz=_frequencies_of(one))
        for one in limbs
    ]
    scorers = [_scorer(responses, targets, beta, stop) for responses in each]

    def scores(sets: Indices) -> Floats:
        parts = np.array_split(sets, -(-len(sets) // _AT_ONCE))
        return np.concatenate(
            [np.mean([scorer(part) for scorer in scorers], axis=0) for part in parts]
        )

    return each[0].inputs, scores


def _of_all(used: Sequence[int], scores: Scores) -> float:
    """Return the score of all candidates together."""
    return float(scores(np.arange(len(used))[None])[0])


def _frequencies_of(limb: Limb) -> Floats:
    if limb.name in PUBLISHED or limb.band_hz is None:
        return _AT_HZ
    (low, high), at_hz = limb.band_hz, _AT_HZ
    return at_hz[(at_hz >= low) & (at_hz <= high)]


Sets = list[tuple[int, ...]]


def _found(
    n: int, count: int, allowed: Callable[[Sequence[int]], bool], scores: Scores
) -> tuple[Sets, Floats, bool] | None:
    """Return sets of positions, the best first, their scores, and whether all were tried."""
    if count <= _EXACT_COUNT and comb(n, count) <= _MOST_SETS:
        sets = [each for each in combinations(range(n), count) if allowed(each)]
        return (*_ranked(sets, scores), True) if sets else None
    chosen: tuple[int, ...] = ()
    score_db = -np.inf
    while len(chosen) < count:
        sets = [(*chosen, k) for k in range(n) if k not in chosen and allowed((*chosen, k))]
        if not sets:
            return None
        sets, values = _ranked(sets, scores)
        chosen, score_db = sets[0], values[0]
    while True:
        swaps = [
            (*(k for k in chosen if k != out), new)
            for out in chosen
            for new in range(n)
            if new not in chosen
        ]
        sets, values = _ranked([chosen, *filter(allowed, swaps)], scores)
        if values[0] <= score_db:
            return sets, values, False
        chosen, score_db = sets[0], values[0]


def _ranked(sets: Sets, scores: Scores) -> tuple[Sets, Floats]:
    """Return sets and their scores, the best first."""
    values = scores(np.array(sets))
    order = np.argsort(-values, kind="stable")
    return [sets[k] for k in order], values[order]


def _scorer(responses: Responses, targets: Sequence[int], beta: float, stop: Stop) -> Scores:
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
            stop_if(stop)
            of_target = np.moveaxis(rows[:, target][..., sets], 1, 2)
            reached = of_target @ inverse @ of_target.conj().swapaxes(2, 3)
            largest = np.linalg.eigvalsh(reached)[..., -1].astype(np.float64, copy=False)
            if among[target]:
                # R holds the rows of the target as well; taken out they give this.
                largest = largest / (1.0 - largest)
            total += np.log10(n_quiet[target] * largest).mean(axis=0)
        return 10.0 * total / len(checked)

    return scores
