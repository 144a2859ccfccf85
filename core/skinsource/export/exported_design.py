"""A design that is being exported: its quantities, lines about them, and the file that it goes to.

Every table and picture says which limb it is of, what was played, how it was computed and how
wrong it can be.
"""

import hashlib
import math
import os
from collections.abc import Collection, Iterable, Iterator
from contextlib import contextmanager, suppress
from io import BufferedRandom, FileIO
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np
import scipy

from skinsource.actuators.actuation import Actuation, ActuatorAt
from skinsource.base.arrays import Floats
from skinsource.base.errors import TooInaccurateError
from skinsource.base.files import replacing
from skinsource.base.job import Progress, Stop, stop_if
from skinsource.base.measurement_conditions import ALL_AXES, Axes, axes_of
from skinsource.base.work import counted
from skinsource.design.amplitudes import amplitude_note
from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input, audible_inputs
from skinsource.design.labels import AXES, METHODS, SCALINGS, SPANS, label_of, limb_label
from skinsource.design.view import View
from skinsource.engine.gains import ESTIMATE_FACTOR, N_SAMPLES, TraceError
from skinsource.engine.quantities import new_graph, sources
from skinsource.engine.streaming import StreamedVibration
from skinsource.limbs.limb import Limb
from skinsource.limbs.scaling import Scaling
from skinsource.perception.validity import findings_lines as finding_words_of
from skinsource.version import __version__

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer


#: Samples that are written together.
PIECE_SAMPLES = 1536

#: Channels of a long response that take more than this are never held as a whole.
_MOST_HELD_BYTES = 64 * 2**20


