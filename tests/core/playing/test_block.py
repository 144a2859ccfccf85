"""Blocks for a device: samples, limits, and levels."""

import tracemalloc
from dataclasses import replace

import numpy as np
import pytest

from skinsource.lab.playing.stream import Due, PlayQueue, next_block
from tests.core.playing import playing_bench

WINDOW = playing_bench.RATE_HZ // 10


def test_what_is_sent_is_what_was_to_be_played_to_the_last_bit():
    # Also in a block longer than any device asks for.
    rows = np.random.default_rng(1).uniform(-1, 1, (3, 9000))
    live = playing_bench.playing(playing_bench.mix(rows))
    output = playing_bench.block(live, 9200)
    assert np.array_equal(
        output[:, playing_bench.FADE : playing_bench.FADE + 9000], rows.astype(np.float32)
    )
    assert not output[:, : playing_bench.FADE].any()
    assert not output[:, playing_bench.FADE + 9000 :].any()
    # What is heard is told from where the block began.
    assert live.began_at == -playing_bench.FADE


def test_a_queue_takes_no_mix_that_does_not_fit():
    with pytest.raises(ValueError, match="2 outputs at 8000 Hz, the queue 1"):
        playing_bench.play_queue(1).play(playing_bench.mix(np.zeros((2, 100))))
    with pytest.raises(ValueError, match="44100"):
        playing_bench.play_queue(1).play(playing_bench.mix(np.zeros(100), rate_hz=44100))


def test_nothing_grows_while_it_plays():
    live = playing_bench.playing(playing_bench.mix(playing_bench.tone(4000), loop=(0, 4000)))
    out = np.zeros((240, 1), np.float32)

    def play(n):
        for _ in range(n):
            next_block(live, out)

    play(50)
    tracemalloc.start()
    play(50)
    before = tracemalloc.get_traced_memory()[0]
    tracemalloc.reset_peak()
    play(2000)
    after, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert abs(after - before) < 2000
    # Less than one block of one output: views and numbers, no samples.
    assert peak - before < 240 * 8 * 2


def test_a_sample_beyond_full_scale_is_not_played_and_its_output_is_named():
    rows = np.zeros((2, 1000))
    rows[0], rows[1, 600] = 0.5, 1.25
    live = playing_bench.playing(playing_bench.mix(rows))
    output = playing_bench.blocks(live, [playing_bench.FADE, 256, 256, 256])[
        :, playing_bench.FADE :
    ]
    assert np.array_equal(output[:, :600], rows[:, :600].astype(np.float32))
    assert np.all(np.abs(np.diff(output[0, 599:])) <= 0.5 * np.pi / 2 / playing_bench.FALL)
    assert not output[:, 600 + playing_bench.FALL :].any()
    ending = live.ending
    assert (ending.reason, ending.output, ending.name) == ("limit", 2, "place 2")
    assert ending.peak == pytest.approx(1.25)
    assert "output 2 (place 2) would have passed full scale." in ending.sentence
    assert "down to \u22122.0 dB or less" in ending.sentence


def test_the_gain_that_is_named_is_low_enough_for_all_that_comes():
    row = np.concatenate((np.linspace(0.0, 3.0, 500), np.full(100, -7.0)))
    loud = playing_bench.playing(playing_bench.mix(row))
    playing_bench.block(loud, 800)
    assert loud.ending.peak < 1.1
    stated_db = float(loud.ending.sentence.split("down to ")[1].split()[0].replace("\u2212", "-"))
    again = playing_bench.playing(playing_bench.mix(row), gain_db=stated_db)
    playing_bench.block(again, 800)
    assert again.ending.reason == "end"
    assert stated_db == pytest.approx(-20 * np.log10(7.0), abs=0.11)


