"""Reads what must not change: public names, commands, quantities, numbers, and bytes of exports.

``python tests/core/frozen/read_frozen.py`` writes the files beside this script anew. Do that
only for a change that is meant, and name each difference in the change's description.
`test_frozen.py` compares.  The 200 designs in ``designs.tar.xz`` were drawn at random over
all kinds of waveforms, effects, scalings, and views; all of them use synthetic limbs.
"""

import argparse
import contextlib
import dataclasses
import hashlib
import inspect
import io
import json
import re
import shutil
import tempfile
import types
from pathlib import Path
from unittest.mock import patch

import h5py
import numpy as np

import skinsource as ss
from skinsource.__main__ import main
from skinsource.engine.quantities import new_graph
from skinsource.specs.models import specs_of
from skinsource.specs.spec import Spec

HERE = Path(__file__).parent
QUANTITIES = ("output_levels_db", "selected_traces", "selected_spectra")
#: Attributes of a field's specification that limit its values.
LIMITS = ("minimum", "maximum", "whole", "longest", "one_line", "fewest", "most", "different")
#: Traces and spectra are stored as so many sums with random signs: any change changes these.
N_SUMS = 4
EXPORTED = ss.waveforms.Recording(
    samples=np.round(np.random.default_rng(7).uniform(-1.0, 1.0, 130) * 2**10) / 2**10
)


def _parameters(function: object) -> list[str]:
    parameters = inspect.signature(function).parameters.values()
    return [f"{p.kind.name} {p.name}{'' if p.default is p.empty else '='}" for p in parameters]


def _description(value: object) -> dict:
    """Return the kind, parameters, fields, and members of a public name."""
    if not inspect.isclass(value):
        parameters = _parameters(value) if callable(value) else []
        return {"kind": type(value).__name__, "parameters": parameters}
    description = {"kind": "class", "members": [n for n in dir(value) if not n.startswith("_")]}
    if dataclasses.is_dataclass(value):
        description["fields"] = [field.name for field in dataclasses.fields(value)]
    with contextlib.suppress(TypeError, ValueError):
        description["parameters"] = _parameters(value)
    return description


def public() -> dict[str, object]:
    """Return all public names of ``skinsource`` and of its packages."""
    names: dict[str, object] = {}
    for name in sorted(ss.__all__):
        value = getattr(ss, name)
        if isinstance(value, types.ModuleType):
            names |= {f"{name}.{n}": getattr(value, n) for n in sorted(value.__all__)}
        else:
            names[name] = value
    return names


def public_names() -> dict:
    """Return descriptions of all public names."""
    return {name: _description(value) for name, value in public().items()}


def models() -> dict[str, type]:
    """Return the public classes whose fields say what they may hold."""
    classes = {n: v for n, v in public().items() if dataclasses.is_dataclass(v)}
    return {n: v for n, v in classes.items() if inspect.isclass(v) and specs_of(v)}


def limits() -> dict:
    """Return what each field of the models may hold."""
    return {
        f"{name}.{field}": _limits(spec)
        for name, model in models().items()
        for field, spec in specs_of(model).items()
    }


def _limits(spec: Spec) -> dict:
    found = {name: getattr(spec, name) for name in LIMITS if hasattr(spec, name)}
    parts = {name: getattr(spec, name) for name in ("of", "x", "y") if hasattr(spec, name)}
    parts |= {str(k): column for k, column in enumerate(getattr(spec, "columns", ()))}
    found |= {name: _limits(part) for name, part in parts.items()}
    options = [option for option, _ in getattr(spec, "options", ())]
    return {"kind": type(spec).__name__, **found, "options": options}


class _Stop(BaseException):
    pass


