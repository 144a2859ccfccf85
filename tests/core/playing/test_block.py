import numpy as np
import pytest

from tests.core.playing.playing_bench import (
    FADE,
    FALL,
    RATE_HZ,
    block,
    blocks,
    largest_step,
    mix,
    play_queue,
    playing,
    tone,
)


def test_what_is_sent_is_what_was_to_be_played_to_the_last_bit():
    rows = np.random.default_rng(1).uniform(-1, 1, (3, 500))
    output = block(playing(mix(rows)), 700)
    assert np.array_equal(output[:, FADE : FADE + 500], rows.astype(np.float32))
    assert not output[:, :FADE].any()
    assert not output[:, FADE + 500 :].any()


def test_a_gain_multiplies_each_sample_before_it_is_rounded():
    row = np.random.default_rng(2).uniform(-1, 1, 300)
    output = block(playing(mix(row), gain_db=-20.0), FADE + 300)
    expected = (0.1 * row.astype(np.float32).astype(float)).astype(np.float32)
    assert np.array_equal(output[0, FADE:], expected)


@pytest.mark.parametrize("sizes", [[1] * 600, [7, 93, 500], [600], [299, 301]])
def test_it_does_not_matter_how_long_the_blocks_are(sizes):
    row = tone(500)

    def samples_of(lengths):
        queue = playing(mix(row, loop=(100, 420)))
        queue.set_gain(-6.0)
        return blocks(queue, lengths)

    assert np.array_equal(samples_of(sizes), samples_of([64] * 9 + [24]))


def test_blocks_longer_than_any_device_asks_for_are_whole():
    row = np.random.default_rng(3).uniform(-1, 1, 9000)
    output = block(playing(mix(row)), 9000 + FADE)
    assert np.array_equal(output[0, FADE:], row.astype(np.float32))


def test_it_starts_at_the_playhead_with_its_first_sample_whole():
    row = np.linspace(0.5, 0.9, 400)
    output = block(playing(mix(row), at=150), 250 + FADE)
    assert np.array_equal(output[0, FADE:], row[150:].astype(np.float32))
    # What stands before it rises from silence.
    weight = 0.5 - 0.5 * np.cos(np.pi * np.arange(1, FADE + 1) / (FADE + 1))
    assert output[0, :FADE] == pytest.approx(weight * row[150 - FADE : 150], abs=1e-7)


def test_a_loop_comes_back_to_its_first_sample_each_time():
    row = np.random.default_rng(4).uniform(-0.5, 0.5, 1000)
    output = block(playing(mix(row, loop=(200, 500)), at=300), FADE + 200 + 3 * 300)[0, FADE:]
    inside = slice(200, 500 - FADE)
    for begin in (200, 500, 800):
        turn = output[begin : begin + 300 - FADE]
        assert np.array_equal(turn, row[inside].astype(np.float32))


def test_the_end_of_a_loop_passes_over_into_what_stands_before_its_beginning():
    row = np.concatenate((np.full(200, 0.25), np.full(300, 0.75)))
    output = block(playing(mix(row, loop=(200, 400)), at=200), FADE + 200)[0, FADE:]
    weight = 0.5 - 0.5 * np.cos(np.pi * np.arange(1, FADE + 1) / (FADE + 1))
    assert output[200 - FADE :] == pytest.approx(0.75 * (1 - weight) + 0.25 * weight, abs=1e-7)


def test_a_loop_is_no_click_where_its_ends_do_not_fit():
    row = np.sin(2 * np.pi * np.arange(4000) * 110.0 / RATE_HZ)
    output = block(playing(mix(row, loop=(500, 1333)), at=500), 5000)
    own = largest_step(output[:, FADE : FADE + 833 - FADE])
    assert largest_step(output[:, FADE : FADE + 4000]) <= own + np.pi / FADE


def test_a_live_change_goes_on_at_the_same_sample_without_a_step():
    before, after = tone(4000, 40), -0.4 * tone(4000, 40)
    live = playing(mix(before, loop=(0, 4000)))
    first = block(live, FADE + 1000)
    live.play(mix(after, loop=(0, 4000)))
    second = block(live, 3000)
    # The last samples of the loop are its seam.
    expected = after[1000 + FADE : 4000 - FADE].astype(np.float32)
    assert np.array_equal(second[0, FADE:-FADE], expected)
    output = np.concatenate((first, second), axis=1)
    own = max(largest_step(before[np.newaxis]), largest_step(after[np.newaxis]))
    assert largest_step(output) <= own + 0.7 * np.pi / 2 / FADE