@pytest.mark.parametrize("later", [0, 39, 40, 41, 139, 140, 141, 1000])
def test_what_is_due_begins_at_the_sample_of_its_time_and_as_soon_as_it_can(later):
    rate_hz, fade, n = playing_bench.RATE_HZ, playing_bench.FADE, 100
    rests, begun = [], []
    queue = PlayQueue(1, rate_hz, 0.0, lambda: rests.append(True))
    mix = playing_bench.mix(np.full(300, 0.5))
    queue.begin(Due(mix, 10.0 + later / rate_hz, begun.append))
    heard = []
    for number in range(20):
        queue.begin_due(10.0 + number * n / rate_hz, n)
        heard.append(playing_bench.block(queue, n))
    samples = np.concatenate(heard, axis=1)[0]
    # Before the first sample there is a fade of silence.
    first = max(later, fade)
    assert begun == [pytest.approx(10.0 + first / rate_hz)]
    assert np.array_equal(
        samples, np.r_[np.zeros(first), np.full(300, 0.5), np.zeros(1700 - first)]
    )
    assert rests == [True]


class RunningQueue(PlayQueue):
    """A queue whose device asks for a block after each thing that `begin` sets."""

    def __setattr__(self, name, value):
        super().__setattr__(name, value)
        if name in ("due", "busy") and value:
            self.begin_due(0.0, 8)
            playing_bench.block(self, 8)


def test_a_mix_is_not_over_before_it_has_begun():
    rests, begun = [], []
    queue = RunningQueue(1, playing_bench.RATE_HZ, 0.0, lambda: rests.append(len(begun)))
    queue.begin(Due(playing_bench.mix(playing_bench.tone(400)), None, begun.append))
    playing_bench.block(queue, 600)
    assert rests == [1]


def test_a_mix_that_is_due_begins_after_the_one_that_still_plays():
    rests, begun = [], []
    queue = PlayQueue(1, playing_bench.RATE_HZ, 0.0, lambda: rests.append(len(begun)))
    for _ in range(2):
        queue.begin(Due(playing_bench.mix(playing_bench.tone(400)), None, begun.append))
        queue.begin_due(0.0, 100)
        playing_bench.block(queue, 100)
    for _ in range(12):
        queue.begin_due(1.0, 100)
        playing_bench.block(queue, 100)
    assert len(begun) == 2
    assert rests == [2]
    assert queue.ending is None


def test_the_limit_is_told_apart_from_what_is_no_number():
    live = playing_bench.playing(playing_bench.mix(np.full(400, 0.5)))
    playing_bench.block(live, playing_bench.FADE)
    live.mix = replace(live.mix, samples=np.full((1, 400), np.nan, np.float32))
    output = playing_bench.block(live, 100)
    assert np.isfinite(output).all()
    assert live.ending.reason == "broken"
    assert "output 1 (place 1) was given a value that is not a number" in live.ending.sentence


def test_a_steady_tone_at_full_scale_has_an_rms_of_minus_three_decibels():
    live = playing_bench.play_queue()
    live.play(
        playing_bench.mix(np.sin(2 * np.pi * np.arange(4 * WINDOW) * 100 / playing_bench.RATE_HZ)),
        0,
    )
    playing_bench.blocks(live, [97] * 24)
    levels = live.levels()
    assert levels.peak_db[0] == pytest.approx(0.0, abs=0.01)
    assert levels.rms_db[0] == pytest.approx(-3.0103, abs=0.001)
    assert levels.highest_db[0] == pytest.approx(0.0, abs=0.01)


def test_each_output_has_its_own_and_what_is_over_stays_the_highest():
    live = playing_bench.play_queue(2, gain_db=-20.0)
    rows = np.zeros((2, 3 * WINDOW))
    rows[0, 10] = -1.0
    rows[1] = 0.5
    live.play(playing_bench.mix(rows), 0)
    playing_bench.block(live, WINDOW)
    first = live.levels()
    assert first.peak_db == pytest.approx([-20.0, -26.02], abs=0.01)
    playing_bench.block(live, WINDOW)
    second = live.levels()
    assert second.peak_db[0] == -200.0
    assert second.rms_db == pytest.approx([-200.0, -26.02], abs=0.01)
    assert second.highest_db == pytest.approx([-20.0, -26.02], abs=0.01)
