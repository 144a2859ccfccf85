"""The presets of a folder."""

import re
from dataclasses import dataclass
from pathlib import Path

from skinsource.errors import SkinSourceError
from skinsource.files import named
from skinsource.files.assets import data_folder, user_folder
from skinsource.files.reasons import reason_of
from skinsource.presets.preset import Preset
from skinsource.presets.preset_file import SUFFIX, read_preset, why

FOLDER = "presets"
#: Files of one folder that are read.
MOST_FILES = 2000

_DIGITS = re.compile(r"(\d+)")


@dataclass(frozen=True, slots=True, kw_only=True)
class Entry:
    """A preset and its file."""

    path: Path
    preset: Preset


@dataclass(frozen=True, slots=True, kw_only=True)
class Fault:
    """A file, or the folder, that was left out, and why."""

    path: Path
    sentence: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Shelf:
    """What a folder holds.

    Attributes
    ----------
    entries
        By name, "Tone 50 Hz" before "Tone 100 Hz".
    faults
        What was left out.
    """

    entries: tuple[Entry, ...] = ()
    faults: tuple[Fault, ...] = ()


def shipped_folder() -> Path:
    """Where the presets of the library lie."""
    return data_folder() / FOLDER


def users_folder() -> Path:
    """Where those of the user lie; it need not be there yet."""
    return user_folder() / FOLDER


def read_shelf(folder: Path) -> Shelf:
    """Read the presets of a folder; what is none, or cannot be read, is named and left out."""
    try:
        paths = sorted(path for path in folder.iterdir() if _is_meant(path))
    except (FileNotFoundError, NotADirectoryError):
        return Shelf()
    except OSError as error:
        words = f"{named(folder)}: cannot be looked through ({reason_of(error)})."
        return Shelf(faults=(Fault(path=folder, sentence=words),))
    entries, faults = [], []
    for path in paths[:MOST_FILES]:
        try:
            entries.append(Entry(path=path, preset=read_preset(path)))
        except SkinSourceError as error:
            faults.append(Fault(path=path, sentence=why(error)))
    if len(paths) > MOST_FILES:
        words = f"{named(folder)}: holds {len(paths)} presets, the first {MOST_FILES} are read."
        faults.append(Fault(path=folder, sentence=words))
    entries.sort(key=lambda entry: (_by_number(entry.preset.name), entry.path))
    return Shelf(entries=tuple(entries), faults=tuple(faults))


def _is_meant(path: Path) -> bool:
    return path.suffix == SUFFIX and not path.name.startswith(".")


def _by_number(name: str) -> tuple[tuple[int, str], ...]:
    """Whole numbers in a name count as such."""
    parts = _DIGITS.split(name.casefold())
    return tuple((int(part), "") if k % 2 else (0, part) for k, part in enumerate(parts))
