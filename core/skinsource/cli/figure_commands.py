"""``skinsource figures``: draw the figures of the scenes."""

import argparse
import sys
from pathlib import Path
from typing import Any

from skinsource.export.plot import SYNTHETIC
from skinsource.limbs.catalog import available_limbs
from skinsource.limbs.dataset.commands import ProgressBar
from skinsource.studies.figures.writing import write_figures
from skinsource.studies.scenes.catalog import names, why_not_on


def add_to(subparsers: Any) -> None:
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


def _figures(arguments: argparse.Namespace) -> int:
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
    return 0
