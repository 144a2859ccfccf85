"""The scenes that are stepped through: designs of a folder, or those of the paper."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from skinsource.design.design import Design
from skinsource.design.design_file import SUFFIX, open_design
from skinsource.design.view import View
from skinsource.studies import scenes


@dataclass(frozen=True, slots=True, kw_only=True)
class Shown:
    """A scene once it is opened.

    Attributes
    ----------
    design, view
        What the window shows.
    arrangement, panels
        Arrangement of the window that shows it, and the panels that are brought in sight there;
        empty: the window stays as it is.
    of_file
        Whether it was saved: then it has colours that it was saved with, or that were chosen in
        this show, but none of the file before.
    """

    design: Design
    view: View
    arrangement: str = ""
    panels: tuple[str, ...] = ()
    of_file: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Step:
    """One scene of a list.

    Attributes
    ----------
    title
        What it is called.
    open
        Opens it; may raise a `SkinSourceError`.
    """

    title: str
    open: Callable[[], Shown]


def steps_of_folder(folder: Path) -> tuple[Step, ...]:
    """The designs of a folder, by name; numbers in front of names put them in order."""
    try:
        paths = sorted(path for path in folder.iterdir() if path.suffix == SUFFIX)
    except OSError:
        return ()
    return tuple(Step(title=path.stem, open=partial(_of_file, path)) for path in paths)


def steps_of_paper() -> tuple[Step, ...]:
    """The scenes that are shipped, in the order of the figures."""
    return tuple(
        Step(title=one.heading, open=partial(_of_paper, one.name)) for one in scenes.all_scenes()
    )


def _of_file(path: Path) -> Shown:
    content = open_design(path)
    return Shown(design=content.design, view=content.view, of_file=True)


def _of_paper(name: str) -> Shown:
    opened = scenes.open_scene(name)
    known = opened.scene
    return Shown(
        design=opened.design,
        view=opened.view,
        arrangement=known.arrangement,
        panels=known.panels,
    )
