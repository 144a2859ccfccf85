"""`.skinsource` files, a design, its view and the arrangement, and `.skinshow` files of several.

A file holds the codec's tree of a `DesignFile` as the image of an HDF5 file (see
`skinsource.specs.image`), so that a new field of any model needs no change here.  A checksum over
the whole file is verified first; after that a missing field means that an older studio wrote the
file, and gets its default.  A file of a newer studio is refused, so that nothing is guessed or
lost.  A file with a limb that is not available can be opened, and another limb chosen.

Only files of `VERSION` can be read.  When there is a next version, `UPGRADES` says how a tree of
the version before becomes one of it.

A `.skinshow` file has designs in an order, each with what is said and turned in front of people.
It is a ZIP archive that stores, in their order, images as design files are (see
`skinsource.specs.image`).  Each has its own checksum, so that one that is damaged, or of a newer
studio, leaves the others as they are.
"""

from __future__ import annotations

import io
import os
import zipfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from skinsource.base.arguments import brief, checking
from skinsource.base.errors import DesignFileError, FileFormatError, InvalidInputError, sentence
from skinsource.base.files import path_text, read_bytes, write_bytes
from skinsource.base.json_text import Tree
from skinsource.design.design import NOTES, TITLE, Design, View
from skinsource.design.panel_settings import (
    ALL,
    CONTROL,
    STAGE,
    StageSettings,
    settings_of,
    stage_settings,
    with_settings,
)
from skinsource.specs import fields, image, models
from skinsource.specs.codec import check_version
from skinsource.specs.numbers import ModelSpec
from skinsource.specs.spec import Address, BytesSpec, TextSpec

SUFFIX = ".skinsource"
#: Version of the files that are written.
VERSION = 3
#: By version, the function that converts its trees to the next version; these are read as well.
UPGRADES: Mapping[int, Callable[[Tree], Tree]] = {}

#: The window's arrangement takes some thousand bytes.
_MAX_LAYOUT_BYTES = 2**20


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignFile(fields.CheckedModel):
    """The content of a file: a design, the view on it, and the window's arrangement."""

    design: Design = fields.field(ModelSpec(label="Design", kinds=lambda: (Design,)))
    view: View = fields.field(ModelSpec(label="View", kinds=lambda: (View,)), default=View())
    layout: bytes = fields.field(
        BytesSpec(label="Arrangement", longest=_MAX_LAYOUT_BYTES), default=b""
    )


@checking
def save_design(
    path: str | os.PathLike[str], design: Design, view: View | None = None, *, layout: bytes = b""
) -> None:
    """Write a design, and the view on it, whole or not at all.

    The same content gives the same bytes.

    Parameters
    ----------
    path
        The file, usually with the suffix ``.skinsource``; an existing file is replaced.
    design, view
        Design and view to save; without a view the default one.
    layout
        Arrangement of the studio's window.

    Raises
    ------
    StorageError
        The folder cannot be written, or the disk is full.
    InvalidInputError
        The design is larger than any file may be.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import skinsource as ss
    >>> tone = ss.track(7, ss.waveforms.Tone(frequency_hz=100.0))
    >>> design = ss.Design(limb="synthetic-1", inputs=(tone,))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "scene.skinsource"
    ...     ss.save_design(path, design)
    ...     print(path.exists())
    True
    """
    content = DesignFile(design=design, view=View() if view is None else view, layout=layout)
    write_bytes(Path(path), to_bytes(content))


def to_bytes(content: DesignFile) -> bytes:
    """Return the content of a file; raise `InvalidInputError` where it would be too large."""
    return image.to_image(models.encode(content), VERSION)


