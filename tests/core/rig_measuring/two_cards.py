"""Two devices that are made up: one plays, another records by a clock of its own."""

import threading
from types import SimpleNamespace

import numpy as np
import scipy
from scipy.signal import czt

from tests.core.playing.synthetic_sound import CallbackStop, MadeUpStream, SoundLibrary
from tests.core.rig_measuring.bench_top import RATE_HZ

#: What is played reaches the sensor's device so many of its samples later, beside the path's delay.
BEGUN_LATER = 321.4
_NO_TROUBLE = SimpleNamespace(output_underflow=False, input_overflow=False)


def by_another_clock(samples, ratio, late):
    """The same signal, by a clock ``ratio`` times as quick; its sample ``late`` is time 0.

    Exactly what lies between samples: the sum of its Fourier series, by the chirp transform.
    """
    n = scipy.fft.next_fast_len(samples.size + 4 * round(late), real=True)
    n += n % 2
    series = scipy.fft.fft(samples, n)
    low = np.concatenate((series[n // 2 + 1 :], series[: n // 2]))
    count = int((samples.size + late) * ratio)
    step = 2.0 * np.pi / (n * ratio)
    spectrum = czt(low, count, np.exp(1j * step), np.exp(1j * step * late))
    place = np.arange(count) - late
    return (spectrum * np.exp(1j * step * place * (1 - n // 2))).real / n


class Out(MadeUpStream):
    """Takes all that is played as quickly as it comes, and hands on what the sensor makes of it."""

    def _run(self) -> None:
        n, channels = self.asked["blocksize"], self.asked["channels"]
        # The inputs are on since a while.
        assert self.library.listening.wait(10)
        played, over = [], False
        with self.library.turn:
            while not (over or self.closed.is_set() or len(played) > self.library.pulled_after):
                out = np.full((n, channels), np.nan, np.float32)
                try:
                    self.asked["callback"](out, n, None, _NO_TROUBLE)
                except CallbackStop:
                    over = True
                played.append(out)
            self.library.hear(np.concatenate(played)[:, self.library.output - 1].astype(float))
        self.active = False
        self.asked["finished_callback"]()


class In(MadeUpStream):
    """Records noise, and what is heard as soon as there is something."""

    def _run(self) -> None:
        cards, n, channels = self.library, self.asked["blocksize"], self.asked["channels"]
        rng, recorded = np.random.default_rng(len(cards.streams)), np.zeros((channels, 0))
        for number in range(100_000):
            if self.closed.is_set() or number > cards.deaf_after:
                break
            came = cards.noise * rng.standard_normal((n, channels))
            lost = number == cards.loses_at
            status = SimpleNamespace(input_overflow=lost, output_underflow=False)
            with cards.turn:
                if cards.answers is not None:
                    recorded, cards.answers = cards.answers[:channels], None
                now, recorded = recorded[:, :n], recorded[:, n:]
                came[: now.shape[1], : now.shape[0]] += now.T
                self.asked["callback"](came.astype("f4"), n, None, status)
            cards.listening.set()
            if not cards.began:
                # Nothing is played yet: no need to hurry.
                self.closed.wait(0.001)
        self.active = False


class TwoCards(SoundLibrary):
    """``Plays`` has outputs; ``Hears`` has inputs and a clock ``ratio`` times as quick."""

    hosts = ("Made up", "Elsewhere")
    rows = (("Plays", 0, 4, 0, 44_100.0), ("Hears", 1, 0, 2, 44_100.0))

    def __init__(self, *paths, ratio=1.0, noise=1e-5, output=3) -> None:
        super().__init__(default_input=1)
        self.paths, self.ratio, self.noise, self.output = paths, ratio, noise, output
        self.pulled_after = self.deaf_after = 100_000
        self.loses_at = -1
        self.answers, self.began, self.listening = None, False, threading.Event()
        # Who has it goes on; the other waits.
        self.turn = threading.Lock()

    def hear(self, played) -> None:
        """Make what is recorded of what was played."""
        rows = [scipy.signal.fftconvolve(played, path) for path in self.paths]
        self.answers = np.stack([by_another_clock(row, self.ratio, BEGUN_LATER) for row in rows])
        self.began = True

    def OutputStream(self, **asked):  # as sounddevice calls it
        self.streams.append(Out(self, asked))
        return self.streams[-1]

    def InputStream(self, **asked):  # as sounddevice calls it
        stream = self.open(In(self, asked))
        assert asked["samplerate"] == RATE_HZ
        self.answers, self.began = None, False
        self.listening.clear()
        return stream
