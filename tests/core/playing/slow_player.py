"""The same as `skinsource.lab.playing.stream.next_block`, one sample after the other and in plain
numbers."""

from math import cos, pi

from tests.core.playing.playing_bench import FADE, FALL, RATE_HZ


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
        if stays and (loop is None or here < loop[1]):
            self.now = [row, loop, here]
            return
        first = loop[0] if loop is not None else 0
        begin = first if at is None or (loop is not None and at >= loop[1]) else at
        self.now = [row, loop, begin - FADE]

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
        elif self.now[1] is None and self.now[2] >= len(self.now[0]):
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
