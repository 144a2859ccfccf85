"""The vibration by drives at some places, from spectra."""

from collections.abc import Callable, Iterator, Sequence
from functools import partial

import numpy as np

from skinsource.arrays import Complexes, Floats
from skinsource.prediction.second_thread import helped
from skinsource.rendering.response_spectra import ResponseSpectrum
from skinsource.rendering.sums import add_up, parts_of
from skinsource.rendering.transforms import forward_in_parts, inverse_here
from skinsource.work import tally

#: Spectra of the responses at some outputs.
SpectraOf = Callable[[slice], Complexes]


def superposed(
    spectra: Sequence[SpectraOf],
    drives: Sequence[Complexes],
    shape: tuple[int, int, int],
    n_fft: int,
) -> list[Floats]:
    """Vibration by ``drives``.

    Parameters
    ----------
    spectra
        Of the responses to the place of each drive, (n, 3 axes, n_fft // 2 + 1) for n outputs.
    drives : (n_fft // 2 + 1,) each
        Spectra, at least one.
    shape
        Outputs, axes and samples of the vibration.

    Returns
    -------
    The vibration, m/s², in pieces of some outputs (`parts_of`).  Each piece is taken from the
    spectra to the samples at once: what lies between stays in a core's own cache.
    """

    def samples_of(part: slice) -> Floats:
        found = [spectra_of(part) for spectra_of in spectra]
        total = np.empty_like(found[0])
        add_up(found, drives, total)
        return inverse_here(total, n_fft)[..., : shape[-1]]

    pieces = helped([partial(samples_of, part) for part in parts_of(shape[0])])
    tally(inverse_transforms=shape[0] * shape[1])
    return pieces


def caused_by_one(
    responses: Floats | ResponseSpectrum,
    drive: Complexes,
    shape: tuple[int, int, int],
    n_fft: int,
) -> tuple[Floats, float]:
    """Vibration by one drive, and its largest sample.

    One thread does it: where no processor is free a second one would make it slower than the plain
    way, and where one is free it gains little of what is over in a few milliseconds.

    Parameters
    ----------
    responses
        To its place: as samples, (n_outputs, 3 axes, n_taps), or transformed.
    drive : (n_fft // 2 + 1,)
        Its spectrum.
    shape
        Outputs, axes and samples of the vibration.

    Returns
    -------
    The vibration, (n_outputs, 3 axes, n_times), m/s², and m/s².
    """
    n_outputs, n_axes, n_times = shape
    vibration, largest = np.empty(shape), -np.inf
    at_once = max(1, _SAMPLES_AT_ONCE // (n_axes * n_fft))
    for part, spectra in _spectra_in_parts(responses, drive, n_fft, at_once):
        piece = vibration[part]
        piece[:] = inverse_here(spectra, n_fft)[..., :n_times]
        largest = max(largest, float(piece.max()))
    tally(inverse_transforms=n_outputs * n_axes)
    return vibration, largest


def _spectra_in_parts(
    responses: Floats | ResponseSpectrum, drive: Complexes, n_fft: int, at_once: int
) -> Iterator[tuple[slice, Complexes]]:
    if isinstance(responses, ResponseSpectrum):
        for low in range(0, len(responses.values), at_once):
            part = slice(low, low + at_once)
            yield part, responses.values[part] * drive
    else:
        for part, spectra in forward_in_parts(responses, n_fft, at_once):
            # They are wanted for nothing else.
            spectra *= drive
            yield part, spectra
        tally(forward_transforms=responses.shape[0] * responses.shape[1])


# What a core's own cache holds of spectra and as many samples, beside what they come from.
_SAMPLES_AT_ONCE = 2**16