@checking
def open_design(path: str | os.PathLike[str]) -> DesignFile:
    """Read a design file; ``.design`` and ``.view`` of what is returned hold its content.

    Raises
    ------
    StorageError
        The file cannot be read.
    DesignFileError
        It is not a design file, it is damaged, or it holds something this version does not know.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import skinsource as ss
    >>> tone = ss.track(7, ss.waveforms.Tone(frequency_hz=100.0))
    >>> design = ss.Design(limb="synthetic-1", inputs=(tone,))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "scene.skinsource"
    ...     ss.save_design(path, design)
    ...     print(ss.open_design(path).design == design)
    True
    """
    return read_design(Path(path))[1]


def read_design(path: Path) -> tuple[bytes, DesignFile]:
    """Return the bytes of a design file and its content; errors are those of `open_design`."""
    name = path_text(Path(path.name))
    try:
        stored = read_bytes(path, most=image.MAX_IMAGE_BYTES)
        content: DesignFile = decoded(stored, DesignFile)
    except FileFormatError as error:
        problem = str(error).removeprefix(f"{name}: ")
        raise DesignFileError(f"{name}: {sentence(problem)}") from error
    except InvalidInputError as error:
        raise DesignFileError(f"{name}: {sentence(str(error))} Nothing was opened.") from error
    return stored, content


def decoded(stored: bytes, kind: type) -> Any:
    """Return the model of a kind in the bytes of a file.

    Raises
    ------
    FileFormatError, InvalidInputError
        They are damaged, hold something else, or were written in another version.
    """
    version = image.version_of(stored)
    check_version(version, *UPGRADES, VERSION)
    tree = image.from_image(stored, version)
    for older in range(version, VERSION):
        tree = UPGRADES[older](tree)
    return models.decode(tree, (kind,), Address())


SHOW_SUFFIX = ".skinshow"
#: Most entries of a show.
MOST_ENTRIES = 200
SENTENCE = TextSpec(label="Sentence", longest=1000, one_line=True)
# The same show gives the same bytes.
_DATE = (1980, 1, 1, 0, 0, 0)
_DAMAGED = "Go back to an earlier copy."


@brief
@dataclass(frozen=True, slots=True, kw_only=True)
class ShowEntry(fields.CheckedModel):
    """A design of a show.

    Attributes
    ----------
    design, view
        The design, and how it is seen.
    title, sentence
        The large words beside it.
    knob
        The number that is turned: ``"frequency"``, ``"amplitude"``, ``"onset"``, or ``"all"``: the
        first of them that the design has.
    notes
        What the speaker reads.
    """

    design: Design = fields.field(ModelSpec(label="Design", kinds=lambda: (Design,)))
    view: View = fields.field(ModelSpec(label="View", kinds=lambda: (View,)), default=View())
    title: str = fields.text("", TITLE)
    sentence: str = fields.text("", SENTENCE)
    knob: str = fields.choice(ALL, CONTROL)
    notes: str = fields.text("", NOTES)

    @classmethod
    def of(cls, design: Design, view: View, title: str = "") -> ShowEntry:
        """Return the entry that shows a design as it is: its sentence begins its notes."""
        first, _, others = design.notes.partition("\n")
        return cls(
            design=design,
            view=view,
            title=title or design.title,
            sentence=first[: SENTENCE.longest].strip(),
            knob=stage_settings(view).control,
            notes=others,
        )

    @property
    def presented(self) -> tuple[Design, View]:
        """The design with the words of the entry, and the view with its knob."""
        stage = replace(settings_of(self.view, STAGE, StageSettings), control=self.knob)
        notes = f"{self.sentence}\n{self.notes}".rstrip("\n")
        view, title = with_settings(self.view, STAGE, stage), self.title
        common, dot, own = self.design.title.rpartition(" · ")
        if dot and view.snapshots:
            title = f"{title.removesuffix(dot + own)}{dot}{own}"
        design = replace(self.design, title=title[: TITLE.longest], notes=notes[: NOTES.longest])

        def told(other: Design) -> Design:
            if other == self.design:
                return design
            # Designs that are compared are told apart by the ends of their titles.
            end = other.title.removeprefix(common + dot)
            words = f"{title.removesuffix(own)}{end}" if dot else end
            # What has the title of all keeps it: it tells none of them apart.
            words = title if end == self.design.title else words
            return replace(other, title=words[: TITLE.longest])

        snapshots = (replace(each, design=told(each.design)) for each in view.snapshots)
        return design, replace(view, snapshots=tuple(snapshots))


