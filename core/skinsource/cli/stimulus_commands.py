"""``skinsource export``, ``wiring``, ``sweep`` and ``rig``: stimuli for actuators."""

import argparse
import sys
from pathlib import Path
from typing import Any

from skinsource.actuators.equalising import RegularisedInverse
from skinsource.actuators.rigs import Rig, open_rig, save_rig
from skinsource.base.errors import InvalidInputError
from skinsource.base.files import make_folder
from skinsource.cli.help_format import HelpFormatter, given
from skinsource.design.design_file import open_design
from skinsource.export.formats import FORMATS, export_formats
from skinsource.export.stimulus_export.export import export_stimulus
from skinsource.export.stimulus_export.options import Nothing, StimulusOptions
from skinsource.export.wiring import export_wiring
from skinsource.lab.playing.devices import Output, devices
from skinsource.lab.rig_measuring.duplex import input_devices
from skinsource.lab.rig_measuring.measurement import MeasuringSetup, kept, measure
from skinsource.limbs.dataset.commands import ProgressBar, WithTimeLeft
from skinsource.studies.sweeps.running import read_sweep, read_variables, run
from skinsource.studies.sweeps.stimulus_set import CONDITIONS, export_set
from skinsource.studies.sweeps.table import TABLE
from skinsource.studies.sweeps.workers import Cluster

_TIME_OPTIONS = {
    "--from": ("from_s", "start of the exported part of the design"),
    "--to": ("to_s", "end of the exported part"),
    "--lead-in": ("lead_in_s", "silence before the stimulus (default: 0.1 s with an equaliser)"),
    "--tail": ("tail_s", "silence after the stimulus (default: 0.1 s with an equaliser)"),
    "--fade-in": ("fade_in_s", "fade at the start"),
    "--fade-out": ("fade_out_s", "fade at the end"),
}


def add_to(subparsers: Any) -> None:
    """Add the commands on stimuli for actuators."""
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
    add_set = parser.add_argument_group("set of stimuli, in the folder PATH").add_argument
    vary = "values as in a sweep: 'frequency_hz = [50, 100]'; repeated: all combinations"
    add_set("--vary", action="append", metavar="VALUES", help=vary)
    level = "that level, in dB re 1 m/s² (default: that of the design); repeated: each"
    add_set("--match-output", type=int, metavar="N", help="same level at this output in all files")
    add_set("--level-db", action="append", type=float, metavar="DB", help=level)
    add_time = parser.add_argument_group("time").add_argument
    add_time("--rate", type=int, metavar="HZ", help="sample rate (default: that of the format)")
    for flag, (name, description) in _TIME_OPTIONS.items():
        add_time(flag, dest=name, type=float, metavar="S", help=f"{description}, in s")
    text = "write the range between people into the sidecar"
    add("--people", action="store_true", help=text)
    _add_channels(parser.add_argument_group("channels").add_argument)
    _add_numbers(parser.add_argument_group("numbers").add_argument)
    add = parser.add_argument_group("rig").add_argument
    add("--rig", type=Path, metavar="FILE", help="a .skinrig file, or none (default: the design's)")
    add(
        "--equalise",
        choices=("linear", "minimum", "none"),
        help="regularised inverse with this phase, or none (default: that of the design)",
    )
    add("--boost", type=float, metavar="DB", help="largest boost of --equalise (default: 20)")
    parser.set_defaults(run=_export)
    wiring = subparsers.add_parser(
        "wiring",
        help="draw which channel of a stimulus goes to which place",
        description="Writes a page with the channels of a stimulus at their places on the hand, "
        "and their polarity, gain and actuator, for the wall beside the setup. Needs the extra "
        "plot.",
    )
    add = wiring.add_argument
    add("design", type=Path, metavar="DESIGN", help="a .skinsource file")
    add("--out", type=Path, required=True, metavar="FILE", help="a .pdf, .svg or .png to write")
    add("--rig", type=Path, metavar="FILE", help="a .skinrig file: what is wired")
    _add_channels(wiring.add_argument_group("channels").add_argument)
    wiring.set_defaults(run=_wiring)
    _add_sweep(subparsers)
    _add_rig_actions(subparsers)


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
    chosen = {name: value for name, value in choices.items() if value is not None}
    return StimulusOptions(**given(arguments, StimulusOptions), choices=chosen)


