"""A part of a scene: the field of one input, or of all the others together."""

from collections.abc import Callable

import numpy as np

from skinsource.rendering.drives import Booleans
from skinsource.rendering.transforms import Complexes, Floats, forward, inverse

#: Output, 1 to 72, and axis, 0 to 2.
Channel = tuple[int, int]


def rows_of(spectrum: Complexes, channels: list[Channel]) -> Complexes:
    """Some channels of (72 outputs, 3 axes, n_bins), one in a row."""
    return np.array([spectrum[output - 1, axis] for output, axis in channels])


class Part:
    """A field by its spectrum; single channels are brought back to time when asked for.

    What is missing is computed together.  A transform gives the same bits alone and beside others
    (a test sees to it), so what comes out does not depend on what was asked for before.

    Parameters
    ----------
    spectra
        Function from channels to their spectra, (n_channels, n_fft // 2 + 1).
    felt : (n_times,) of bool
        When the field can be felt at all; elsewhere it is exactly zero.
    exact_spectra
        Spectra of channels over exactly n_times samples, (n_channels, n_times // 2 + 1), where
        there is a shorter way to them than by their traces.
    """

    # Nothing here refers back to the part, so that an old one goes at once with its megabytes.
    __slots__ = (
        "__weakref__",
        "_exact_spectra",
        "_felt",
        "_n_fft",
        "_spectra",
        "_trace_spectra",
        "_traces",
    )

    def __init__(
        self,
        spectra: Callable[[list[Channel]], Complexes],
        n_fft: int,
        felt: Booleans,
        exact_spectra: Callable[[list[Channel]], Complexes] | None = None,
    ) -> None:
        self._spectra = spectra
        self._n_fft = n_fft
        self._felt = felt
        self._exact_spectra = exact_spectra
        self._traces = _Channels(np.empty((0, felt.size)))
        self._trace_spectra = _Channels(np.empty((0, felt.size // 2 + 1), np.complex128))

    def traces(self, outputs: tuple[int, ...], axes: tuple[int, ...]) -> Floats:
        """Acceleration of some outputs, (n_outputs, n_axes, n_times)."""
        missing = self._traces.missing(outputs, axes)
        if missing:
            samples = inverse(self._spectra(missing), self._n_fft)[:, : self._felt.size]
            self._traces.add(missing, np.where(self._felt, samples, 0.0))
        return self._traces.of(outputs, axes)

    def trace_spectra(self, outputs: tuple[int, ...], axes: tuple[int, ...]) -> Complexes:
        """Their spectra over exactly n_times samples, (n_outputs, n_axes, n_times // 2 + 1)."""
        missing = self._trace_spectra.missing(outputs, axes)
        if missing:
            if self._exact_spectra is None:
                self.traces(outputs, axes)
                traces = np.array([self._traces.known[channel] for channel in missing])
                found = forward(traces, self._felt.size)
            else:
                found = self._exact_spectra(missing)
            self._trace_spectra.add(missing, found)
        return self._trace_spectra.of(outputs, axes)


class _Channels:
    """Remembers single channels, and the latest selection of them as one array."""

    __slots__ = ("_latest", "known")

    def __init__(self, none: np.ndarray) -> None:
        self.known: dict[Channel, np.ndarray] = {}
        self._latest: tuple[list[Channel], np.ndarray] = [], none

    def missing(self, outputs: tuple[int, ...], axes: tuple[int, ...]) -> list[Channel]:
        return [channel for channel in _all(outputs, axes) if channel not in self.known]

    def add(self, channels: list[Channel], rows: np.ndarray) -> None:
        self.known.update(zip(channels, rows, strict=True))
        self._latest = channels, rows

    def of(self, outputs: tuple[int, ...], axes: tuple[int, ...]) -> np.ndarray:
        asked = _all(outputs, axes)
        channels, rows = self._latest
        if channels != asked:
            rows = np.array([self.known[channel] for channel in asked], rows.dtype)
            rows = rows.reshape(len(asked), self._latest[1].shape[-1])
            self._latest = asked, rows
        return rows.reshape(len(outputs), len(axes), rows.shape[-1])


def _all(outputs: tuple[int, ...], axes: tuple[int, ...]) -> list[Channel]:
    return [(output, axis) for output in outputs for axis in axes]
