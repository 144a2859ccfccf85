"""Run by .ci/run from an empty folder, in an environment that holds only the built package."""

import hashlib
import json
import re
import subprocess
import sys
from importlib import metadata
from pathlib import Path

import numpy as np

import skinsource as ss
import skinsource_gui
from skinsource.base.assets import data_folder, manual_file
from skinsource_gui.qt.resources import resource_folder


def test_the_package_under_test_is_the_installed_one():
    for module in (ss, skinsource_gui):
        assert "site-packages" in module.__file__
    assert metadata.version("skinsource") == ss.__version__


def test_every_shipped_data_file_is_installed_unchanged():
    listed = json.loads((data_folder() / "shipped_files.json").read_text(encoding="utf-8"))
    assert listed["files"], "the list names no files"
    for expected in listed["files"]:
        content = (data_folder() / expected["name"]).read_bytes()
        assert len(content) == expected["size"], expected["name"]
        assert hashlib.sha256(content).hexdigest() == expected["sha256"], expected["name"]


def test_the_windows_resources_are_installed():
    tables = ("themes", "keys", "actions", "choices", "exports", "analysis", "numbers", "columns")
    for name in ("theme.qss", "icons/play.svg", *(f"{table}.toml" for table in tables)):
        assert (resource_folder() / name).is_file()


def test_the_manual_is_the_site():
    """`.ci/run` builds it before."""
    assert manual_file().name == "index.html"
    assert (manual_file().parent / "limbs.html").is_file()


def test_menu_entry_icon_and_file_types_lie_where_desktops_look():
    share = Path(sys.prefix) / "share"
    (entry,) = (share / "applications").glob("skinsource*.desktop")
    said = dict(re.findall(r"(\w+)=(.*)", entry.read_text(encoding="utf-8")))
    assert (share / f"icons/hicolor/scalable/apps/{said['Icon']}.svg").is_file()
    assert (Path(sys.prefix) / "bin" / said["Exec"].split()[0]).is_file()
    types = (share / "mime/packages/skinsource-studio.xml").read_text(encoding="utf-8")
    assert re.findall(r'mime-type type="(.*)"', types) == said["MimeType"].rstrip(";").split(";")


def test_a_prediction_runs_on_the_built_in_limb():
    limb = ss.load_limb("synthetic-1")
    acceleration = ss.predict(limb, [ss.sinusoid(100.0)], [7])
    assert acceleration.shape == (72, 3, 651)
    heatmap = ss.surface_operator(limb).interpolate(ss.decibels(ss.rms(acceleration[:, 2])))
    assert np.isfinite(heatmap).any()


def test_both_commands_answer_from_an_unrelated_folder(tmp_path):
    scripts = Path(sys.executable).parent
    for command in (
        [scripts / "skinsource", "--help"],
        [scripts / "skinsource-gui", "--help"],
        [sys.executable, "-m", "skinsource", "--version"],
        [sys.executable, "-m", "skinsource_gui", "--version"],
        [scripts / "skinsource", "limbs"],
    ):
        subprocess.run(command, check=True, cwd=tmp_path, capture_output=True)


def test_without_a_display_the_start_design_is_rendered_to_files(tmp_path):
    done = subprocess.run(
        [sys.executable, "-m", "skinsource_gui", "--render", str(tmp_path / "out")],
        check=True,
        cwd=tmp_path,
        capture_output=True,
        text=True,
    )
    for name in ("window.png", "rms-map.png", "rms-map.csv", "traces.csv"):
        assert (tmp_path / "out" / name).stat().st_size > 1000
        assert name in done.stdout