def _rig(arguments: argparse.Namespace) -> Rig | Nothing | None:
    if arguments.rig is None:
        return None
    return "none" if str(arguments.rig) == "none" else open_rig(arguments.rig)


def _wiring(arguments: argparse.Namespace) -> None:
    make_folder(arguments.out.parent)
    design = open_design(arguments.design).design
    export_wiring(design, arguments.out, options=_options(arguments), rig=_rig(arguments))
    sys.stdout.write(f"{arguments.out}\n")


def _export(arguments: argparse.Namespace) -> int:
    make_folder(arguments.out.parent)
    made_for: dict[str, Any] = {
        "options": _options(arguments),
        "rig": _rig(arguments),
        "equaliser": _equaliser(arguments),
        "confirmed": arguments.confirm,
    }
    if (arguments.vary, arguments.match_output, arguments.level_db) != (None, None, None):
        return _export_set(arguments, made_for)
    exported = export_stimulus(
        open_design(arguments.design).design,
        arguments.out,
        arguments.format,
        arguments.rate,
        **made_for,
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


def _export_set(arguments: argparse.Namespace, made_for: dict[str, Any]) -> int:
    with ProgressBar(sys.stderr) as bar:
        exported = export_set(
            open_design(arguments.design).design,
            read_variables("\n".join(arguments.vary or ())),
            arguments.out,
            arguments.format or "wav",
            arguments.rate,
            match_output=arguments.match_output,
            level_db=arguments.level_db,
            progress=bar,
            **made_for,
        )
    for number, reason in exported.refused.items():
        sys.stderr.write(f"skinsource: condition {number} left out: {reason}\n")
    sys.stdout.write(f"{arguments.out / CONDITIONS}\n  {exported.summary}.\n")
    for condition in exported.written:
        if condition.weakened:
            sys.stdout.write(f"  {condition.name}: {condition.weakened}\n")
    # Programs that use the set must notice that it is incomplete.
    return int(bool(exported.refused))


def _equaliser(arguments: argparse.Namespace) -> RegularisedInverse | Nothing | None:
    if arguments.equalise in (None, "none"):
        if arguments.boost is not None:
            raise InvalidInputError(
                f"--boost {arguments.boost:g} has no equaliser that it limits, expected --equalise "
                "linear or minimum, too"
            )
        return arguments.equalise
    boost = {} if arguments.boost is None else {"boost_db": arguments.boost}
    return RegularisedInverse(phase=arguments.equalise, **boost)


_MOST_SHOWN = 10


def _add_sweep(subparsers: Any) -> None:
    """Add the command ``sweep``."""
    sweep = subparsers.add_parser(
        "sweep",
        help="predict many stimuli: designs x frequencies x places x ...",
        description=(
            "Predicts all combinations that a TOML file names, on all cores, and writes a row of "
            "metrics for each to stimuli.csv. Run it again after a stop, and it continues."
        ),
        epilog=(
            "A stimulus that cannot be predicted is left out, and its row says why. Exit codes: 0, "
            "all were predicted; 1, one was left out or the sweep could not run; 130, it was "
            "stopped."
        ),
    )
    add = sweep.add_argument
    add("sweep", type=Path, metavar="SWEEP", help="a .toml file")
    add("--out", type=Path, required=True, metavar="FOLDER", help="folder to write or continue in")
    add("--processes", type=int, metavar="N", help="number of processes (default: all cores)")
    add(
        "--scheduler",
        metavar="ADDRESS",
        help="address of a Dask cluster that computes instead: tcp://host:8786",
    )
    sweep.set_defaults(run=_sweep)


def _sweep(arguments: argparse.Namespace) -> int:
    plan = read_sweep(arguments.sweep)
    cluster = None if arguments.scheduler is None else Cluster(arguments.scheduler)
    with ProgressBar(sys.stderr) as bar:
        table = run(
            plan,
            arguments.out,
            processes=arguments.processes,
            measuring=cluster,
            progress=WithTimeLeft(bar),
        )
    failed = table.failed
    for number in sorted(failed)[:_MOST_SHOWN]:
        sys.stderr.write(f"skinsource: stimulus {number} left out: {failed[number]}\n")
    if len(failed) > _MOST_SHOWN:
        sys.stderr.write(f"skinsource: … and {len(failed) - _MOST_SHOWN} more\n")
    left_out = f", {len(failed)} of them left out" if failed else ""
    sys.stdout.write(f"{len(table)} stimuli{left_out}\n{arguments.out / TABLE}\n")
    # Programs that use the table (make, a queue of jobs) must notice that it is incomplete.
    return int(bool(failed))


_MEASURE = (
    "Plays sweeps on the output of one channel, records an accelerometer, and writes acceleration "
    "for each volt over frequency into the rig file. Nothing passes a limit of the rig; a quieter "
    "sweep comes first. Ctrl+C stops at once."
)


def _add_rig_actions(subparsers: Any) -> None:
    """Add the command ``rig`` with its actions."""
    rig = subparsers.add_parser(
        "rig",
        help="measure the actuators of a rig",
        description=(
            "A rig says what is wired to which output, and how it responds. To edit one, use Play "
            "> Rig… in the studio."
        ),
    )
    actions = rig.add_subparsers(title="actions", metavar="ACTION", required=True)
    _add_measure(actions)
    parser = actions.add_parser("devices", help="list devices for playback and recording")
    parser.set_defaults(run=_devices)


def _add_measure(actions: Any) -> None:
    default, output = MeasuringSetup(), Output()
    parser = actions.add_parser(
        "measure", help="measure a channel with an accelerometer", description=_MEASURE
    )
    parser.add_argument("rig", type=Path, metavar="RIG", help="a .skinrig file")
    parser.add_argument("--out", type=Path, metavar="FILE", help="rig to write (default: RIG)")
    add = parser.add_argument_group("channel and accelerometer").add_argument
    add("--place", type=int, required=True, metavar="N", help="place of the channel")
    add(
        "--sensitivity",
        dest="sensitivity_v_per_m_per_s2",
        type=float,
        required=True,
        metavar="V",
        help="sensitivity of the accelerometer, V per m/s² (100 mV per g is 0.0102)",
    )
    add(
        "--input-volts",
        dest="input_full_scale_v",
        type=float,
        required=True,
        metavar="V",
        help="volts at the input for a recorded sample of 1",
    )
    add("--input", dest="input_number", type=int, metavar="N", help="with the sensor")
    add(
        "--loopback",
        dest="loopback_input",
        type=int,
        metavar="N",
        help="input that is wired to the output, to measure the delay (default: none)",
    )
    add = parser.add_argument_group("sweeps").add_argument
    add(
        "--level",
        dest="level_db",
        type=float,
        metavar="DB",
        help=f"of the sweeps, dB re full scale (default: {default.level_db:g})",
    )
    add("--seconds", dest="sweep_s", type=float, metavar="S", help="of each sweep")
    add("--repeats", type=int, metavar="N")
    add(
        "--band",
        type=float,
        nargs=2,
        default=default.band_hz,
        metavar="HZ",
        help="lowest and highest frequency to measure, Hz (default: 20 1000)",
    )
    add = parser.add_argument_group("audio devices").add_argument
    add("--rate", type=int, default=output.sample_rate_hz, metavar="HZ")
    add("--device", default="", metavar="NAME", help="default: that of the rig, or the system")
    add("--input-device", metavar="NAME", help="default: the playback device")
    parser.set_defaults(run=_measure)


def _measure(arguments: argparse.Namespace) -> None:
    rig = open_rig(arguments.rig)
    lowest_hz, highest_hz = arguments.band
    options = given(arguments, MeasuringSetup)
    setup = MeasuringSetup(**options, lowest_hz=lowest_hz, highest_hz=highest_hz)
    output = Output(device=arguments.device, sample_rate_hz=arguments.rate)
    with ProgressBar(sys.stderr) as bar:
        measurement = measure(rig, arguments.place, setup, output=output, progress=bar)
    path = arguments.out or arguments.rig
    save_rig(path, kept(rig, measurement))
    sys.stdout.write("\n".join((*measurement.lines, str(path))) + "\n")


def _devices(_: argparse.Namespace) -> None:
    for title, listed in (("Outputs", devices()), ("Inputs", input_devices())):
        sys.stdout.write(f"{title}\n")
        for device in listed:
            mark = "  (usual)" if device.is_default else ""
            sys.stdout.write(f"  {device.title}{mark}\n")
        if not listed:
            sys.stdout.write("  none\n")
