"""Sums of vibrations, written so that memory is read once, by two threads."""

from collections.abc import Sequence

import numpy as np

from skinsource.arrays import Complexes
from skinsource.rendering.side_by_side import side_by_side

# Outputs at a time: what is summed and what is added to it stay in a core's own cache.
_OUTPUTS_AT_ONCE = 18
# A second thread pays from about a millisecond of work on.
_WORTH_A_THREAD = 10**6


def sum_of_vibrations(responses: Sequence[Complexes], drives: Sequence[Complexes]) -> Complexes:
    """Sum over voices of the spectra of responses times that of the drive.

    Parameters
    ----------
    responses : (n_outputs, 3 axes, n_bins) each
        At least one.
    drives : (n_bins,) each
        As many.

    Returns
    -------
    (n_outputs, 3 axes, n_bins), the same bits whatever the number of threads
    """
    total = np.empty(responses[0].shape, np.complex128)

    def fill(outputs: range) -> None:
        buffer = np.empty((_OUTPUTS_AT_ONCE, *total.shape[1:]), np.complex128)
        for low in outputs:
            part = slice(low, low + _OUTPUTS_AT_ONCE)
            found = np.multiply(responses[0][part], drives[0], out=total[part])
            for response, drive in zip(responses[1:], drives[1:], strict=True):
                found += np.multiply(response[part], drive, out=buffer[: len(found)])

    if len(responses) * total.size < _WORTH_A_THREAD:
        fill(range(0, len(total), _OUTPUTS_AT_ONCE))
        return total
    half = len(total) // 2
    side_by_side(
        lambda: fill(range(0, half, _OUTPUTS_AT_ONCE)),
        lambda: fill(range(half, len(total), _OUTPUTS_AT_ONCE)),
    )
    return total
