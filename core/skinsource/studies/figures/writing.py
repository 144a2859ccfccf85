"""Figures as files: PNG, SVG, PDF, and their numbers as CSV."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from skinsource.base.files import make_folder, write_bytes
from skinsource.base.job import Progress, never, silent
from skinsource.design.labels import SCALINGS, label_of, limb_label
from skinsource.export.exported_design import output_file
from skinsource.export.plot import METADATA, SYNTHETIC, figure_content, module
from skinsource.export.tables import CsvTable
from skinsource.studies.figures.figures import FIGURES, Drawn, condition_lines, limbs_of
from skinsource.studies.scenes.scenes import OpenedScene, names, open_scene, scene, why_not_on
from skinsource.version import __version__


def write_figures(
    folder: Path,
    only: Sequence[str] = (),
    *,
    limb: str = "",
    progress: Progress = silent,
) -> tuple[Path, ...]:
    """Draw figures of scenes and write each as ``2F.png``, ``.svg``, ``.pdf`` and ``.csv``.

    They show the limbs of the paper where the measured dataset is installed, else synthetic limbs;
    figure and table then say so.  The same data give the same files.

    Parameters
    ----------
    folder
        The folder; it is made where it does not exist.
    only
        Names of scenes; empty: all.
    limb
        A limb for the scenes that apply there; empty: the limbs of the paper.
    progress
        Called with (done, total, what is being done).

    Returns
    -------
    The files, in the order in which they were written.

    Raises
    ------
    InvalidInputError
        There is no such scene, or one of ``only`` does not apply on ``limb``.
    StorageError
        The folder cannot be made or written.
    MissingExtraError
        matplotlib is not installed.
    """
    chosen = [scene(name).name for name in only]
    chosen = chosen or [name for name in names() if not limb or not why_not_on(name, limb)]
    module("matplotlib")
    make_folder(folder)
    written: list[Path] = []
    for k, name in enumerate(chosen):
        progress(k, len(chosen), name)
        opened = open_scene(name, limb=limb)
        written += _write(folder, opened, draw_figure(opened))
    progress(len(chosen), len(chosen), "")
    return tuple(written)


def draw_figure(opened: OpenedScene) -> Drawn:
    """Draw the figure of a scene.

    Raises
    ------
    MissingExtraError
        matplotlib is not installed.
    """
    return FIGURES[opened.scene.name](opened)


def about(opened: OpenedScene, *, maps: bool) -> list[str]:
    """Return the comment lines of a table: scene, source, limbs, scaling and conditions.

    ``maps``: whether its figure shows maps.
    """
    shown = opened.scene
    limbs = (f"{limb_label(limb_name).title} ({limb_name})" for limb_name in limbs_of(opened))
    return [
        f"SkinSource studio: {shown.heading}",
        shown.sentence,
        f"after {shown.source}",
        *(f"inferred: {part}" for part in shown.inferred),
        *filter(None, (SYNTHETIC * opened.synthetic, opened.note)),
        f"limb: {', '.join(limbs)}",
        f"scaling: {label_of(SCALINGS, opened.design.scaling).both}",
        *condition_lines(opened, maps=maps),
        f"computed by: skinsource {__version__}, numpy {np.__version__}",
    ]


def _write(folder: Path, opened: OpenedScene, drawn: Drawn) -> list[Path]:
    name = opened.scene.name
    written = [folder / f"{name}.{kind}" for kind in METADATA]
    for path, kind in zip(written, METADATA, strict=True):
        write_bytes(path, figure_content(drawn.figure, kind))
    for suffix, table in drawn.tables.items():
        path = folder / f"{name}{suffix}.csv"
        with output_file(path, never) as file:
            lines = about(opened, maps=drawn.sheet.maps)
            CsvTable(file, lines, list(table), never).add(np.column_stack(list(table.values())))
        written.append(path)
    return written
