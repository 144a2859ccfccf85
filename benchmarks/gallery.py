"""The gallery of scenes: a picture of each, and a page of the documentation that shows them.

    python benchmarks/gallery.py resources/scenes docs/scenes.md

Pictures are computed on the synthetic limbs, whatever is installed: they may be distributed.
"""

import hashlib
import os
import sys
from dataclasses import MISSING, Field, fields, is_dataclass
from io import BytesIO
from pathlib import Path
from typing import Any

from skinsource.base.assets import data_folder
from skinsource.base.files import write_bytes
from skinsource.export.plot import module
from skinsource.studies.figures.writing import draw_figure
from skinsource.studies.scenes.scenes import (
    OpenedScene,
    Scene,
    all_scenes,
    missing_panels,
    open_scene,
    opened_plainly,
)

#: Width of a picture, px.
WIDTH_PX = 900
#: Keyword of the text in a picture that identifies its scene.
MARK = "Scene"

_HEADING = """\
# Scenes

Panels of the figures of the SkinSource paper as designs, and five of [inverse design](inverse.md):
`ss.scenes.open_scene("2F")`, the command `skinsource scenes 2F --out 2F.skinsource` and File >
Scenes… open them. `skinsource figures --out FOLDER` draws them on the measured limbs where those
are installed. The pictures below are computed on the **synthetic** limbs, which may not show what
the sentences say of the measured ones. Made by `python benchmarks/gallery.py`; do not edit.
"""

_INVERSE = """\
# Inverse design

Their drives are found on the limb where they open, and with them a sentence on what they do there.
"""


def synthetic_scene(name: str) -> OpenedScene:
    """Open a scene on synthetic limbs, whatever is installed."""
    return open_scene(name, available=())


def mark_of(opened: OpenedScene) -> str:
    """Return a digest of designs, view and synthetic limbs of a scene, without drives found."""
    if not opened.scene.of_paper:
        opened = opened_plainly(opened.scene.name, available=())
    parts = (opened.design, opened.view, *opened.conditions)
    content = [_changed_fields(part) for part in parts]
    digest = hashlib.sha256(repr(content).encode())
    for path in (data_folder() / "synthetic-limbs.json", *sorted(data_folder().glob("hands/*"))):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def _changed_fields(value: Any) -> Any:
    """Return a value without fields at their defaults: a new field changes no digest."""
    if isinstance(value, tuple):
        return tuple(_changed_fields(item) for item in value)
    if not is_dataclass(value):
        return value
    contents = ((field, getattr(value, field.name)) for field in fields(value))
    return (
        type(value).__name__,
        *(
            (field.name, _changed_fields(content))
            for field, content in contents
            if content != _default_of(field)
        ),
    )


def _default_of(field: Field[Any]) -> Any:
    return field.default if field.default_factory is MISSING else field.default_factory()


def picture_of(opened: OpenedScene) -> bytes:
    """Return a PNG of the figure of a scene, without its text; it holds `mark_of`."""
    drawn = draw_figure(opened)
    box = module("matplotlib.transforms").Bbox.from_extents(*drawn.sheet.picture_inches())
    content = BytesIO()
    metadata = {"Software": None, MARK: mark_of(opened)}
    drawn.figure.savefig(
        content, format="png", dpi=WIDTH_PX / box.width, bbox_inches=box, metadata=metadata
    )
    return content.getvalue()


def page_of(scenes: tuple[Scene, ...], pictures: str) -> str:
    """Return the page of the documentation; ``pictures`` is the relative folder of pictures."""
    parts = [_HEADING]
    for scene in scenes:
        if not scene.of_paper and _INVERSE not in parts:
            parts.append(_INVERSE)
        paragraphs = [
            f"## {scene.heading}",
            f"![{scene.title}]({pictures}/{scene.name}.png)",
            scene.notes.partition("\n")[0],
            f"Source: {scene.source}.",
        ]
        if scene.inferred:
            paragraphs.append(f"Inferred: {'; '.join(scene.inferred)}.")
        parts.append("\n\n".join(paragraphs) + "\n")
    missing = "\n".join(f"- **{name}**: {reason}" for name, reason in missing_panels())
    return "\n".join((*parts, f"## Panels that are no scenes\n\n{missing}\n"))


def write_gallery(folder: Path, page: Path) -> None:
    """Write all pictures to a folder, and the page that shows them."""
    for scene in all_scenes():
        write_bytes(folder / f"{scene.name}.png", picture_of(synthetic_scene(scene.name)))
    pictures = Path(os.path.relpath(folder, page.parent)).as_posix()
    write_bytes(page, page_of(all_scenes(), pictures).encode())


if __name__ == "__main__":
    write_gallery(Path(sys.argv[1]), Path(sys.argv[2]))
