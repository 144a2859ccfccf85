"""``skinsource figures``: the figures of the scenes, without a window."""

import argparse
import sys
from pathlib import Path
from typing import Any

from skinsource.catalogue import available_limbs
from skinsource.dataset.progress_bar import ProgressBar
from skinsource.figures import write_figures
from skinsource.plot.paper import SYNTHETIC


def add_to(subparsers: Any) -> None:
    """Add the command ``figures``."""
    parser = subparsers.add_parser(
        "figures",
        help="draw the figures of the scenes: PNG, SVG, PDF and their numbers",
        description="Draws the panels of the paper's figures that can be computed, on the measured "
        "limbs where they are installed, else on synthetic ones, and says so. Needs the extra "
        '"plot".',
    )
    parser.add_argument(
        "--out", type=Path, required=True, metavar="DIR", help="an existing folder to write to"
    )
    parser.add_argument(
        "--only", nargs="+", default=(), metavar="NAME", help="only these scenes, such as 2F"
    )
    parser.set_defaults(run=_figures)


def _figures(arguments: argparse.Namespace) -> int:
    with ProgressBar(sys.stderr) as bar:
        written = write_figures(arguments.out, arguments.only, progress=bar)
    if not any(name.startswith("measured") for name in available_limbs()):
        sys.stderr.write(f"skinsource: {SYNTHETIC}; see skinsource dataset fetch\n")
    for path in written:
        sys.stdout.write(f"{path}\n")
    return 0