def commands() -> dict:
    """Return the options of each command, and the choices of each option."""
    options: dict[str, list[str]] = {}

    def read(parser: argparse.ArgumentParser, name: str) -> None:
        options[name] = sorted({o for a in parser._actions for o in a.option_strings or [a.dest]})
        for action in parser._actions:
            if isinstance(action, argparse._SubParsersAction):
                for command, own_parser in action.choices.items():
                    read(own_parser, f"{name} {command}")
            elif action.choices:
                key = f"{name} {action.option_strings or action.dest}"
                options[key] = [str(choice) for choice in action.choices]

    def stop(parser: argparse.ArgumentParser, *_: object, **__: object) -> None:
        read(parser, "skinsource")
        raise _Stop

    with patch.object(argparse.ArgumentParser, "parse_args", stop), contextlib.suppress(_Stop):
        main([])
    return options


def numbers(designs: Path) -> dict[str, np.ndarray]:
    """Return levels of the designs (as ratios), and sums of their traces and spectra."""
    values = {}
    for path in sorted(designs.glob("*.skinsource")):
        opened = ss.open_design(path)
        result = ss.evaluate(opened.design, *QUANTITIES, view=opened.view)
        values[f"{path.stem}/levels"] = 10 ** (result["output_levels_db"] / 20)
        for name in ("selected_traces", "selected_spectra"):
            values[f"{path.stem}/{name}"] = _sums(result[name])
    return values


def _sums(rows: tuple[object, ...]) -> np.ndarray:
    """Return sums of each row with random signs, relative to its norm, and the norm."""
    sums: list[float] = []
    for row in rows:
        flat = np.ravel(getattr(row, "values", row))
        signs = np.random.default_rng(flat.size).choice([-1.0, 1.0], (N_SUMS, flat.size))
        norm = float(np.linalg.norm(flat))
        sums += [*(signs @ flat / norm if norm else np.zeros(N_SUMS)), norm]
    return np.array(sums)


def export_digests(folder: Path) -> dict[str, str]:
    """Return a digest of each file that an export in each format writes to ``folder``."""
    design = ss.Design(
        limb="synthetic-1", inputs=(ss.track(7, EXPORTED), ss.track(8, EXPORTED, amplitude=0.25))
    )
    ss.save_design(folder / "design.skinsource", design)
    for name in ss.export_formats():
        target = folder / name
        target.mkdir()
        with contextlib.redirect_stdout(io.StringIO()):
            arguments = ["--out", str(target / "drive"), "--format", name, "--accept-loss"]
            assert main(["export", str(folder / "design.skinsource"), *arguments]) == 0, name
    return {
        path.relative_to(folder).as_posix(): hashlib.sha256(_compared(path)).hexdigest()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def _compared(path: Path) -> bytes:
    """Return what must not change in a file; the last digits depend on the version of SciPy."""
    if path.parent.name == "hdf5" and h5py.is_hdf5(path):
        with h5py.File(path) as file:
            values = {name: file[name][()] for name in sorted(file)}
        return b"".join(
            name.encode() + np.round(v / np.abs(v).max(), 6).tobytes() for name, v in values.items()
        )
    try:
        text = path.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        return path.read_bytes()
    text = re.sub(r'"(sha256|bytes|numpy|scipy)": ["\w.]+', r'"\1":', text)
    return re.sub(r"\d+\.\d{9,}", lambda digits: f"{float(digits[0]):.9g}", text).encode()


@contextlib.contextmanager
def designs():
    """Yield a folder with the designs."""
    with tempfile.TemporaryDirectory() as folder:
        shutil.unpack_archive(HERE / "designs.tar.xz", folder, filter="data")
        yield Path(folder)


def _write() -> None:
    for name, value in (
        ("public", public_names()),
        ("limits", limits()),
        ("commands", commands()),
        ("quantities", sorted(new_graph().rules)),
    ):
        (HERE / f"{name}.json").write_text(json.dumps(value, indent=1) + "\n", encoding="utf-8")
    with tempfile.TemporaryDirectory() as folder:
        text = json.dumps(export_digests(Path(folder)), indent=1)
        (HERE / "exports.json").write_text(text + "\n", encoding="utf-8")
    with designs() as folder:
        np.savez_compressed(HERE / "numbers.npz", **numbers(folder))


if __name__ == "__main__":
    _write()
