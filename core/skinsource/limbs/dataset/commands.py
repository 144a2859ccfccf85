"""The commands ``skinsource dataset ...``, and the progress bar of the terminal."""

import argparse
import sys
import time
from pathlib import Path
from typing import Any, Self, TextIO

from skinsource.base.conventions import HAND_LENGTHS_MM
from skinsource.base.errors import DatasetMissingError
from skinsource.base.job import seconds_left, time_left_text
from skinsource.limbs.dataset.install import fetch, install
from skinsource.limbs.dataset.published import DATASET_URL, MAP_URL, published_files
from skinsource.limbs.dataset.store import (
    HOW_TO_GET,
    NOT_INSTALLED,
    REINSTALL,
    StoreInfo,
    describe,
    installed_files,
    remove,
    verify,
)

_WIDTH = 30


class ProgressBar:
    """Draws itself over and over on one line; draws nothing where there is no terminal.

    Use it in a ``with`` statement, and hand it to a job as its ``progress``.
    """

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._shown = ""
        self._is_terminal = stream.isatty()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._draw("")

    def __call__(self, done: int, total: int, text: str) -> None:
        """Show ``done`` of ``total``."""
        share = done / total if total else 1.0
        filled = "#" * int(_WIDTH * share)
        self._draw(f"[{filled:.<{_WIDTH}}] {share:4.0%} {text}"[:79])

    def _draw(self, line: str) -> None:
        if self._is_terminal and line != self._shown:
            self._stream.write("\r" + line.ljust(len(self._shown)) + ("" if line else "\r"))
            self._stream.flush()
            self._shown = line


class WithTimeLeft:
    """Shows progress with the time left, as seen since the start of this run."""

    def __init__(self, bar: ProgressBar) -> None:
        self._bar = bar
        self._start_s = time.monotonic()
        self._before: int | None = None

    def __call__(self, done: int, total: int, text: str) -> None:
        """Show ``done`` of ``total``."""
        if self._before is None:
            self._before = done
        elapsed_s = time.monotonic() - self._start_s
        left = time_left_text(seconds_left(done - self._before, total - self._before, elapsed_s))
        self._bar(done, total, f"{text}  {left}".rstrip())


def add_to(subparsers: Any) -> None:
    """Add the command ``dataset`` with its five actions."""
    dataset = subparsers.add_parser(
        "dataset",
        help="get, check and remove the measured dataset",
        description=f"The measured limbs are not part of the program. {HOW_TO_GET}",
    )
    actions = dataset.add_subparsers(title="actions", metavar="ACTION", required=True)

    action = actions.add_parser("install", help="install from files you have downloaded")
    action.add_argument(
        "path",
        type=Path,
        metavar="PATH",
        help="folder that holds impulseResponses.mat and the toolbox's folder 'visualization', "
        "or impulseResponses.mat itself with that folder beside it",
    )
    action.add_argument(
        "--unpublished",
        action="store_true",
        help="accept map files that are not the published ones",
    )
    action.set_defaults(run=_install)

    action = actions.add_parser("fetch", help="download (70 MB) and install")
    action.add_argument("--dataset-url", default=DATASET_URL, help="mirror (default: %(default)s)")
    action.add_argument("--map-url", default=MAP_URL, help="mirror (default: %(default)s)")
    action.set_defaults(run=_fetch)

    actions.add_parser("list", help="show what is installed").set_defaults(run=_list)
    actions.add_parser("verify", help="compare every checksum").set_defaults(run=_verify)

    action = actions.add_parser("remove", help="delete what is installed")
    action.add_argument("--yes", action="store_true", help="do not ask")
    action.set_defaults(run=_remove)


def _install(arguments: argparse.Namespace) -> None:
    with ProgressBar(sys.stderr) as bar:
        info = install(arguments.path, unpublished=arguments.unpublished, progress=bar)
    _print_installed(info)


def _fetch(arguments: argparse.Namespace) -> None:
    files = published_files(arguments.dataset_url, arguments.map_url)
    with ProgressBar(sys.stderr) as bar:
        info = fetch(files=files, progress=bar)
    _print_installed(info)


def _list(_: argparse.Namespace) -> None:
    try:
        info = describe()
    except DatasetMissingError:
        sys.stdout.write(f"{NOT_INSTALLED} {HOW_TO_GET}\n")
        return
    for number in info.limbs:
        length_mm = HAND_LENGTHS_MM[number - 1]
        sys.stdout.write(f"measured-{number}  hand length {length_mm:g} mm\n")
    sys.stdout.write(
        f"store      {info.path} ({_megabytes(info.size_bytes)})\n"
        f"installed  {info.installed_at}\n"
        f"made from  {info.source_name} ({info.source_bytes} bytes)\n"
        f"sha256     {info.source_sha256}\n"
    )
    _print_note(info)


def _verify(_: argparse.Namespace) -> int:
    with ProgressBar(sys.stderr) as bar:
        problems = verify(progress=bar)
    for problem in problems:
        sys.stderr.write(f"skinsource: {problem}\n")
    if problems:
        sys.stderr.write(f"skinsource: the measured dataset is damaged. {REINSTALL}\n")
        return 1
    sys.stdout.write("The measured dataset is whole: every checksum matches.\n")
    _print_note(describe())
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


def _print_installed(info: StoreInfo) -> None:
    sys.stdout.write(
        f"Installed measured-{info.limbs[0]} to measured-{info.limbs[-1]} "
        f"({_megabytes(info.size_bytes)}) in {info.path}\n"
    )
    _print_note(info)


def _print_note(info: StoreInfo) -> None:
    if info.note:
        sys.stdout.write(f"NOTE       {info.note}\n")


def _megabytes(n_bytes: int) -> str:
    return f"{n_bytes / 1e6:.1f} MB"
