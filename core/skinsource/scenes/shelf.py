"""The scenes that there are, and how they are opened."""

from collections.abc import Collection
from dataclasses import replace
from pathlib import Path

from skinsource.catalogue import available_limbs
from skinsource.comparing import Snapshot
from skinsource.design import Design
from skinsource.design_file import SUFFIX, DesignFile, open_design
from skinsource.errors import InvalidInputError
from skinsource.files.assets import data_folder
from skinsource.quoting import quoted
from skinsource.scenes.on_limb import opened_on, reason_against
from skinsource.scenes.paper_scene import Condition, OpenedScene, Scene
from skinsource.scenes.shipped import SHIPPED

FOLDER = "scenes"


def scenes_folder() -> Path:
    """Where the design files of the scenes lie."""
    return data_folder() / FOLDER


def all_scenes() -> tuple[Scene, ...]:
    """Every scene, in the order of the figures."""
    return tuple(one.scene for one in SHIPPED)


def names() -> tuple[str, ...]:
    """Names of the scenes, as `scene` and `open_scene` take them."""
    return tuple(one.name for one in all_scenes())


def scene(name: str) -> Scene:
    """Return what is known of a scene; capitals do not matter.

    Raises
    ------
    InvalidInputError
        There is no such scene.
    """
    wanted = name.casefold() if isinstance(name, str) else None
    for one in all_scenes():
        if one.name.casefold() == wanted:
            return one
    raise InvalidInputError(
        f"the scene {quoted(name)} does not exist; there are {', '.join(names())}"
    )


def path_of(name: str) -> Path:
    """The design file of a scene."""
    return scenes_folder() / f"{name}{SUFFIX}"


def why_not_on(name: str, limb: str) -> str:
    """Why a scene does not apply on a limb, in a sentence; empty if it does.

    Raises
    ------
    InvalidInputError
        There is no such scene.
    DesignFileError, StorageError
        The installation is damaged.
    """
    known = scene(name)
    content = open_design(path_of(known.name))
    return reason_against(known, compared(content), content.view, limb)


def open_scene(
    name: str, *, available: Collection[str] | None = None, limb: str = ""
) -> OpenedScene:
    """Open a scene on the limbs that there are, or on one that is chosen for it.

    Parameters
    ----------
    name
        Of the panel: ``"2F"``.
    available
        Limbs that can be used, `skinsource.available_limbs` unless given.  Where a measured one is
        not among them, the synthetic one of its number stands in for it, and `OpenedScene.note`
        says so.
    limb
        A limb that all of it shall be played on, such as one that was imported; empty: those of the
        paper.

    Raises
    ------
    InvalidInputError
        There is no such scene, or it does not apply on ``limb``.
    DesignFileError, StorageError
        The installation is damaged.
    """
    known = scene(name)
    content = open_design(path_of(known.name))
    if limb:
        return opened_on(known, compared(content), content.design, content.view, limb)
    limbs = frozenset(available_limbs() if available is None else available)
    snapshots = tuple(
        Snapshot(number=one.number, design=_on_limbs(one.design, limbs))
        for one in content.view.snapshots
    )
    design = _on_limbs(content.design, limbs)
    view = replace(content.view, snapshots=snapshots)
    designs = compared(DesignFile(design=design, view=view))
    was = compared(content)
    return OpenedScene(
        scene=known,
        design=design,
        view=view,
        conditions=tuple(
            Condition(label=label, design=one)
            for label, one in zip(known.labels, designs, strict=True)
        ),
        synthetic=any(a.limb != b.limb for a, b in zip(designs, was, strict=True)),
    )


def compared(content: DesignFile) -> tuple[Design, ...]:
    """The designs of a file, by the numbers of their snapshots; one that is none comes last."""
    snapshots = sorted(content.view.snapshots, key=lambda one: one.number)
    designs = tuple(one.design for one in snapshots)
    return designs if content.design in designs else (*designs, content.design)


def _on_limbs(design: Design, limbs: frozenset[str]) -> Design:
    kind, _, number = design.limb.partition("-")
    if kind != "measured" or design.limb in limbs:
        return design
    return replace(design, limb=f"synthetic-{number}")
