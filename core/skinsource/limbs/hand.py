"""Drawings of right hands and forearms: files in ``data/hands``, one for each synthetic limb."""

import json
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from skinsource.base.arrays import Floats
from skinsource.base.assets import data_folder
from skinsource.base.measurement_conditions import VOLAR_OUTPUTS
from skinsource.limbs.limb import LimbMap

#: Outline pixels in one hand length.
HAND_LENGTH_PX = 400.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HandShape:
    """A right hand and arm seen from the back, in outline pixels, x right, y up, thumb left.

    Attributes
    ----------
    outline : (n_vertices, 2)
        Closed simple polygon, counter-clockwise, last vertex not repeated.
    input_positions : (20, 2)
        Input places, seen through the hand.
    output_positions : (72, 2)
        Sensors; the six volar ones seen through the arm.
    digit_axes
        For digits I to V the base knuckle, joints and tip, (3, 2) for the thumb, else (4, 2).
    wrist : (2,)
        Middle of the wrist.
    wrist_ends : (2, 2)
        Radial and ulnar end of the wrist line.
    creases
        Lines of a palmar drawing: fingers, palm, wrist; open polylines (n, 2).  Of hand 1, which
        the studio shows.
    """

    outline: Floats
    input_positions: Floats
    output_positions: Floats
    digit_axes: tuple[Floats, ...]
    wrist: Floats
    wrist_ends: Floats
    creases: tuple[Floats, ...]

    def limb_map(self) -> LimbMap:
        """Return the part of this drawing that a `Limb` carries."""
        outputs = self.output_positions.copy()
        outputs[np.array(VOLAR_OUTPUTS) - 1] = np.nan
        return LimbMap(
            outline=self.outline,
            output_positions=_read_only(outputs),
            input_positions=self.input_positions,
            hand_length_px=HAND_LENGTH_PX,
        )


@cache
def drawn_hand(number: int) -> HandShape:
    """Return the hand of synthetic limb 1 to 4; its arrays cannot be written to."""
    text = (data_folder() / "hands" / f"{number}.json").read_text(encoding="utf-8")
    drawing = json.loads(text)
    return HandShape(
        outline=_read_only(drawing["outline"]),
        input_positions=_read_only(drawing["input_positions"]),
        output_positions=_read_only(drawing["output_positions"]),
        digit_axes=tuple(map(_read_only, drawing["digit_axes"])),
        wrist=_read_only(drawing["wrist"]),
        wrist_ends=_read_only(drawing["wrist_ends"]),
        creases=tuple(map(_read_only, drawing.get("creases", ()))),
    )


def _read_only(points: Any) -> Floats:
    array: Floats = np.array(points, np.float64)
    array.flags.writeable = False
    return array
