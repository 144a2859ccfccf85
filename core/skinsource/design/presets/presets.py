"""The library: clips that are kept under a name, to be placed in any design.

A preset is a `skinsource.design.clips.Fragment` with a name, tags, a source and a description.
Each is a file of its own, see `skinsource.design.presets.presets`: those that the library ships lie
in its data folder, and are made by ``python -m skinsource.design.presets``; those of the
user in the user's.
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from skinsource.base.arrays import Floats
from skinsource.base.assets import data_folder, user_folder
from skinsource.base.errors import FileFormatError, InvalidInputError, SkinSourceError, StorageError
from skinsource.base.files import is_there, make_folder, named, read_bytes, reason_of, write_bytes
from skinsource.base.json_text import MAX_TEXT_BYTES
from skinsource.base.quoting import sentence
from skinsource.design.clips import MAX_EFFECTS, Clip, Fragment, Lane
from skinsource.design.design import Design, Input, audible_indices
from skinsource.design.edits.clips import fragment_of
from skinsource.design.effects.level import Envelope
from skinsource.design.waveforms.samples import Layers
from skinsource.specs import codec as text
from skinsource.specs import fields, models
from skinsource.specs.breakpoints import Breakpoint
from skinsource.specs.numbers import ListSpec, ModelSpec
from skinsource.specs.spec import Address, TextSpec

# What the library holds: a piece of a design under a name.

MAX_TAGS = 20

NAME = TextSpec(label="Name", longest=100, one_line=True)
TAG = TextSpec(label="Tag", longest=40, one_line=True)
TAGS = ListSpec(label="Tags", of=TAG, most=MAX_TAGS, different=True)
SOURCE = TextSpec(label="Source", longest=1000)
DESCRIPTION = TextSpec(label="Description", longest=5000)
FRAGMENT = ModelSpec(label="Clips", kinds=lambda: (Fragment,))


@dataclass(frozen=True, slots=True, kw_only=True)
class Preset:
    """Clips that are kept under a name.

    Attributes
    ----------
    name
        What it is for; not empty.
    tags
        Words that it is found by.
    source
        Where its numbers come from.
    description
        What it is, in a sentence or two.
    fragment
        The clips, of one track or several.
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


def tags_of(text_: str) -> tuple[str, ...]:
    """Tags as they are typed: between commas, each once, without blanks around them.

    >>> tags_of("tap, texture,, tap ")
    ('tap', 'texture')
    """
    tags = (" ".join(part.split()) for part in text_.split(","))
    return tuple(dict.fromkeys(tag for tag in tags if tag))


# A preset as a file: one JSON text with a checksum, see `skinsource.specs.codec`.

#: What the text says that it is.
FORMAT = "skinsource preset"
SUFFIX = ".skinpreset"


def preset_text(preset: Preset) -> str:
    """The preset as a text; the same preset gives the same text.

    Raises
    ------
    InvalidInputError
        It holds so many samples that it could not be read again.
    """
    return text.to_text(models.encode(preset), FORMAT) + "\n"


def preset_from(text_: str) -> Preset:
    """The preset that `preset_text` wrote.

    Raises
    ------
    FileFormatError, InvalidInputError
        The text is something else, is damaged, or was written in another version.
    """
    preset: Preset = models.decode(text.from_text(text_, FORMAT), (Preset,), Address())
    return preset


def read_preset(path: Path) -> Preset:
    """The preset in a file.

    Raises
    ------
    StorageError
        The file cannot be read.
    FileFormatError
        It holds none, and why.
    """
    content = read_bytes(path, most=MAX_TEXT_BYTES + 1)
    try:
        return preset_from(content.decode(errors="replace"))
    except (FileFormatError, InvalidInputError) as error:
        raise FileFormatError(f"{named(Path(path.name))}: {sentence(str(error))}") from error


def why(error: SkinSourceError) -> str:
    """What went wrong, as one sentence."""
    return sentence(str(error))


# The presets of a folder.

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
class PresetFolder:
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


def read_preset_folder(folder: Path) -> PresetFolder:
    """Read the presets of a folder; what is none, or cannot be read, is named and left out."""
    try:
        paths = sorted(path for path in folder.iterdir() if _is_meant(path))
    except (FileNotFoundError, NotADirectoryError):
        return PresetFolder()
    except OSError as error:
        problem = f"{named(folder)}: cannot be looked through ({reason_of(error)})."
        return PresetFolder(faults=(Fault(path=folder, sentence=problem),))
    entries, faults = [], []
    for path in paths[:MOST_FILES]:
        try:
            entries.append(Entry(path=path, preset=read_preset(path)))
        except SkinSourceError as error:
            faults.append(Fault(path=path, sentence=why(error)))
    if len(paths) > MOST_FILES:
        problem = f"{named(folder)}: holds {len(paths)} presets, the first {MOST_FILES} are read."
        faults.append(Fault(path=folder, sentence=problem))
    entries.sort(key=lambda entry: (_by_number(entry.preset.name), entry.path))
    return PresetFolder(entries=tuple(entries), faults=tuple(faults))


