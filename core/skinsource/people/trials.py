"""What the range between people held, leaving one person out in turn."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from skinsource.base.conventions import Band
from skinsource.design.comparing import half_width_db
from skinsource.limbs.limb import Limb
from skinsource.people.others import OCTAVES_HZ, band_levels_db, hand_outputs, people_of

_TONES_HZ = (60.0, 100.0, 200.0, 300.0)
_NOISE_HZ: Band = (25.0, 400.0)
#: Half a bin of the transforms: within it lies a tone.
_NEAR_HZ = 0.635


def range_held(limbs: Sequence[Limb | str] | None = None) -> dict[str, tuple[float, list[float]]]:
    """Return what the range of other people held of one person's levels, by what played.

    That is half the width of the range, dB, mean over the people left out, and the share of each
    one's levels, from all places to all outputs of the hand, that lay in the range.

    Parameters
    ----------
    limbs
        Limbs of the people, three or more; None: all measured ones.
    """
    people = people_of(limbs, 3)
    bands = {f"tone of {hz:g} Hz": (hz - _NEAR_HZ, hz + _NEAR_HZ) for hz in _TONES_HZ}
    bands |= {f"{low:g} to {high:g} Hz": (low, high) for low, high in OCTAVES_HZ}
    bands["noise, {:g} to {:g} Hz".format(*_NOISE_HZ)] = _NOISE_HZ
    inputs = range(1, people[0].n_inputs + 1)
    every_db = np.stack([band_levels_db(limb, inputs, [*bands.values()]) for limb in people])
    levels_db = every_db[:, :, np.array(hand_outputs(people[0])) - 1]
    found = {}
    for band, played in enumerate(bands):
        halves, shares = [], []
        for person in range(len(people)):
            others_db = np.delete(levels_db[:, band], person, axis=0)
            half_db = half_width_db(others_db)
            far_db = np.abs(levels_db[person, band] - others_db.mean(axis=0))
            halves.append(half_db)
            shares.append(float((far_db <= half_db).mean()))
        found[played] = float(np.mean(halves)), shares
    return found


def held_text(held: Mapping[str, tuple[float, list[float]]]) -> str:
    """Return a table of what was held."""
    head = "| plays | half width, dB | held of each person left out, % |\n|---|---|---|\n"
    rows = (
        f"| {played} | {half_db:.1f} | {', '.join(f'{100 * share:.0f}' for share in shares)} |"
        for played, (half_db, shares) in held.items()
    )
    return head + "\n".join(rows)
