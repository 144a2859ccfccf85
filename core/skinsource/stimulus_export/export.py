"""A design goes to a file, or a folder, with a sidecar that says what its numbers mean."""

import hashlib
import os
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from skinsource.design import Design
from skinsource.errors import NotConfirmedError, StorageError
from skinsource.files import named, replacing, replacing_folder, write_bytes
from skinsource.job import Progress, Stop, never, silent, stop_if
from skinsource.stimulus import Stage
from skinsource.stimulus_export.options import StimulusOptions
from skinsource.stimulus_export.preparing import Prepared, prepared
from skinsource.stimulus_export.safety import Limit, objections
from skinsource.stimulus_export.sidecar import sidecar_of
from skinsource.stimulus_formats import Outgoing, format_named

#: Name of what shows that a folder is an exported stimulus.
MARK = "stimulus.json"
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
    """

    files: tuple[Path, ...]
    gain: float
    clip_count: int
    objections: tuple[str, ...]


def export_stimulus(
    design: Design,
    path: str | os.PathLike[str],
    format: str | None = None,
    rate_hz: int | None = None,
    *,
    full_scale: float | None = None,
    options: StimulusOptions | None = None,
    confirmed: bool = False,
    stages: Sequence[Stage] = (),
    limits: Sequence[Limit] = (),
    progress: Progress = silent,
    stop: Stop = never,
) -> Exported:
    """Write what the actuators get to play a design, and a sidecar ``PATH.json``.

    One channel per place in use, in the order of first use, of inputs that are heard: amplitude x
    gain x waveform, times one factor for all channels that brings the largest sample to full
    scale.  Time 0 of the file is time 0 of the design.  Nothing is left half written.

    Parameters
    ----------
    design, path
        What is played; the file, or folder.
    format
        One of `export_formats`; None: the one that the ending of ``path`` tells.
    rate_hz
        A whole number of hertz; None: the usual one.  Formats that know one rate only ignore it.
    full_scale
        Drive that becomes full scale, in its unit; None: as ``options`` say.
    options
        What shall differ from the above.
    confirmed
        Whether it is written even though samples clip or limits are passed.
    stages, limits
        What is done at the rate of the device; what the drives may not pass.
    progress, stop
        Told how far it is; once ``stop`` is true, nothing is written.

    Raises
    ------
    InvalidInputError
        Nothing is heard, or something cannot be had: a format, a rate, an option.
    NotConfirmedError
        Samples would clip or limits be passed.
    StorageError
        The folder cannot be written, or the disk is full.
    Stopped
        ``stop`` said so.
    """
    target = Path(path)
    kind, wanted = format_named(format, target), options or StimulusOptions()
    if full_scale is not None:
        wanted = replace(wanted, full_scale=full_scale)
    ready = prepared(
        design, target, kind, rate_hz, wanted, stages=stages, progress=progress, stop=stop
    )
    return write_prepared(ready, confirmed=confirmed, limits=limits, progress=progress, stop=stop)


def write_prepared(
    ready: Prepared,
    *,
    confirmed: bool = False,
    limits: Sequence[Limit] = (),
    progress: Progress = silent,
    stop: Stop = never,
) -> Exported:
    """Write what is ready; parameters and errors are those of `export_stimulus`."""
    found = objections(ready, limits)
    if found and not confirmed:
        raise NotConfirmedError(
            f"{' '.join(found)} Nothing was written. Lower the amplitudes, choose a larger full "
            "scale, or confirm that it shall be written all the same (--confirm)."
        )
    for path, outgoing in ready.files:
        one = replace(outgoing, progress=progress, stop=stop)
        (_write_folder if ready.format.folder else _write_file)(ready, path, one, found)
    return Exported(
        files=tuple(path for path, _ in ready.files),
        gain=ready.gain,
        clip_count=ready.clipped,
        objections=found,
    )


def sidecar_path(path: Path) -> Path:
    """Where the sidecar of a file or folder is."""
    return path.with_name(f"{path.name}.json")


def _write_file(
    ready: Prepared, path: Path, outgoing: Outgoing, confirmed: tuple[str, ...]
) -> None:
    if path.is_dir():
        raise StorageError(f"{named(path)}: a folder stands there. Choose another name.")
    with replacing(path) as temporary:
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
        # First the words, then the file that they are about: whoever finds the file finds them.
        for place, words in ready.format.beside(path, facts).items():
            write_bytes(place, words)
        write_bytes(sidecar_path(path), content)


def _write_folder(
    ready: Prepared, path: Path, outgoing: Outgoing, confirmed: tuple[str, ...]
) -> None:
    with replacing_folder(path, MARK) as temporary:
        facts = ready.format.write(outgoing, temporary)
        stop_if(outgoing.stop)
        n_bytes = sum(one.stat().st_size for one in temporary.rglob("*") if one.is_file())
        content = sidecar_of(
            ready, outgoing, facts, sha256=None, n_bytes=n_bytes, confirmed=confirmed
        )
        (temporary / MARK).write_bytes(content)
        write_bytes(sidecar_path(path), content)


def _sha256(path: Path) -> str:
    digest = hashlib.sha256()
    with path.open("rb") as file:
        while piece := file.read(_DIGEST_BYTES):
            digest.update(piece)
    return digest.hexdigest()
