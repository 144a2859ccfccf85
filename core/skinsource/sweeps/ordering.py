"""In which order stimuli are presented: blocks of trials for each participant."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from skinsource.arguments import one_of, whole_number
from skinsource.counting import counted
from skinsource.errors import InvalidInputError

Kind = Literal["given", "random", "counterbalanced"]
KINDS: tuple[Kind, ...] = get_args(Kind)
_MOST = 10_000
_MOST_TRIALS = 10_000_000
_MOST_SEED = 2**63 - 1


@dataclass(frozen=True, slots=True, kw_only=True)
class Order:
    """How trials follow each other.

    Attributes
    ----------
    kind
        ``"given"``: as in the sweep.  ``"random"``: each block is a permutation of its own.
        ``"counterbalanced"``: rows of a balanced Latin square, so that over as many blocks as there
        are stimuli (twice as many where their number is odd) each stimulus stands in each place,
        and follows each other one, equally often (Williams, "Experimental designs balanced for the
        estimation of residual effects of treatments", Aust. J. Chem. 2, 1949).
    seed
        Of what is random: the permutations, or which stimulus is which letter of the square.
    participants
        How many; each has blocks of its own.
    blocks
        For each participant; every block holds every stimulus once.
    """

    kind: Kind = "given"
    seed: int = 0
    participants: int = 1
    blocks: int = 1

    def __post_init__(self) -> None:
        one_of("order", self.kind, KINDS)
        whole_number("seed", self.seed, 0, _MOST_SEED)
        whole_number("participants", self.participants, 1, _MOST)
        whole_number("blocks", self.blocks, 1, _MOST)


@dataclass(frozen=True, slots=True)
class Trial:
    """One presentation; all numbers from 1."""

    participant: int
    block: int
    trial: int
    stimulus: int


def trials(order: Order, stimuli: Sequence[int]) -> tuple[Trial, ...]:
    """Return all presentations of ``stimuli``, their numbers, participant by participant.

    Raises
    ------
    InvalidInputError
        There would be too many.
    """
    n_stimuli = len(stimuli)
    n_blocks = order.participants * order.blocks
    if n_blocks * n_stimuli > _MOST_TRIALS:
        raise InvalidInputError(
            f"{counted(n_blocks, 'block')} of {counted(n_stimuli, 'stimulus', 'stimuli')} are "
            f"{n_blocks * n_stimuli} trials, expected at most {_MOST_TRIALS}"
        )
    rng = np.random.default_rng(order.seed)
    # Which stimulus is which letter: the square itself is the same for all seeds.
    letters = rng.permutation(n_stimuli)
    found = []
    for block in range(n_blocks):
        if order.kind == "random":
            sequence = rng.permutation(n_stimuli)
        elif order.kind == "counterbalanced":
            sequence = letters[latin_row(block, n_stimuli)]
        else:
            sequence = np.arange(n_stimuli)
        participant, of_participant = divmod(block, order.blocks)
        found += [
            Trial(participant + 1, of_participant + 1, k + 1, stimuli[stimulus])
            for k, stimulus in enumerate(sequence)
        ]
    return tuple(found)


def latin_row(row: int, n: int) -> np.ndarray:
    """Return row ``row`` of a balanced Latin square of ``n`` letters, (n,), from 0.

    For odd n the square is followed by its mirror image: balance takes 2 n rows.
    """
    steps = np.arange(n)
    # 0, 1, n-1, 2, n-2, …: the steps between neighbours are all different.
    first = np.where(steps % 2 == 1, (steps + 1) // 2, (n - steps // 2) % n)
    which, mirrored = row % n, n % 2 == 1 and (row // n) % 2 == 1
    found: np.ndarray = (first + which) % n
    return found[::-1] if mirrored else found
