"""The maps of designs side by side: their levels, their differences, their mean and spread."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from skinsource.base.arrays import Floats
from skinsource.base.decibels import FLOOR_DB
from skinsource.design.comparing import difference_db, end_db, mean_and_spread_over, same_outputs
from skinsource.signals.analysis.noise import LEAST_ABOVE_NOISE_DB
from skinsource_gui.compared import ELSEWHERE, SILENCE, Compared, gain_db, is_silent
from skinsource_gui.panels.side_by_side.content import Cell
from skinsource_gui.widgets.map.colour_maps import DIVERGING
from skinsource_gui.widgets.map.level_look import USUAL_LOOK, LevelLook
from skinsource_gui.widgets.map.scale_row import Scale, scale_of_levels, scale_of_own
from skinsource_gui.widgets.map.small_map import Range, SmallMap, SmallMaps

#: What something is called, in ever fewer words.
Names = tuple[str, ...]


class Cells:
    """Makes the maps; the pixels of each are made once."""

    def __init__(self) -> None:
        self._maps: dict[str, SmallMaps] = {}
        self._before: dict[str, SmallMaps] = {}

    def of_levels(
        self, compared: Sequence[Compared], names: Sequence[Names], look: LevelLook = USUAL_LOOK
    ) -> tuple[Cell, ...]:
        """A map of the levels of each, in the same colours over the same range."""
        self._begin()
        known = [_levels_db(one) for one in compared if one.values is not None]
        loudest = np.array([levels.max() for levels in known])
        scale = scale_of_levels(loudest, look)
        return tuple(
            self._levels(one, name, scale) for one, name in zip(compared, names, strict=True)
        )

    def of_own_maxima(
        self,
        compared: Sequence[Compared],
        names: Sequence[Names],
        look: LevelLook = USUAL_LOOK,
    ) -> tuple[Cell, ...]:
        """A map of the levels of each relative to its own loudest output, in colours of a look."""
        self._begin()
        scale, pairs = scale_of_own(look), zip(compared, names, strict=True)
        return tuple(self._levels(one, name, scale, own=True) for one, name in pairs)

    def of_differences(
        self, compared: Sequence[Compared], names: Sequence[Names], reference: int
    ) -> tuple[Cell, ...]:
        """A map of how much louder each of the others is than the one at ``reference``."""
        self._begin()
        base, of_base = compared[reference], names[reference]
        cells = [
            self._difference(one, _minus(of_one, of_base), base)
            for k, (one, of_one) in enumerate(zip(compared, names, strict=True))
            if k != reference
        ]
        drawn = [cell.values_db for cell in cells if cell.values_db is not None]
        end, reached = end_db(*drawn), _reached_db(drawn)
        scale = Scale(
            range_db=(-end, end), words="dB", colours=DIVERGING, signed=True, reached_db=reached
        )
        return tuple(cell if cell.small is None else replace(cell, scale=scale) for cell in cells)

    def of_spread(
        self,
        compared: Sequence[Compared],
        names: Sequence[Names],
        reference: int,
        look: LevelLook = USUAL_LOOK,
    ) -> tuple[Cell, ...]:
        """Mean and standard deviation over all whose outputs are at the places of ``reference``."""
        self._begin()
        base = compared[reference]
        limb = _limb(base)
        pairs = zip(compared, names, strict=True)
        alike = [(one, words) for one, words in pairs if same_outputs(limb, _limb(one))]
        # Silence is no level that others could lie about.
        felt = [(one, words) for one, words in alike if one.values and not is_silent(one)]
        known = [one for one, _ in felt]
        # A mean of those that happen to be known already would change by itself.
        computing = any(one.values is None and not one.problem for one, _ in alike)
        if base.values is None or computing or len(known) < 2:
            few = (
                "A mean takes two at least that are not silent and have outputs at the same places."
            )
            problem = base.problem or next((one.problem for one, _ in alike if one.problem), few)
            return (Cell(headings=("",), limb=limb, words="" if computing else problem),)
        mean, spread = mean_and_spread_over([_levels_db(one) for one in known])
        called = [words for _, words in felt]
        what = _of_all(called, len(compared))
        late = any(one.late for one in known)
        noisy = _noisy(*known)
        common: dict[str, Any] = {
            "limb": limb,
            "late": late,
            "synthetic": any(_synthetic(one) for one in known),
        }
        of_mean = scale_of_levels(mean, look)
        of_spread = Scale(
            range_db=(0.0, end_db(spread)),
            words="dB",
            colours=look.colours,
            reached_db=_reached_db([spread]),
        )
        return (
            Cell(
                headings=(*(f"Mean {one}" for one in what), "Mean"),
                small=self._map("mean", base, mean, noisy),
                scale=of_mean,
                **common,
            ),
            Cell(
                headings=(
                    *(f"Standard deviation {one}" for one in what),
                    *(f"Spread {one}" for one in what),
                    "Spread",
                ),
                small=self._map("spread", base, spread, noisy),
                scale=of_spread,
                **common,
            ),
        )

    def _difference(self, one: Compared, headings: Names, base: Compared) -> Cell:
        cell = Cell(headings=headings, limb=_limb(one), late=one.late or base.late)
        if problem := one.problem or base.problem:
            return replace(cell, words=problem)
        if not same_outputs(_limb(one), _limb(base)):
            return replace(cell, words=ELSEWHERE)
        if one.values is None or base.values is None:
            return cell
        if is_silent(one) or is_silent(base):
            return replace(cell, words=SILENCE)
        levels = difference_db(_levels_db(one), _levels_db(base))
        both = _synthetic(one) or _synthetic(base)
        small = self._map(headings[0], one, levels, _noisy(one, base))
        return replace(cell, small=small, synthetic=both)

    def _levels(self, one: Compared, names: Names, scale: Scale, *, own: bool = False) -> Cell:
        cell = Cell(headings=names, limb=_limb(one), words=one.problem, late=one.late)
        if one.values is None:
            return cell
        small, maximum_db = self._map(names[0], one, None, _noisy(one)), None
        if own and not is_silent(one):
            maximum_db = float(_levels_db(one).max())
            small = _relative(small, maximum_db)
        return replace(
            cell,
            small=small,
            scale=scale,
            maximum_db=maximum_db,
            design=one.snapshot.design,
            synthetic=_synthetic(one),
        )

    def _begin(self) -> None:
        self._before, self._maps = self._maps, {}

    def _map(
        self, kept: str, one: Compared, levels_db: Floats | None, noisy: tuple[int, ...]
    ) -> SmallMap:
        """A map on the limb of ``one``: of its levels as they are shown, or of others."""
        values: dict[str, Any] = dict(one.values or {})
        if levels_db is not None:
            values["output_levels_db"] = levels_db
            values["surface_levels_db"] = values["surface"].interpolate(levels_db)
        elif one.gain != 1.0:
            values["output_levels_db"] = _levels_db(one)
            values["surface_levels_db"] = values["surface_levels_db"] + gain_db(one)
        self._maps[kept] = maps = self._before.pop(kept, None) or SmallMaps()
        return replace(maps.map_of(values), noisy=noisy)


def _relative(small: SmallMap, maximum_db: float) -> SmallMap:
    """The same map with its levels re ``maximum_db``; what is silent stays so."""
    levels, field = small.levels_db, small.field_levels_db
    return replace(
        small,
        levels_db=None if levels is None else _below(levels, maximum_db),
        field_levels_db=None if field is None else field - maximum_db,
    )


def _below(levels_db: Floats, maximum_db: float) -> Floats:
    return np.where(levels_db > FLOOR_DB, levels_db - maximum_db, levels_db)


def _of_all(called: Sequence[Names], n_compared: int) -> Names:
    """Of how many and of which; where some cannot take part, of how many there are."""
    number = f"of {len(called)}"
    if len(called) < n_compared:
        number += f" of {n_compared}"
    listed = ", ".join(one[min(1, len(one) - 1)] for one in called)
    return f"{number}: {listed}", number


def _minus(one: Names, other: Names) -> Names:
    """What a difference is called; as few words of both."""
    n = max(len(one), len(other))
    pairs = [(one[min(k, len(one) - 1)], other[min(k, len(other) - 1)]) for k in range(n)]
    return tuple(f"{this} minus {that}" for this, that in pairs)


def _reached_db(drawn: Sequence[Floats]) -> Range | None:
    """The smallest and the largest of all values; None where there is none."""
    known = [one for one in drawn if one.size]
    if not known:
        return None
    return (min(float(one.min()) for one in known), max(float(one.max()) for one in known))


def _levels_db(one: Compared) -> Floats:
    """Levels as it is shown: as loud as the others, where that is wanted."""
    levels: Floats = (one.values or {})["output_levels_db"]
    return levels if one.gain == 1.0 else levels + gain_db(one)


def _noisy(*compared: Compared) -> tuple[int, ...]:
    """Numbers of the outputs that are mostly noise in any of them."""
    known = [(one.values or {}).get("above_noise_db") for one in compared]
    found = {
        int(k) + 1
        for levels in known
        if levels is not None
        for k in np.flatnonzero(levels < LEAST_ABOVE_NOISE_DB)
    }
    return tuple(sorted(found))


def _limb(one: Compared) -> str:
    return one.snapshot.design.limb


def _synthetic(one: Compared) -> bool:
    return one.values is not None and bool(one.values["limb_data"].synthetic)
