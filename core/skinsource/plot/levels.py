"""What a map shows, from a design or from levels."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from skinsource.arguments import finite_array
from skinsource.arrays import Floats
from skinsource.catalogue import load_limb
from skinsource.design import Design, audible_inputs
from skinsource.errors import InvalidInputError
from skinsource.evaluation import evaluate
from skinsource.limb import Limb
from skinsource.map_range import map_range_db
from skinsource.quoting import quoted
from skinsource.surface import SurfaceOperator, surface_operator
from skinsource.view import View

Range = tuple[float, float]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Levels:
    """Levels of all outputs of a limb.

    Attributes
    ----------
    limb, surface
        Where the outputs are, and how levels are spread between them.
    values : (n_outputs,)
        In dB, or signed accelerations.
    places
        Input places that play.
    noisy
        Outputs that are mostly noise, see `skinsource.validity`; none where that is not known.
    """

    limb: Limb
    surface: SurfaceOperator
    values: Floats
    places: tuple[int, ...] = ()
    noisy: tuple[int, ...] = ()


def levels_of(shown: Design | ArrayLike, limb: Limb | str | None, view: View | None) -> Levels:
    """Return what a map shows.

    Raises
    ------
    InvalidInputError
        Levels come without a limb, or do not fit it.
    """
    if isinstance(shown, Design):
        found = evaluate(shown, "output_levels_db", "limb_data", "surface", "validity", view=view)
        places = sorted({one.location for one in audible_inputs(shown.inputs)})
        return Levels(
            limb=found["limb_data"],
            surface=found["surface"],
            values=found["output_levels_db"],
            places=tuple(places),
            noisy=next(one.outputs for one in found["validity"] if one.name == "noise"),
        )
    if limb is None:
        raise InvalidInputError(
            "levels need the limb that they belong to: map(levels_db, limb=...); a Design knows it"
        )
    whose = load_limb(limb) if isinstance(limb, str) else limb
    if not isinstance(whose, Limb):
        raise InvalidInputError(f"limb is {quoted(limb)}, expected a Limb or the name of one")
    values = finite_array("levels", shown)
    if values.shape != (whose.n_outputs,):
        raise InvalidInputError(
            f"levels have shape {values.shape}, expected one for each of the {whose.n_outputs} "
            f"outputs of {whose.name}"
        )
    return Levels(limb=whose, surface=surface_operator(whose), values=values)


def common_range(*levels_db: Floats) -> Range:
    """Colours for maps of all of these: see `skinsource.map_range.map_range_db`."""
    return map_range_db(np.concatenate(levels_db, axis=None))
