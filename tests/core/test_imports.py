"""What is imported when: nothing that is not needed yet, and no part of Qt anywhere in the core."""

import importlib
import subprocess
import sys
from pathlib import Path

import pytest

from skinsource.base import extras
from skinsource.base.errors import MissingExtraError

PROBE = """
import importlib
import pkgutil
import sys

# None in sys.modules makes every import of the name raise.
blocked = ("PySide6", "PySide2", "PyQt6", "PyQt5", "shiboken6", "pyqtgraph", "qtpy")
sys.modules.update(dict.fromkeys(blocked))


def absent(after, *names):
    there = [name for name in names if name in sys.modules]
    assert not there, f"{after} imports {', '.join(there)}"


import skinsource

absent("skinsource alone", "numpy")
# Asked for before anything else is.
assert skinsource.locations.OUTPUTS
from skinsource.limbs.synthetic import load_synthetic_limb

load_synthetic_limb(1).response_to(1)
absent("a synthetic limb", "scipy.signal", "scipy.interpolate", "scipy.stats")
import skinsource.cli.command_line

absent("the command line", "scipy.signal", "matplotlib")
import skinsource.lab.playing.session

absent("playing", "sounddevice")
for module in pkgutil.walk_packages(skinsource.__path__, "skinsource."):
    if not module.name.endswith("__main__"):
        importlib.import_module(module.name)
        print(module.name)
"""


def test_each_part_imports_what_it_needs_and_the_whole_core_is_there_without_qt():
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", PROBE], capture_output=True, text=True, timeout=60
    )
    assert done.returncode == 0, done.stderr
    assert {"skinsource.engine.quantities", "skinsource.design.waveforms.tones"} <= set(
        done.stdout.split()
    )


TOP = Path(__file__).parents[2]
STUBS = [
    path
    for folder in ("core/skinsource", "skinsource_gui")
    for path in sorted((TOP / folder).rglob("__init__.pyi"))
]


def dotted(path: Path) -> str:
    top = TOP / "core" if (TOP / "core") in path.parents else TOP
    return ".".join(path.parent.relative_to(top).parts)


@pytest.mark.parametrize("path", STUBS, ids=dotted)
def test_all_that_a_package_offers_is_there(path):
    package = importlib.import_module(dotted(path))
    assert package.__all__
    for name in package.__all__:
        assert getattr(package, name) is not None
        assert name in dir(package)


@pytest.mark.parametrize("editable", [True, False])
def test_the_line_fits_how_the_studio_is_installed(monkeypatch, tmp_path, editable):
    folder = tmp_path / "my studio" / "core" / "skinsource" / "extras"
    folder.mkdir(parents=True)
    root = folder.parents[2]
    if editable:
        (root / "pyproject.toml").write_text("[project]\n", encoding="utf-8")
    monkeypatch.setattr(extras, "__file__", str(folder / "__init__.py"))
    what = f'-e "{root}[audio]"' if editable else '"skinsource[audio]"'
    assert extras.extra_line("audio") == f"{sys.executable} -m pip install {what}"
    with pytest.raises(MissingExtraError) as error:
        extras.package_of_extra("no_package_of_this_name", "audio")
    assert extras.extra_line("audio") in str(error.value)


def test_where_uv_made_the_environment_its_line_is_of_uv(monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", {}.get)
    assert extras.extra_line("audio").startswith(f"uv pip install --python {sys.executable} ")


def test_on_macs_with_intel_the_line_names_the_compiler_that_mat_io_needs(monkeypatch):
    monkeypatch.setattr(sys, "platform", "darwin")
    for machine, needs in (("x86_64", True), ("arm64", False)):
        monkeypatch.setattr("platform.machine", lambda machine=machine: machine)
        line = extras.extra_line("dataset")
        assert line.startswith("xcode-select --install, ") == needs
        assert line.endswith(" mat-io") == needs
        assert "mat-io" not in extras.extra_line("audio")
