"""What a release says of itself, and that workshops on Windows and macOS can install it."""

import os
import re
import runpy
import subprocess
import tomllib
from itertools import chain
from pathlib import Path

import pytest

import skinsource as ss

ROOT = Path(__file__).resolve().parents[2]
SYSTEMS = ("x86_64-pc-windows-msvc", "aarch64-apple-darwin", "x86_64-apple-darwin")


def lines_of(name):
    return (ROOT / name).read_text(encoding="utf-8").splitlines()


def test_changelog_citation_and_recipe_name_the_version():
    runpy.run_path(str(ROOT / "packaging/release.py"))["check_versions"]()
    assert f'  version: "{ss.__version__}"' in lines_of("packaging/conda/recipe.yaml")


def test_a_release_whose_changelog_is_of_another_version_ends_before_it_is_built():
    release = runpy.run_path(str(ROOT / "packaging/release.py"))
    release["check_versions"].__globals__["VERSION"] = "9.9.9"
    with pytest.raises(SystemExit, match=r"CHANGELOG.md names the versions"):
        release["check_versions"]()


def test_the_recipe_asks_for_what_the_wheel_asks_for():
    asked = re.findall(r"    - ([\w-]+ >=.*)", "\n".join(lines_of("packaging/conda/recipe.yaml")))
    project = tomllib.loads("\n".join(lines_of("pyproject.toml")))["project"]
    extras = chain.from_iterable(project["optional-dependencies"].values())
    needed, more = (
        {line.replace(">=", " >=").replace("_", "-") for line in lines}
        for lines in (project["dependencies"], extras)
    )
    # Names that differ there: PySide6, sounddevice, soundfile, matplotlib.
    others = ("python ", "hatchling", "pyside6", "python-sounddevice", "pysoundfile", "matplotlib")
    assert {line for line in asked if not line.startswith(others)} <= needed | more
    assert needed - {"soundfile >=0.13"} <= set(asked)


@pytest.mark.parametrize("system", SYSTEMS)
@pytest.mark.parametrize("python", ["3.11", "3.12", "3.13"])
def test_all_extras_resolve_to_wheels(system, python):
    uv = pytest.importorskip("uv").find_uv_bin()
    done = subprocess.run(
        [
            *(uv, "pip", "compile", "--quiet", "--all-extras", "--only-binary", ":all:"),
            *("--python-platform", system, "--python-version", python, "pyproject.toml"),
        ],
        cwd=ROOT,
        capture_output=True,
        text=True,
        env={**os.environ, "UV_PYTHON_DOWNLOADS": "never"},
    )
    if "Failed to fetch" in done.stderr:
        pytest.skip("no package index is reachable")
    assert done.returncode == 0, done.stderr
    assert "pyside6-essentials==" in done.stdout


def test_no_code_of_our_own_is_compiled():
    build = tomllib.loads("\n".join(lines_of("pyproject.toml")))["build-system"]
    assert build["requires"] == ["hatchling>=1.27"]
    ours = {
        file.suffix
        for folder in ("core", "skinsource_gui")
        for file in (ROOT / folder).rglob("*")
        if file.is_file() and "__pycache__" not in file.parts
    }
    assert ours <= {".py", ".pyi", ".typed", ""}


@pytest.mark.parametrize("name", ["README.md", "docs/installing.md"])
def test_the_wheel_is_named_as_a_path_else_pipx_leaves_out_its_extras(name):
    text = "\n".join(lines_of(name))
    wheels = re.findall(r"install (?:--python \S+ )?\"(\S+\.whl\[all\])\"", text)
    assert set(wheels) == {f"./skinsource-{ss.__version__}-py3-none-any.whl[all]"}
