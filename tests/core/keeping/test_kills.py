"""Studios that are killed while they work lose at most one interval."""

import json
import os
import subprocess
import sys
from itertools import pairwise
from pathlib import Path

import pytest

from skinsource.design import recovery
from skinsource.design.design_file import open_design

KILLS, INTERVAL_S, SEED = 100, 0.2, 20_261_122


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no system call makes so many writers quickly")
def test_of_100_killed_writers_none_loses_more_than_one_interval(tmp_path):
    program = Path(__file__).with_name("killed_writers.py")
    command = [sys.executable, program, tmp_path, str(KILLS), str(INTERVAL_S), str(SEED)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    writers = json.loads(done.stdout)
    assert len(writers) == KILLS
    search = recovery.find(tmp_path)
    assert search.set_aside == ()
    left = {
        int(left_over.copies[0].parent.name.split("-")[2]): left_over for left_over in search.left
    }
    for writer in writers:
        times = writer["edits_s"]
        restored = 0
        if writer["pid"] in left:
            left_over = left[writer["pid"]]
            assert len(left_over.copies) <= 6  # the sixth was being written
            restored = round(8 * open_design(left_over.copies[0]).design.inputs[0].amplitude)
            assert [open_design(copy).layout for copy in left_over.copies] == [b""] * len(
                left_over.copies
            )
            assert (left_over.name, left_over.file) == ("tap", Path("/designs/tap.skinsource"))
        since_s = times[restored - 1] if restored else times[0]
        # Between two edits the writer may have had to wait for its turn, or for the disk.
        longest_s = max((b - a for a, b in pairwise(times)), default=0.0)
        assert times[-1] - since_s <= INTERVAL_S + longest_s + 1e-6
    assert len(left) > KILLS // 2
    files = [path for path in tmp_path.rglob("*") if path.is_file()]
    assert [path for path in files if path.name.endswith((".part", ".opening"))] == []
    for left_over in search.left:
        recovery.discard(left_over)
    assert [path for path in tmp_path.rglob("*") if path.is_file()] == []
