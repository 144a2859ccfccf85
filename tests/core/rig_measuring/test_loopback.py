"""A loopback tells the delay of a card, beyond what the card says."""

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import PlaybackError
from tests.core.rig_measuring import bench_top
from tests.core.rig_measuring.bench_top import BLOCK_S, TIMES

RATE_HZ, DELAY = 48_000, 321


@pytest.fixture
def cable(monkeypatch):
    path = np.zeros(8192)
    path[DELAY] = 0.6
    return bench_top.use(monkeypatch, bench_top.Card(path, output=1))


def test_delay_and_jitter_of_a_cable_are_those_of_the_card(cable):
    found = ss.rig_measuring.loopback(1, 1, repeats=5)
    assert found.n_seen == 5
    # What is played in a block comes back from the next one on.
    assert found.round_trip_s == BLOCK_S + DELAY / RATE_HZ
    assert found.jitter_s == 0.0
    told_s = TIMES.outputBufferDacTime - TIMES.inputBufferAdcTime
    assert found.behind_s == pytest.approx(found.round_trip_s - told_s)


def test_a_reference_tells_how_much_later_another_output_is(monkeypatch):
    # The card answers to output 2 alone; output 1 plays the same clicks.
    late, prompt = np.zeros(8192), np.zeros(8192)
    late[DELAY], prompt[0] = 0.6, 0.6
    bench_top.use(monkeypatch, bench_top.Card(late, prompt, output=2))
    found = ss.rig_measuring.loopback(2, 1, reference=(1, 2), repeats=3)
    np.testing.assert_allclose(found.later_s, DELAY / RATE_HZ)


def test_a_missing_cable_is_one_sentence(cable):
    cable.noise = 0.0
    with pytest.raises(PlaybackError, match=r"Input 2 .* heard nothing of output 1"):
        ss.rig_measuring.loopback(1, 2, repeats=2)
    with pytest.raises(PlaybackError, match="4 outputs"):
        ss.rig_measuring.loopback(9, 1)
