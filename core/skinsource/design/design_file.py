"""`.skinsource` files: a design, the view on it and the window's arrangement.

A file holds the codec's tree of a `DesignFile` as the image of an HDF5 file (see
`skinsource.specs.image`), so that a new field of any model needs no change here.  A checksum over
the whole file is verified first; after that a missing field means that an older studio wrote the
file, and gets its default.  A file of a newer studio is refused, so that nothing is guessed or
lost.  A file with a limb that is not available can be opened, and another limb chosen.

Only files of `VERSION` can be read.  When there is a next version, `UPGRADES` says how a tree of
the version before becomes one of it.
"""

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from skinsource.base.arguments import checking
from skinsource.base.errors import DesignFileError, FileFormatError, InvalidInputError
from skinsource.base.files import path_text, read_bytes, write_bytes
from skinsource.base.json_text import Tree
from skinsource.base.quoting import sentence
from skinsource.design.design import Design
from skinsource.design.view import View
from skinsource.specs import fields, image, models
from skinsource.specs.codec import check_version
from skinsource.specs.numbers import ModelSpec
from skinsource.specs.spec import Address, BytesSpec

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
