"""A design with all that belongs to it, as one zip file."""

import hashlib
import importlib
import json
import platform
import zipfile
from collections.abc import Callable
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import scipy

from skinsource.design import Design, audible_inputs
from skinsource.design_file import save_design
from skinsource.errors import MissingExtraError
from skinsource.export import export_levels, export_map, export_map_picture, export_traces
from skinsource.extras import package_of_extra
from skinsource.files import replacing
from skinsource.job import Progress, Stop, never, silent, stop_if
from skinsource.packing.data_citation import citation, data_of
from skinsource.rigs import Rig, save_rig
from skinsource.version import __version__
from skinsource.view import View

# What is packed twice is the same file twice: no clock has a part in it.
_DATE = (1980, 1, 1, 0, 0, 0)
_RATE_HZ = 48_000
_FIGURES = ("svg", "pdf")
_READ_ME = """What lies here

design.skinsource      the design, as SkinSource studio opens it
stimulus.wav, .json    what the actuators get, and what its numbers mean
map.png, map.csv       the map of levels, as a picture and as numbers
figure.svg, .pdf       the same map as lines, for a paper, where matplotlib is installed
levels.csv             levels of all outputs
traces.csv             acceleration of the selected outputs
rig.skinrig            what was wired to what, where that was said
citation.txt           what to cite
about.json             versions, limb, digests of the data and of each of these files
"""


def _stimuli() -> Any:
    # Imported when something is packed: the studio starts without it.
    return importlib.import_module("skinsource.stimulus_export")


def pack(
    path: Path,
    design: Design,
    view: View,
    *,
    rig: Rig | None = None,
    progress: Progress = silent,
    stop: Stop = never,
) -> None:
    """Write a design with its stimulus, figure and tables, and where all of it comes from.

    The same design gives the same bytes, with the same versions.

    Parameters
    ----------
    path
        The zip file; what stands there is replaced, at the end.
    design, view
        What is packed; of the traces, the selected outputs.
    rig
        What its places are wired to, if that is known.
    progress, stop
        As of a job.

    Raises
    ------
    StorageError
        The folder cannot be written, or the disk is full.
    Stopped
        ``stop`` said so; nothing is written.
    """
    with TemporaryDirectory(prefix="skinsource-") as name:
        folder = Path(name)
        writers = _writers(design, view, rig, stop)
        for number, (file_name, write) in enumerate(writers.items()):
            stop_if(stop)
            progress(number, len(writers), f"Writing {file_name}")
            write(folder / file_name)
        files = sorted(folder.iterdir())
        about = _about(design, files)
        (folder / "about.json").write_text(json.dumps(about, indent=2) + "\n", "utf-8")
        with replacing(path) as temporary:
            with zipfile.ZipFile(temporary, "w", zipfile.ZIP_DEFLATED) as archive:
                for file in sorted(folder.iterdir()):
                    stop_if(stop)
                    entry = zipfile.ZipInfo(file.name, _DATE)
                    entry.compress_type = zipfile.ZIP_DEFLATED
                    entry.external_attr = 0o644 << 16
                    archive.writestr(entry, file.read_bytes())
            stop_if(stop)


def _writers(
    design: Design, view: View, rig: Rig | None, stop: Stop
) -> dict[str, Callable[[Path], object]]:
    found: dict[str, Callable[[Path], object]] = {
        "design.skinsource": lambda path: save_design(path, design, view),
        "levels.csv": lambda path: export_levels(path, design, view, stop=stop),
        "map.csv": lambda path: export_map(path, design, view, stop=stop),
        "map.png": lambda path: export_map_picture(path, design, view, stop=stop),
        "citation.txt": lambda path: path.write_text(citation(design), "utf-8"),
        "README.txt": lambda path: path.write_text(_READ_ME, "utf-8"),
    }
    if view.outputs:
        found["traces.csv"] = lambda path: export_traces(path, design, view, stop=stop)
    if _can_draw():
        for kind in _FIGURES:
            found[f"figure.{kind}"] = partial(_write_figure, design=design, view=view, kind=kind)
    if audible_inputs(design.inputs):
        # Full scale is the largest sample: nothing clips. What the rate loses is in the sidecar.
        found["stimulus.wav"] = lambda path: _stimuli().export_stimulus(
            design,
            path,
            "wav",
            _RATE_HZ,
            options=_stimuli().StimulusOptions(accept_loss=True),
            stop=stop,
        )
    if rig is not None:
        found["rig.skinrig"] = lambda path: save_rig(path, rig)
    return found


def _can_draw() -> bool:
    try:
        package_of_extra("matplotlib", "plot")
    except MissingExtraError:
        return False
    return True


def _write_figure(path: Path, *, design: Design, view: View, kind: str) -> None:
    figure = importlib.import_module("skinsource.plot").map(design, view=view, outputs=view.outputs)
    content = importlib.import_module("skinsource.plot.figure_file").figure_content(figure, kind)
    path.write_bytes(content)


def _about(design: Design, files: list[Path]) -> dict[str, object]:
    versions = {
        "skinsource": __version__,
        "python": platform.python_version(),
        "numpy": np.__version__,
        "scipy": scipy.__version__,
    }
    digests = {file.name: hashlib.sha256(file.read_bytes()).hexdigest() for file in files}
    return {"versions": versions, "data": data_of(design), "sha256": digests}
