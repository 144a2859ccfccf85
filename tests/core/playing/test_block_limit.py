"""The limit of what is played: what passes full scale is not played."""

import numpy as np
import pytest

from tests.core.playing.playing_bench import (
    FADE,
    FALL,
    RATE_HZ,
    block,
    blocks,
    mix,
    playing,
)


def test_a_sample_beyond_full_scale_is_not_played_and_its_output_is_named():
    rows = np.zeros((2, 1000))
    rows[0], rows[1, 600] = 0.5, 1.25
    live = playing(mix(rows))
    output = blocks(live, [FADE, 256, 256, 256])[:, FADE:]
    assert np.array_equal(output[:, :600], rows[:, :600].astype(np.float32))
    assert np.all(np.abs(np.diff(output[0, 599:])) <= 0.5 * np.pi / 2 / FALL)
    assert not output[:, 600 + FALL :].any()
    ending = live.ending
    assert (ending.reason, ending.output, ending.name) == ("limit", 2, "place 2")
    assert ending.peak == pytest.approx(1.25)
    assert "output 2 (place 2) would have passed full scale." in ending.sentence
    assert "down to \u22122.0 dB or less" in ending.sentence


def test_the_gain_that_is_named_is_low_enough_for_all_that_comes():
    row = np.concatenate((np.linspace(0.0, 3.0, 500), np.full(100, -7.0)))
    loud = playing(mix(row))
    block(loud, 800)
    assert loud.ending.peak < 1.1
    stated_db = float(loud.ending.sentence.split("down to ")[1].split()[0].replace("\u2212", "-"))
    again = playing(mix(row), gain_db=stated_db)
    block(again, 800)
    assert again.ending.reason == "end"
    assert stated_db == pytest.approx(-20 * np.log10(7.0), abs=0.11)


def test_full_scale_itself_is_played():
    row = np.array([0.0, 1.0, -1.0, 1.0] * 20)
    live = playing(mix(row))
    assert np.array_equal(block(live, FADE + 80)[0, FADE:], row.astype(np.float32))
    assert live.ending.reason == "end"


def test_a_gain_that_would_pass_full_scale_stops_where_it_does():
    live = playing(mix(np.full(8000, 0.5), loop=(0, 8000)), gain_db=0.0)
    block(live, FADE + 1)
    live.set_gain(20.0)
    output = block(live, 2000)[0]
    assert output.max() <= 1.0
    assert live.ending.reason == "limit"
    # From 0.5 to 1.0 takes 50 ms, the way from silence to full scale.
    assert int(np.argmax(output)) == pytest.approx(0.05 * RATE_HZ, abs=2)
    assert live.ending.highest_db == pytest.approx(6.0206, abs=1e-4)


def test_the_limit_is_told_apart_from_what_is_no_number():
    live = playing(mix(np.full(400, 0.5)))
    block(live, FADE)
    live.mix = object.__new__(type(live.mix))
    broken = np.full((1, 400), np.nan, np.float32)
    for name, value in (
        ("samples", broken),
        ("sample_rate_hz", RATE_HZ),
        ("peak", 0.5),
        ("names", ("place 1",)),
        ("loop", None),
        ("seam", broken[:, :0]),
        ("most_gain", np.inf),
    ):
        object.__setattr__(live.mix, name, value)
    output = block(live, 100)
    assert np.isfinite(output).all()
    assert live.ending.reason == "broken"
    assert "output 1 (place 1) was to play something that is no number" in live.ending.sentence


def test_the_smallest_number_beyond_full_scale_is_too_much():
    row = np.full(100, 0.25)
    row[50] = np.nextafter(np.float32(1.0), np.float32(2.0))
    live = playing(mix(row))
    assert block(live, FADE + 100).max() <= 0.25
    assert live.ending.reason == "limit"


@pytest.mark.parametrize("into_the_block", [0, 1, 2])
def test_the_limit_at_the_beginning_of_a_block_falls_from_the_sample_before(into_the_block):
    row = np.concatenate((np.linspace(0.1, 0.9, 100), np.full(50, 2.0)))
    live = playing(mix(row))
    output = blocks(live, [FADE + 100 - into_the_block, 50])[0, FADE:]
    assert np.array_equal(output[:100], row[:100].astype(np.float32))
    weight = 0.5 - 0.5 * np.cos(np.pi * np.arange(1, FALL + 1) / (FALL + 1))
    assert output[100 : 100 + FALL] == pytest.approx(0.9 * (1 - weight), abs=1e-6)
    assert not output[100 + FALL :].any()


def test_it_is_silent_as_soon_as_it_has_fallen_and_not_before():
    live = playing(mix(np.full(4000, 0.8)))
    block(live, 500)
    live.stop_at_once()
    block(live, FALL - 1)
    assert not live.silent
    block(live, 1)
    assert live.silent
