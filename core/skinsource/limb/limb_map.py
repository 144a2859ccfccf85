"""Where things are on a limb."""

from dataclasses import dataclass

import numpy as np

from skinsource.arrays import Floats


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LimbMap:
    """Where things are on the back of a right hand and arm.

    Coordinates are outline pixels: x to the right, y up (towards the fingertips), thumb to the
    left.  ``hand_length_px`` of them make one hand length.

    Attributes
    ----------
    outline : (n_vertices, 2)
        Closed polygon, last vertex not repeated.
    output_positions : (n_outputs, 2)
        Sensors; rows of those that have no place here are NaN: 61 to 66, on the palmar side, of
        the published limbs.
    input_positions : (n_inputs, 2)
        Input places, seen through the hand from the back.
    hand_length_px
        Tip of digit III to the middle of the wrist, in pixels.
    visibility : (n_vertices, n_outputs) or None
        Distance from outline vertex to output where the one sees the other, else NaN.
        ``None``: the surface operator applies its own rule.
    densify
        Whether the surface operator may split long outline edges (own outlines yes; the
        published outline no, for parity).
    axes_shown
        Whether the sensors' axes point as those of the published limbs do, which the map shows.
    """

    outline: Floats
    output_positions: Floats
    input_positions: Floats
    hand_length_px: float
    visibility: Floats | None = None
    densify: bool = True
    axes_shown: bool = True

    @property
    def unplaced(self) -> tuple[int, ...]:
        """Numbers of the outputs that have no place here."""
        return tuple(int(k) + 1 for k in np.flatnonzero(np.isnan(self.output_positions[:, 0])))
