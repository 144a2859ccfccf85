"""``skinsource scenes``: list the panels of the paper's figures, or write them as designs."""

import argparse
import sys
from pathlib import Path
from typing import Any

from skinsource.base.files import make_folder
from skinsource.design.design_file import save_design
from skinsource.studies.scenes.catalog import all_scenes, missing_panels, open_scene, why_not_on


def add_to(subparsers: Any) -> None:
    """Add the command ``scenes``."""
    parser = subparsers.add_parser(
        "scenes",
        help="list the scenes of the paper, or write one as a design file",
        description="Lists the panels of the paper's figures that can be computed, and why the "
        "others cannot. With a name and "
        "--out, writes that scene as a design file for show, render, export and the studio.",
    )
    parser.add_argument("name", nargs="?", metavar="NAME", help="of a scene, such as 2F")
    parser.add_argument(
        "--limb",
        default="",
        metavar="NAME",
        help="play it on this limb, such as one that was imported; without a scene: list which "
        "scenes apply there",
    )
    parser.add_argument("--out", type=Path, metavar="PATH", help="the .skinsource file to write")
    parser.set_defaults(run=_scenes, parser=parser)


def _scenes(arguments: argparse.Namespace) -> int:
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
        return 0
    opened = open_scene(arguments.name, limb=arguments.limb)
    sys.stdout.write(f"{opened.scene.heading}\n{opened.scene.notes}\n")
    if opened.note:
        sys.stdout.write(f"{opened.note}\n")
    if arguments.out is not None:
        make_folder(arguments.out.parent)
        save_design(arguments.out, opened.design, opened.view)
        sys.stdout.write(f"{arguments.out}\n")
    return 0
