"""Reference and test arrive at the outputs of their actuators, through PortAudio."""

import json
import subprocess
import sys

import numpy as np
import pytest

import skinsource as ss
from skinsource.lab.matching import MatchingRun, Procedure
from tests.core.playing import file_card
from tests.core.playing.file_card import CYCLE, MATCHED, RATE_HZ


def test_what_an_arrow_changes_is_the_test_alone_on_its_own_actuator(tmp_path):
    file_card.skip_where_there_is_none()
    done = subprocess.run(
        [sys.executable, file_card.__file__, "matching", str(tmp_path)],
        capture_output=True, text=True, timeout=120,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    report = json.loads(done.stdout.splitlines()[-1])
    first_db = report["levels_db"][0]
    assert report["levels_db"] == pytest.approx([first_db, first_db + 1.0, first_db + 2.0])
    assert (report["done"], report["same"], report["reason"]) == (True, True, "")
    test, reference = file_card.read_heard(tmp_path, 2)
    begin = int(np.flatnonzero(reference)[0])
    run = MatchingRun(Procedure(**MATCHED), None)
    exact = ss.stimulus_of(run.design, RATE_HZ)
    sent = dict(zip((channel.place for channel in exact.channels), exact.samples, strict=True))
    # The first samples of a sine that begins at 0 are 0.
    begin -= int(np.flatnonzero(sent[7])[0])
    n = min(sent[7].size, CYCLE)
    for cycle in range(2):
        recorded = reference[begin + cycle * CYCLE :][:n]
        assert recorded == pytest.approx(sent[7][:n], abs=1e-6)
    # Where the test starts is random.
    factor = 10.0 ** ((first_db - run.level_db) / 20.0)
    n = min(sent[3].size, CYCLE)
    assert test[begin:][:n] == pytest.approx(factor * sent[3][:n], abs=1e-6)
    cycles = [test[begin + k * CYCLE :][:CYCLE] for k in range((test.size - begin) // CYCLE)]
    heard_db = 20.0 * np.log10([np.abs(cycle).max() / 0.25 for cycle in cycles])
    for level_db in report["levels_db"]:
        assert np.abs(heard_db - level_db).min() < 0.05
