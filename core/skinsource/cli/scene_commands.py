"""``skinsource scenes`` and ``figures``: scenes, as designs and drawn."""

import argparse
import sys
from pathlib import Path
from typing import Any

from skinsource.base.files import make_folder
from skinsource.design.design_file import save_design
from skinsource.export.plot import SYNTHETIC
from skinsource.limbs.catalog import available_limbs
from skinsource.limbs.dataset.commands import ProgressBar
from skinsource.studies.figures.writing import write_figures
from skinsource.studies.scenes.scenes import (
    all_scenes,
    missing_panels,
    names,
    open_scene,
    why_not_on,
)


def add_to(subparsers: Any) -> None:
    """Add the commands ``scenes`` and ``figures``."""
    parser = subparsers.add_parser(
        "scenes",
        help="list the scenes of the paper, or write one as a design file",
        description="Lists the panels of the paper's figures that can be computed, and why the "
        "others cannot. With a name and "
        "--out, writes that scene as a design file for show, render, export and the studio.",
    )
    parser.add_argument("name", nargs="?", metavar="NAME", help="name of a scene, such as 2F")
    parser.add_argument(
        "--limb",
        default="",
        metavar="NAME",
        help="play it on this limb, such as one that was imported; without a scene: list which "
        "scenes apply there",
    )
    parser.add_argument("--out", type=Path, metavar="PATH", help="the .skinsource file to write")
    parser.set_defaults(run=_scenes, parser=parser)
    _add_figures(subparsers)


def _scenes(arguments: argparse.Namespace) -> None:
    if arguments.name is None:
        if arguments.out is not None:
            arguments.parser.error("--out needs the NAME of a scene")
        for scene in all_scenes():
            sys.stdout.write(f"{scene.name:4}  {scene.title}\n      {scene.sentence}\n")
            reason = why_not_on(scene.name, arguments.limb) if arguments.limb else ""
            if reason:
                sys.stdout.write(f"      Not on {arguments.limb}: {reason}\n")
        for name, reason in missing_panels():
            sys.stdout.write(f"{name:4}  – {reason}\n")
        return
    opened = open_scene(arguments.name, limb=arguments.limb)
    sys.stdout.write(f"{opened.scene.heading}\n{opened.scene.notes}\n")
    if opened.note:
        sys.stdout.write(f"{opened.note}\n")
    if arguments.out is not None:
        make_folder(arguments.out.parent)
        save_design(arguments.out, opened.design, opened.view)
        sys.stdout.write(f"{arguments.out}\n")


def _add_figures(subparsers: Any) -> None:
    """Add the command ``figures``."""
    parser = subparsers.add_parser(
        "figures",
        help="draw the figures of the scenes: PNG, SVG, PDF and their numbers",
        description="Draws the panels of the paper's figures that can be computed, on the measured "
        "limbs where they are installed, else on synthetic ones, and says so. Needs the extra "
        '"plot".',
    )
    parser.add_argument("--out", type=Path, required=True, metavar="FOLDER", help="where to write")
    parser.add_argument(
        "--only", nargs="+", default=(), metavar="NAME", help="only these scenes, such as 2F"
    )
    parser.add_argument(
        "--limb",
        default="",
        metavar="NAME",
        help="draw them on this limb, such as one that was imported: those that apply there",
    )
    parser.set_defaults(run=_figures)


def _figures(arguments: argparse.Namespace) -> None:
    with ProgressBar(sys.stderr) as bar:
        written = write_figures(arguments.out, arguments.only, limb=arguments.limb, progress=bar)
    for name in names() if arguments.limb and not arguments.only else ():
        reason = why_not_on(name, arguments.limb)
        if reason:
            sys.stderr.write(f"skinsource: {name} was not drawn. {reason}\n")
    if not arguments.limb and not any(name.startswith("measured") for name in available_limbs()):
        sys.stderr.write(f"skinsource: {SYNTHETIC}; see skinsource dataset fetch\n")
    for path in written:
        sys.stdout.write(f"{path}\n")
