"""A design with all that belongs to it as one zip file, and what to cite for it."""

import hashlib
import importlib
import json
import platform
import shutil
import zipfile
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

from skinsource.actuators.rigs import Rig, save_rig
from skinsource.base.assets import data_folder
from skinsource.base.errors import MissingExtraError, SkinSourceError
from skinsource.base.extras import package_of_extra
from skinsource.base.files import replacing
from skinsource.base.job import Progress, Stop, never, silent, stop_if
from skinsource.design.design import Design, View, audible_inputs
from skinsource.design.design_file import save_design
from skinsource.design.labels import limb_label
from skinsource.export.exported_design import ExportedDesign, versions
from skinsource.export.tables import write_levels, write_map, write_map_picture, write_traces
from skinsource.limbs.dataset.store import describe
from skinsource.limbs.own_limbs import facts_of
from skinsource.version import __version__

#: The paper, and the dataset.
PAPER_DOI, DATASET_DOI = "10.1109/HAPTICS59260.2024.10520852", "10.5281/zenodo.10547601"
_AUTHORS = "N. Tummala, G. Reardon, S. Fani, D. Goetz, M. Bianchi, Y. Visell"
_PAPER = (
    f"{_AUTHORS}: SkinSource: A Data-Driven Toolbox for Predicting Touch-Elicited Vibrations in "
    f"the Upper Limb. IEEE Haptics Symposium, 2024. doi:{PAPER_DOI}"
)
_DATASET = (
    f"{_AUTHORS}: SkinSource: impulse responses of the upper limb (dataset), 2024. "
    f"doi:{DATASET_DOI}"
)


def citation(design: Design) -> str:
    """Return what to cite for a design, as lines of text: paper, dataset, program and limb.

    The dataset is named where its limbs are used; an imported limb is identified by its digest.
    """
    limb, data = limb_label(design.limb).title, data_of(design)
    published = bool(data["dataset_doi"])
    what = f"doi:{DATASET_DOI}" if published else _kind_of(design.limb)
    unverified = f"; {data['source_note']}" if data["source_note"] else ""
    digest, own = data["source_sha256"], data["limb_sha256"]
    lines = [
        _PAPER,
        *([_DATASET] if published else []),
        f"Predicted with SkinSource studio {__version__} on the limb {limb} ({what}{unverified})"
        + (f", responses SHA-256 {digest}" if digest else "")
        + (f", its numbers SHA-256 {own}" if own else ""),
    ]
    return "\n".join(lines) + "\n"


def data_of(design: Design) -> dict[str, str]:
    """Return where the responses of a design's limb come from: name, DOI and SHA-256 of the file.

    A note says so where the file is not known to be the published one.  An imported limb has the
    SHA-256 of its numbers.  What is not known here, or is computed, is empty.
    """
    data = {
        "limb": design.limb,
        "dataset_doi": "",
        "source_name": "",
        "source_note": "",
        "source_sha256": "",
        "limb_sha256": design.limb_digest or facts_of(design.limb).digest,
    }
    if design.limb.startswith("measured"):
        data["dataset_doi"] = DATASET_DOI
        with suppress(SkinSourceError):
            store = describe()
            data["source_name"], data["source_sha256"] = store.source_name, store.source_sha256
            data["source_note"] = f"not verified as published: {store.note}" if store.note else ""
    return data


def _kind_of(limb: str) -> str:
    facts = facts_of(limb)
    if facts.synthetic:
        return "computed from a wave model, not measured"
    return "imported here" if facts.own else "not known here"


# A fixed date: packing a design twice gives the same bytes.
_DATE = (1980, 1, 1, 0, 0, 0)
_RATE_HZ = 48_000
_FIGURES = ("svg", "pdf")


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
        Design and view to pack; traces are those of the selected outputs.
    rig
        Wiring of its places; None: that of the design, if it has one.
    progress, stop
        As those of a job.

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
        known = {"skinsource": __version__, "python": platform.python_version(), **versions()}
        digests = {
            file.name: hashlib.sha256(file.read_bytes()).hexdigest()
            for file in sorted(folder.iterdir())
        }
        about = {"versions": known, "data": data_of(design), "sha256": digests}
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
    exported, rig = ExportedDesign(design, view, stop=stop), rig or design.rig
    tables = {"levels.csv": write_levels, "map.csv": write_map, "map.png": write_map_picture}
    if view.outputs:
        tables["traces.csv"] = write_traces
    writers: dict[str, Callable[[Path], object]] = {
        "design.skinsource": lambda path: save_design(path, design, view),
        "citation.txt": lambda path: path.write_text(citation(design), "utf-8"),
        "README.txt": partial(shutil.copyfile, data_folder() / "pack-read-me.txt"),
        **{name: partial(write, exported=exported) for name, write in tables.items()},
    }
    with suppress(MissingExtraError):
        package_of_extra("matplotlib", "plot")
        for kind in _FIGURES:
            writers[f"figure.{kind}"] = partial(_write_figure, design=design, view=view, kind=kind)
    if audible_inputs(design.inputs):
        # Imported when something is packed: the studio starts without it.
        stimuli = importlib.import_module("skinsource.export.stimulus_export.export")
        # The sidecar says what the rate loses, and what clips where a rig says full scale.
        options = stimuli.StimulusOptions(accept_loss=True)
        writers["stimulus.wav"] = lambda path: stimuli.export_stimulus(
            design, path, "wav", _RATE_HZ, options=options, rig=rig, confirmed=True, stop=stop
        )
    if rig is not None:
        writers["rig.skinrig"] = lambda path: save_rig(path, rig)
    return writers


def _write_figure(path: Path, *, design: Design, view: View, kind: str) -> None:
    plot = importlib.import_module("skinsource.export.plot")
    figure = plot.map(design, view=view, outputs=view.outputs)
    path.write_bytes(plot.figure_content(figure, kind))
