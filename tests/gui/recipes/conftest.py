"""Copies of the project in which CONTRIBUTING's recipes are followed to the letter."""

import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from skinsource.design.design import Design, track
from skinsource.design.design_file import save_design
from skinsource.design.view import View

PROJECT = Path(__file__).parents[3]


@dataclass(frozen=True, slots=True)
class Copy:
    """A copy of library and studio that may be changed."""

    folder: Path

    @property
    def library(self) -> Path:
        return self.folder / "core" / "skinsource"

    @property
    def studio(self) -> Path:
        return self.folder / "skinsource_gui"

    def write(self, path: Path, text: str) -> None:
        """Write a new file."""
        path.parent.mkdir(exist_ok=True)
        path.write_text(text.lstrip(), encoding="utf-8")

    def insert(self, path: Path, before: str, new: str) -> None:
        """Write a line, as somebody would who follows the recipe."""
        text = path.read_text(encoding="utf-8")
        assert text.count(before) == 1, f"{before!r} in {path.name}"
        path.write_text(text.replace(before, new + before), encoding="utf-8")

    def run(self, script: str, *arguments: object) -> str:
        """Run ``script`` with the copy; return what it prints."""
        place = os.pathsep.join([str(self.folder / "core"), str(self.folder)])
        result = subprocess.run(
            [sys.executable, "-c", script, *map(str, arguments)],
            env={**os.environ, "PYTHONPATH": place, "QT_QPA_PLATFORM": "offscreen"},
            # Python looks there first.
            cwd=self.folder,
            check=False,
            capture_output=True,
            text=True,
            timeout=120,
        )
        assert result.returncode == 0, result.stderr[-3000:]
        return result.stdout


@pytest.fixture(scope="session")
def older_design(tmp_path_factory) -> Path:
    """A design file that the project wrote before anything in a copy of it was changed."""
    path = tmp_path_factory.mktemp("older") / "older.skinsource"
    save_design(path, Design(limb="synthetic-1", inputs=(track(location=7),)), View())
    return path


@pytest.fixture(scope="session")
def make_copy(tmp_path_factory):
    def make() -> Copy:
        folder = tmp_path_factory.mktemp("copy")
        skipped = shutil.ignore_patterns("__pycache__")
        shutil.copytree(PROJECT / "core", folder / "core", ignore=skipped)
        shutil.copytree(PROJECT / "skinsource_gui", folder / "skinsource_gui", ignore=skipped)
        for name in ("data", "resources"):
            shutil.copytree(PROJECT / name, folder / name, ignore=skipped)
        return Copy(folder)

    return make