def _is_meant(path: Path) -> bool:
    return path.suffix == SUFFIX and not path.name.startswith(".")


def _by_number(name: str) -> tuple[tuple[int, str], ...]:
    """Whole numbers in a name count as such."""
    parts = _DIGITS.split(name.casefold())
    return tuple((int(part), "") if k % 2 else (0, part) for k, part in enumerate(parts))


# Finding presets by words.


def matching(entries: Iterable[Entry], query: str, tag: str = "") -> tuple[Entry, ...]:
    """Entries that hold every one of ``words``, and have the ``tag`` where one is given.

    A word is looked for in name, tags, description and source, in capitals or not.  First come
    those with all words in their names, then those with all in names and tags, then the others;
    otherwise they stay in their order.
    """
    terms = query.casefold().split()
    ranked = [
        (_rank(entry, terms), entry) for entry in entries if not tag or tag in entry.preset.tags
    ]
    matches = sorted(((rank, entry) for rank, entry in ranked if rank < _NONE), key=_first)
    return tuple(entry for _, entry in matches)


_NONE = 3


def _first(pair: tuple[int, Entry]) -> int:
    return pair[0]


def _rank(entry: Entry, terms: list[str]) -> int:
    preset = entry.preset
    name = preset.name.casefold()
    tagged = "\n".join((name, *preset.tags)).casefold()
    everything = "\n".join((tagged, preset.description, preset.source)).casefold()
    for rank, searched in enumerate((name, tagged, everything)):
        if all(term in searched for term in terms):
            return rank
    return _NONE


# Writing, renaming and deleting the user's presets.

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


# Making presets of what is open.


def whole_design(design: Design) -> Fragment | None:
    """All clips of a design as they are heard; None where there are none.

    A fragment has no mute, no solo and no gain curve of tracks: clips of silent tracks become
    muted, and a gain curve becomes an `Envelope` of each clip below it.
    """
    audible = audible_indices(design.inputs)
    inputs = tuple(
        replace(track, clips=tuple(_alone(track, clip, index in audible) for clip in track.clips))
        for index, track in enumerate(design.inputs)
    )
    return fragment_of(replace(design, inputs=inputs), (clip.id for clip in design.clips))


def _alone(track: Input, clip: Clip, audible: bool) -> Clip:
    """The clip with what its track does to it."""
    if track.gain_curve and len(clip.effects) == MAX_EFFECTS:
        # There is no room for another one but around it.
        inner = replace(clip, onset_s=0.0, gain=1.0, muted=False, id=0)
        clip = replace(clip, waveform=Layers((inner,)), effects=())
    effects = clip.effects
    if track.gain_curve:
        effects = (*effects, Envelope(_points(track.gain_curve, clip)))
    if effects is clip.effects and (audible or clip.muted):
        return clip
    return replace(clip, effects=effects, muted=clip.muted or not audible)


def _points(curve: tuple[tuple[float, float], ...], clip: Clip) -> tuple[Breakpoint, ...]:
    """The gain curve over the own time of a clip: as far as the first point behind its end."""
    shifted: list[Breakpoint] = [
        (time_s - clip.onset_s, gain, "straight") for time_s, gain in curve
    ]
    before = sum(point[0] <= 0.0 for point in shifted)
    last = next((k for k, point in enumerate(shifted) if point[0] >= clip.duration_s), len(shifted))
    track_envelope = Envelope(tuple((time_s, gain, "straight") for time_s, gain in curve))
    start = float(track_envelope.values_at(np.array([clip.onset_s]))[0])
    return ((0.0, start, "straight"), *shifted[before : last + 1])


# What the clips of a fragment sound like together.

#: What is longer is too much for a picture.
LONGEST_S = 60.0


def mixed(fragment: Fragment, sample_rate_hz: float) -> Floats:
    """Sum of all lanes, (n_times,), from the earliest onset on; muted clips are silent.

    Raises
    ------
    InvalidInputError
        It lasts longer than `LONGEST_S`, or holds something that cannot be played at this rate.
    """
    if fragment.duration_s > LONGEST_S:
        raise InvalidInputError(
            f"{fragment.duration_s:.3g} s are too long for a picture, expected at most "
            f"{LONGEST_S:g} s; place it to see it"
        )
    played = [
        (first, lane.amplitude * gain * samples)
        for lane in fragment.lanes
        for first, gain, samples in _clips(lane, sample_rate_hz)
    ]
    n = max((first + samples.size for first, samples in played), default=0)
    total = np.zeros(n)
    for first, samples in played:
        total[first : first + samples.size] += samples
    return total


def _clips(lane: Lane, sample_rate_hz: float) -> list[tuple[int, float, Floats]]:
    sampled = []
    for clip in lane.clips:
        if not clip.muted:
            first, samples = clip.sampled(sample_rate_hz)
            sampled.append((first, clip.gain, samples))
    return sampled
