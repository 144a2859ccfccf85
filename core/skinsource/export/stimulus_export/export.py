"""A design goes to a file, or a folder, with a sidecar that says what its numbers mean."""

import hashlib
import os
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path

from skinsource.actuators.actuation import Actuation
from skinsource.actuators.equalising import Equaliser
from skinsource.actuators.rigs import Rig
from skinsource.base.errors import NotConfirmedError, StorageError
from skinsource.base.files import named, replacing, replacing_folder
from skinsource.base.job import Progress, Stop, never, silent, stop_if
from skinsource.design.design import Design
from skinsource.engine.stimulus import Stage
from skinsource.export.formats.format import Outgoing
from skinsource.export.formats.formats import format_named
from skinsource.export.stimulus_export.options import StimulusOptions, sidecar_path
from skinsource.export.stimulus_export.preparing import (
    Limit,
    PreparedStimulus,
    advice_on_loss,
    calibration_of,
    edges_of,
    equalised_of,
    loses_of,
    lost_at_rate,
    objections,
    prepare_stimulus,
)
from skinsource.export.stimulus_export.sidecar import sidecar_of

#: Name of what shows that a folder is an exported stimulus.
MARK = "stimulus.json"
#: What its player writes into it, session by session.
LOGS = "log*.csv"
_DIGEST_BYTES = 2**20


@dataclass(frozen=True, slots=True, kw_only=True)
class Exported:
    """What was written.

    Attributes
    ----------
    files
        Files or folders, without sidecars: each has its own, with ``.json`` added to its name.
    gain
        The one factor between drives and samples.
    clip_count
        Samples that were cut off.
    objections
        What was confirmed.
    edges, loses, calibration, equalised
        Which channels begin or end hard; what of the drive is not in the files; whether m/s² follow
        from the samples; what they are equalised for: in words, as in the sidecars.  "" where
        nothing is to be said.
    """

    files: tuple[Path, ...]
    gain: float
    clip_count: int
    objections: tuple[str, ...]
    edges: str
    loses: str
    calibration: str
    equalised: str


def export_stimulus(
    design: Design,
    path: str | os.PathLike[str],
    format: str | None = None,
    rate_hz: int | None = None,
    *,
    full_scale: float | None = None,
    options: StimulusOptions | None = None,
    confirmed: bool = False,
    actuation: Actuation | None = None,
    rig: Rig | None = None,
    equaliser: Equaliser | None = None,
    stages: Sequence[Stage] = (),
    limits: Sequence[Limit] = (),
    progress: Progress = silent,
    stop: Stop = never,
) -> Exported:
    """Write what the actuators get to play a design, and a sidecar ``PATH.json``.

    One channel per place in use, in the order of first use, of what is heard: amplitude x gain x
    waveform, times one factor that brings the largest sample to full scale.  Time 0 is that of
    the design.  Nothing is left half written.

    Parameters
    ----------
    design, path
        What is played; the file, or folder.
    format, rate_hz
        One of `export_formats`, None: as ``path`` ends; whole hertz, None: the usual one.
    full_scale, options
        Drive that becomes full scale, in its unit; what else shall differ from the above.
    confirmed
        Whether it is written even though samples clip or limits are passed.
    actuation, rig, equaliser
        Actuators, None: those that the design is predicted through; what is wired; what makes
        volts, for the rig or else for the actuators.
    stages, limits, progress, stop
        What is done at the rate of the device; what the drives may not pass; as of a job.

    Raises
    ------
    InvalidInputError
        Nothing is heard, or something cannot be had.
    NotConfirmedError
        Samples would clip, limits be passed, or a channel lose more than 1 dB to the rate.
    StorageError
        The folder cannot be written, or the disk is full.
    """
    target = Path(path)
    options = options or StimulusOptions()
    progress(0, 0, "Computing")
    ready = prepare_stimulus(
        design,
        target,
        format_named(format, target),
        rate_hz,
        _with_full_scale(options, full_scale),
        stages=stages,
        actuation=actuation,
        rig=rig,
        equaliser=equaliser,
        stop=stop,
    )
    if not options.accept_loss and (refused := advice_on_loss(ready)):
        lost = lost_at_rate([outgoing for _, outgoing in ready.files])
        raise NotConfirmedError(f"{lost} {refused[:-1]}, or accept the loss (--accept-loss).")
    return write_prepared(ready, confirmed=confirmed, limits=limits, progress=progress, stop=stop)


def write_prepared(
    ready: PreparedStimulus,
    *,
    confirmed: bool = False,
    limits: Sequence[Limit] = (),
    progress: Progress = silent,
    stop: Stop = never,
) -> Exported:
    """Write what is ready; parameters and errors are those of `export_stimulus`."""
    objected = objections(ready, limits)
    if objected and not confirmed:
        raise NotConfirmedError(
            f"{' '.join(objected)} Nothing was written. Lower the amplitudes, choose a larger full "
            "scale, or confirm that it shall be written all the same (--confirm)."
        )
    with ExitStack() as stack:
        # All are written before the first takes its place.
        for path, outgoing in ready.files:
            reporting = replace(outgoing, progress=progress, stop=stop)
            (_write_folder if ready.format.folder else _write_file)(
                ready, path, reporting, objected, stack
            )
        stop_if(stop)
    return Exported(
        files=tuple(path for path, _ in ready.files),
        gain=ready.gain,
        clip_count=ready.clipped,
        objections=objected,
        edges=edges_of(ready),
        loses=loses_of(ready),
        calibration=calibration_of(ready),
        equalised=equalised_of(ready),
    )


def _with_full_scale(options: StimulusOptions, full_scale: float | None) -> StimulusOptions:
    return options if full_scale is None else replace(options, full_scale=full_scale)


def _write_file(
    ready: PreparedStimulus,
    path: Path,
    outgoing: Outgoing,
    confirmed: tuple[str, ...],
    stack: ExitStack,
) -> None:
    if path.is_dir():
        raise StorageError(f"{named(path)}: a folder stands there. Choose another name.")
    temporary = stack.enter_context(replacing(path))
    facts = ready.format.write(outgoing, temporary)
    stop_if(outgoing.stop)
    content = sidecar_of(
        ready,
        outgoing,
        facts,
        sha256=_sha256(temporary),
        n_bytes=temporary.stat().st_size,
        confirmed=confirmed,
    )
    # What is entered last is moved first: whoever finds the file finds the words about it.
    other = ready.format.beside(path)
    if other is not None:
        stack.enter_context(replacing(other)).write_bytes(ready.format.words_beside(facts))
    stack.enter_context(replacing(sidecar_path(path))).write_bytes(content)


def _write_folder(
    ready: PreparedStimulus,
    path: Path,
    outgoing: Outgoing,
    confirmed: tuple[str, ...],
    stack: ExitStack,
) -> None:
    temporary = stack.enter_context(replacing_folder(path, MARK, kept=LOGS))
    facts = ready.format.write(outgoing, temporary)
    stop_if(outgoing.stop)
    n_bytes = sum(file.stat().st_size for file in temporary.rglob("*") if file.is_file())
    content = sidecar_of(ready, outgoing, facts, sha256=None, n_bytes=n_bytes, confirmed=confirmed)
    (temporary / MARK).write_bytes(content)
    stack.enter_context(replacing(sidecar_path(path))).write_bytes(content)


def _sha256(path: Path) -> str:
    digest = hashlib.sha256()
    with path.open("rb") as file:
        while piece := file.read(_DIGEST_BYTES):
            digest.update(piece)
    return digest.hexdigest()
