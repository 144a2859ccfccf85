"""``skinsource check``: check linearity, superposition, and agreement with recordings."""

import argparse
import sys
from pathlib import Path
from typing import Any

from skinsource.base.errors import InvalidInputError
from skinsource.base.files import make_folder
from skinsource.design.design_file import open_design
from skinsource.design.labels import AXES
from skinsource.readers.reading_process import ReadingProcess
from skinsource.studies.checking import Recorded, condition_of, summary_lines, write_report


def add_to(subparsers: Any) -> None:
    """Add the command ``check``."""
    parser = subparsers.add_parser(
        "check",
        help="check linearity and superposition, and agreement with recorded responses",
        description="For each design: whether outputs are proportional to inputs, whether inputs "
        "add up, and, with --measured, the figures of the paper's Fig. 4 against recorded "
        "responses (CSV, NPZ, MATLAB, HDF5: times by outputs and axes).",
    )
    parser.add_argument("designs", type=Path, nargs="+", metavar="DESIGN", help=".skinsource files")
    parser.add_argument(
        "--measured",
        type=Path,
        nargs="+",
        default=[],
        metavar="FILE",
        help="recorded responses, one file for each design, in their order",
    )
    parser.add_argument(
        "--axes",
        default="",
        choices=tuple(word.name for word in AXES),
        help="recorded axes (default: all axes of the limb)",
    )
    parser.add_argument(
        "--rate",
        type=float,
        metavar="HZ",
        help="rate of recordings that state none (default: that of the limb)",
    )
    parser.add_argument("--out", type=Path, metavar="FILE", help="an HTML report to write")
    parser.set_defaults(run=_check)


def _check(arguments: argparse.Namespace) -> int:
    measured = arguments.measured or [None] * len(arguments.designs)
    if len(measured) != len(arguments.designs):
        raise InvalidInputError(
            f"{len(measured)} recordings for {len(arguments.designs)} designs, expected one for "
            "each. Name them in the same order."
        )
    designs = {path: open_design(path).design for path in arguments.designs}
    with ReadingProcess() as process:
        conditions = [
            condition_of(
                designs[path],
                path.name,
                None if file is None else Recorded(path=file, rate_hz=arguments.rate),
                axes=arguments.axes,
                process=process,
            )
            for path, file in zip(arguments.designs, measured, strict=True)
        ]
    sys.stdout.write("\n".join(summary_lines(conditions)) + "\n")
    if arguments.out is not None:
        make_folder(arguments.out.parent)
        write_report(arguments.out, conditions, (design.limb for design in designs.values()))
        sys.stdout.write(f"{arguments.out}\n")
    return 0
