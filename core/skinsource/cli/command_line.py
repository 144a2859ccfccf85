"""The command ``skinsource``."""

import argparse
import os
import sys
from collections.abc import Sequence

from skinsource.base.errors import SkinSourceError, Stopped
from skinsource.cli import (
    bench_command,
    design_commands,
    doctor_command,
    limb_commands,
    scene_commands,
    stimulus_commands,
)
from skinsource.cli.help_format import CommandsFormatter
from skinsource.limbs.dataset import commands as dataset_commands
from skinsource.version import __version__

# Modules that add the commands, by the groups of the help page.  Each command sets ``run``, a
# function from the parsed arguments to the exit code, if that may be another one than 0.
_COMMAND_MODULES = {
    "designs": (design_commands,),
    "stimuli for actuators": (stimulus_commands,),
    "figures of the paper": (scene_commands,),
    "limbs": (limb_commands, dataset_commands),
    "this program": (doctor_command, bench_command),
}

_FAILED, _STOPPED, _UNREAD = 1, 130, 141


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command and return its exit code.

    Returns
    -------
    int
        0: done.  1: failed, the reason is one line on stderr.  130: stopped by the user.
        141: who reads the output has closed it.
        (A wrong call ends in `SystemExit` 2, as usual with argparse.)
    """
    try:
        try:
            arguments = _parser().parse_args(argv)
            return int(arguments.run(arguments) or 0)
        finally:
            sys.stdout.flush()
    except BrokenPipeError:
        # What is left of the output goes nowhere: Python writes it at the end.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return _UNREAD
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
        epilog="skinsource COMMAND --help explains a command.",
        formatter_class=CommandsFormatter,
    )
    parser.add_argument("--version", action="version", version=f"skinsource {__version__}")
    subparsers = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    CommandsFormatter.titles = {}
    for title, modules in _COMMAND_MODULES.items():
        n_before = len(subparsers.choices)
        for module in modules:
            module.add_to(subparsers)
        CommandsFormatter.titles[list(subparsers.choices)[n_before]] = title
    return parser


def _explain(text: str, code: int) -> int:
    sys.stderr.write(f"skinsource: {' '.join(text.split())}\n")
    return code