@dataclass(frozen=True, slots=True, kw_only=True)
class UnreadEntry:
    """An entry that cannot be read; saving keeps it as it is.

    Attributes
    ----------
    problem
        Why not, in a sentence.
    stored
        Its bytes.
    """

    problem: str
    stored: bytes = field(repr=False)


@checking
def save_show(path: str | os.PathLike[str], entries: Sequence[ShowEntry | UnreadEntry]) -> None:
    """Write a show, whole or not at all; the same entries give the same bytes.

    Parameters
    ----------
    path
        The file, usually with the suffix ``.skinshow``; an existing file is replaced.
    entries
        In their order, at most 200.

    Raises
    ------
    StorageError
        The folder cannot be written, or the disk is full.
    InvalidInputError
        There are too many, or one is larger than any file may be.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import skinsource as ss
    >>> tone = ss.track(7, ss.waveforms.Tone(frequency_hz=100.0))
    >>> entry = ss.ShowEntry(design=ss.Design(limb="synthetic-1", inputs=(tone,)), title="A tone")
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "lecture.skinshow"
    ...     ss.save_show(path, [entry])
    ...     print(ss.open_show(path) == (entry,))
    True
    """
    if len(entries) > MOST_ENTRIES:
        raise InvalidInputError(f"a show has {len(entries)} entries, expected {MOST_ENTRIES}")
    memory = io.BytesIO()
    with zipfile.ZipFile(memory, "w", zipfile.ZIP_STORED) as archive:
        for number, entry in enumerate(entries, 1):
            stored = (
                entry.stored
                if isinstance(entry, UnreadEntry)
                else image.to_image(models.encode(entry), VERSION)
            )
            archive.writestr(zipfile.ZipInfo(f"{number:03}{SUFFIX}", _DATE), stored)
    write_bytes(Path(path), memory.getvalue())


@checking
def open_show(path: str | os.PathLike[str]) -> tuple[ShowEntry | UnreadEntry, ...]:
    """Read a show; an entry that cannot be read is an `UnreadEntry` that says why.

    Raises
    ------
    StorageError
        The file cannot be read.
    DesignFileError
        It is not a show, or so damaged that its entries cannot be told apart.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import skinsource as ss
    >>> entry = ss.ShowEntry(design=ss.Design(limb="synthetic-1"), title="Silence")
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "lecture.skinshow"
    ...     ss.save_show(path, [entry, entry])
    ...     print([entry.title for entry in ss.open_show(path)])
    ['Silence', 'Silence']
    """
    path = Path(path)
    name, content = path_text(Path(path.name)), read_bytes(path, most=image.MAX_IMAGE_BYTES)
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            return tuple(_entry(content, member) for member in archive.infolist())
    except (zipfile.BadZipFile, NotImplementedError) as error:
        raise DesignFileError(f"{name}: not a SkinSource show, or damaged. {_DAMAGED}") from error


def _entry(content: bytes, member: zipfile.ZipInfo) -> ShowEntry | UnreadEntry:
    # Not by zipfile, which returns nothing of what is damaged: that is kept.
    start = member.header_offset
    names = (int.from_bytes(content[start + at :][:2], "little") for at in (26, 28))
    stored = content[start + 30 + sum(names) :][: member.file_size]
    try:
        entry: ShowEntry = decoded(stored, ShowEntry)
    except (FileFormatError, InvalidInputError) as error:
        return UnreadEntry(problem=sentence(str(error)), stored=stored)
    return entry
