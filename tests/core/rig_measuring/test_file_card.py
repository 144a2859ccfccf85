"""Measured through PortAudio, on devices that are files."""

import json
import subprocess
import sys
from pathlib import Path

from tests.core.playing import file_card

DELAY_S = 0.0123


def report_of(script: str, folder: Path) -> dict:
    file_card.skip_where_there_is_none()
    done = subprocess.run(
        [sys.executable, str(Path(__file__).with_name(script)), str(folder)],
        capture_output=True, text=True, timeout=120,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout.splitlines()[-1])


def test_a_response_is_measured_through_portaudio(tmp_path):
    report = report_of("file_duplex.py", tmp_path)
    assert report["off"] < 0.06
    assert abs(report["delay_s"] - DELAY_S) < 2e-5
    assert report["points"] > 230
