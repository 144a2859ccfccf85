"""What a design is called once it may be no longer the scene that its title names."""

import re
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

from skinsource.chain import ARBITRARY_UNIT, amplitude_unit
from skinsource.design import Design
from skinsource.design_file import open_design
from skinsource.errors import SkinSourceError
from skinsource.limb import PUBLISHED
from skinsource.scenes.on_limb import OF_PROBES
from skinsource.scenes.paper_scene import Scene
from skinsource.scenes.shelf import compared, path_of, scene

_OF_SCENE = re.compile(r"Fig\. (\w+): ")
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
    found = _OF_SCENE.match(design.title)
    if found is None:
        return design.title
    try:
        known = scene(found[1])
        designs = _designs_of(path_of(known.name))
    except SkinSourceError:
        return design.title
    without_limb = _LIMB.sub("", known.title)
    said = _beginning(f"Fig. {known.name}: ", (known.title, without_limb), design.title)
    if not said or _is_as_made(known, designs, design):
        return design.title
    changed_limb = _LIMB.search(said) and not _is_on(designs[0], design)
    return f"{_LIMB.sub('', said) if changed_limb else said} · {_EDITED}"


def _beginning(figure: str, titles: Sequence[str], said: str) -> str:
    """With which of its titles the scene begins what is said; empty: with none."""
    begun = (figure + one for one in titles)
    return next((one for one in begun if said == one or said.startswith(f"{one} · ")), "")


def _is_as_made(known: Scene, designs: tuple[Design, ...], design: Design) -> bool:
    """Whether it plays what the scene plays under this title, where the title says so."""
    if _is_of_other_drives(design):
        return False
    people = len({one.limb for one in designs}) > 1
    named = [one for one in designs if one.title == design.title]
    if named and (people or _LIMB.search(known.title)) and not _is_on(named[0], design):
        return False
    # On a limb of a lab a scene plays at other places, which its title tells.
    moved = design.limb not in PUBLISHED
    played = _played(design, moved=moved)
    return any(_played(one, moved=moved) == played for one in named or designs)


def _is_of_other_drives(design: Design) -> bool:
    """Whether the title tells a strength in a unit that the drive does not have on this limb."""
    if amplitude_unit(design) == ARBITRARY_UNIT:
        return design.title.endswith(OF_PROBES)
    return design.title.endswith(f" {ARBITRARY_UNIT}")


def _is_on(known: Design, design: Design) -> bool:
    """Whether it is on this limb, or on the synthetic one that stands in for it."""
    number = known.limb.partition("-")[2]
    # A lab may give its own limb a number too.
    return design.limb in PUBLISHED and design.limb.partition("-")[2] == number


def _played(design: Design, *, moved: bool) -> Design:
    """What is heard of a design; ``moved``: wherever on the limb."""
    inputs = tuple(
        replace(one, colour=0, location=1 if moved else one.location) for one in design.inputs
    )
    return Design(
        limb="synthetic-1", inputs=inputs, scaling=design.scaling, actuation=design.actuation
    )


@lru_cache(maxsize=64)
def _designs_of(path: Path) -> tuple[Design, ...]:
    return compared(open_design(path))
