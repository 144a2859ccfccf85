"""``skinsource limbs``, and ``skinsource limb import | list | mirror | export | remove``."""

import argparse
import sys
from pathlib import Path
from typing import Any

from skinsource.base.conventions import AXES
from skinsource.base.files import make_folder
from skinsource.cli.help_format import given
from skinsource.limbs.catalog import available_limbs, load_limb
from skinsource.limbs.dataset.commands import ProgressBar
from skinsource.limbs.limb_import import LimbSource, import_limb
from skinsource.limbs.limb_layout import export_limb
from skinsource.limbs.own_limbs import (
    NAME_RULE,
    OwnLimb,
    facts_of,
    mirror_limb,
    own_limb_names,
    own_limb_path,
    remove_limb,
)

_IMPORT = (
    "Imports impulse responses that were measured elsewhere, so that designs can use them. The "
    "file is in the layout of docs/limbs.md, or any array of three or four dimensions in NPY, NPZ, "
    "MATLAB or HDF5, with options for what it does not say."
)


def add_to(subparsers: Any) -> None:
    """Add the commands ``limbs``, and ``limb`` with its actions."""
    limbs = subparsers.add_parser("limbs", help="list the available limbs")
    limbs.set_defaults(run=_limbs)
    limb = subparsers.add_parser(
        "limb",
        help="import, list, mirror and remove limbs of your own",
        description="Limbs that you measured yourself; docs/limbs.md says what they consist of.",
    )
    actions = limb.add_subparsers(title="actions", metavar="ACTION", required=True)
    _add_import(actions)
    parser = actions.add_parser("list", help="list the available limbs, as skinsource limbs does")
    parser.set_defaults(run=_list)
    parser = actions.add_parser("mirror", help="show a left hand as a right one, or as it is")
    parser.add_argument("name", metavar="NAME")
    parser.add_argument("--off", action="store_true", help="as it is")
    parser.set_defaults(run=_mirror)
    parser = actions.add_parser("export", help="write a limb in the layout of docs/limbs.md")
    parser.add_argument("name", metavar="NAME")
    file = parser.add_mutually_exclusive_group(required=True)
    file.add_argument("--out", type=Path, metavar="FILE", help="an .h5 file")
    file.add_argument("file", type=Path, nargs="?", metavar="FILE", help="the same")
    parser.set_defaults(run=_export)
    parser = actions.add_parser("remove", help="delete a limb that was imported")
    parser.add_argument("name", metavar="NAME")
    parser.set_defaults(run=_remove)


def _add_import(actions: Any) -> None:
    parser = actions.add_parser("import", help="import impulse responses", description=_IMPORT)
    add = parser.add_argument
    add("file", type=Path, metavar="FILE", help="the responses, in m/s²")
    add("--replace", action="store_true", help="replace an own limb of the same name")
    add = parser.add_argument_group("names").add_argument
    add("--name", help=f"name in designs: {NAME_RULE}")
    add("--title", help="title in the window")
    add("--note", help="note for users")
    add = parser.add_argument_group("responses").add_argument
    add("--array", metavar="NAME", help="which array (default: largest)")
    add(
        "--order",
        metavar="LETTERS",
        help="order of its dimensions: i input, o output, a axis, t tap (default: ioat, or iot)",
    )
    add("--axes", choices=AXES, help="axes of each output; z: normal to the skin")
    _add_numbers(
        add,
        ("--rate", "sample_rate_hz", "HZ", "sample rate, Hz"),
        ("--delay", "pre_trigger_delay_s", "S", "delay of the responses, s"),
    )
    add(
        "--band",
        dest="band_hz",
        type=float,
        nargs=2,
        metavar=("LOWEST", "HIGHEST"),
        help="valid frequencies of the responses, Hz (default: unknown)",
    )
    add(
        "--pulse",
        dest="per_unit_drive",
        action="store_false",
        default=None,
        help="the responses are to the published pulse, not to one sample of the drive",
    )
    add(
        "--synthetic",
        action="store_true",
        default=None,
        help="the responses are computed, not measured",
    )
    add = parser.add_argument_group("hand and places").add_argument
    in_units = "hand length in the unit of the coordinates (default: mm)"
    _add_numbers(
        add,
        ("--hand-length", "hand_length_mm", "MM", "middle fingertip to wrist, mm"),
        ("--hand-length-units", "hand_length_px", "N", in_units),
    )
    add("--outline", type=Path, metavar="FILE", help="SVG, or CSV of x, y")
    add("--inputs", type=Path, metavar="CSV", help="places of inputs: x, y, name")
    add("--outputs", type=Path, metavar="CSV", help="places of outputs: x, y, name")
    add("--y-down", action="store_true", default=None, help="y points down in these files, too")
    add("--left", action="store_true", default=None, help="it is a left hand")
    add("--mirrored", action="store_true", default=None, help="show it as a right hand")
    parser.set_defaults(run=_import)


def _add_numbers(add: Any, *numbers: tuple[str, str, str, str]) -> None:
    for flag, name, metavar, about in numbers:
        add(flag, dest=name, type=float, metavar=metavar, help=about)


def _import(arguments: argparse.Namespace) -> None:
    parts = given(arguments, LimbSource)
    # The outline is a part of both: here it is a file.
    values = {key: value for key, value in given(arguments, OwnLimb).items() if key not in parts}
    source = LimbSource(responses=arguments.file, **parts, values=values)
    with ProgressBar(sys.stderr) as bar:
        facts = import_limb(source, replace=arguments.replace, progress=bar)
    sys.stdout.write(f"Imported {_limb_line(facts.name)}\n")


def _limbs(_: argparse.Namespace) -> None:
    for name in available_limbs():
        sys.stdout.write(f"{_limb_line(name)}\n")


def _list(arguments: argparse.Namespace) -> None:
    _limbs(arguments)
    if not own_limb_names():
        sys.stdout.write("No limb was imported. skinsource limb import FILE imports one.\n")


def _mirror(arguments: argparse.Namespace) -> None:
    mirror_limb(arguments.name, not arguments.off)
    sys.stdout.write(f"{_limb_line(arguments.name)}\n")


def _export(arguments: argparse.Namespace) -> None:
    path: Path = arguments.out or arguments.file
    make_folder(path.parent)
    with ProgressBar(sys.stderr) as bar:
        export_limb(arguments.name, path, progress=bar)
    sys.stdout.write(f"{path}\n")


def _remove(arguments: argparse.Namespace) -> None:
    path = own_limb_path(arguments.name)
    remove_limb(arguments.name)
    sys.stdout.write(f"Deleted {path}\n")


def _limb_line(name: str) -> str:
    facts = facts_of(name)
    if not facts.known:
        return f"{name:12}  damaged: import it again"
    mark = "SYNTHETIC  " if facts.synthetic else ""
    line = f"{name:12}  {facts.title:22}  {mark}{facts.sentence}"
    if facts.own:
        size = "" if facts.live else "  Too large for live results: exports and sweeps compute it."
        return f"{line}  {facts.digest[:12]}{size}"
    note = load_limb(name).note
    return f"{line}  NOTE: {note}" if note else line
