from math import pi

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from tests.core.playing.playing_bench import FADE, FALL, RATE_HZ, block, mix, play_queue
from tests.core.playing.slow_player import SlowPlayer


def _row(kind: int, n: int, amplitude: float) -> np.ndarray:
    time = np.arange(n)
    if kind == 0:
        return np.full(n, amplitude)
    if kind == 1:
        return amplitude * np.sin(2 * pi * time * 0.013)
    return amplitude * np.cos(2 * pi * time * 0.05 + 1.0) * np.exp(-time / 300)


rows = st.builds(
    _row, st.integers(0, 2), st.integers(1, 900), st.floats(-1.0, 1.0, allow_subnormal=False)
)
loops = st.none() | st.tuples(st.integers(0, 700), st.integers(2 * FADE, 500)).map(
    lambda span: (span[0], span[0] + span[1])
)
swaps = st.tuples(st.just("play"), rows, loops, st.none() | st.integers(0, 1200))
gains = st.tuples(st.just("gain"), st.floats(-60.0, 20.0))
quiet_gains = st.tuples(st.just("gain"), st.floats(-60.0, 0.0))
ends = st.sampled_from([("stop",), ("panic",)])
plays = st.tuples(st.just("hear"), st.integers(1, 400))
# What ends all comes now and then.
commands = st.lists(st.one_of(swaps, gains, plays, plays, ends), max_size=12)
quiet_commands = st.lists(st.one_of(swaps, quiet_gains, plays, plays, ends), max_size=12)


def run(all_commands):
    """What is heard of both players, and the largest step that the signals have themselves."""
    quick, slow = play_queue(gain_db=0.0), SlowPlayer(1.0)
    quick.play(mix(np.zeros(2000)), 0)
    slow.requested = (np.zeros(2000, np.float32), None, 0)
    output, expected, own = [], [], 0.0
    for name, *what in [*all_commands, ("hear", 300)]:
        if name == "play":
            row, loop, at = what
            quick.play(mix(row, loop=loop), at)
            slow.requested = (row.astype(np.float32), loop, at)
            own = max(own, float(np.abs(np.diff(np.pad(row, 1))).max()))
        elif name == "gain":
            quick.set_gain(what[0])
            slow.wanted_gain = 10 ** (what[0] / 20)
        elif name == "stop":
            quick.stop()
            slow.requested = (None, None, None)
        elif name == "panic":
            quick.stop_at_once()
            if not slow.over:
                slow.over, slow.fall = "panic", 0
        else:
            output.append(block(quick, what[0])[0])
            slow.begin_block()
            expected.append([slow.next() for _ in range(what[0])])
            slow.end_block()
            if not slow.over and slow.now is not None:
                assert quick.position == slow.now[2]
    return quick, slow, np.concatenate(output), np.concatenate(expected), own


@given(commands)
def test_whatever_is_asked_for_what_is_heard_is_what_a_plain_player_plays(all_commands):
    quick, slow, output, expected, _ = run(all_commands)
    assert np.allclose(output, expected, rtol=0, atol=3e-7)
    assert (quick.ending.reason if quick.ending else "") == slow.over


@given(commands)
def test_whatever_is_asked_for_full_scale_is_kept(all_commands):
    _, _, output, _, _ = run(all_commands)
    assert np.all(np.abs(output) <= 1.0)


@given(quiet_commands)
def test_whatever_is_asked_for_nothing_clicks(all_commands):
    _, _, output, _, own = run(all_commands)
    # A signal's own steps; a fade between full scale of either sign, and another where a seam of a
    # loop lies within it; a step of the gain.
    allowed = own + 2 * 2 * pi / 2 / (FADE + 1) + 1 / (0.05 * RATE_HZ)
    if any(name == "panic" for name, *_ in all_commands):
        allowed = max(allowed, pi / 2 / FALL)
    assert np.abs(np.diff(np.pad(output.astype(float), 1))).max() <= allowed


@given(rows, st.integers(0, 400), st.lists(st.integers(1, 300), min_size=1, max_size=6))
def test_a_mix_in_the_place_of_itself_changes_nothing(row, at, sizes):
    loop = (100, 400)
    live, left_alone = play_queue(), play_queue()
    for queue in (live, left_alone):
        queue.play(mix(row, loop=loop), at)
    for n in sizes:
        live_heard, left_heard = block(live, n), block(left_alone, n)
        assert np.allclose(live_heard, left_heard, rtol=0, atol=1e-7)
        assert live.position == left_alone.position
        live.play(mix(row, loop=loop))
