"""``skinsource rig measure | devices``: measure actuators, and list audio devices."""

import argparse
import sys
from pathlib import Path
from typing import Any

from skinsource.actuators.rigs import open_rig, save_rig
from skinsource.lab.playing.devices import Output, devices
from skinsource.lab.rig_measuring.duplex import input_devices
from skinsource.lab.rig_measuring.measurement import MeasuringSetup, kept, measure
from skinsource.limbs.dataset.commands import ProgressBar

_MEASURE = (
    "Plays sweeps on the output of one channel, records an accelerometer, and writes acceleration "
    "for each volt over frequency into the rig file. Nothing passes a limit of the rig; a quieter "
    "sweep comes first. Ctrl+C stops at once."
)


def add_to(subparsers: Any) -> None:
    """Add the command ``rig`` with its actions."""
    rig = subparsers.add_parser(
        "rig",
        help="measure the actuators of a rig",
        description="A rig says what is wired to which output, and how it responds. To edit one, "
        "use Play > Rig… in the studio.",
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
        type=float,
        required=True,
        metavar="V",
        help="sensitivity of the accelerometer, V per m/s² (100 mV per g is 0.0102)",
    )
    add(
        "--input-volts",
        type=float,
        required=True,
        metavar="V",
        help="volts at the input for a recorded sample of 1",
    )
    add("--input", type=int, default=default.input_number, metavar="N", help="from 1")
    add(
        "--loopback",
        type=int,
        default=default.loopback_input,
        metavar="N",
        help="input that is wired to the output, to measure the delay (default: none)",
    )
    add = parser.add_argument_group("sweeps").add_argument
    add(
        "--level",
        type=float,
        default=default.level_db,
        metavar="DB",
        help=f"dB of full scale (default: {default.level_db:g})",
    )
    add("--seconds", type=float, default=default.sweep_s, metavar="S", help="length of each sweep")
    add("--repeats", type=int, default=default.repeats, metavar="N")
    add(
        "--band",
        type=float,
        nargs=2,
        default=default.band_hz,
        metavar="HZ",
        help="lowest and highest frequency to measure (default: 20 1000)",
    )
    add = parser.add_argument_group("audio devices").add_argument
    add("--rate", type=int, default=output.sample_rate_hz, metavar="HZ")
    add("--device", default="", metavar="NAME", help="default: that of the rig, or the system")
    add("--input-device", default="", metavar="NAME", help="default: the playback device")
    parser.set_defaults(run=_measure)


def _measure(arguments: argparse.Namespace) -> int:
    rig = open_rig(arguments.rig)
    setup = MeasuringSetup(
        sensitivity_v_per_m_per_s2=arguments.sensitivity,
        input_full_scale_v=arguments.input_volts,
        input_number=arguments.input,
        loopback_input=arguments.loopback,
        input_device=arguments.input_device,
        level_db=arguments.level,
        sweep_s=arguments.seconds,
        repeats=arguments.repeats,
        lowest_hz=arguments.band[0],
        highest_hz=arguments.band[1],
    )
    output = Output(device=arguments.device, sample_rate_hz=arguments.rate)
    with ProgressBar(sys.stderr) as bar:
        measurement = measure(rig, arguments.place, setup, output=output, progress=bar)
    path = arguments.out or arguments.rig
    save_rig(path, kept(rig, measurement))
    sys.stdout.write("\n".join((*measurement.lines, str(path))) + "\n")
    return 0


def _devices(_: argparse.Namespace) -> int:
    for title, listed in (("Outputs", devices()), ("Inputs", input_devices())):
        sys.stdout.write(f"{title}\n")
        for device in listed:
            mark = "  (usual)" if device.is_default else ""
            sys.stdout.write(f"  {device.title}{mark}\n")
        if not listed:
            sys.stdout.write("  none\n")
    return 0
