"""Names of the kinds of arrays."""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
#: Positions in an array.
Indices = NDArray[np.intp]
Complexes = NDArray[np.complex128]
Booleans = NDArray[np.bool_]
