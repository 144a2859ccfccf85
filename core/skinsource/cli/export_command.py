"""``skinsource export`` and ``wiring``: stimulus and wiring page of a design file."""

import argparse
import sys
from dataclasses import fields
from pathlib import Path
from typing import Any

from skinsource.actuators.equalising import RegularisedInverse
from skinsource.actuators.rigs import Rig, open_rig
from skinsource.base.files import make_folder
from skinsource.cli.help_format import HelpFormatter
from skinsource.design.design_file import open_design
from skinsource.export.formats import FORMATS, export_formats
from skinsource.export.stimulus_export.export import export_stimulus
from skinsource.export.stimulus_export.options import Nothing, StimulusOptions
from skinsource.export.wiring import export_wiring

_TIME_OPTIONS = {
    "--from": ("from_s", "start of the exported part of the design"),
    "--to": ("to_s", "end of the exported part"),
    "--lead-in": ("lead_in_s", "silence before the stimulus (default: 0.1 s with an equaliser)"),
    "--tail": ("tail_s", "silence after the stimulus (default: 0.1 s with an equaliser)"),
    "--fade-in": ("fade_in_s", "fade at the start"),
    "--fade-out": ("fade_out_s", "fade at the end"),
}


def add_to(subparsers: Any) -> None:
    """Add the command ``export``."""
    listed = "\n".join(f"  {file_format.name:10} {file_format.hint}" for file_format in FORMATS)
    parser = subparsers.add_parser(
        "export",
        help="write the stimulus of a design file: WAV, CSV, MATLAB, C and others",
        description="Writes what the actuators get, and beside it OUT.json, which says what its "
        "numbers mean. One channel per place in use; the largest sample is full scale. Prints the "
        "paths, and below them, indented, a summary, what is lost and whether it is calibrated.",
        epilog=f"formats:\n{listed}",
        formatter_class=HelpFormatter,
    )
    add = parser.add_argument
    add("design", type=Path, metavar="DESIGN", help="a .skinsource file")
    add("--out", type=Path, required=True, metavar="PATH", help="the file, or folder, to write")
    add(
        "--format",
        choices=export_formats(),
        metavar="FORMAT",
        help="one of those below (default: from the ending of PATH)",
    )
    add("--confirm", action="store_true", help="write even if samples clip or limits are exceeded")
    add(
        "--accept-loss",
        action="store_true",
        help="write even if a channel loses more than 1 dB of its energy at this rate",
    )
    add_time = parser.add_argument_group("time").add_argument
    add_time("--rate", type=int, metavar="HZ", help="sample rate (default: that of the format)")
    for flag, (name, description) in _TIME_OPTIONS.items():
        add_time(flag, dest=name, type=float, metavar="S", help=f"{description}, in s")
    _add_channels(parser.add_argument_group("channels").add_argument)
    _add_numbers(parser.add_argument_group("numbers").add_argument)
    _add_rig(parser.add_argument_group("rig").add_argument)
    parser.set_defaults(run=_export)
    wiring = subparsers.add_parser(
        "wiring",
        help="draw which channel of a stimulus goes to which place",
        description="Writes a page with the channels of a stimulus at their places on the hand, "
        "and their polarity, gain and actuator, for the wall beside the setup. Needs the extra "
        "plot.",
    )
    add_wiring = wiring.add_argument
    add_wiring("design", type=Path, metavar="DESIGN", help="a .skinsource file")
    add_wiring(
        "--out", type=Path, required=True, metavar="FILE", help="a .pdf, .svg or .png to write"
    )
    add_wiring("--rig", type=Path, metavar="FILE", help="a .skinrig file: what is wired")
    _add_channels(wiring.add_argument_group("channels").add_argument)
    wiring.set_defaults(run=_wiring)


