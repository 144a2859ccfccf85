"""Long scenes, block by block: nothing as long as the scene is held but the drives.

Overlap-save: a block of ``BLOCK_FFT`` samples of the drives gives ``BLOCK_SAMPLES`` samples of
response.  At each frequency the fields of all inputs, in some blocks, are one matrix product.
Blocks in which all inputs are silent cost nothing.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from skinsource.job import Stop, never, stop_if
from skinsource.limb import N_AXES, N_OUTPUTS, N_TAPS
from skinsource.rendering.drives import Booleans, reach
from skinsource.rendering.moments import Moments
from skinsource.rendering.response_spectra import Stack
from skinsource.rendering.segments import BLOCK_FFT, BLOCK_SAMPLES, Played
from skinsource.rendering.side_by_side import side_by_side
from skinsource.rendering.transforms import Complexes, Floats, forward, inverse

# Blocks whose spectra are made together: enough for matrix products to be worth it.
_GROUP = 4


class StreamedField:
    """The field of a long scene.

    Parameters
    ----------
    inputs
        What is played.
    stack
        Responses to their places, at ``BLOCK_FFT``; None where nothing is played.
    n_times
        Samples of the response.

    What takes long asks ``stop`` before each group of blocks; once true, `Stopped` is raised.
    """

    def __init__(self, inputs: Sequence[Played], stack: Stack | None, n_times: int) -> None:
        self._inputs = inputs
        self._stack = stack
        self.n_times = n_times
        self._moments: Moments | None = None

    def moments(self, stop: Stop = never) -> Moments:
        """Moments of the field over the whole response, all products."""
        if self._moments is None:
            second = np.zeros((N_OUTPUTS, N_AXES, N_AXES))
            total = np.zeros((N_OUTPUTS, N_AXES))
            for _, block in self.blocks(stop):
                second += block @ block.transpose(0, 2, 1)
                total += block.sum(axis=-1)
            self._moments = Moments(second, total)
        return self._moments

    def traces(self, outputs: tuple[int, ...], axes: tuple[int, ...], stop: Stop = never) -> Floats:
        """Acceleration of some outputs, (n_outputs, n_axes, n_times)."""
        result = np.zeros((len(outputs), len(axes), self.n_times))
        channels = [(output - 1) * N_AXES + axis for output in outputs for axis in axes]
        if not channels:
            return result
        for first, block in self._blocks(channels, stop):
            result[..., first : first + block.shape[-1]] = block.reshape(*result.shape[:2], -1)
        return result

    def everything(self) -> Floats:
        """All outputs and axes, (72 outputs, 3 axes, n_times): as long as the scene."""
        result = np.zeros((N_OUTPUTS, N_AXES, self.n_times))
        for first, block in self.blocks():
            result[..., first : first + block.shape[-1]] = block
        return result

    def blocks(self, stop: Stop = never) -> Iterator[tuple[int, Floats]]:
        """Yield first sample and samples, (72 outputs, 3 axes, n), of each block that is felt."""
        for first, block in self._blocks(None, stop):
            yield first, block.reshape(N_OUTPUTS, N_AXES, -1)

    def _blocks(self, channels: list[int] | None, stop: Stop) -> Iterator[tuple[int, Floats]]:
        """Yield first sample and samples, (n_channels, n); None: all channels."""
        if self._stack is None:
            return
        values = self._stack.values
        if channels is not None:
            values = np.ascontiguousarray(values[:, :, channels])
        starts = range(0, self.n_times, BLOCK_SAMPLES)
        for k in range(0, len(starts), _GROUP):
            stop_if(stop)
            segments = [self._segments(first) for first in starts[k : k + _GROUP]]
            played = [place for place, found in enumerate(segments) if found]
            if not played:
                continue
            spectra = self._spectra([segments[place] for place in played], values)
            samples = inverse(spectra, BLOCK_FFT).reshape(len(played), -1, BLOCK_FFT)
            for block, place in zip(samples, played, strict=True):
                first = starts[k + place]
                n = min(BLOCK_SAMPLES, self.n_times - first)
                felt = _felt(segments[place])[N_TAPS - 1 : N_TAPS - 1 + n]
                block = block[:, N_TAPS - 1 : N_TAPS - 1 + n]
                yield first, block if felt.all() else np.where(felt, block, 0.0)

    def _segments(self, first: int) -> dict[int, Floats]:
        """Drives that the block from sample ``first`` on needs, by input; but silent ones."""
        found = {number: one.segment(first) for number, one in enumerate(self._inputs)}
        return {number: piece for number, piece in found.items() if piece is not None}

    def _spectra(self, segments: list[dict[int, Floats]], values: Complexes) -> Complexes:
        """Spectra of blocks, (n_blocks * n_channels, n_bins), from ``values`` of the stack."""
        n_bins, n_places, n_channels = values.shape
        rows = list(self._stack.responses) if self._stack is not None else []
        drives = np.zeros((n_bins, len(segments), n_places), np.complex128)
        for block, found in enumerate(segments):
            for number, piece in found.items():
                one = self._inputs[number]
                spectrum = forward(piece, BLOCK_FFT) * one.weight
                drives[:, block, rows.index(one.location)] += spectrum
        spectra = np.empty((n_bins, len(segments), n_channels), np.complex128)
        half = n_bins // 2

        def multiply(part: slice) -> None:
            np.matmul(drives[part], values[part], out=spectra[part])

        side_by_side(lambda: multiply(slice(0, half)), lambda: multiply(slice(half, n_bins)))
        return spectra.reshape(n_bins, -1).T


def _felt(segments: dict[int, Floats]) -> Booleans:
    played = np.any([piece != 0.0 for piece in segments.values()], axis=0)
    return reach(played, N_TAPS)
