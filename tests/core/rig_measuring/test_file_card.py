"""Measured through PortAudio, on a card that is a file."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from skinsource.errors import SkinSourceError
from skinsource.playing.sounding import sound_library
from tests.core.playing import file_card

SCRIPT = Path(__file__).with_name("file_duplex.py")
DELAY_S = 0.0123


def test_a_response_is_measured_through_portaudio(tmp_path):
    if not sys.platform.startswith("linux"):
        pytest.skip("sound cards that are files are a thing of ALSA, on Linux")
    try:
        sound_library()
    except SkinSourceError as missing:
        pytest.skip(str(missing))
    if not file_card._ALSA.is_file():
        pytest.skip(f"{file_card._ALSA} is not there: the settings of ALSA are not installed")
    done = subprocess.run(
        [sys.executable, str(SCRIPT), str(tmp_path)], capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout.splitlines()[-1])
    assert found["off"] < 0.06
    assert abs(found["delay_s"] - DELAY_S) < 2e-5
    assert found["points"] > 230
