"""Measured through PortAudio, on a card that is a file."""

import json
import subprocess
import sys
from pathlib import Path

from tests.core.playing import file_card

SCRIPT = Path(__file__).with_name("file_duplex.py")
DELAY_S = 0.0123


def test_a_response_is_measured_through_portaudio(tmp_path):
    file_card.skip_where_there_is_none()
    done = subprocess.run(
        [sys.executable, str(SCRIPT), str(tmp_path)], capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout.splitlines()[-1])
    assert found["off"] < 0.06
    assert abs(found["delay_s"] - DELAY_S) < 2e-5
    assert found["points"] > 230
