"""Writing, renaming and deleting the user's presets."""

import re
from dataclasses import replace
from pathlib import Path

from skinsource.errors import InvalidInputError, StorageError
from skinsource.files import is_there, make_folder, named, write_bytes
from skinsource.files.reasons import reason_of
from skinsource.presets.preset import Preset
from skinsource.presets.preset_file import SUFFIX, preset_text, read_preset

_LONGEST_STEM = 60
#: No file of Windows can be called so, whatever follows behind a dot.
_TAKEN = re.compile(r"(con|prn|aux|nul|com\d|lpt\d)?")


def save_preset(folder: Path, preset: Preset) -> Path:
    """Write a preset to a new file in ``folder``, which is made where it is not there.

    Returns
    -------
    The file; it is called like the preset, as far as files can be.

    Raises
    ------
    StorageError
        The folder cannot be written, or the disk is full.
    InvalidInputError
        The preset holds so many samples that it could not be read again.
    """
    content = preset_text(preset).encode()
    make_folder(folder)
    path = _free(folder, preset.name)
    write_bytes(path, content)
    return path


def rename_preset(folder: Path, path: Path, name: str) -> Path:
    """Give a preset of ``folder`` another name, and its file one like it; returns the file.

    Raises
    ------
    StorageError, FileFormatError
        It cannot be read or written.
    InvalidInputError
        It is not in ``folder``, or the name is none.
    """
    _check_own(folder, path)
    before = read_preset(path)
    after = replace(before, name=" ".join(name.split()))
    if after == before:
        return path
    # Written first: whatever happens, one of them is there.
    new = save_preset(folder, after)
    delete_preset(folder, path)
    return new


def delete_preset(folder: Path, path: Path) -> None:
    """Delete the file of a preset of ``folder``.

    Raises
    ------
    StorageError
        It cannot be deleted.
    InvalidInputError
        It is not in ``folder``.
    """
    _check_own(folder, path)
    try:
        path.unlink(missing_ok=True)
    except OSError as error:
        raise StorageError(
            f"{named(path)}: cannot be deleted ({reason_of(error)}). Look whether another program "
            "holds it, or whether the folder is read-only."
        ) from error


def _check_own(folder: Path, path: Path) -> None:
    if path.parent != folder or path.suffix != SUFFIX:
        raise InvalidInputError(
            f"{named(path)} is no preset in {named(folder)}; only your own can be renamed and "
            "deleted"
        )


def _free(folder: Path, name: str) -> Path:
    """A file that is not there yet, called like the preset."""
    stem = re.sub(r"[^a-z0-9]+", "-", name.casefold()).strip("-")[:_LONGEST_STEM].strip("-")
    if _TAKEN.fullmatch(stem):
        stem = f"preset-{stem}".strip("-")
    path, number = folder / f"{stem}{SUFFIX}", 1
    while is_there(path):
        number += 1
        path = folder / f"{stem}-{number}{SUFFIX}"
    return path
