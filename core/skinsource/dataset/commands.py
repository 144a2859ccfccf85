"""``skinsource dataset install | fetch | list | verify | remove``."""

import argparse
import sys
from pathlib import Path
from typing import Any

from skinsource.dataset.fetch import fetch
from skinsource.dataset.install import install
from skinsource.dataset.not_installed import HOW_TO_GET, NOT_INSTALLED
from skinsource.dataset.progress_bar import ProgressBar
from skinsource.dataset.published import DATASET_URL, MAP_URL, published_files
from skinsource.dataset.store import (
    StoreInfo,
    describe,
)
from skinsource.dataset.store_parts import REINSTALL
from skinsource.dataset.upkeep import installed_files, remove, verify
from skinsource.errors import DatasetMissingError
from skinsource.limb import HAND_LENGTHS_MM


def add_to(subparsers: Any) -> None:
    """Add the command ``dataset`` with its five actions."""
    dataset = subparsers.add_parser(
        "dataset",
        help="get, check and remove the measured dataset",
        description=f"The measured limbs are not part of the program. {HOW_TO_GET}",
    )
    actions = dataset.add_subparsers(title="actions", metavar="ACTION", required=True)

    one = actions.add_parser("install", help="install from files you have downloaded")
    one.add_argument(
        "path",
        type=Path,
        metavar="PATH",
        help="folder that holds impulseResponses.mat and the toolbox's folder 'visualization', "
        "or impulseResponses.mat itself with that folder beside it",
    )
    one.add_argument(
        "--unpublished",
        action="store_true",
        help="accept map files that are not the published ones",
    )
    one.set_defaults(run=_install)

    one = actions.add_parser("fetch", help="download (70 MB) and install")
    one.add_argument("--dataset-url", default=DATASET_URL, help="mirror (default: %(default)s)")
    one.add_argument("--map-url", default=MAP_URL, help="mirror (default: %(default)s)")
    one.set_defaults(run=_fetch)

    actions.add_parser("list", help="show what is installed").set_defaults(run=_list)
    actions.add_parser("verify", help="compare every checksum").set_defaults(run=_verify)

    one = actions.add_parser("remove", help="delete what is installed")
    one.add_argument("--yes", action="store_true", help="do not ask")
    one.set_defaults(run=_remove)


def _install(arguments: argparse.Namespace) -> int:
    with ProgressBar(sys.stderr) as bar:
        info = install(arguments.path, unpublished=arguments.unpublished, progress=bar)
    _say_installed(info)
    return 0


def _fetch(arguments: argparse.Namespace) -> int:
    files = published_files(arguments.dataset_url, arguments.map_url)
    with ProgressBar(sys.stderr) as bar:
        info = fetch(files=files, progress=bar)
    _say_installed(info)
    return 0


def _list(_: argparse.Namespace) -> int:
    try:
        info = describe()
    except DatasetMissingError:
        sys.stdout.write(f"{NOT_INSTALLED} {HOW_TO_GET}\n")
        return 0
    for number in info.limbs:
        length_mm = HAND_LENGTHS_MM[number - 1]
        sys.stdout.write(f"measured-{number}  hand length {length_mm:g} mm\n")
    sys.stdout.write(
        f"store      {info.path} ({_megabytes(info.size_bytes)})\n"
        f"installed  {info.installed_at}\n"
        f"made from  {info.source_name} ({info.source_bytes} bytes)\n"
        f"sha256     {info.source_sha256}\n"
    )
    _say_note(info)
    return 0


def _verify(_: argparse.Namespace) -> int:
    with ProgressBar(sys.stderr) as bar:
        problems = verify(progress=bar)
    for problem in problems:
        sys.stderr.write(f"skinsource: {problem}\n")
    if problems:
        sys.stderr.write(f"skinsource: the measured dataset is damaged. {REINSTALL}\n")
        return 1
    sys.stdout.write("The measured dataset is whole: every checksum matches.\n")
    _say_note(describe())
    return 0


def _remove(arguments: argparse.Namespace) -> int:
    files = installed_files()
    if not files:
        sys.stdout.write("Nothing is installed.\n")
        return 0
    for path in files:
        sys.stdout.write(f"{path} ({_megabytes(path.stat().st_size)})\n")
    if not (arguments.yes or _confirmed()):
        sys.stdout.write("Nothing was deleted.\n")
        return 1
    remove()
    sys.stdout.write("Deleted.\n")
    return 0


def _confirmed() -> bool:
    sys.stdout.write("Delete these files? [y/N] ")
    sys.stdout.flush()
    return sys.stdin.readline().strip().lower() in ("y", "yes")


def _say_installed(info: StoreInfo) -> None:
    sys.stdout.write(
        f"Installed measured-{info.limbs[0]} to measured-{info.limbs[-1]} "
        f"({_megabytes(info.size_bytes)}) in {info.path}\n"
    )
    _say_note(info)


def _say_note(info: StoreInfo) -> None:
    if info.note:
        sys.stdout.write(f"NOTE       {info.note}\n")


def _megabytes(n_bytes: int) -> str:
    return f"{n_bytes / 1e6:.1f} MB"
