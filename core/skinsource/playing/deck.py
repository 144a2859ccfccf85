"""What is known while something is played, and what is wanted next."""

from dataclasses import dataclass
from math import log10
from time import perf_counter

import numpy as np

from skinsource.playing.ending import Ending
from skinsource.playing.gain import START_DB, Gain, factor_of
from skinsource.playing.meters import Levels, Meters
from skinsource.playing.mix import Mix, fade_samples, rise

#: Samples that are computed at once; longer blocks are made of several.
MOST_SAMPLES = 2048
# Time in which what is stopped at once becomes silent.
_FALL_S = 0.001


@dataclass(frozen=True, slots=True, eq=False)
class Swap:
    """A mix that is wanted in the place of the present one.

    Attributes
    ----------
    mix
        What to play; it needs no more outputs than the deck has.
    at
        Sample at which it goes on; None: where the present one is.
    handed_s
        When it was wanted, by `time.perf_counter`.
    """

    mix: Mix | None
    at: int | None
    handed_s: float


class Deck:
    """The state behind a stream: one thread asks for things, another plays.

    What is asked for is one attribute each, which `skinsource.playing.block.next_block` looks at
    once per block: nobody ever waits for the other.

    Parameters
    ----------
    n_outputs
        Outputs that are played on.
    sample_rate_hz
        Of the device; mixes have the same.
    gain_db
        Where the gain begins.
    """

    def __init__(self, n_outputs: int, sample_rate_hz: int, gain_db: float = START_DB) -> None:
        self.n_outputs, self.sample_rate_hz = n_outputs, sample_rate_hz
        # What is wanted.
        self.swap: Swap | None = None
        self.panic = False
        self.gain = Gain(factor_of(gain_db), sample_rate_hz, MOST_SAMPLES)
        # What is played: the mix, and the one it takes over from.
        self.mix: Mix | None = None
        self.old: Mix | None = None
        self.position = self.old_position = 0
        self.fade = rise(fade_samples(sample_rate_hz))
        self.faded = self.fade.size
        # What falls to silence from where it was.
        self.fall = 1.0 - rise(max(round(_FALL_S * sample_rate_hz), 1))
        self.fallen: int | None = None
        self.last = np.zeros(n_outputs)
        # What is known.
        self.ending: Ending | None = None
        self.played_samples = 0
        # Where the block that was played last begins, and in what.
        self.began_at = 0
        self.began_in: Mix | None = None
        self.taken_s = self.waited_s = 0.0
        self.meters = Meters(n_outputs, sample_rate_hz)
        self.work, self.other, self.scratch = np.zeros((3, n_outputs, MOST_SAMPLES))
        self.factors = np.ones(MOST_SAMPLES)

    def play(self, mix: Mix, at: int | None = None) -> None:
        """Go over to ``mix``: at sample ``at``, or where the present one is by then."""
        if mix.n_outputs > self.n_outputs or mix.sample_rate_hz != self.sample_rate_hz:
            raise ValueError(
                f"the mix has {mix.n_outputs} outputs at {mix.sample_rate_hz} Hz, the deck "
                f"{self.n_outputs} at {self.sample_rate_hz} Hz"
            )
        self.swap = Swap(mix, at, perf_counter())

    def seek(self, at: int) -> None:
        """Go on at another sample of what is played."""
        swap = self.swap
        mix = self.mix if swap is None else swap.mix
        if mix is not None:
            self.swap = Swap(mix, at, perf_counter())

    def stop(self) -> None:
        """Fade out."""
        self.swap = Swap(None, None, perf_counter())

    def stop_at_once(self) -> None:
        """Fall silent within a millisecond, whatever else is going on."""
        self.panic = True

    def set_gain(self, gain_db: float) -> None:
        """Go to another gain within 50 ms."""
        self.gain.wanted = factor_of(gain_db)

    @property
    def silent(self) -> bool:
        """Whether nothing but silence will come."""
        return self.ending is not None and (self.fallen is None or self.fallen >= self.fall.size)

    @property
    def gain_db(self) -> float:
        """The gain that is wanted."""
        return 20.0 * log10(self.gain.wanted)

    def levels(self) -> Levels:
        """How loud each output is."""
        return self.meters.levels()
