"""``skinsource show``, ``render``, ``film``, ``share``, ``pack``, ``check``: a design's results."""

import argparse
import sys
from pathlib import Path
from typing import Any

from skinsource.actuators.rigs import open_rig
from skinsource.base.conventions import Floats
from skinsource.base.decibels import FLOOR_DB
from skinsource.base.errors import InvalidInputError, counted, escaped, printable
from skinsource.base.files import make_folder
from skinsource.design.amplitudes import amplitude_note, amplitude_text, is_gain
from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input, View, audible_inputs, view_on
from skinsource.design.design_file import open_design
from skinsource.design.labels import AXES, SCALINGS, label_of, level_label, limb_label, signal_label
from skinsource.engine.evaluation import evaluate
from skinsource.export import plot
from skinsource.export.exported_design import ExportedDesign
from skinsource.export.packing import pack
from skinsource.export.tables import write_levels, write_map, write_map_picture, write_traces
from skinsource.export.web_page import export_page
from skinsource.limbs.dataset.commands import ProgressBar, WithTimeLeft
from skinsource.limbs.locations import input_name, output_name
from skinsource.limbs.own_limbs import facts_of
from skinsource.perception.validity import Judged, in_short
from skinsource.readers.reading_process import ReadingProcess
from skinsource.studies.checking import Recorded, condition_of, summary_lines, write_report


def add_to(subparsers: Any) -> None:
    """Add the commands on design files."""
    show = subparsers.add_parser(
        "show",
        help="show the content of a design file, and its levels",
        description="Shows the content of a design file, the conditions of the measurement that it "
        "does not meet, and a table with the level at each output.",
    )
    render = subparsers.add_parser(
        "render",
        help="compute a design file: levels, traces, map and picture",
        description="Writes levels.csv, traces.csv (of the outputs selected in the file), map.csv "
        "and map.png into a folder.",
    )
    film = subparsers.add_parser(
        "film",
        help="write the vibration of a design file in slow motion: MP4, WebM or GIF",
        description="Writes a film of the vibration on hand and arm in slow motion; rings mark "
        "active inputs. It covers the time range of the view in the file. Needs the extras plot "
        "and video.",
    )
    film.add_argument(
        "--out", type=Path, required=True, metavar="FILE", help="a .mp4, .webm or .gif file"
    )
    film.add_argument(
        "--quantity",
        choices=("z", "magnitude"),
        default="z",
        help="acceleration normal to the skin, or the length of its vector (default: z)",
    )
    film.add_argument(
        "--slow-motion",
        type=float,
        metavar="X",
        help="how many times slower than real time (default: 20, or more for fast waves)",
    )
    film.set_defaults(run=_film)
    share = subparsers.add_parser(
        "share",
        help="write a design file as a web page: moving map, levels, traces, snapshots, drive",
        description="Writes one file that any browser of 2023 or later shows, without a request to "
        "anything. Of a measured limb it holds magnitudes in 8 bits, and not the responses.",
    )
    share.add_argument("--out", type=Path, required=True, metavar="FILE", help="a .html file")
    share.set_defaults(run=_share)
    for parser in (show, render, film, share):
        parser.add_argument("design", type=Path, metavar="DESIGN", help="a .skinsource file")
    where = "where to write (default: here)"
    render.add_argument("--out", type=Path, default=Path(), metavar="FOLDER", help=where)
    show.set_defaults(run=_show)
    render.set_defaults(run=_render)
    pack = subparsers.add_parser(
        "pack",
        help="put a design file and all that belongs to it into one zip",
        description="Writes design, stimulus, map, levels, traces, citation, and the versions "
        "and digests of all of them into one zip file.",
    )
    pack.add_argument("design", type=Path, metavar="DESIGN", help="a .skinsource file")
    pack.add_argument("--out", type=Path, required=True, metavar="FILE", help="the zip to write")
    pack.add_argument("--rig", type=Path, metavar="FILE", help="a .skinrig file: what is wired")
    pack.set_defaults(run=_pack)
    _add_check(subparsers)


def _show(arguments: argparse.Namespace) -> None:
    content = open_design(arguments.design)
    design, view = content.design, content.view
    results = evaluate(design, "limb_data", "validity", "output_levels_db", view=view)
    note, judged = results["limb_data"].note, Judged(label="", findings=results["validity"])
    lines = [
        *_design_lines(design),
        *([f"NOTE      {note}"] if note else []),
        *(f"CAUTION   {text}" for text in in_short([judged])),
        *_track_lines(design),
        *_level_lines(design, view, results["output_levels_db"]),
    ]
    sys.stdout.write("\n".join(lines) + "\n")


def _render(arguments: argparse.Namespace) -> None:
    content = open_design(arguments.design)
    folder: Path = arguments.out
    make_folder(folder)
    view = view_on(content.design.limb, content.view)
    exported = ExportedDesign(content.design, view)
    writers = {"levels.csv": write_levels, "map.csv": write_map, "map.png": write_map_picture}
    if content.view.outputs:
        writers["traces.csv"] = write_traces
    for name, write in writers.items():
        write(folder / name, exported)
        sys.stdout.write(f"{folder / name}\n")


