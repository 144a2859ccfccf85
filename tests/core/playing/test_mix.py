import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.lab.playing.stream import FREQUENCY_HZ, DeviceClock, HeardPosition, mix_of, tone_of
from tests.core.playing.playing_bench import RATE_HZ, mix


def made(rows, **changes):
    settings = {"outputs": [1, 2], "titles": ["a", "b"], "n_outputs": 4, **changes}
    return mix_of(np.asarray(rows, float), RATE_HZ, **settings)


def test_each_channel_goes_to_its_output():
    mixed = made([[1, 2], [3, 4]], outputs=[4, 2])
    assert mixed.samples.tolist() == [[0, 0], [3, 4], [0, 0], [1, 2]]
    assert mixed.names == ("", "b", "", "a")


def test_channels_at_one_output_add_up():
    mixed = made([[1, 2], [3, 4]], outputs=[2, 2])
    assert mixed.samples.tolist() == [[0, 0], [4, 6], [0, 0], [0, 0]]
    assert mixed.names[1] == "a + b"


@pytest.mark.parametrize(
    ("rows", "changes", "message"),
    [
        ([[1, np.nan], [0, 0]], {}, "finite"),
        ([[1, np.inf], [0, 0]], {}, "finite"),
        ([[1, 1e39], [0, 0]], {}, "1e\\+39"),
        ([[1, 2], [3, 4]], {"loop_s": (0.1, 0.109)}, "lasts 9 ms, expected at least 10 ms"),
        ([[1, 2], [3, 4]], {"loop_s": (0.2, 0.1)}, "expected at least 10 ms"),
    ],
)
def test_what_cannot_be_played_is_refused(rows, changes, message):
    with pytest.raises(InvalidInputError, match=message):
        made(rows, **changes)


def test_the_test_tone_is_on_its_output_alone_and_has_its_frequency():
    samples = tone_of(3, 4, 48_000)
    assert not samples.samples[[0, 1, 3]].any()
    tone = samples.samples[2].astype(float)
    assert np.abs(tone).max() == pytest.approx(1.0, abs=1e-3)
    spectrum = np.abs(np.fft.rfft(tone, 480_000))
    assert spectrum.argmax() / 10 == pytest.approx(FREQUENCY_HZ, abs=0.2)
    assert abs(tone[0]) < 1e-3
    assert abs(tone[-1]) < 1e-3


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


def test_the_first_times_of_a_device_that_jump_are_forgotten_and_a_clock_goes_after_three_blocks():
    clock = DeviceClock()
    steady = [clock.note(device_s, 10.0 + 0.005 * k) for k, device_s in enumerate((89_478.4, 0.03))]
    steady += [clock.note(0.03 + 0.005 * k, 10.005 + 0.005 * k) for k in (1, 2)]
    assert steady == [False, False, False, True]
    assert clock.at(10.025) == pytest.approx(0.05)
