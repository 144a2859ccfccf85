"""The vibration by all voices, for the outputs that are looked at."""

from dataclasses import dataclass

import numpy as np

from skinsource.arrays import Complexes, Floats
from skinsource.job import Stop, never, stop_if
from skinsource.rendering.channels import ChannelsOnDemand
from skinsource.rendering.drives import delayed
from skinsource.rendering.streaming import StreamedVibration
from skinsource.rendering.transforms import forward


def one_by_one(signals: Floats, stop: Stop) -> Complexes:
    """Transforms over exactly the samples of long signals, (..., n_times // 2 + 1).

    One after the other: each takes much memory, and a tenth of a second.
    """
    found = np.empty((*signals.shape[:-1], signals.shape[-1] // 2 + 1), np.complex128)
    for place in np.ndindex(signals.shape[:-1]):
        stop_if(stop)
        found[place] = forward(signals[place], signals.shape[-1])
    return found


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Vibration:
    """What all voices cause together, as a sum of two, or as a stream.

    Attributes
    ----------
    n_times
        Samples of the response.
    others
        That by all voices but the edited one.
    edited, weight, delay_samples
        That by the edited voice at amplitude 1 and onset 0, what it is multiplied with, and how
        much later it starts.
    streamed
        That by all, where they play too long to be transformed at once.
    """

    n_times: int
    others: ChannelsOnDemand | None
    edited: ChannelsOnDemand | None
    weight: float
    delay_samples: int
    streamed: StreamedVibration | None

    def traces(self, outputs: tuple[int, ...], axes: tuple[int, ...], stop: Stop = never) -> Floats:
        """Acceleration of some outputs, (n_outputs, n_axes, n_times), in m/s²."""
        if self.streamed is not None:
            return self.streamed.traces(outputs, axes, stop)
        if self.others is not None:
            total = self.others.traces(outputs, axes).copy()
        else:
            total = np.zeros((len(outputs), len(axes), self.n_times))
        if self.edited is not None and self.weight != 0.0:
            unit = self.edited.traces(outputs, axes)
            started = self.n_times - self.delay_samples
            total[..., self.delay_samples :] += self.weight * unit[..., :started]
        return total

    def transforms(
        self, outputs: tuple[int, ...], axes: tuple[int, ...], stop: Stop = never
    ) -> Complexes:
        """Their transforms over exactly n_times samples, (n_outputs, n_axes, n_times // 2 + 1)."""
        if self.streamed is not None:
            return one_by_one(self.streamed.traces(outputs, axes, stop), stop)
        if self.others is not None:
            total = self.others.trace_spectra(outputs, axes).copy()
        else:
            total = np.zeros((len(outputs), len(axes), self.n_times // 2 + 1), np.complex128)
        if self.edited is not None and self.weight != 0.0:
            unit = self.edited.trace_spectra(outputs, axes)
            total += self.weight * delayed(unit, self.delay_samples, self.n_times)
        return total
