"""``skinsource pack``: put a design file and all that belongs to it into one zip."""

import argparse
import sys
from pathlib import Path
from typing import Any

from skinsource.actuators.rigs import open_rig
from skinsource.base.errors import InvalidInputError
from skinsource.base.files import make_folder
from skinsource.base.quoting import printable
from skinsource.design.design_file import open_design
from skinsource.design.view import view_on
from skinsource.export.packing import pack


def add_to(subparsers: Any) -> None:
    """Add the command ``pack``."""
    parser = subparsers.add_parser(
        "pack",
        help="put a design file and all that belongs to it into one zip",
        description="Writes design, stimulus, map, levels and traces, what to cite, and the "
        "versions and digests of all that went in, into one zip file.",
    )
    parser.add_argument("design", type=Path, metavar="DESIGN", help="a .skinsource file")
    parser.add_argument("--out", type=Path, required=True, metavar="FILE", help="the zip to write")
    parser.add_argument("--rig", type=Path, metavar="FILE", help="a .skinrig file: what is wired")
    parser.set_defaults(run=_pack)


def _pack(arguments: argparse.Namespace) -> int:
    if arguments.out.suffix.lower() != ".zip":
        raise InvalidInputError(
            f"{printable(arguments.out.name)} is no name of a zip file. Call it *.zip."
        )
    content = open_design(arguments.design)
    rig = None if arguments.rig is None else open_rig(arguments.rig)
    view = view_on(content.design.limb, content.view)
    make_folder(arguments.out.parent)
    pack(arguments.out, content.design, view, rig=rig)
    sys.stdout.write(f"{arguments.out}\n")
    return 0
