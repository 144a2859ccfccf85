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

# Blocks whose spectra are made together, and outputs at a time: a megabyte, which fits a cache.
_GROUP, _OUTPUTS_AT_ONCE = 4, 8


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
        starts = range(0, self.n_times, BLOCK_SAMPLES)
        for k in range(0, len(starts), _GROUP):
            group = starts[k : k + _GROUP]
            spectra = self._group_spectra(group, rows)
            for first in group:
                if self._stop():
                    raise Stopped
                if first not in spectra:
                    continue
                n = min(BLOCK_SAMPLES, self.n_times - first)
                spectrum = spectra.pop(first)
                samples = inverse(spectrum, BLOCK_FFT)[..., N_TAPS - 1 : N_TAPS - 1 + n]
                felt = self._felt(first, n)
                yield first, samples if felt.all() else np.where(felt, samples, 0.0)

    def _group_spectra(
        self, group: Sequence[int], rows: tuple[np.ndarray, ...] | None
    ) -> dict[int, Complexes]:
        """Spectra of the blocks of a group that are felt.

        Some channels of all blocks at a time: what is read of a response stays in the cache for
        the next block, and what is summed for the next input.
        """
        drives = [self._drives_of(one, group) for one in self._inputs]
        shape = (N_OUTPUTS, N_AXES) if rows is None else np.broadcast_shapes(*map(np.shape, rows))
        n_bins = BLOCK_FFT // 2 + 1
        spectra = {
            first: np.zeros((*shape, n_bins), np.complex128)
            for first in group
            if any(first in found for found in drives)
        }
        buffer = np.empty((_OUTPUTS_AT_ONCE, shape[1], n_bins), np.complex128)
        for low in range(0, shape[0] if spectra else 0, _OUTPUTS_AT_ONCE):
            if self._stop():
                raise Stopped
            part = slice(low, low + _OUTPUTS_AT_ONCE)
            for one, found in zip(self._inputs, drives, strict=True):
                values = one.response.values if rows is None else one.response.values[rows]
                values = values[part]
                for first, drive in found.items():
                    field = np.multiply(values, drive, out=buffer[: len(values)])
                    spectra[first][part] += field
        return spectra

    @staticmethod
    def _drives_of(one: Played, group: Sequence[int]) -> dict[int, Complexes]:
        segments = {first: one.segment(first) for first in group}
        return {
            first: forward(segment, BLOCK_FFT) * one.weight
            for first, segment in segments.items()
            if segment is not None
        }

    def _felt(self, first: int, n: int) -> Booleans:
        felt = np.zeros(n, bool)
        for one in self._inputs:
            segment = one.segment(first)
            if segment is not None:
                felt |= reach(segment, 0, N_TAPS, BLOCK_FFT)[N_TAPS - 1 : N_TAPS - 1 + n]
        return felt
