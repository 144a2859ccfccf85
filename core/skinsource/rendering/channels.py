"""A vibration by its spectrum, whose channels are brought back to time when they are looked at."""

from collections.abc import Callable

import numpy as np

from skinsource.arrays import Booleans, Complexes, Floats
from skinsource.rendering.transforms import forward, inverse

#: Output, 1, 2, 3, …, and axis, 0 to 2.
Channel = tuple[int, int]


def rows_of(spectrum: Complexes, channels: list[Channel]) -> Complexes:
    """Some channels of (n_outputs, 3 axes, n_bins), one in a row; a copy."""
    return np.array([spectrum[output - 1, axis] for output, axis in channels])


def driven(rows: Complexes, drive: Complexes) -> Complexes:
    """Rows times the spectrum of a drive, (n_bins,), in their place: one pass of memory less."""
    return np.multiply(rows, drive, out=rows)


class ChannelsOnDemand:
    """A vibration by its spectrum; channels are brought back to time when asked for.

    What is missing is computed together.  A transform gives the same bits alone and beside others
    (a test sees to it), so what comes out does not depend on what was asked for before.

    Parameters
    ----------
    spectra
        Function from channels to their spectra, (n_channels, n_fft // 2 + 1).
    active : (n_times,) of bool
        When the skin can move at all; elsewhere it is exactly at rest.
    exact_spectra
        Spectra of channels over exactly n_times samples, (n_channels, n_times // 2 + 1), where
        there is a shorter way to them than by their traces.
    """

    # Nothing here refers back to it, so that an old one goes at once with its megabytes.
    __slots__ = (
        "__weakref__",
        "_active",
        "_exact_spectra",
        "_n_fft",
        "_spectra",
        "_trace_spectra",
        "_traces",
    )

    def __init__(
        self,
        spectra: Callable[[list[Channel]], Complexes],
        n_fft: int,
        active: Booleans,
        exact_spectra: Callable[[list[Channel]], Complexes] | None = None,
    ) -> None:
        self._spectra = spectra
        self._n_fft = n_fft
        self._active = active
        self._exact_spectra = exact_spectra
        self._traces = _Channels(np.empty((0, active.size)))
        self._trace_spectra = _Channels(np.empty((0, active.size // 2 + 1), np.complex128))

    def traces(self, outputs: tuple[int, ...], axes: tuple[int, ...]) -> Floats:
        """Acceleration of some outputs, (n_outputs, n_axes, n_times)."""
        missing = self._traces.missing(outputs, axes)
        if missing:
            samples = inverse(self._spectra(missing), self._n_fft)[:, : self._active.size]
            np.copyto(samples, 0.0, where=~self._active)
            self._traces.add(missing, samples)
        return self._traces.of(outputs, axes)

    def trace_spectra(self, outputs: tuple[int, ...], axes: tuple[int, ...]) -> Complexes:
        """Their spectra over exactly n_times samples, (n_outputs, n_axes, n_times // 2 + 1)."""
        missing = self._trace_spectra.missing(outputs, axes)
        if missing:
            if self._exact_spectra is None:
                self.traces(outputs, axes)
                traces = np.array([self._traces.known[channel] for channel in missing])
                found = forward(traces, self._active.size)
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
