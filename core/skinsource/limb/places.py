"""Numbers of input places."""

import numpy as np

from skinsource.errors import InvalidInputError
from skinsource.limb.published import N_INPUTS
from skinsource.quoting import quoted


def check_input_location(location: int, n_inputs: int = N_INPUTS) -> None:
    """Raise `InvalidInputError` unless ``location`` is an integer from 1 to ``n_inputs``."""
    is_integer = isinstance(location, int | np.integer) and not isinstance(location, bool)
    if not is_integer or not 1 <= location <= n_inputs:
        raise InvalidInputError(
            f"input location {quoted(location)} does not exist: locations are the whole numbers 1 "
            f"to {n_inputs}. See skinsource.locations for the list."
        )
