"""Presets: clips under a name, to be placed in any design.

A preset is a `skinsource.design.clips.Fragment` with a name, tags, a source and a description, in a
file of its own: a JSON text with a checksum, see `skinsource.specs.codec`.  The shipped presets are
in the data folder of the library; those of the user are in the user's folder.
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from skinsource.base.assets import data_folder, user_folder
from skinsource.base.conventions import Floats
from skinsource.base.errors import FileFormatError, InvalidInputError, SkinSourceError, sentence
from skinsource.base.files import (
    make_folder,
    path_exists,
    path_text,
    read_bytes,
    reason_of,
    storage_errors_of,
    write_bytes,
)
from skinsource.base.json_text import MAX_TEXT_BYTES
from skinsource.design.clips import MAX_EFFECTS, Clip, Fragment
from skinsource.design.design import Design, Input, audible_indices
from skinsource.design.edits.clips import fragment_of
from skinsource.design.effects.level import Envelope
from skinsource.design.waveforms.samples import Layers
from skinsource.specs import codec, fields, models
from skinsource.specs.breakpoints import Breakpoint
from skinsource.specs.numbers import ListSpec, ModelSpec
from skinsource.specs.spec import Address, TextSpec

MAX_TAGS = 20

NAME = TextSpec(label="Name", longest=100, one_line=True)
TAG = TextSpec(label="Tag", longest=40, one_line=True)
TAGS = ListSpec(label="Tags", of=TAG, most=MAX_TAGS, different=True)
SOURCE = TextSpec(label="Source", longest=1000)
DESCRIPTION = TextSpec(label="Description", longest=5000)
FRAGMENT = ModelSpec(label="Clips", kinds=lambda: (Fragment,))


@dataclass(frozen=True, slots=True, kw_only=True)
class Preset:
    """Clips of one or more tracks under a name.

    Attributes
    ----------
    name
        Says what it is for; not empty.
    tags
        Words for the search.
    source
        Origin of its numbers.
    description
        One or two sentences.
    """

    name: str = fields.field(NAME)
    tags: tuple[str, ...] = fields.field(TAGS, ())
    source: str = fields.text("", SOURCE)
    description: str = fields.text("", DESCRIPTION)
    fragment: Fragment = fields.field(FRAGMENT)

    def __post_init__(self) -> None:
        fields.check(self)
        if not self.name.strip():
            raise InvalidInputError("Preset.name is empty; give it one that says what it is for")


def tags_of(text: str) -> tuple[str, ...]:
    """Split a typed text at commas into tags, each once and without blanks around it.

    >>> tags_of("tap, texture,, tap ")
    ('tap', 'texture')
    """
    tags = (" ".join(part.split()) for part in text.split(","))
    return tuple(dict.fromkeys(tag for tag in tags if tag))


#: Name of the format in the text of a preset.
FORMAT = "skinsource preset"
SUFFIX = ".skinpreset"


def preset_text(preset: Preset) -> str:
    """Return a preset as a text; equal presets give equal texts.

    Raises
    ------
    InvalidInputError
        The preset holds too many samples to be read again.
    """
    return codec.to_text(models.encode(preset), FORMAT) + "\n"


def preset_from(text: str) -> Preset:
    """Read a preset that `preset_text` wrote.

    Raises
    ------
    FileFormatError, InvalidInputError
        The text is something else, is damaged, or was written in another version.
    """
    return models.decode(codec.from_text(text, FORMAT), (Preset,), Address())


def read_preset(path: Path) -> Preset:
    """Read the preset in a file.

    Raises
    ------
    StorageError
        The file cannot be read.
    FileFormatError
        The file holds no preset; the message says why.
    """
    content = read_bytes(path, most=MAX_TEXT_BYTES + 1)
    try:
        return preset_from(content.decode(errors="replace"))
    except (FileFormatError, InvalidInputError) as error:
        raise FileFormatError(f"{path_text(Path(path.name))}: {sentence(str(error))}") from error


FOLDER = "presets"
#: Most files of a folder that are read.
MOST_FILES = 2000

_DIGITS = re.compile(r"(\d+)")


@dataclass(frozen=True, slots=True, kw_only=True)
class Entry:
    """A preset and its file."""

    path: Path
    preset: Preset


@dataclass(frozen=True, slots=True, kw_only=True)
class Fault:
    """A file, or the folder, that could not be read, and why."""

    path: Path
    sentence: str


@dataclass(frozen=True, slots=True, kw_only=True)
class PresetFolder:
    """The content of a folder.

    Attributes
    ----------
    entries
        Sorted by name, "Tone 50 Hz" before "Tone 100 Hz".
    faults
        Files that could not be read.
    """

    entries: tuple[Entry, ...] = ()
    faults: tuple[Fault, ...] = ()


def shipped_folder() -> Path:
    """Return the folder of the shipped presets."""
    return data_folder() / FOLDER


def users_folder() -> Path:
    """Return the folder of the user's presets, which need not exist yet."""
    return user_folder() / FOLDER


