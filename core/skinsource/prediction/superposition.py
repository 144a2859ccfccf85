"""The vibration by drives at some places, from spectra."""

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from skinsource.arrays import Complexes, Floats
from skinsource.prediction.helped import helped
from skinsource.rendering.sums import add_up, parts_of
from skinsource.rendering.transforms import inverse_here
from skinsource.work import tally

#: Spectra of the responses at some outputs.
SpectraOf = Callable[[slice], Complexes]


def superposed(
    spectra: Sequence[SpectraOf],
    drives: Sequence[Complexes],
    shape: tuple[int, int, int],
    n_fft: int,
    *,
    kept: bool = True,
) -> tuple[list[Floats], float]:
    """Vibration by ``drives``, and its largest sample.

    Parameters
    ----------
    spectra
        Of the responses to the place of each drive, (n, 3 axes, n_fft // 2 + 1) for n outputs.
    drives : (n_fft // 2 + 1,) each
        Spectra, at least one.
    shape
        Outputs, axes and samples of the vibration.
    kept
        Whether the spectra are wanted afterwards.

    Returns
    -------
    The vibration, m/s², in pieces of some outputs (`parts_of`), and m/s².  Each piece is taken from
    the spectra to the samples at once: what lies between stays in a core's own cache.
    """

    def samples_of(part: slice) -> tuple[Floats, float]:
        found = [spectra_of(part) for spectra_of in spectra]
        # What was transformed for this alone is not needed any more.
        total = np.empty_like(found[0]) if kept else found[0]
        add_up(found, drives, total)
        samples = inverse_here(total, n_fft)[..., : shape[-1]]
        return samples, float(samples.max())

    pieces = helped([partial(samples_of, part) for part in parts_of(shape[0])])
    tally(inverse_transforms=shape[0] * shape[1])
    return [samples for samples, _ in pieces], max(largest for _, largest in pieces)