class ExportedDesign:
    """Computes quantities of one design and view, with a graph of its own.

    Parameters
    ----------
    design, view
        Sources of the quantities.
    progress
        Called with (done, total, what is being done); a total of 0 while that is not known.
    stop
        Asked now and then; once true, `skinsource.base.errors.Stopped` is raised.

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

    def values(self, names: Collection[str], **changed: Any) -> dict[str, Any]:
        """Return quantities, with some of their sources ``changed``."""
        all_sources = {**sources(self.design, self.view), **changed}
        return self._graph.evaluate(names, all_sources, self.stop)

    def value(self, name: str, **changed: Any) -> Any:
        """Return one quantity."""
        return self.values({name}, **changed)[name]

    def holdable(self, outputs: tuple[int, ...], axes: Axes) -> tuple[int, ...]:
        """Return the first of ``outputs``, as many as fit into memory; all of a short response."""
        n_axes = len(axes_of(self.limb.axes, axes))
        bytes_each = n_axes * self.n_times * np.dtype(np.float64).itemsize
        return outputs if self.streamed is None else outputs[: _MOST_HELD_BYTES // bytes_each]

    def error(self, outputs: tuple[int, ...], axes: Axes) -> TraceError | None:
        """Return the error of the vibration at some outputs; None where nothing moves."""
        error: TraceError | None = self.value("trace_error", outputs=outputs, axes=axes)
        return error

    def error_of(self, field: Floats, outputs: tuple[int, ...]) -> TraceError | None:
        """Return the error of ``field``, (n_outputs, n_axes, n_times), at some outputs."""
        error: TraceError | None = self.value(
            "trace_error", outputs=outputs, axes=ALL_AXES, axis_traces=field
        )
        return error

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


def describe_played(
    limb: str,
    note: str,
    scaling: Scaling,
    inputs: Iterable[Input],
    actuated: Actuation | None = None,
) -> list[str]:
    """Return lines on the limb, its note, the scaling, the actuators and the inputs."""
    lines = [f"NOTE on the limb: {note}"] if note else []
    lines.append(
        f"limb: {limb_label(limb).title}, {limb}; scaling: {label_of(SCALINGS, scaling).both}"
    )
    meaning = amplitude_note(limb, "", scaling, actuated)
    if meaning:
        lines.append(f"amplitudes: {meaning}")
    if actuated is not None:
        lines.append(f"predicted through: {actuated.words}")
        lines += [
            f"  {_actuator_label(actuator)}: {actuator.model}" for actuator in actuated.actuators
        ]
    for track in inputs:
        muted = ", muted" if track.muted else ""
        solo = ", solo" if track.solo else ""
        curve = f", gain curve {track.gain_curve}" if track.gain_curve else ""
        lines.append(
            f"input at place {track.location}: amplitude {track.amplitude!r}, "
            f"{counted(len(track.clips), 'clip')}{curve}{muted}{solo}"
        )
        lines += [
            f"  clip of the input at place {track.location}: {clip_description(x)}"
            for x in track.clips
        ]
    return lines


def _actuator_label(actuator: ActuatorAt) -> str:
    where = "all other places" if actuator.place is None else f"place {actuator.place}"
    return f"{where}, {actuator.actuator}" if actuator.actuator else where


def clip_description(clip: Clip) -> str:
    """Return a description of a clip: waveform, onset, gain and effects."""
    gain = "" if clip.gain == 1.0 else f", gain {clip.gain!r}"
    through = "".join(f", {effect}" for effect in clip.effects if effect.on)
    muted = ", muted" if clip.muted else ""
    return f"{clip.waveform}, onset {clip.onset_s!r} s{gain}{through}{muted}"


def describe_projection(axes: str, method: str) -> str:
    """Return a line on the axes and how they become one signal."""
    how = "" if len(axes) == 1 else f"; method: {label_of(METHODS, method).both}"
    return f"axes: {label_of(AXES, axes).both}{how}"


def describe_levels(span: str) -> str:
    """Return a line on the span that levels are the RMS over.

    Files without levels have it too: a reader sees whether traces and levels belong together.
    """
    return f"levels: RMS over the {label_of(SPANS, span).both.lower()}"


def about_design(exported: ExportedDesign) -> list[str]:
    """Return lines on limb, scaling, inputs and validity."""
    design = exported.design
    lines = ["SkinSource studio"]
    if exported.limb.synthetic:
        lines.append("SYNTHETIC LIMB: computed responses, not measured ones")
    lines += describe_played(
        design.limb, exported.limb.note, design.scaling, design.inputs, design.actuated
    )
    return [*lines, *finding_words_of(exported.value("validity"))]


def about_axes(exported: ExportedDesign) -> str:
    """Return a line on the axes and how they become one signal."""
    axes = axes_of(exported.limb.axes, exported.view.axes)
    return describe_projection(axes, exported.view.method)


def about_levels(exported: ExportedDesign) -> str:
    """Return a line on the span that levels are the RMS over."""
    return describe_levels(exported.view.span)


def about_method(exported: ExportedDesign) -> list[str]:
    """Return lines on versions, method, and the responses that were used."""
    audible = audible_inputs(exported.design.inputs)
    how = (
        "cached spectra"
        if exported.streamed is None
        else f"overlap-save {exported.streamed.cut.n_fft}"
    )
    return [
        f"computed by: skinsource {__version__}, numpy {np.__version__}, scipy {scipy.__version__}",
        f"precision and method: float64, {how}",
        f"inputs heard: {len(audible)} of {len(exported.design.inputs)}",
        *_about_data(exported, sorted({track.location for track in audible})),
    ]


def about_error(error: TraceError | None, what: str) -> str:
    """Return a line on the error of ``what``, as far as it is known."""
    if error is None:
        return f"error of {what}: there is nothing to check"
    return (
        f"error of {what}, relative to the largest sample: about {error.estimate!r} "
        f"({ESTIMATE_FACTOR:g} x the worst of {N_SAMPLES} samples computed again exactly), at most "
        f"{error.bound!r} (theory)"
    )


def checked_error_line(exported: ExportedDesign, rms: Floats, largest_error: float) -> str:
    """Return the line on the error at the loudest output, by the RMS of each, (n_outputs,).

    Raises
    ------
    TooInaccurateError
        The error is larger than ``largest_error``.
    """
    loudest = int(np.argmax(rms)) + 1
    error = exported.error((loudest,), exported.view.axes)
    check_accuracy(error, largest_error)
    return about_error(error, f"the traces of output {loudest}, the loudest")


def listed(outputs: tuple[int, ...]) -> str:
    """Return some outputs as text."""
    return f"outputs {', '.join(map(str, outputs))}"


def check_accuracy(error: TraceError | None, largest_error: float) -> None:
    """Raise `TooInaccurateError` where the estimate is not at most ``largest_error``."""
    if error is not None and not error.estimate <= largest_error and largest_error < math.inf:
        raise TooInaccurateError(
            f"The result may be wrong by {error.estimate:.1e} of its largest sample, more than "
            f"{largest_error:g}. Nothing was written. Look for inputs that cancel each other."
        )


def _about_data(exported: ExportedDesign, places: list[int]) -> list[str]:
    if not places:
        return []
    digest = hashlib.sha256()
    for place in places:
        digest.update(np.ascontiguousarray(exported.limb.response_to(place), "<f8").data)
    numbers = ", ".join(map(str, places))
    return [f"responses to places {numbers}: SHA-256 {digest.hexdigest()}"]


_BYTES_BETWEEN_SYNCS = 8 * 2**20


@contextmanager
def output_file(path: Path, stop: Stop) -> Iterator[BinaryIO]:
    """Give an open file that replaces ``path`` at the end, whole or not at all.

    Raises
    ------
    StorageError
        The folder cannot be written, or the disk is full.
    Stopped
        ``stop`` said so at the end.
    """
    with replacing(path) as temporary, steadily_written(temporary) as file:
        try:
            yield file
            file.flush()
            os.fsync(file.fileno())
            stop_if(stop)
        except BaseException:
            # Delete it at once: freeing a gigabyte, when the file is closed, can take a second.
            # Systems that cannot delete an open file do so when it is closed.
            with suppress(OSError):
                temporary.unlink()
            raise


def steadily_written(path: Path) -> BinaryIO:
    """Open ``path`` for writing; the data is synchronised with the disk now and then."""
    return BufferedRandom(_SteadyFile(path, "w+b"))


class _SteadyFile(FileIO):
    """A file that is synchronised with the disk now and then.

    At the end little is left to synchronise, so that the user can stop it at any time: nothing
    stops the flush of a gigabyte.
    """

    _unsynced = 0

    def write(self, data: "ReadableBuffer") -> int:
        written = super().write(data)
        self._unsynced += written
        if self._unsynced >= _BYTES_BETWEEN_SYNCS:
            os.fsync(self.fileno())
            self._unsynced = 0
        return written
