"""The scenes that there are, and how they are opened."""

import re
from collections.abc import Collection, Sequence
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

from skinsource.base.assets import data_folder
from skinsource.base.errors import InvalidInputError, SkinSourceError
from skinsource.base.quoting import quoted
from skinsource.design.amplitudes import ARBITRARY_UNIT, amplitude_unit
from skinsource.design.comparing import Snapshot
from skinsource.design.design import Design
from skinsource.design.design_file import SUFFIX, DesignFile, open_design
from skinsource.limbs.catalogue import available_limbs
from skinsource.limbs.limb import PUBLISHED
from skinsource.studies.scenes.scene import (
    PROBE_UNITS,
    Condition,
    OpenedScene,
    Scene,
    opened_on,
    reason_against,
)
from skinsource.studies.scenes.shipped import SHIPPED

FOLDER = "scenes"


def scenes_folder() -> Path:
    """Where the design files of the scenes lie."""
    return data_folder() / FOLDER


def all_scenes() -> tuple[Scene, ...]:
    """Every scene, in the order of the figures."""
    return tuple(made.scene for made in SHIPPED)


def names() -> tuple[str, ...]:
    """Names of the scenes, as `scene` and `open_scene` take them."""
    return tuple(each.name for each in all_scenes())


def scene(name: str) -> Scene:
    """Return what is known of a scene; capitals do not matter.

    Raises
    ------
    InvalidInputError
        There is no such scene.
    """
    wanted = name.casefold() if isinstance(name, str) else None
    for known in all_scenes():
        if known.name.casefold() == wanted:
            return known
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
        Snapshot(number=snapshot.number, design=_on_limbs(snapshot.design, limbs))
        for snapshot in content.view.snapshots
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
            Condition(label=label, design=design)
            for label, design in zip(known.labels, designs, strict=True)
        ),
        synthetic=any(a.limb != b.limb for a, b in zip(designs, was, strict=True)),
    )


def compared(content: DesignFile) -> tuple[Design, ...]:
    """The designs of a file, by the numbers of their snapshots; one that is none comes last."""
    snapshots = sorted(content.view.snapshots, key=lambda snapshot: snapshot.number)
    designs = tuple(snapshot.design for snapshot in snapshots)
    return designs if content.design in designs else (*designs, content.design)


def _on_limbs(design: Design, limbs: frozenset[str]) -> Design:
    kind, _, number = design.limb.partition("-")
    if kind != "measured" or design.limb in limbs:
        return design
    return replace(design, limb=f"synthetic-{number}")


# What a design is called once it may be no longer the scene that its title names.

_SCENE_TITLE = re.compile(r"Fig\. (\w+): ")
_LIMB = re.compile(r", limb \d+$")
_EDITED = "edited"


def title_of(design: Design) -> str:
    """The title of a design; of a scene that was changed, without what need not hold any more.

    A title that is no scene's is the user's own words, and stays.

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
    said = _title_prefix(f"Fig. {known.name}: ", (known.title, without_limb), design.title)
    if not said or _is_as_made(known, designs, design):
        return design.title
    changed_limb = _LIMB.search(said) and not _is_on(designs[0], design)
    return f"{_LIMB.sub('', said) if changed_limb else said} · {_EDITED}"


def _title_prefix(figure: str, titles: Sequence[str], said: str) -> str:
    """With which of its titles the scene begins what is said; empty: with none."""
    begun = (figure + title for title in titles)
    return next(
        (
            beginning
            for beginning in begun
            if said == beginning or said.startswith(f"{beginning} · ")
        ),
        "",
    )


def _is_as_made(known: Scene, designs: tuple[Design, ...], design: Design) -> bool:
    """Whether it plays what the scene plays under this title, where the title says so."""
    if _has_other_unit(design):
        return False
    people = len({design.limb for design in designs}) > 1
    named = [one for one in designs if one.title == design.title]
    if named and (people or _LIMB.search(known.title)) and not _is_on(named[0], design):
        return False
    # On a limb of a lab a scene plays at other places, which its title tells.
    moved = design.limb not in PUBLISHED
    played = _played_content(design, moved=moved)
    return any(_played_content(candidate, moved=moved) == played for candidate in named or designs)


def _has_other_unit(design: Design) -> bool:
    """Whether the title tells a strength in a unit that the drive does not have on this limb."""
    if amplitude_unit(design) == ARBITRARY_UNIT:
        return design.title.endswith(PROBE_UNITS)
    return design.title.endswith(f" {ARBITRARY_UNIT}")


def _is_on(known: Design, design: Design) -> bool:
    """Whether it is on this limb, or on the synthetic one that stands in for it."""
    number = known.limb.partition("-")[2]
    # A lab may give its own limb a number too.
    return design.limb in PUBLISHED and design.limb.partition("-")[2] == number


def _played_content(design: Design, *, moved: bool) -> Design:
    """What is heard of a design; ``moved``: wherever on the limb."""
    inputs = tuple(
        replace(track, colour=0, location=1 if moved else track.location) for track in design.inputs
    )
    return Design(
        limb="synthetic-1", inputs=inputs, scaling=design.scaling, actuation=design.actuation
    )


@lru_cache(maxsize=64)
def _designs_of(path: Path) -> tuple[Design, ...]:
    return compared(open_design(path))
