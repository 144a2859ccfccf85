"""``skinsource doctor`` says what is installed, and what works."""

import sys
import tomllib
from importlib.metadata import PackageNotFoundError
from pathlib import Path

import pytest

from skinsource import __version__
from skinsource.cli import doctor_command
from skinsource.cli.command_line import main

EXTRAS = tomllib.loads((Path(__file__).resolve().parents[2] / "pyproject.toml").read_text())[
    "project"
]["optional-dependencies"]


@pytest.fixture
def told(capsys):
    def run():
        assert main(["doctor"]) == 0
        lines = capsys.readouterr().out.splitlines()
        return {line[:12].strip(): line[12:] for line in lines}

    return run


def test_it_names_version_packages_qt_limbs_and_folders(told, tmp_path, monkeypatch):
    monkeypatch.setenv("SKINSOURCE_DATA", str(tmp_path))
    said = told()
    assert said["skinsource"] == __version__
    assert "numpy" in said["library"]
    assert "pyqtgraph" in said["gui"]
    assert said["Qt"] == "starts, platform offscreen"
    assert said["next"].endswith(": skinsource-gui")
    assert "synthetic-1" in said["limbs"]
    assert said["data"] == str(tmp_path)


def test_every_extra_has_a_line_that_says_how_to_get_what_is_missing(told, monkeypatch):
    def version(name):
        raise PackageNotFoundError(name)

    monkeypatch.setattr(doctor_command, "version", version)
    said = told()
    for extra in EXTRAS.keys() - {"all"}:
        assert "is missing. Install it with: " in said[extra]
        assert f"[{extra}]" in said[extra]


def test_the_self_contained_folder_is_told_what_works_there(told, monkeypatch):
    def version(name):
        raise PackageNotFoundError(name)

    monkeypatch.setattr(doctor_command, "version", version)
    monkeypatch.setattr(sys, "frozen", True, raising=False)
    said = told()
    assert "docs/installing.html" in said["parquet"]
    assert "pip" not in said["parquet"]
    assert said["next"] == "open the studio with: ./skinsource-gui"


def test_a_qt_that_cannot_start_is_a_line_and_ends_nothing(told, monkeypatch):
    monkeypatch.setenv("QT_QPA_PLATFORM", "none-such")
    monkeypatch.setenv("DISPLAY", ":0")
    said = told()
    assert said["Qt"].startswith("does not start")
    assert said["next"] == "do what the line Qt says"
    assert said["limbs"]


def test_the_extra_all_holds_what_one_computer_uses():
    (requirement,) = EXTRAS["all"]
    held = set(requirement.removeprefix("skinsource[").removesuffix("]").split(","))
    # A cluster is many computers; bench needs what plot needs.
    assert held == EXTRAS.keys() - {"all", "cluster", "bench"}
    assert set(EXTRAS["bench"]) <= set(EXTRAS["plot"])