def test_a_change_within_a_change_waits_and_only_the_last_one_comes():
    live = playing(mix(np.full(2000, 0.1), loop=(0, 2000)))
    block(live, 100)
    live.play(mix(np.full(2000, 0.2), loop=(0, 2000)))
    block(live, 10)
    live.play(mix(np.full(2000, 0.3), loop=(0, 2000)))
    live.play(mix(np.full(2000, 0.4), loop=(0, 2000)))
    output = blocks(live, [30, 40, 10])[0]
    assert np.isclose(output[29], 0.2, atol=1e-3)
    assert output[-1] == np.float32(0.4)
    assert np.all(np.diff(output) >= 0)


def test_a_loop_that_moves_away_is_entered_at_its_beginning():
    row = np.random.default_rng(5).uniform(-0.5, 0.5, 4000)
    live = playing(mix(row, loop=(2000, 3000)), at=2500)
    block(live, FADE + 100)
    live.play(mix(row, loop=(0, 1000)))
    output = block(live, FADE + 500)
    assert np.array_equal(output[0, FADE:], row[:500].astype(np.float32))


def test_a_loop_ahead_is_reached_in_its_time():
    row = np.random.default_rng(6).uniform(-0.5, 0.5, 4000)
    live = playing(mix(row, loop=(2000, 3000)), at=0)
    output = block(live, FADE + 2900)
    assert np.array_equal(output[0, FADE:], row[:2900].astype(np.float32))


def test_it_stops_within_a_fade_and_says_so():
    live = playing(mix(np.full(4000, 0.8)))
    block(live, 500)
    live.stop()
    output = block(live, 2 * FADE)
    assert largest_step(output[:, :-1]) <= 0.8
    assert np.abs(np.diff(output[0, : FADE + 1])).max() <= 0.8 * np.pi / 2 / FADE
    assert not output[0, FADE:].any()
    assert live.ending.reason == "stopped"
    assert live.silent


def test_a_panic_is_silent_within_a_millisecond_even_amid_a_fade():
    live = playing(mix(np.full(4000, 0.8)))
    block(live, FADE + 100)
    live.play(mix(np.full(4000, 0.4)))
    before = block(live, FADE // 2)
    live.stop_at_once()
    output = block(live, 100)
    assert not output[0, FALL:].any()
    steps = np.abs(np.diff(np.concatenate((before[0, -1:], output[0]))))
    assert steps.max() <= 0.8 * np.pi / 2 / FALL
    assert live.ending.reason == "panic"
    assert not block(live, 50).any()


def test_it_ends_when_all_has_been_played():
    live = playing(mix(tone(1000)))
    block(live, FADE + 999)
    assert live.ending is None
    block(live, 1)
    assert live.ending.reason == "end"
    assert live.silent


def test_a_gain_goes_in_a_straight_line_and_arrives_exactly():
    live = playing(mix(np.full(8000, 1.0)), gain_db=-20.0)
    block(live, FADE)
    live.set_gain(0.0)
    output = blocks(live, [100, 100, 100, 100])[0]
    expected = np.minimum(0.1 + np.arange(1, 401) / (0.05 * RATE_HZ), 1.0)
    assert output == pytest.approx(expected, abs=1e-6)
    assert output[-1] == 1.0


def test_outputs_that_nobody_uses_are_silent():
    live = playing(mix(np.full(500, 0.5)), n_outputs=4)
    output = block(live, 300)
    assert not output[1:].any()


def test_a_queue_takes_no_mix_that_does_not_fit():
    with pytest.raises(ValueError, match="2 outputs at 8000 Hz, the queue 1"):
        play_queue(1).play(mix(np.zeros((2, 100))))
    with pytest.raises(ValueError, match="44100"):
        play_queue(1).play(mix(np.zeros(100), rate_hz=44100))


def test_nothing_grows_while_it_plays():
    import tracemalloc

    live = playing(mix(tone(4000), loop=(0, 4000)))
    out = np.zeros((240, 1), np.float32)
    from skinsource.lab.playing.stream import next_block

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


def test_a_loop_that_ends_at_this_very_sample_is_entered_at_its_beginning():
    row = np.random.default_rng(7).uniform(-0.5, 0.5, 4000)
    live = playing(mix(row))
    block(live, FADE + 1000)
    assert live.position == 1000
    live.play(mix(row, loop=(200, 1000)))
    assert np.array_equal(block(live, FADE + 300)[0, FADE:], row[200:500].astype(np.float32))