def read_preset_folder(folder: Path) -> PresetFolder:
    """Read the presets of a folder; files that cannot be read are listed as faults."""
    try:
        visible = (path for path in folder.iterdir() if not path.name.startswith("."))
        paths = sorted(path for path in visible if path.suffix == SUFFIX)
    except (FileNotFoundError, NotADirectoryError):
        return PresetFolder()
    except OSError as error:
        problem = f"{path_text(folder)}: cannot be searched ({reason_of(error)})."
        return PresetFolder(faults=(Fault(path=folder, sentence=problem),))
    entries, faults = [], []
    for path in paths[:MOST_FILES]:
        try:
            entries.append(Entry(path=path, preset=read_preset(path)))
        except SkinSourceError as error:
            faults.append(Fault(path=path, sentence=sentence(str(error))))
    if len(paths) > MOST_FILES:
        problem = (
            f"{path_text(folder)}: holds {len(paths)} presets, the first {MOST_FILES} are read."
        )
        faults.append(Fault(path=folder, sentence=problem))
    entries.sort(key=lambda entry: (by_number(entry.preset.name), entry.path))
    return PresetFolder(entries=tuple(entries), faults=tuple(faults))


def by_number(name: str) -> tuple[tuple[int, str], ...]:
    """Return a sort key in which numbers within a name count as numbers."""
    parts = _DIGITS.split(name.casefold())
    return tuple((int(part), "") if k % 2 else (0, part) for k, part in enumerate(parts))


def matching(entries: Iterable[Entry], query: str, tag: str = "") -> tuple[Entry, ...]:
    """Return the entries that hold every word of ``query``, and have ``tag`` if one is given.

    Words are searched in name, tags, description and source, whatever their case.  Entries with all
    words in the name come first, then those with all in name and tags, then the others; within
    these groups the order stays.
    """
    terms = query.casefold().split()
    ranked = [
        (rank, entry)
        for entry in entries
        if (not tag or tag in entry.preset.tags) and (rank := _rank(entry, terms)) is not None
    ]
    return tuple(entry for _, entry in sorted(ranked, key=lambda pair: pair[0]))


def _rank(entry: Entry, terms: list[str]) -> int | None:
    """Return 0 if the name holds all terms, 1 with the tags, 2 with all texts; else None."""
    preset = entry.preset
    name = preset.name.casefold()
    tagged = "\n".join((name, *preset.tags)).casefold()
    everything = "\n".join((tagged, preset.description, preset.source)).casefold()
    for rank, searched in enumerate((name, tagged, everything)):
        if all(term in searched for term in terms):
            return rank
    return None


_LONGEST_STEM = 60
#: Names that Windows reserves, whatever the suffix.
_RESERVED = re.compile(r"(con|prn|aux|nul|com\d|lpt\d)?")


def save_preset(folder: Path, preset: Preset) -> Path:
    """Write a preset to a new file in ``folder``, which is made if needed.

    Returns
    -------
    The file, whose name follows the name of the preset.

    Raises
    ------
    StorageError
        The folder cannot be written, or the disk is full.
    InvalidInputError
        The preset holds too many samples to be read again.
    """
    content = preset_text(preset).encode()
    make_folder(folder)
    path = _free_path(folder, preset.name)
    write_bytes(path, content)
    return path


def rename_preset(folder: Path, path: Path, name: str) -> Path:
    """Rename a preset of ``folder`` and its file; return the new file.

    Raises
    ------
    StorageError, FileFormatError
        The preset cannot be read or written.
    InvalidInputError
        The preset is not in ``folder``, or the name is not allowed.
    """
    _check_own(folder, path)
    before = read_preset(path)
    after = replace(before, name=" ".join(name.split()))
    if after == before:
        return path
    # The new file comes first, so that a failure never loses the preset.
    new = save_preset(folder, after)
    delete_preset(folder, path)
    return new


