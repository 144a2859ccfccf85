"""Sums of vibrations, written so that memory is read once, by two threads."""

from collections.abc import Sequence
from functools import partial

import numpy as np

from skinsource.arrays import Complexes
from skinsource.rendering.side_by_side import side_by_side

#: Outputs whose spectra, at the lengths of a second, stay in a core's own cache.
OUTPUTS_AT_ONCE = 18
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

    tasks = [
        partial(add_up, [one[part] for one in responses], drives, total[part])
        for part in parts_of(len(total))
    ]
    if len(responses) * total.size < _WORTH_A_THREAD:
        for task in tasks:
            task()
    else:
        side_by_side(tasks)
    return total


def parts_of(n_outputs: int) -> list[slice]:
    """Outputs that are summed at a time: they stay in a core's own cache."""
    return [slice(low, low + OUTPUTS_AT_ONCE) for low in range(0, n_outputs, OUTPUTS_AT_ONCE)]


def add_up(responses: Sequence[Complexes], drives: Sequence[Complexes], total: Complexes) -> None:
    """Write the sum of responses times drives to ``total``, as `sum_of_vibrations` says."""
    # The total may be the first response.
    np.multiply(responses[0], drives[0], out=total)
    if len(responses) > 1:
        buffer = np.empty(total.shape, np.complex128)
        for response, drive in zip(responses[1:], drives[1:], strict=True):
            total += np.multiply(response, drive, out=buffer)