def _add_channels(add: Any) -> None:
    add("--inputs", type=int, nargs="+", metavar="N", help="only these inputs, by number")
    add("--per", choices=("place", "input"), default="place", help="what gets its own channel")
    add(
        "--file-per-input",
        dest="one_file_per_input",
        action="store_true",
        help="one file with one channel for each input",
    )
    add("--sync", action="store_true", help="add a channel that marks time 0, or --from")
    add(
        "--map",
        dest="channel_map",
        type=int,
        nargs="+",
        default=(),
        metavar="N",
        help="channel of each output of the device, in order; 0: none",
    )


def _add_numbers(add: Any) -> None:
    add(
        "--full-scale",
        type=float,
        metavar="X",
        help="drive at full scale, in its unit (default: the largest sample)",
    )
    add(
        "--dither",
        dest="dither_seed",
        type=int,
        metavar="SEED",
        help="add dither to integer samples, with this seed",
    )
    for name, (formats, options) in _choices().items():
        add(
            f"--{name}",
            dest=f"choice_{name}",
            metavar=f"{{{','.join(options)}}}",
            help=f"for {', '.join(formats)}",
        )


def _add_rig(add: Any) -> None:
    add("--rig", type=Path, metavar="FILE", help="a .skinrig file, or none (default: the design's)")
    add(
        "--equalise",
        choices=("linear", "minimum", "none"),
        help="convert accelerations to volts, with this phase (default: from the design)",
    )
    add("--boost", type=float, metavar="DB", help="largest boost of --equalise (default: 20)")


def _choices() -> dict[str, tuple[list[str], list[str]]]:
    """Return, by name of a choice, the formats that offer it and its options in any of them."""
    choices: dict[str, tuple[list[str], list[str]]] = {}
    for file_format in FORMATS:
        for name, spec in file_format.choices.items():
            formats, options = choices.setdefault(name, ([], []))
            formats.append(file_format.name)
            options.extend(value for value, _ in spec.options if value not in options)
    return choices


def _options(arguments: argparse.Namespace) -> StimulusOptions:
    choices = {name: getattr(arguments, f"choice_{name}", None) for name in _choices()}
    # Flags that are given are fields of the options.
    given = {field.name: getattr(arguments, field.name, None) for field in fields(StimulusOptions)}
    given["choices"] = {name: value for name, value in choices.items() if value is not None}
    return StimulusOptions(**{name: value for name, value in given.items() if value is not None})


def _rig(arguments: argparse.Namespace) -> Rig | Nothing | None:
    if arguments.rig is None:
        return None
    return "none" if str(arguments.rig) == "none" else open_rig(arguments.rig)


def _wiring(arguments: argparse.Namespace) -> int:
    make_folder(arguments.out.parent)
    design = open_design(arguments.design).design
    export_wiring(design, arguments.out, options=_options(arguments), rig=_rig(arguments))
    sys.stdout.write(f"{arguments.out}\n")
    return 0


def _export(arguments: argparse.Namespace) -> int:
    make_folder(arguments.out.parent)
    exported = export_stimulus(
        open_design(arguments.design).design,
        arguments.out,
        arguments.format,
        arguments.rate,
        options=_options(arguments),
        rig=_rig(arguments),
        equaliser=_equaliser(arguments),
        confirmed=arguments.confirm,
    )
    for objection in exported.objections:
        sys.stderr.write(f"skinsource: confirmed: {objection}\n")
    for path in exported.files:
        sys.stdout.write(f"{path}\n")
    for note in filter(
        None, (exported.summary, exported.edges, exported.loses, exported.calibration)
    ):
        sys.stdout.write(f"  {note[:1].upper()}{note[1:].rstrip('.')}.\n")
    return 0


def _equaliser(arguments: argparse.Namespace) -> RegularisedInverse | Nothing | None:
    if arguments.equalise in (None, "none"):
        return arguments.equalise
    boost = {} if arguments.boost is None else {"boost_db": arguments.boost}
    return RegularisedInverse(phase=arguments.equalise, **boost)
