"""The same design on several limbs: which ones, and what their levels have in common."""

import numpy as np
from numpy.typing import ArrayLike

from skinsource.arguments import real_array
from skinsource.arrays import Floats
from skinsource.comparing.difference import DEPTH_DB
from skinsource.errors import InvalidInputError
from skinsource.limb import PUBLISHED
from skinsource.own_limbs import facts_of, own_limb_names

#: Of so many limbs or designs side by side each is still large enough to be looked at.
MOST_BESIDE = 4


def limbs_beside(limb: str) -> tuple[str, ...]:
    """Names of the limbs that belong beside ``limb``, at most four, itself among them.

    Of a published or synthetic limb the four of its kind; of an own limb the others that a lab
    imported with the same outputs.
    """
    kind = limb.partition("-")[0]
    if limb in PUBLISHED:
        return tuple(name for name in PUBLISHED if name.partition("-")[0] == kind)
    others = (name for name in own_limb_names() if name != limb and same_outputs(limb, name))
    return (limb, *others)[:MOST_BESIDE]


def same_outputs(limb: str, other: str) -> bool:
    """Whether an output of one limb is at the place that it has on the other, by its number.

    That is so of all published and synthetic limbs, and of own limbs with as many outputs that
    have the same names.
    """
    one, two = facts_of(limb), facts_of(other)
    if not (one.known and two.known):
        return False
    same = one.own == two.own and one.output_names == two.output_names
    return same and one.n_outputs == two.n_outputs


def mean_and_spread_over(
    levels_db: ArrayLike, *, depth_db: float = DEPTH_DB
) -> tuple[Floats, Floats]:
    """Return mean and standard deviation, (n_outputs,), of levels over limbs or designs, in dB.

    Parameters
    ----------
    levels_db : (n, n_outputs)
        Level of each output on each; two at least.
    depth_db
        Levels farther below the loudest of all count as so far below, as in `difference_db`.

    Returns
    -------
    The mean of the levels in dB, and their standard deviation, that of a sample.

    Raises
    ------
    InvalidInputError
        The levels are not a table of at least two rows of finite numbers.
    """
    levels = real_array("levels_db", levels_db, "levels in dB")
    if levels.ndim != 2 or len(levels) < 2 or not levels.shape[1] or not np.isfinite(levels).all():
        raise InvalidInputError(
            f"levels_db has shape {levels.shape}, expected finite levels (n, n_outputs) of at "
            "least two limbs or designs"
        )
    audible = np.maximum(levels, levels.max() - depth_db)
    return audible.mean(axis=0), audible.std(axis=0, ddof=1)
