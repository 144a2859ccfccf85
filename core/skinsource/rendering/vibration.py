"""The vibration by all voices, for the outputs that are looked at."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from skinsource.arrays import Complexes, Floats
from skinsource.job import Stop, never, stop_if
from skinsource.rendering.channels import ChannelsOnDemand
from skinsource.rendering.drives import delayed
from skinsource.rendering.projecting import Projection
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
        others = None if self.others is None else self.others.traces(outputs, axes)
        if self.edited is None or self.weight == 0.0:
            shape = len(outputs), len(axes), self.n_times
            return np.zeros(shape) if others is None else others.copy()
        unit, start = self.edited.traces(outputs, axes), self.delay_samples
        total = np.empty(unit.shape)
        total[..., :start] = 0.0
        np.multiply(unit[..., : self.n_times - start], self.weight, out=total[..., start:])
        if others is not None:
            total += others
        return total

    def transforms(
        self, outputs: tuple[int, ...], axes: tuple[int, ...], stop: Stop = never
    ) -> Complexes:
        """Their transforms over exactly n_times samples, (n_outputs, n_axes, n_times // 2 + 1)."""
        if self.streamed is not None:
            return one_by_one(self.streamed.traces(outputs, axes, stop), stop)
        return self._summed_spectra(outputs, axes, lambda spectra: spectra)

    def projected_transforms(self, outputs: tuple[int, ...], projection: Projection) -> Complexes:
        """The same of projected signals, (n_outputs, n_times // 2 + 1), which is no magnitude.

        Projected before they are summed: a third of the numbers.  Not of what is streamed.
        """
        return self._summed_spectra(outputs, projection.axis_numbers, projection.spectra)

    def _summed_spectra(
        self,
        outputs: tuple[int, ...],
        axes: tuple[int, ...],
        seen: Callable[[Complexes], Complexes],
    ) -> Complexes:
        """Sum of what is ``seen``, which is linear, of the vibrations by all voices."""
        total: Complexes | None = None
        if self.edited is not None and self.weight != 0.0:
            unit = seen(self.edited.trace_spectra(outputs, axes))
            total = self.weight * delayed(unit, self.delay_samples, self.n_times)
        if self.others is not None:
            others = seen(self.others.trace_spectra(outputs, axes))
            # Never the other way round: what others cause is remembered.
            total = others if total is None else np.add(total, others, out=total)
        if total is None:
            shape = len(outputs), len(axes), self.n_times // 2 + 1
            total = seen(np.zeros(shape, np.complex128))
        return total
