"""A design that is being exported: its quantities, lines about them, and the file that it goes to.

Every table and picture says which limb it is of, what was played, how it was computed and how
wrong it can be.
"""

import hashlib
import math
from collections.abc import Callable, Collection, Iterable, Iterator
from contextlib import contextmanager
from decimal import ROUND_CEILING, Context
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
import scipy

from skinsource.actuators.actuation import Actuation, ActuatorAt
from skinsource.base.conventions import ALL_AXES, Axes, Floats, axes_of
from skinsource.base.errors import TooInaccurateError, counted
from skinsource.base.files import replacing
from skinsource.base.job import Progress, Stop, never, silent, stop_if
from skinsource.design.amplitudes import amplitude_note
from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input, View, audible_inputs
from skinsource.design.labels import AXES, METHODS, SCALINGS, SPANS, label_of, limb_label
from skinsource.engine.gains import ESTIMATE_FACTOR, N_SAMPLES, TraceError
from skinsource.engine.quantities import new_graph, sources
from skinsource.engine.streaming import StreamedVibration
from skinsource.limbs.limb import Limb
from skinsource.limbs.scaling import Scaling
from skinsource.perception.validity import findings_lines
from skinsource.version import __version__

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
    largest_error
        Estimated error, relative to the largest sample, above which nothing is written.

    Attributes
    ----------
    limb, sample_rate_hz, n_times
        The limb; rate and samples of the response.
    all_outputs
        Numbers of the limb's outputs.
    streamed
        The vibration of a response that is too long to be computed at once, else None.
    """

    def __init__(
        self,
        design: Design,
        view: View,
        progress: Progress = silent,
        stop: Stop = never,
        largest_error: float = math.inf,
    ) -> None:
        self.design, self.view = design, view
        self.progress, self.stop, self._largest_error = progress, stop, largest_error
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

    def error_line(
        self, what: str, outputs: tuple[int, ...], axes: Axes | None = None, **changed: Any
    ) -> str:
        """Return a line on the error of the vibration at some outputs, as far as it is known.

        Parameters
        ----------
        what
            What the line is about.
        outputs, axes
            Outputs, and axes; None: those of the view.
        changed
            Sources that replace those of the design.

        Raises
        ------
        TooInaccurateError
            The error is larger than it may be.
        """
        axes = self.view.axes if axes is None else axes
        error: TraceError | None = self.value("trace_error", outputs=outputs, axes=axes, **changed)
        if error is None:
            return f"error of {what}: there is nothing to check"
        if not error.estimate <= self._largest_error and self._largest_error < math.inf:
            raise TooInaccurateError(
                f"The result may be wrong by {error.estimate:.1e} of its largest sample, more than "
                f"{self._largest_error:g}. Nothing was written; check for inputs that cancel each "
                "other."
            )
        return (
            f"error of {what}, relative to the largest sample: about {_two_digits(error.estimate)} "
            f"({ESTIMATE_FACTOR:g} x the worst of {N_SAMPLES} samples computed again exactly), at "
            f"most {_two_digits(error.bound)} (theory)"
        )

    def loudest_error_line(self, rms: Floats) -> str:
        """Return the line on the error at the loudest output, by the RMS of each, (n_outputs,)."""
        loudest = int(np.argmax(rms)) + 1
        return self.error_line(f"the traces of output {loudest}, the loudest", (loudest,))

    def field_blocks(self) -> Iterator[Floats]:
        """Yield the field piece by piece, (n_outputs, n_axes, n) in m/s², silence included."""
        if self.streamed is None:
            yield self.value("axis_traces", outputs=self.all_outputs, axes=ALL_AXES)
            return
        done = 0
        for first, block in self.streamed.blocks_of(*self.streamed.every_channel, self.stop):
            yield from self._silence(done, first)
            yield block
            done = first + block.shape[-1]
            self.progress(done, self.n_times, "Writing")
        yield from self._silence(done, self.n_times)

    def _silence(self, first: int, end: int) -> Iterator[Floats]:
        for start in range(first, end, PIECE_SAMPLES):
            yield np.zeros((self.limb.n_outputs, self.limb.n_axes, min(PIECE_SAMPLES, end - start)))


def _two_digits(error: float) -> str:
    """Return an error with two digits, rounded up."""
    return f"{float(Context(prec=2, rounding=ROUND_CEILING).create_decimal(error)):.2g}"


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
    where = "any other place" if actuator.place is None else f"place {actuator.place}"
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


def describe_levels(span: str, record_s: float, actuated: Actuation | None) -> str:
    """Return a line on the span that levels are the RMS over: of a whole record with its length.

    Files without levels have it too: a reader sees whether traces and levels belong together.
    """
    line = f"levels: RMS over the {label_of(SPANS, span).both.lower()}"
    length = f"{round(record_s, 3):g} s{', its length without the actuator' if actuated else ''}"
    return f"{line}, {length}" if span == "record" else line


def about_levels(exported: ExportedDesign) -> str:
    """Return `describe_levels` of a design."""
    record_s = exported.value("record_samples") / exported.sample_rate_hz
    return describe_levels(exported.view.span, record_s, exported.design.actuated)


def about_axes(exported: ExportedDesign) -> str:
    """Return a line on the axes and how they become one signal."""
    axes = axes_of(exported.limb.axes, exported.view.axes)
    return describe_projection(axes, exported.view.method)


def about(exported: ExportedDesign, *lines: str) -> list[str]:
    """Return ``lines`` between those on limb, scaling, inputs and validity, and on the method."""
    design, limb, streamed = exported.design, exported.limb, exported.streamed
    audible = audible_inputs(design.inputs)
    how = "cached spectra" if streamed is None else f"overlap-save {streamed.cut.n_fft}"
    return [
        "SkinSource studio",
        *(["SYNTHETIC LIMB: computed responses, not measured ones"] if limb.synthetic else []),
        *describe_played(design.limb, limb.note, design.scaling, design.inputs, design.actuated),
        *findings_lines(exported.value("validity")),
        *lines,
        f"computed by: {', '.join(f'{name} {number}' for name, number in versions().items())}",
        f"precision and method: float64, {how}",
        f"inputs heard: {len(audible)} of {len(design.inputs)}",
        *_about_data(limb, sorted({track.location for track in audible})),
    ]


def _about_data(limb: Limb, places: list[int]) -> list[str]:
    if not places:
        return []
    digest = hashlib.sha256()
    for place in places:
        digest.update(np.ascontiguousarray(limb.response_to(place), "<f8").data)
    numbers = ", ".join(map(str, places))
    return [f"responses to places {numbers}: SHA-256 {digest.hexdigest()}"]


def versions() -> dict[str, str]:
    """Return the versions of this program and of its numerical libraries."""
    return {"skinsource": __version__, "numpy": np.__version__, "scipy": scipy.__version__}


class Export:
    """A file that holds quantities of a design: computed, and written whole or not at all.

    Parameters
    ----------
    write
        Writes the file from a design that is being exported.
    """

    def __init__(self, write: Callable[[Path, ExportedDesign], None]) -> None:
        self.write, self.__doc__ = write, write.__doc__

    def __call__(
        self,
        path: Path,
        design: Design,
        view: View,
        *,
        progress: Progress = silent,
        stop: Stop = never,
        largest_error: float = math.inf,
    ) -> None:
        """Compute and write the file.

        Parameters
        ----------
        path
            The file.
        design, view
            The design, and what of it is written: axes, method, outputs, span.
        progress
            Called with (done, total, what is being done); a total of 0 while that is not known.
        stop
            Asked now and then; once true, nothing is written.
        largest_error
            Estimated error, relative to the largest sample, above which nothing is written.

        Raises
        ------
        StorageError
            The folder cannot be written, or the disk is full.
        TooInaccurateError
            The error is larger than ``largest_error``.
        Stopped
            ``stop`` said so.
        """
        self.write(path, ExportedDesign(design, view, progress, stop, largest_error))


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
    with replacing(path) as temporary:
        with temporary.open("w+b") as file:
            yield file
        stop_if(stop)
