"""The limbs that were imported: a file each, in a folder beside the measured dataset."""

from collections.abc import Iterable
from pathlib import Path

from skinsource.arrays import Floats
from skinsource.errors import StorageError, UnknownLimbError
from skinsource.files import is_file, make_folder
from skinsource.files.assets import user_folder
from skinsource.files.writing import explained
from skinsource.job import Progress, Stop, never, silent
from skinsource.limb import Limb
from skinsource.own_limbs.content import OwnLimb, is_free_name
from skinsource.own_limbs.limb_file import LimbFile, write_limb_file
from skinsource.quoting import quoted

FOLDER, ENDING = "limbs", ".limb"


def own_limb_path(name: str) -> Path:
    """Where an own limb is kept, or would be."""
    return user_folder() / FOLDER / f"own-{name}{ENDING}"


def own_limb_names() -> tuple[str, ...]:
    """Names of the limbs that were imported, in the order of the alphabet."""
    try:
        found = sorted((user_folder() / FOLDER).glob(f"own-*{ENDING}"))
        names = [path.name.removeprefix("own-").removesuffix(ENDING) for path in found]
        return tuple(name for name in names if is_free_name(name) and is_file(own_limb_path(name)))
    except (OSError, StorageError):
        return ()  # of a folder that may not be searched nothing can be used either


def install_limb(
    limb: OwnLimb,
    responses: Iterable[Floats],
    *,
    progress: Progress = silent,
    stop: Stop = never,
) -> Path:
    """Keep a limb under its name, in place of one that has this name already.

    Parameters and errors are those of `skinsource.own_limbs.limb_file.write_limb_file`.
    """
    path = own_limb_path(limb.name)
    make_folder(path.parent)
    write_limb_file(path, limb, responses, progress=progress, stop=stop)
    return path


def load_own_limb(name: str) -> Limb:
    """Open an own limb: its map now, its responses one input at a time when touched.

    Raises
    ------
    UnknownLimbError
        There is none of this name.
    FileFormatError, StorageError
        Its file is damaged, or cannot be read; raised by ``response_to`` too.
    """
    file = _opened(name)
    held = file.limb
    return Limb(
        name=name,
        hand_length_mm=held.hand_length_mm,
        synthetic=held.synthetic,
        map=held.map(),
        read_response=file.response,
        sample_rate_hz=held.sample_rate_hz,
        axes=held.axes,
        pre_trigger_delay_s=held.pre_trigger_delay_s,
        band_hz=held.band_hz,
        per_unit_drive=held.per_unit_drive,
        note=held.note,
        shape=held.shape,
    )


def mirror_limb(
    name: str, mirrored: bool, *, progress: Progress = silent, stop: Stop = never
) -> None:
    """Show a limb the other way round, as a right hand, or as it is.

    Raises as `load_own_limb`, and `Stopped` where ``stop`` said so: it is as it was then.
    """
    file = _opened(name)
    limb = file.limb.shown_mirrored(mirrored)
    responses = map(file.response, range(1, limb.n_inputs + 1))
    write_limb_file(file.path, limb, responses, progress=progress, stop=stop)


def remove_limb(name: str) -> None:
    """Delete an own limb; raises as `load_own_limb`, but damage is no hindrance."""
    path = existing_path(name)
    with explained(path):
        path.unlink()


def _opened(name: str) -> LimbFile:
    return LimbFile(existing_path(name))


def existing_path(name: str) -> Path:
    """Where an own limb is kept; raises `UnknownLimbError` where there is none."""
    if not is_free_name(name) or not is_file(own_limb_path(name)):
        raise UnknownLimbError(
            f"no own limb is called {quoted(name)}; there are "
            f"{', '.join(own_limb_names()) or 'none'}"
        )
    return own_limb_path(name)
