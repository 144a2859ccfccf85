import numpy as np
import pytest

from skinsource.lab.playing.mix import DeviceClock, HeardPosition
from tests.core.playing.playing_bench import mix

RATE_HZ = 8000


def test_what_is_heard_now_is_not_what_was_computed_last():
    position = HeardPosition(RATE_HZ)
    for k in range(10):
        position.note(100.0 + k * 0.005, 400 + k * 40, None)
    assert position.at(99.999) is None
    assert position.at(100.0) == pytest.approx(0.05)
    assert position.at(100.0175) == pytest.approx(0.05 + 0.0175)


def test_it_goes_on_between_blocks_round_the_loop():
    position = HeardPosition(RATE_HZ)
    position.note(10.0, 1990, mix(np.zeros(2000), loop=(1000, 2000)))
    assert position.at(10.0 + 9 / RATE_HZ) == pytest.approx(1999 / RATE_HZ)
    assert position.at(10.0 + 10 / RATE_HZ) == pytest.approx(1000 / RATE_HZ)
    assert position.at(10.0 + 2015 / RATE_HZ) == pytest.approx(1005 / RATE_HZ)


def test_the_fade_before_the_first_sample_is_no_time_of_the_design():
    position = HeardPosition(RATE_HZ)
    position.note(10.0, -40, None)
    assert position.at(10.001) == 0.0
    assert position.at(10.005) == pytest.approx(0.0, abs=1e-12)
    assert position.at(10.006) == pytest.approx(0.001)


def test_it_forgets_what_is_long_past():
    position = HeardPosition(RATE_HZ)
    for k in range(100_000):
        position.note(k * 0.005, k * 40, None)
    assert position.at(99_999 * 0.005 + 0.001) == pytest.approx(99_999 * 0.005 + 0.001)
    assert position.at(5.0) is None


def test_before_a_device_has_told_its_time_nothing_is_heard():
    position = HeardPosition(RATE_HZ)
    position.note(0.0, 0, None)
    assert position.at(DeviceClock().at(1e9)) is None


def test_the_clock_of_a_device_is_that_of_the_block_that_waited_least():
    clock = DeviceClock()
    for now_s, waited_s in ((10.0, 0.004), (10.005, 0.001), (10.010, 0.006)):
        clock.note(now_s + 500.0, now_s + waited_s)
    assert clock.at(10.021) == pytest.approx(510.020)
