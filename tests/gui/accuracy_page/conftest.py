"""A page, and a made-up benchmark that it starts."""

import sys

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QImage

from skinsource_gui.accuracy_page import bench_job

CHILD = """
import os, sys, time
from pathlib import Path
from skinsource.method_comparison.table import Row, write_table

mode, note, picture, folder = sys.argv[1], *map(Path, sys.argv[2:5])
note.write_text(f"{os.getpid()} {folder}")
note.with_name("limb").write_text(" ".join(sys.argv[5:]))
print("0/3 S1 direct", flush=True)
if mode == "hang":
    time.sleep(600)
if mode == "fail":
    sys.exit("skinsource: the disk is full. Make room.")
about = {"scene": "S1", "precision": "float64", "inputs": 1, "inputs_changed": 1, "samples": 9}
about |= {"reference": "S1"}
times = {"t_min_ms": 2.0, "t_median_ms": 3.0, "t_mad_ms": 0.5}
times |= {"err_window": 1e-12, "err_max": 1e-16}
rows = [
    Row(engine="this program", setting="map and 6 traces", promise="kept", **about, **times),
    Row(engine="direct", setting="exact", failure="would take long", **about),
    Row(engine="cached spectra", setting="cut", **about, **{**times, "t_min_ms": 10.0}),
]
write_table(folder / "work_precision.csv", rows)
(folder / "report.md").write_text("# Report")
if mode == "no plot":
    sys.exit('skinsource: the plot needs matplotlib. Type: pip install "skinsource[bench]"')
(folder / "work_precision.png").write_bytes(picture.read_bytes())
print("3 rows")
"""


@pytest.fixture
def child(tmp_path, monkeypatch):
    """Choose what the benchmark does: work, fail, hang, no plot; give where it notes itself."""
    script, note, picture = tmp_path / "child.py", tmp_path / "note", tmp_path / "picture.png"
    script.write_text(CHILD, encoding="utf-8")
    image = QImage(800, 1200, QImage.Format.Format_RGB32)
    image.fill(Qt.GlobalColor.red)
    image.save(str(picture))

    def choose(mode):
        words = (sys.executable, str(script), mode, str(note), str(picture))
        monkeypatch.setattr(bench_job, "COMMAND", words)
        return note

    choose("work")
    return choose


@pytest.fixture
def page(window, child):
    window.actions_by_name["show_accuracy"].trigger()
    return window.pages.accuracy
