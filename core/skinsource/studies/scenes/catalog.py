"""The catalog of scenes: their names, their files, how they are opened, and their titles."""

import re
import tomllib
from collections.abc import Collection, Sequence
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any

from skinsource.base.arguments import checking
from skinsource.base.assets import data_folder
from skinsource.base.errors import InvalidInputError, SkinSourceError, quoted
from skinsource.design.amplitudes import ARBITRARY_UNIT, amplitude_unit
from skinsource.design.design import Design
from skinsource.design.design_file import SUFFIX, DesignFile, open_design
from skinsource.limbs.catalog import available_limbs
from skinsource.limbs.limb import PUBLISHED
from skinsource.studies.scenes.opened_scene import (
    PROBE_UNITS,
    Condition,
    OpenedScene,
    Scene,
    opened_on,
    reason_against,
    told,
    with_designs,
)

FOLDER, DESCRIPTIONS = "scenes", "scenes.toml"


def scenes_folder() -> Path:
    """Return the folder of the design files of the scenes.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(ss.scenes.scenes_folder().name)
    scenes
    """
    return data_folder() / FOLDER


def all_scenes() -> tuple[Scene, ...]:
    """Return every scene, in the order of the figures.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(ss.scenes.all_scenes()[0].name)
    1C
    """
    return _scenes_in(scenes_folder())


def names() -> tuple[str, ...]:
    """Return the names of the scenes, as `scene` and `open_scene` take them.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(ss.scenes.names()[:3])
    ('1C', '1D', '1E')
    """
    return tuple(each.name for each in all_scenes())


def scene(name: str) -> Scene:
    """Return the description of a scene; the case of its name does not matter.

    Raises
    ------
    InvalidInputError
        There is no such scene.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(ss.scenes.scene("2F").title)
    Two inputs interfere
    """
    folded = name.casefold() if isinstance(name, str) else None
    for known in all_scenes():
        if known.name.casefold() == folded:
            return known
    raise InvalidInputError(
        f"the scene {quoted(name)} does not exist; choose one of {', '.join(names())}"
    )


def path_of(name: str) -> Path:
    """Return the path of the design file of a scene."""
    return scenes_folder() / f"{name}{SUFFIX}"


def why_not_on(name: str, limb: str) -> str:
    """Return why a scene does not apply on a limb, in a sentence; empty if it does.

    Raises
    ------
    InvalidInputError
        There is no such scene.
    DesignFileError, StorageError
        The installation is damaged.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(repr(ss.scenes.why_not_on("2F", "synthetic-1")))
    ''
    """
    content = open_design(path_of(scene(name).name))
    return reason_against(compared(content), content.view, limb)


def open_scene(
    name: str, *, available: Collection[str] | None = None, limb: str = ""
) -> OpenedScene:
    """Open a scene on the limbs that are available, or on one that is chosen for it.

    Parameters
    ----------
    name
        Name of the panel: ``"2F"``.
    available
        Limbs that can be used, `skinsource.available_limbs` unless given.  A measured limb that is
        not among them is replaced by the synthetic limb of its number, and `OpenedScene.note` says
        so.
    limb
        A limb for all designs, such as an imported one; empty: the limbs of the paper.

    Raises
    ------
    InvalidInputError
        There is no such scene, or it does not apply on ``limb``.
    DesignFileError, StorageError
        The installation is damaged.

    Examples
    --------
    >>> import skinsource as ss
    >>> opened = ss.scenes.open_scene("2F")
    >>> figure = ss.plot.map(opened.design)
    """
    return told(opened_plainly(name, available=available, limb=limb))


def opened_plainly(
    name: str, *, available: Collection[str] | None = None, limb: str = ""
) -> OpenedScene:
    """Return a scene as `open_scene`, without what is computed on its limb."""
    known = scene(name)
    content = open_design(path_of(known.name))
    pairs = zip(known.labels, compared(content), strict=True)
    of_file = OpenedScene(
        scene=known,
        design=content.design,
        view=content.view,
        conditions=tuple(Condition(label=label, design=design) for label, design in pairs),
        synthetic=False,
    )
    if limb:
        return opened_on(of_file, limb)
    limbs = frozenset(available_limbs() if available is None else available)
    opened = with_designs(of_file, lambda design: _on_limbs(design, limbs))
    return replace(opened, synthetic=opened.conditions != of_file.conditions)


def compared(content: DesignFile) -> tuple[Design, ...]:
    """Return the designs of a file by the numbers of their snapshots; others come last."""
    snapshots = sorted(content.view.snapshots, key=lambda snapshot: snapshot.number)
    designs = tuple(snapshot.design for snapshot in snapshots)
    return designs if content.design in designs else (*designs, content.design)