def delete_preset(folder: Path, path: Path) -> None:
    """Delete the file of a preset of ``folder``.

    Raises
    ------
    StorageError
        The file cannot be deleted.
    InvalidInputError
        The preset is not in ``folder``.
    """
    _check_own(folder, path)
    with storage_errors_of(path):
        path.unlink(missing_ok=True)


def _check_own(folder: Path, path: Path) -> None:
    if path.parent != folder or path.suffix != SUFFIX:
        raise InvalidInputError(
            f"{path_text(path)} is not a preset in {path_text(folder)}; choose one of your own"
        )


def _free_path(folder: Path, name: str) -> Path:
    """Return the path of a new file named after the preset."""
    stem = re.sub(r"[^a-z0-9]+", "-", name.casefold()).strip("-")[:_LONGEST_STEM].strip("-")
    if _RESERVED.fullmatch(stem):
        stem = f"preset-{stem}".strip("-")
    path, number = folder / f"{stem}{SUFFIX}", 1
    while path_exists(path):
        number += 1
        path = folder / f"{stem}-{number}{SUFFIX}"
    return path


def whole_design(design: Design) -> Fragment | None:
    """Return all clips of a design as a fragment that sounds the same; None without clips.

    A fragment has no mute, solo or gain curve of tracks: clips of silent tracks become muted, and a
    gain curve becomes an `Envelope` of each clip of its track.
    """
    audible = audible_indices(design.inputs)
    inputs = tuple(
        replace(
            track,
            clips=tuple(_with_track_applied(track, clip, index in audible) for clip in track.clips),
        )
        for index, track in enumerate(design.inputs)
    )
    return fragment_of(replace(design, inputs=inputs), (clip.id for clip in design.clips))


def _with_track_applied(track: Input, clip: Clip, audible: bool) -> Clip:
    """Return a clip with mute and gain curve of its track."""
    if track.gain_curve and len(clip.effects) == MAX_EFFECTS:
        # No further effect fits, so the clip becomes a layer of a new one.
        inner = replace(clip, onset_s=0.0, gain=1.0, muted=False, id=0)
        clip = replace(clip, waveform=Layers((inner,)), effects=())
    effects = clip.effects
    if track.gain_curve:
        effects = (*effects, Envelope(_points(track.gain_curve, clip)))
    if effects is clip.effects and (audible or clip.muted):
        return clip
    return replace(clip, effects=effects, muted=clip.muted or not audible)


def _points(curve: tuple[tuple[float, float], ...], clip: Clip) -> tuple[Breakpoint, ...]:
    """Return a gain curve over the own time of a clip, up to the first point after its end."""
    shifted: list[Breakpoint] = [
        (time_s - clip.onset_s, gain, "straight") for time_s, gain in curve
    ]
    before = sum(point[0] <= 0.0 for point in shifted)
    last = next((k for k, point in enumerate(shifted) if point[0] >= clip.duration_s), len(shifted))
    track_envelope = Envelope(tuple((time_s, gain, "straight") for time_s, gain in curve))
    start = float(track_envelope.values_at(np.array([clip.onset_s]))[0])
    return ((0.0, start, "straight"), *shifted[before : last + 1])


#: Longest fragment for a picture.
LONGEST_S = 60.0


def mixed(fragment: Fragment, sample_rate_hz: float) -> Floats:
    """Return the sum of all lanes, (n_times,), from the earliest onset on; muted clips are silent.

    Raises
    ------
    InvalidInputError
        The fragment is longer than `LONGEST_S`, or a clip cannot be played at this rate.
    """
    if fragment.duration_s > LONGEST_S:
        raise InvalidInputError(
            f"{fragment.duration_s:.3g} s are too long for a picture, expected at most "
            f"{LONGEST_S:g} s; place it to see it"
        )
    played = []
    for lane in fragment.lanes:
        for clip in lane.clips:
            if not clip.muted:
                first, samples = clip.sampled(sample_rate_hz)
                played.append((first, lane.amplitude * clip.gain * samples))
    n = max((first + samples.size for first, samples in played), default=0)
    total = np.zeros(n)
    for first, samples in played:
        total[first : first + samples.size] += samples
    return total
