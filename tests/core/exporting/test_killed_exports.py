"""No kill leaves half a file under the final name; 300 of them at night."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

PROGRAM = Path(__file__).with_name("killed_exports.py")


@pytest.mark.skipif(sys.platform == "win32", reason="children are made by forking")
def test_a_killed_export_leaves_whole_files_only():
    done = subprocess.run(
        [sys.executable, PROGRAM, "12", "1"], check=False, capture_output=True, text=True
    )
    counts = json.loads(done.stdout)
    assert counts["broken"] == []
    assert counts["at_moves"] == 8
    # The children did write: more was seen than the files of one design.
    assert counts["states"] > 8