def _film(arguments: argparse.Namespace) -> None:
    content = open_design(arguments.design)
    make_folder(arguments.out.parent)
    with ProgressBar(sys.stderr) as bar:
        plot.film(
            content.design,
            arguments.out,
            view=view_on(content.design.limb, content.view),
            quantity=arguments.quantity,
            slow_motion=arguments.slow_motion,
            title=content.design.title,
            progress=WithTimeLeft(bar),
        )
    sys.stdout.write(f"{arguments.out}\n")


def _share(arguments: argparse.Namespace) -> None:
    content = open_design(arguments.design)
    make_folder(arguments.out.parent)
    export_page(content.design, arguments.out, view=content.view)
    sys.stdout.write(f"{arguments.out}\n")


def _design_lines(design: Design) -> list[str]:
    texts = {"title": design.title, "author": design.author, "licence": design.licence}
    limb = limb_label(design.limb)
    synthetic = "  SYNTHETIC" if facts_of(design.limb).synthetic else ""
    return [
        *(f"{name:9} {escaped(text)}" for name, text in texts.items() if text),
        *(f"{'notes':9} {escaped(line)}" for line in design.notes.splitlines()),
        f"limb      {limb.both}{synthetic}",
        f"scaling   {label_of(SCALINGS, design.scaling).both}",
        *([f"through   {design.actuated.words}"] if design.actuated is not None else []),
    ]


def _track_lines(design: Design) -> list[str]:
    n_audible = len(audible_inputs(design.inputs))
    meaning = amplitude_note(design.limb, design.limb_digest, design.scaling, design.actuated)
    return [
        *([f"amplitude {meaning}"] if meaning else []),
        f"inputs    {len(design.inputs)}, {n_audible} of them heard",
        *(line for track in design.inputs for line in _lines_of_track(track, design)),
    ]


def _lines_of_track(track: Input, design: Design) -> list[str]:
    marks = "".join(
        f", {word}" for word, is_so in (("muted", track.muted), ("solo", track.solo)) if is_so
    )
    curve = f", gain curve of {counted(len(track.gain_curve), 'point')}" if track.gain_curve else ""
    strength = amplitude_text(design, track)
    if not is_gain(design, track):
        strength = f"amplitude {strength}"
    return [
        f"  {track.id:3}  place {track.location}, {input_name(track.location, design.limb).name}: "
        f"{strength}{curve}{marks}",
        *(f"       from {clip.onset_s:g} s: {_clip_text(clip)}" for clip in track.clips),
    ]


def _clip_text(clip: Clip) -> str:
    gain = "" if clip.gain == 1.0 else f", gain {clip.gain:g}"
    effects = "".join(f", {effect}" for effect in clip.effects if effect.on)
    return f"{clip.waveform}{gain}{effects}{', muted' if clip.muted else ''}"


def _level_lines(design: Design, view: View, levels_db: Floats) -> list[str]:
    lines = [
        f"levels    {level_label(view.span)}; {signal_label(view.axes, view.method)}",
        "  output  dB re 1 m/s²  place",
    ]
    for number, level_db in enumerate(levels_db.tolist(), start=1):
        name = output_name(number, design.limb).name
        level = f"{level_db:.1f}" if level_db > FLOOR_DB else "silent"
        lines.append(f"  {number:6}  {level:>12}  {name}".rstrip())
    return lines


def _pack(arguments: argparse.Namespace) -> None:
    if arguments.out.suffix.lower() != ".zip":
        raise InvalidInputError(
            f"{printable(arguments.out.name)} is not the name of a zip file. Call it *.zip."
        )
    content = open_design(arguments.design)
    rig = None if arguments.rig is None else open_rig(arguments.rig)
    view = view_on(content.design.limb, content.view)
    make_folder(arguments.out.parent)
    pack(arguments.out, content.design, view, rig=rig)
    sys.stdout.write(f"{arguments.out}\n")


def _add_check(subparsers: Any) -> None:
    """Add the command ``check``."""
    parser = subparsers.add_parser(
        "check",
        help="check linearity and superposition, and agreement with recorded responses",
        description=(
            "For each design: whether responses scale linearly, whether they superpose, and, "
            "with --measured, the figures of the paper's Fig. 4 against recorded responses "
            "(CSV, NPZ, MATLAB, HDF5: times by outputs and axes)."
        ),
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


def _check(arguments: argparse.Namespace) -> None:
    measured = arguments.measured or [None] * len(arguments.designs)
    if len(measured) != len(arguments.designs):
        raise InvalidInputError(
            f"{counted(len(measured), 'recording')} for "
            f"{counted(len(arguments.designs), 'design')}, expected one for each. Name them in the "
            "same order."
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
