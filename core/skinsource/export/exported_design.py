"""A design that is being exported, with a graph of its own."""

from collections.abc import Collection, Iterator
from typing import Any

import numpy as np

from skinsource.arrays import Floats
from skinsource.design import Design
from skinsource.job import Progress, Stop
from skinsource.limb import ALL_AXES, Axes, Limb, axes_of
from skinsource.quantities import new_graph, sources
from skinsource.rendering.check import TraceError
from skinsource.rendering.streaming import StreamedVibration
from skinsource.view import View

#: Samples that are written together.
PIECE_SAMPLES = 1536

#: Channels of a long response that take more than this are never held as a whole.
_MOST_HELD_BYTES = 64 * 2**20


class ExportedDesign:
    """Computes what is exported of one design and view.

    Parameters
    ----------
    design, view
        What is exported.
    progress
        Told how far it is; a total of 0 while that is not known.
    stop
        Asked now and then; once true, `skinsource.errors.Stopped` is raised.

    Attributes
    ----------
    limb, sample_rate_hz, n_times
        The limb; rate and samples of the response.
    all_outputs
        Numbers of the limb's outputs.
    streamed
        The vibration of a response that is too long to be computed at once, else None.
    """

    def __init__(self, design: Design, view: View, progress: Progress, stop: Stop) -> None:
        self.design, self.view = design, view
        self.progress, self.stop = progress, stop
        self._graph = new_graph()
        progress(0, 0, "Computing")
        basis = self.values(
            {"limb_data", "sample_rate_hz", "response_samples", "streamed_vibration"}
        )
        self.limb: Limb = basis["limb_data"]
        self.all_outputs = tuple(range(1, self.limb.n_outputs + 1))
        self.sample_rate_hz: float = basis["sample_rate_hz"]
        self.n_times: int = basis["response_samples"]
        self.streamed: StreamedVibration | None = basis["streamed_vibration"]

    def values(self, wanted: Collection[str], **changed: Any) -> dict[str, Any]:
        """Return quantities, with some of what they start from ``changed``."""
        given = {**sources(self.design, self.view), **changed}
        return self._graph.evaluate(wanted, given, self.stop)

    def value(self, wanted: str, **changed: Any) -> Any:
        """Return one quantity."""
        return self.values({wanted}, **changed)[wanted]

    def holdable(self, outputs: tuple[int, ...], axes: Axes) -> tuple[int, ...]:
        """The first of ``outputs``, as many as may be held from beginning to end; all if short."""
        n_axes = len(axes_of(self.limb.axes, axes))
        bytes_each = n_axes * self.n_times * np.dtype(np.float64).itemsize
        return outputs if self.streamed is None else outputs[: _MOST_HELD_BYTES // bytes_each]

    def error(self, outputs: tuple[int, ...], axes: Axes) -> TraceError | None:
        """Error of the vibration at some outputs; None where there is none."""
        found: TraceError | None = self.value("trace_error", outputs=outputs, axes=axes)
        return found

    def error_of(self, field: Floats, outputs: tuple[int, ...]) -> TraceError | None:
        """Error of ``field``, (n_outputs, n_axes, n_times), at some outputs."""
        found: TraceError | None = self.value(
            "trace_error", outputs=outputs, axes=ALL_AXES, axis_traces=field
        )
        return found

    def field_blocks(self) -> Iterator[Floats]:
        """Yield the field piece by piece, (n_outputs, n_axes, n) in m/s², silence included."""
        if self.streamed is None:
            yield self.value("axis_traces", outputs=self.all_outputs, axes=ALL_AXES)
            return
        done = 0
        for first, block in self.streamed.blocks(self.stop):
            yield from self._silence(done, first)
            yield block
            done = first + block.shape[-1]
            self.progress(done, self.n_times, "Writing")
        yield from self._silence(done, self.n_times)

    def _silence(self, first: int, end: int) -> Iterator[Floats]:
        for start in range(first, end, PIECE_SAMPLES):
            yield np.zeros((self.limb.n_outputs, self.limb.n_axes, min(PIECE_SAMPLES, end - start)))
