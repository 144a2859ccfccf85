"""Writes a design to a file, or a folder, with a sidecar that says what its numbers mean."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path

from skinsource.actuators.actuation import Actuation
from skinsource.actuators.equalising import Equaliser
from skinsource.actuators.rigs import Rig
from skinsource.base.arguments import checking
from skinsource.base.errors import NotConfirmedError, StorageError
from skinsource.base.files import FilePath, path_text, replacing, replacing_folder
from skinsource.base.job import Progress, Stop, never, silent, stop_if
from skinsource.design.design import Design
from skinsource.engine.stimulus import Stage
from skinsource.export.formats import format_of
from skinsource.export.stimulus_export.options import Nothing, StimulusOptions
from skinsource.export.stimulus_export.preparing import Limit, PreparedStimulus, prepare_stimulus
from skinsource.export.stimulus_export.sidecar import sidecar_of, sidecar_path

#: The file that shows that a folder is an exported stimulus.
MARK = "stimulus.json"
#: Files that its player writes into the folder, session by session.
LOGS = "log*.csv"


@dataclass(frozen=True, slots=True, kw_only=True)
class Exported:
    """The files that were written, and facts about them.

    Attributes
    ----------
    files
        Files or folders, without sidecars: each has its own, with ``.json`` added to its name.
    gain
        The one factor between drives and samples.
    clip_count
        Samples that were cut off.
    objections
        Sentences that were confirmed.
    summary
        What was written, in a sentence.
    edges, loses, calibration, equalised
        Sentences as in the sidecars: on channels that begin or end hard, on the part of the drive
        that is not in the files, on whether m/s² follow from the samples, and on the equaliser.
        "" where there is nothing to report.
    """

    files: tuple[Path, ...]
    gain: float
    clip_count: int
    objections: tuple[str, ...]
    summary: str
    edges: str
    loses: str
    calibration: str
    equalised: str


@checking
def export_stimulus(
    design: Design,
    path: FilePath,
    format: str | None = None,
    rate_hz: int | None = None,
    *,
    full_scale: float | None = None,
    options: StimulusOptions | None = None,
    confirmed: bool = False,
    actuation: Actuation | Nothing | None = None,
    rig: Rig | Nothing | None = None,
    equaliser: Equaliser | Nothing | None = None,
    stages: Sequence[Stage] = (),
    limits: Sequence[Limit] = (),
    progress: Progress = silent,
    stop: Stop = never,
) -> Exported:
    """Write the drives of a design as a stimulus for actuators, and a sidecar ``PATH.json``.

    There is one channel per place in use, in the order of the inputs, of all audible inputs:
    amplitude x gain x waveform, times one factor that brings the largest sample to full scale.
    Time 0 is that of the design.  Nothing is left half written.

    Parameters
    ----------
    design, path
        The design; the file, or folder.
    format, rate_hz
        One of `export_formats`, None: by the ending of ``path``; whole hertz, None: the usual one.
    full_scale, options
        Drive that becomes full scale, in its unit; other deviations from the above.
    confirmed
        Whether it is written even though samples clip or limits are passed.
    actuation, rig, equaliser
        Actuators; the wiring; the filter that makes volts, for the rig or else for the actuators.
        None: those of the design; ``"none"``: no wiring, or no filter.
    stages, limits, progress, stop
        Processing at the rate of the device; limits of the drives; as those of a job.

    Raises
    ------
    InvalidInputError
        Nothing is audible, or a format, rate or option is not possible.
    NotConfirmedError
        Samples would clip, limits be passed, or a channel lose more than 1 dB to the rate.
    StorageError
        The folder cannot be written, or the disk is full.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import skinsource as ss
    >>> tone = ss.track(7, ss.waveforms.Tone(frequency_hz=100.0))
    >>> design = ss.Design(limb="synthetic-1", inputs=(tone,))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     exported = ss.export_stimulus(design, Path(folder) / "drive.wav", rate_hz=48000)
    ...     print([path.name for path in exported.files])
    ['drive.wav']
    """
    target = Path(path)
    options = options or StimulusOptions()
    if full_scale is not None:
        options = replace(options, full_scale=full_scale)
    progress(0, 0, "Computing")
    ready = prepare_stimulus(
        design,
        format_of(target, format),
        rate_hz,
        options,
        stages=stages,
        limits=limits,
        actuation=actuation,
        rig=rig,
        equaliser=equaliser,
        stop=stop,
    ).named(target)
    if not options.accept_loss and (advice := ready.advice_on_loss):
        raise NotConfirmedError(
            f"{ready.lost_at_rate} {advice[:-1]}, or accept the loss (--accept-loss)."
        )
    return write_prepared(ready, target, confirmed=confirmed, progress=progress, stop=stop)


def written_files(ready: PreparedStimulus, path: Path) -> tuple[tuple[Path, ...], ...]:
    """Return each file that an export to ``path`` writes, with its sidecar and its companion."""
    paths = (path.with_name(file.name) for file in ready.named(path).files)
    return tuple(
        (path, sidecar_path(path), *filter(None, (ready.format.companion_path(path),)))
        for path in paths
    )


def write_prepared(
    ready: PreparedStimulus,
    path: Path,
    *,
    confirmed: bool = False,
    progress: Progress = silent,
    stop: Stop = never,
) -> Exported:
    """Write a prepared stimulus to ``path``; parameters and errors are those of `export_stimulus`.

    A loss to the rate counts as accepted.
    """
    ready = ready.named(path)
    objections = ready.objections
    if objections and not confirmed:
        raise NotConfirmedError(
            f"{' '.join(objections)} Lower the amplitudes, choose a larger full scale, or confirm "
            "that it is written anyway (--confirm)."
        )
    paths = tuple(path.with_name(file.name) for file in ready.files)
    with ExitStack() as stack:
        # All are written before the first takes its place.
        for path, file in zip(paths, ready.files, strict=True):
            reporting = replace(file, progress=progress, stop=stop)
            _write_file(replace(ready, files=(reporting,)), path, objections, stack)
        stop_if(stop)
    return Exported(
        files=paths,
        gain=ready.gain,
        clip_count=sum(channel.clipped for channel in ready.channels),
        objections=objections,
        summary=ready.summary,
        edges=ready.edges,
        loses=ready.loses,
        calibration=ready.calibration,
        equalised=ready.equalised,
    )


def _write_file(
    ready: PreparedStimulus, path: Path, confirmed: tuple[str, ...], stack: ExitStack
) -> None:
    """Write a file, or fill a folder, with its sidecar; it gets its name as ``stack`` closes."""
    (file,), format = ready.files, ready.format
    if path.is_dir() and not format.folder:
        raise StorageError(f"{path_text(path)}: a folder has this name. Choose another name.")
    temporary = stack.enter_context(
        replacing_folder(path, MARK, kept=LOGS) if format.folder else replacing(path)
    )
    facts = format.write(file, temporary)
    stop_if(file.stop)
    # What the sidecar says of validity is a prediction, which may take longer than the file.
    file.progress(0, 0, "Computing")
    written = [temporary, *temporary.rglob("*")]
    content = sidecar_of(
        ready,
        facts,
        sha256=None if format.folder else _sha256(temporary),
        n_bytes=sum(part.stat().st_size for part in written if part.is_file()),
        confirmed=confirmed,
    )
    if format.folder:
        (temporary / MARK).write_bytes(content)
    # What is entered last is moved first: whoever finds the file finds its description.
    companion = format.companion_path(path)
    if companion is not None:
        stack.enter_context(replacing(companion)).write_bytes(format.companion_content(facts))
    stack.enter_context(replacing(sidecar_path(path))).write_bytes(content)


def _sha256(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
