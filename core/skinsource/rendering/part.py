"""A part of a scene: the field of one input, or of all the others together."""

from collections.abc import Callable

import numpy as np

from skinsource.rendering.drives import Booleans
from skinsource.rendering.transforms import Complexes, Floats, forward, inverse

_Channel = tuple[int, int]


class Part:
    """A field by its spectrum; single channels are brought back to time when asked for.

    Parameters
    ----------
    spectrum : (72 outputs, 3 axes, n_fft // 2 + 1)
        Spectrum of the field.
    felt : (n_times,) of bool
        When the field can be felt at all; elsewhere it is exactly zero.
    """

    def __init__(self, spectrum: Complexes, n_fft: int, felt: Booleans) -> None:
        self._spectrum = spectrum
        self._n_fft = n_fft
        self._felt = felt
        self._traces = _Channels(felt.size, self._to_time)
        self._trace_spectra = _Channels(felt.size // 2 + 1, self._to_frequency)

    def traces(self, outputs: tuple[int, ...], axes: tuple[int, ...]) -> Floats:
        """Acceleration of some outputs, (n_outputs, n_axes, n_times)."""
        return self._traces.of(outputs, axes)

    def trace_spectra(self, outputs: tuple[int, ...], axes: tuple[int, ...]) -> Complexes:
        """Their spectra over exactly n_times samples, (n_outputs, n_axes, n_times // 2 + 1)."""
        return self._trace_spectra.of(outputs, axes)

    def _to_time(self, channels: list[_Channel]) -> Floats:
        rows = np.array([self._spectrum[output - 1, axis] for output, axis in channels])
        samples = inverse(rows, self._n_fft)[:, : self._felt.size]
        return np.where(self._felt, samples, 0.0)

    def _to_frequency(self, channels: list[_Channel]) -> Complexes:
        traces = np.array([self.traces((output,), (axis,))[0, 0] for output, axis in channels])
        return forward(traces, self._felt.size)


class _Channels:
    """Remembers single channels, and computes the missing ones together.

    A transform gives the same bits alone and beside others (a test sees to it), so what comes out
    does not depend on what was asked for before.
    """

    def __init__(self, length: int, compute: Callable[[list[_Channel]], np.ndarray]) -> None:
        self._length = length
        self._compute = compute
        self._known: dict[_Channel, np.ndarray] = {}
        self._latest: tuple[object, np.ndarray] | None = None

    def of(self, outputs: tuple[int, ...], axes: tuple[int, ...]) -> np.ndarray:
        asked = outputs, axes
        if self._latest is None or self._latest[0] != asked:
            channels = [(output, axis) for output in outputs for axis in axes]
            missing = [channel for channel in channels if channel not in self._known]
            if missing:
                self._known.update(zip(missing, self._compute(missing), strict=True))
            rows = np.array([self._known[channel] for channel in channels])
            self._latest = asked, rows.reshape(len(outputs), len(axes), self._length)
        return self._latest[1]
