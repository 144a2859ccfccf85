"""Played and measured through PortAudio, on a device that is a file."""

import json
import subprocess
import sys

import numpy as np
import pytest

from skinsource.base.errors import SkinSourceError
from skinsource.lab.playing.devices import sound_library
from tests.core.rig_measuring import file_card


def report_of(scene, folder):
    if not file_card.ALSA_SETTINGS.is_file():
        pytest.skip(f"{file_card.ALSA_SETTINGS} is not there: ALSA, of Linux, is not installed")
    try:
        sound_library()
    except SkinSourceError as missing:
        pytest.skip(str(missing))
    done = subprocess.run(
        [sys.executable, file_card.__file__, scene, str(folder)],
        capture_output=True, text=True, timeout=120,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout.splitlines()[-1])


def test_what_arrives_at_the_device_is_what_was_sent_sample_by_sample(tmp_path):
    assert report_of("play", tmp_path) == {"done": True, "reason": "end"}
    sent, n_outputs = file_card.noise(), file_card.N_OUTPUTS
    raw = np.fromfile(tmp_path / "heard.raw", np.float32)
    recorded = raw[: raw.size // n_outputs * n_outputs].reshape(-1, n_outputs).T
    begin = int(np.flatnonzero(recorded.any(axis=0))[0])
    assert np.array_equal(recorded[:, begin : begin + sent.shape[1]], sent)
    assert not recorded[:, begin + sent.shape[1] :].any()


def test_a_response_is_measured_through_portaudio(tmp_path):
    report = report_of("measure", tmp_path)
    assert report["off"] < 0.06
    assert abs(report["delay_s"] - file_card.DELAY_S) < 2e-5
    assert report["points"] > 230
