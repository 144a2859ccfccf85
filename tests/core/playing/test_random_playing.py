"""Playing at random, against a player in plain numbers, one sample after the other."""

from math import cos, pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.core.playing.playing_bench import FADE, FALL, RATE_HZ, block, mix, play_queue


def weight(k: int, n: int) -> float:
    """How far a fade of n samples is at its sample k, counted from 0."""
    return 0.5 - 0.5 * cos(pi * (k + 1) / (n + 1))


def sample(row, loop, at: int) -> float:
    """What is played at a sample, the seam of the loop included."""

    def plain(k):
        return float(row[k]) if 0 <= k < len(row) else 0.0

    if loop is None or not loop[1] - FADE <= at < loop[1]:
        return plain(at)
    share = weight(at - loop[1] + FADE, FADE)
    return (1 - share) * plain(at) + share * plain(at - (loop[1] - loop[0]))


def step(loop, at: int) -> int:
    """The sample after ``at``."""
    return loop[0] if loop is not None and at + 1 == loop[1] else at + 1


class SlowPlayer:
    """One output."""

    def __init__(self, gain: float) -> None:
        self.now = self.old = None
        self.faded, self.gain, self.wanted_gain = FADE, gain, gain
        self.requested = None
        self.fall = None
        self.last = 0.0
        self.over = ""

    def begin_block(self) -> None:
        """Commands are looked at once per block."""
        if self.requested is None or self.faded < FADE or self.over:
            return
        (row, loop, at), self.requested = self.requested, None
        self.old, self.faded = self.now, 0
        if row is None:
            self.now = None
            return
        stays = at is None and self.old is not None
        here = self.old[2] if stays else 0
        if stays and (loop in (None, self.old[1]) or here < loop[1]):
            self.now = [row, loop, here]
            return
        first, end = loop or (0, -FADE)
        begin = first if at is None or (loop and at >= max(end, len(row))) else at
        self.now = [row, loop, max(begin - FADE, end) if begin >= end else begin - FADE]

    def next(self) -> float:
        """The next sample."""
        if self.over:
            return self._falling()
        samples = self._read(self.now)
        if self.faded < FADE:
            share = weight(self.faded, FADE)
            samples = share * samples + (1 - share) * self._read(self.old)
            self.faded += 1
        most = 1.0 / (0.05 * RATE_HZ)
        self.gain += max(-most, min(most, self.wanted_gain - self.gain))
        samples *= self.gain
        if abs(samples) > 1.0:
            self.over, self.fall = "limit", 0
            return self._falling()
        self.last = samples
        return samples

    def end_block(self) -> None:
        """All may have been played."""
        if self.over or self.faded < FADE or self.requested is not None:
            return
        if self.now is None:
            self.over = "stopped"
        elif self.now[2] >= max(len(self.now[0]), (self.now[1] or (0, 0))[1]):
            self.over = "end"

    def _read(self, playing) -> float:
        if playing is None:
            return 0.0
        row, loop, at = playing
        playing[2] = step(loop, at)
        return sample(row, loop, at)

    def _falling(self) -> float:
        if self.fall is None or self.fall >= FALL:
            return 0.0
        self.fall += 1
        return self.last * (1 - weight(self.fall - 1, FALL))


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


NOISE = np.random.default_rng(4).uniform(-0.5, 0.5, (2, 2000))
LOOP = (200, 500)
BEGIN = [("hear", FADE), ("play", NOISE[0], None, 0)]
#: Blocks within a fade or a fall.
SHORT = [("hear", 3)] * 20


@pytest.mark.parametrize(
    "scene",
    [
        [*BEGIN, *SHORT, ("play", NOISE[1], LOOP, None), *SHORT, ("hear", 900)],
        [*BEGIN, ("hear", 10), ("play", NOISE[1], None, None), ("play", NOISE[0], LOOP, 7), *SHORT],
        [*BEGIN[:1], ("play", NOISE[0], LOOP, 600), *SHORT, ("play", NOISE[1], LOOP, None), *SHORT],
        [*BEGIN, ("hear", FADE + LOOP[1]), ("play", NOISE[1], LOOP, None), ("hear", 400)],
        [*BEGIN, ("hear", 900), ("play", NOISE[1], LOOP, None), ("hear", 400)],
        [*BEGIN, ("hear", 100), ("gain", 20.0), ("hear", 60), *SHORT],
        [*BEGIN, ("hear", 100), ("play", NOISE[1], LOOP, 0), ("hear", 20), ("panic",), *SHORT],
        [*BEGIN, ("hear", 100), ("gain", -6.0), ("hear", 7), ("stop",), *SHORT],
        [*BEGIN, ("hear", 1999), ("hear", FADE), ("hear", 1), ("play", NOISE[1], None, 0)],
    ],
)
def test_in_each_scene_what_is_heard_is_what_a_plain_player_plays(scene):
    check_against_a_plain_player(scene)


@given(commands)
def test_whatever_is_asked_for_what_is_heard_is_what_a_plain_player_plays(all_commands):
    check_against_a_plain_player(all_commands)


def check_against_a_plain_player(all_commands):
    quick, slow, output, expected, _ = run(all_commands)
    assert np.allclose(output, expected, rtol=0, atol=3e-7)
    assert np.all(np.abs(output) <= 1.0)
    assert (quick.ending.reason if quick.ending else "") == slow.over


@given(quiet_commands)
def test_whatever_is_asked_for_nothing_clicks(all_commands):
    _, _, output, _, own = run(all_commands)
    # A signal's own steps; a fade between full scale of either sign, and another where a seam of a
    # loop lies within it; a step of the gain.
    allowed = own + 2 * 2 * pi / 2 / (FADE + 1) + 1 / (0.05 * RATE_HZ)
    if any(name == "panic" for name, *_ in all_commands):
        allowed = max(allowed, pi / 2 / FALL)
    assert np.abs(np.diff(np.pad(output.astype(float), 1))).max() <= allowed
