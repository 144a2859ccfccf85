"""`.skinsource` files: a design, the view on it and the window's arrangement.

What is written is `VERSION` of the format: the codec's tree of a `DesignFile`, as the image of an
HDF5 file (see `skinsource.specs.image`), so that a new field of any recipe needs no change here.
A checksum over all of it is verified first; only then does a field that is missing mean that an
older studio wrote the file, and takes its default.  What a newer studio wrote is refused: nothing
is guessed, nothing is dropped.  A limb that is not available here is no reason to refuse a file:
the design is kept, and another limb can be chosen.

`VERSION` alone is read, until there is a next one: then `UPGRADES` says how a tree of the version
before becomes one of it.
"""

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from skinsource.base.errors import DesignFileError, FileFormatError, InvalidInputError
from skinsource.base.files import named, read_bytes, write_bytes
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
#: By version, what makes a tree of the next version out of one of it; these versions are read too.
UPGRADES: Mapping[int, Callable[[Tree], Tree]] = {}

#: The window's arrangement takes some thousand bytes.
_MAX_LAYOUT_BYTES = 2**20


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignFile:
    """What a file holds: the design, the view on it, and the window's arrangement."""

    design: Design = fields.field(ModelSpec(label="Design", kinds=lambda: (Design,)))
    view: View = fields.field(ModelSpec(label="View", kinds=lambda: (View,)), default=View())
    layout: bytes = fields.field(
        BytesSpec(label="Arrangement", longest=_MAX_LAYOUT_BYTES), default=b""
    )

    def __post_init__(self) -> None:
        fields.check(self)


def save_design(
    path: str | os.PathLike[str], design: Design, view: View | None = None, *, layout: bytes = b""
) -> None:
    """Write a design, and the view on it, whole or not at all.

    The same content gives the same bytes.

    Parameters
    ----------
    path
        The file; it usually ends in ``.skinsource``.  What stands there is replaced.
    design, view
        What to save; without a view, the usual one.
    layout
        Arrangement of the studio's window.

    Raises
    ------
    StorageError
        The folder cannot be written, or the disk is full.
    InvalidInputError
        The design is larger than any file may be.
    """
    content = DesignFile(design=design, view=View() if view is None else view, layout=layout)
    write_bytes(Path(path), image.to_image(models.encode(content), VERSION))


def open_design(path: str | os.PathLike[str]) -> DesignFile:
    """Read a design file; ``.design`` and ``.view`` of what is returned hold its content.

    Raises
    ------
    StorageError
        The file cannot be read.
    DesignFileError
        It is not a design file, it is damaged, or it holds something this version does not know.
    """
    place = Path(path)
    name = named(Path(place.name))
    try:
        content = _content(read_bytes(place, most=image.MAX_IMAGE_BYTES))
    except FileFormatError as error:
        problem = str(error).removeprefix(f"{name}: ")
        raise DesignFileError(f"{name}: {sentence(problem)}") from error
    except InvalidInputError as error:
        raise DesignFileError(f"{name}: {sentence(str(error))} Nothing was opened.") from error
    return content


def _content(stored: bytes) -> DesignFile:
    version = image.version_of(stored)
    check_version(version, *UPGRADES, VERSION)
    tree = image.from_image(stored, version)
    for older in range(version, VERSION):
        tree = UPGRADES[older](tree)
    return models.decode(tree, (DesignFile,), Address())
