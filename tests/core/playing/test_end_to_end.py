import json
import subprocess
import sys

import numpy as np
import pytest

from tests.core.playing import file_card
from tests.core.playing.file_card import LONG, RATE_HZ, first_sounding, read_heard, rows

FADE = 240


@pytest.fixture(scope="module", autouse=True)
def _sound():
    file_card.skip_where_there_is_none()


def report_of(scene, folder):
    done = subprocess.run(
        [sys.executable, file_card.__file__, scene, str(folder)],
        capture_output=True, text=True, timeout=120,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout.splitlines()[-1])


def test_what_arrives_at_the_device_is_what_was_sent_sample_by_sample(tmp_path):
    assert report_of("once", tmp_path) == {"done": True, "reason": "end"}
    recorded, sent = read_heard(tmp_path), rows(1, 20_011)
    begin = first_sounding(recorded)
    assert np.array_equal(recorded[:, begin : begin + sent.shape[1]], sent)
    assert not recorded[:, begin + sent.shape[1] :].any()


def test_a_live_change_arrives_in_its_place_while_the_playhead_keeps_step(tmp_path):
    report = report_of("live", tmp_path)
    assert (report["done"], report["reason"], report["gone"]) == (True, "stopped", False)
    assert 0.0 < report["total_s"] < 0.5
    assert all(-1.0 < peak <= 0.0 for peak in report["peak_db"])
    recorded, before, after = read_heard(tmp_path), rows(1, LONG), rows(2, LONG)
    begin = first_sounding(recorded)
    # The middle one: on a busy machine one or the other thread stands still now and then.
    ahead_s = [at_s - (frames - begin) / RATE_HZ for at_s, frames in report["seen_at"]]
    assert np.median(ahead_s) == pytest.approx(0.0, abs=0.1)
    recorded = recorded[:, begin:]
    n = recorded.shape[1]
    first_change = int(np.flatnonzero(np.any(recorded != before[:, :n], axis=0))[0])
    settled = first_change + FADE
    # From there on it is the new one, until it fades out.
    last = settled + int(
        np.flatnonzero(np.any(recorded[:, settled:] != after[:, settled:n], axis=0))[0]
    )
    assert last - settled > 0.05 * RATE_HZ
    assert not recorded[:, last + FADE :].any()
    # On the way the two add up.
    weight = 0.5 - 0.5 * np.cos(np.pi * np.arange(1, FADE + 1) / (FADE + 1))
    way = slice(first_change, settled)
    expected = (1 - weight) * before[:, way] + weight * after[:, way]
    assert recorded[:, way] == pytest.approx(expected, abs=1e-6)
