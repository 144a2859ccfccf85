import numpy as np
import pytest

from tests.core.playing.playing_bench import FADE, RATE_HZ, block, blocks, mix, play_queue

WINDOW = RATE_HZ // 10


def test_a_steady_tone_at_full_scale_has_an_rms_of_minus_three_decibels():
    live = play_queue()
    live.play(mix(np.sin(2 * np.pi * np.arange(4 * WINDOW) * 100 / RATE_HZ)), 0)
    blocks(live, [97] * 24)
    levels = live.levels()
    assert levels.peak_db[0] == pytest.approx(0.0, abs=0.01)
    assert levels.rms_db[0] == pytest.approx(-3.0103, abs=0.001)
    assert levels.highest_db[0] == pytest.approx(0.0, abs=0.01)


def test_each_output_has_its_own_and_what_is_over_stays_the_highest():
    live = play_queue(2, gain_db=-20.0)
    rows = np.zeros((2, 3 * WINDOW))
    rows[0, 10] = -1.0
    rows[1] = 0.5
    live.play(mix(rows), 0)
    block(live, WINDOW)
    first = live.levels()
    assert first.peak_db == pytest.approx([-20.0, -26.02], abs=0.01)
    block(live, WINDOW)
    second = live.levels()
    assert second.peak_db[0] == -200.0
    assert second.rms_db == pytest.approx([-200.0, -26.02], abs=0.01)
    assert second.highest_db == pytest.approx([-20.0, -26.02], abs=0.01)


def test_nothing_is_shown_of_what_was_not_played():
    live = play_queue()
    live.play(mix(np.full(2 * WINDOW, 4.0)), 0)
    block(live, WINDOW)
    assert live.ending.reason == "limit"
    assert live.levels().highest_db[0] <= 0.0
    assert FADE < WINDOW
