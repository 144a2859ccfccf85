"""The command ``skinsource``."""

import argparse
import sys
from collections.abc import Sequence

from skinsource.base.errors import SkinSourceError, Stopped
from skinsource.base.run_limited import serve_if_asked
from skinsource.cli import (
    bench_command,
    check_command,
    design_commands,
    export_command,
    figure_commands,
    limb_commands,
    pack_command,
    rig_commands,
    scene_commands,
    sweep_commands,
)
from skinsource.design.labels import limb_label
from skinsource.limbs.catalog import available_limbs, load_limb
from skinsource.limbs.dataset import commands as dataset_commands
from skinsource.version import __version__

# Modules that add the commands, in the order of the help page.  Each command sets ``run``, a
# function from the parsed arguments to the exit code.
_COMMAND_MODULES = (
    design_commands,
    export_command,
    scene_commands,
    pack_command,
    figure_commands,
    sweep_commands,
    check_command,
    dataset_commands,
    bench_command,
    limb_commands,
    rig_commands,
)

_FAILED, _STOPPED = 1, 130


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command and return its exit code.

    Returns
    -------
    int
        0: done.  1: failed, the reason is one line on stderr.  130: stopped by the user.
        (A wrong call ends in `SystemExit` 2, as usual with argparse.)
    """
    if serve_if_asked(sys.argv[1:] if argv is None else argv):
        return 0
    arguments = _parser().parse_args(argv)
    try:
        return int(arguments.run(arguments))
    except KeyboardInterrupt:
        return _explain("stopped.", _STOPPED)
    except Stopped as reason:
        return _explain(str(reason), _STOPPED)
    except SkinSourceError as error:
        return _explain(str(error), _FAILED)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="skinsource",
        description="Design vibrotactile stimuli and see how they travel across the hand and arm.",
    )
    parser.add_argument("--version", action="version", version=f"skinsource {__version__}")
    subparsers = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    limbs = subparsers.add_parser("limbs", help="show the limbs that can be used")
    limbs.set_defaults(run=_limbs)
    for module in _COMMAND_MODULES:
        module.add_to(subparsers)
    return parser


def _limbs(_: argparse.Namespace) -> int:
    for name in available_limbs():
        limb = load_limb(name)
        label = limb_label(name)
        mark = "SYNTHETIC  " if limb.synthetic else ""
        note = f"  NOTE: {limb.note}" if limb.note else ""
        sys.stdout.write(f"{name:12}  {label.title:22}  {mark}{label.sentence}{note}\n")
    return 0


def _explain(text: str, code: int) -> int:
    sys.stderr.write(f"skinsource: {' '.join(text.split())}\n")
    return code
