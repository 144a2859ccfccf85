"""The top of a smooth peak between samples."""

import numpy as np

from skinsource.arrays import Floats


def vertex(beside: Floats) -> float:
    """Where the parabola through three points has its top, in steps from the middle one.

    Parameters
    ----------
    beside : (3,)
        The middle one is not below the others; where all are alike there is no top, and it is 0.
    """
    left, middle, right = (float(one) for one in beside)
    bend = left - 2.0 * middle + right
    return 0.0 if bend >= 0.0 else float(np.clip(0.5 * (left - right) / bend, -0.5, 0.5))
