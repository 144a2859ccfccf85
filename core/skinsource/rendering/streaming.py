"""Long scenes, block by block: nothing as long as the scene is held but the drives.

Overlap-save: a block of ``BLOCK_FFT`` samples of a drive gives ``BLOCK_SAMPLES`` samples of
response; blocks in which an input is silent cost nothing for that input.
"""

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from skinsource.graph import Stopped
from skinsource.limb import N_AXES, N_OUTPUTS, N_TAPS
from skinsource.rendering.drives import Booleans, reach
from skinsource.rendering.moments import Moments
from skinsource.rendering.segments import BLOCK_FFT, BLOCK_SAMPLES, Played
from skinsource.rendering.transforms import Complexes, Floats, forward, inverse


class StreamedField:
    """The field of a long scene.

    Parameters
    ----------
    inputs
        What is played.
    n_times
        Samples of the response.
    stop
        Asked before each block; once true, `Stopped` is raised.
    """

    def __init__(
        self, inputs: Sequence[Played], n_times: int, stop: Callable[[], bool] = lambda: False
    ) -> None:
        self._inputs = inputs
        self.n_times = n_times
        self._stop = stop
        self._moments: Moments | None = None

    def moments(self) -> Moments:
        """Moments of the field over the whole response, all products."""
        if self._moments is None:
            second = np.zeros((N_OUTPUTS, N_AXES, N_AXES))
            total = np.zeros((N_OUTPUTS, N_AXES))
            for _, block in self.blocks():
                second += block @ block.transpose(0, 2, 1)
                total += block.sum(axis=-1)
            self._moments = Moments(second, total)
        return self._moments

    def traces(self, outputs: tuple[int, ...], axes: tuple[int, ...]) -> Floats:
        """Acceleration of some outputs, (n_outputs, n_axes, n_times)."""
        result = np.zeros((len(outputs), len(axes), self.n_times))
        rows = np.ix_([output - 1 for output in outputs], list(axes))
        for first, block in self.blocks(rows):
            result[..., first : first + block.shape[-1]] = block
        return result

    def everything(self) -> Floats:
        """All outputs and axes, (72 outputs, 3 axes, n_times): as long as the scene."""
        result = np.zeros((N_OUTPUTS, N_AXES, self.n_times))
        for first, block in self.blocks():
            result[..., first : first + block.shape[-1]] = block
        return result

    def blocks(self, rows: tuple[np.ndarray, ...] | None = None) -> Iterator[tuple[int, Floats]]:
        """Yield first sample and samples, (n_outputs, n_axes, n), of each block that is felt."""
        for first in range(0, self.n_times, BLOCK_SAMPLES):
            if self._stop():
                raise Stopped
            spectrum = self._block_spectrum(first, rows)
            if spectrum is None:
                continue
            n = min(BLOCK_SAMPLES, self.n_times - first)
            samples = inverse(spectrum, BLOCK_FFT)[..., N_TAPS - 1 : N_TAPS - 1 + n]
            felt = self._felt(first, n)
            if not felt.all():
                samples = np.where(felt, samples, 0.0)
            yield first, samples

    def _block_spectrum(self, first: int, rows: tuple[np.ndarray, ...] | None) -> Complexes | None:
        total: Complexes | None = None
        for one in self._inputs:
            segment = one.segment(first)
            if segment is None:
                continue
            drive = forward(segment, BLOCK_FFT) * one.weight
            values = one.response.values if rows is None else one.response.values[rows]
            if total is None:
                total = values * drive
            else:
                total += values * drive
        return total

    def _felt(self, first: int, n: int) -> Booleans:
        felt = np.zeros(n, bool)
        for one in self._inputs:
            segment = one.segment(first)
            if segment is not None:
                felt |= reach(segment, 0, N_TAPS, BLOCK_FFT)[N_TAPS - 1 : N_TAPS - 1 + n]
        return felt