def _on_limbs(design: Design, limbs: frozenset[str]) -> Design:
    kind, _, number = design.limb.partition("-")
    if kind != "measured" or design.limb in limbs:
        return design
    return replace(design, limb=f"synthetic-{number}")


_SCENE_TITLE = re.compile(r"Fig\. ([\w-]+): ")
_LIMB = re.compile(r", limb \d+$")
_EDITED = "edited"


@checking
def title_of(design: Design) -> str:
    """Return the title of a design; that of an edited scene without details that may be wrong.

    Other titles are those of the user, and stay.

    >>> import skinsource as ss
    >>> tone = ss.scenes.open_scene("2B", available=("synthetic-1",)).conditions[0].design
    >>> ss.scenes.title_of(tone)
    'Fig. 2B: Low frequencies reach farther · 50 Hz'
    >>> ss.scenes.title_of(tone.with_input(0, amplitude=2.0))
    'Fig. 2B: Low frequencies reach farther · edited'
    """
    match = _SCENE_TITLE.match(design.title)
    if match is None:
        return design.title
    try:
        known = scene(match[1])
        designs = _designs_of(path_of(known.name))
    except SkinSourceError:
        return design.title
    without_limb = _LIMB.sub("", known.title)
    prefix = _title_prefix(f"Fig. {known.name}: ", (known.title, without_limb), design.title)
    if not prefix or _is_as_made(known, designs, design):
        return design.title
    changed_limb = _LIMB.search(prefix) and not _is_on(designs[0], design)
    return f"{_LIMB.sub('', prefix) if changed_limb else prefix} · {_EDITED}"


def _title_prefix(figure: str, titles: Sequence[str], title: str) -> str:
    """Return the one of the scene's own titles that ``title`` begins with; empty: none."""
    prefixes = (figure + own_title for own_title in titles)
    return next(
        (prefix for prefix in prefixes if title == prefix or title.startswith(f"{prefix} · ")),
        "",
    )


def _is_as_made(known: Scene, designs: tuple[Design, ...], design: Design) -> bool:
    """Return whether a design still plays what its title promises."""
    if _has_other_unit(design):
        return False
    people = len({design.limb for design in designs}) > 1
    named = [original for original in designs if original.title == design.title]
    if named and (people or _LIMB.search(known.title)) and not _is_on(named[0], design):
        return False
    # On an imported limb a scene plays at other places, and its title names them.
    moved = design.limb not in PUBLISHED
    played = _played_content(design, moved=moved)
    return any(_played_content(candidate, moved=moved) == played for candidate in named or designs)


def _has_other_unit(design: Design) -> bool:
    """Return whether the title has a strength in a unit other than that of the drive."""
    if amplitude_unit(design) == ARBITRARY_UNIT:
        return design.title.endswith(PROBE_UNITS)
    return design.title.endswith(f" {ARBITRARY_UNIT}")


def _is_on(known: Design, design: Design) -> bool:
    """Return whether a design is on the limb of ``known``, or the synthetic one of its number."""
    number = known.limb.partition("-")[2]
    # An imported limb may have a number too.
    return design.limb in PUBLISHED and design.limb.partition("-")[2] == number


def _played_content(design: Design, *, moved: bool) -> Design:
    """Return what a design plays, without texts and limb; ``moved``: without places."""
    inputs = tuple(
        replace(track, colour=0, location=1 if moved else track.location) for track in design.inputs
    )
    return Design(
        limb="synthetic-1", inputs=inputs, scaling=design.scaling, actuation=design.actuation
    )


@lru_cache(maxsize=64)
def _designs_of(path: Path) -> tuple[Design, ...]:
    return compared(open_design(path))


def missing_panels() -> tuple[tuple[str, str], ...]:
    """Return the panels of the paper that are no scenes, each with the reason.

    Examples
    --------
    >>> import skinsource as ss
    >>> print(ss.scenes.missing_panels()[-1][0])
    5C
    """
    return tuple((entry["name"], entry["reason"]) for entry in _read(scenes_folder())["missing"])


@lru_cache(maxsize=1)
def _read(folder: Path) -> dict[str, Any]:
    content: dict[str, Any] = tomllib.loads((folder / DESCRIPTIONS).read_text(encoding="utf-8"))
    return content


@lru_cache(maxsize=1)
def _scenes_in(folder: Path) -> tuple[Scene, ...]:
    scenes = []
    for entry in _read(folder)["scene"]:
        fields: dict[str, Any] = {
            name: tuple(value) if isinstance(value, list) else value
            for name, value in entry.items()
        }
        scenes.append(Scene(**fields))
    return tuple(scenes)
