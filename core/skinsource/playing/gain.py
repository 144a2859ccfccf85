"""How loud it is played, without steps."""

from math import copysign

import numpy as np

from skinsource.arguments import real_number
from skinsource.arrays import Floats

#: Where it begins, each time something new is connected.
START_DB = -20.0
LOWEST_DB, HIGHEST_DB = -60.0, 20.0

# From silence to full scale.
_RAMP_S = 0.05


def factor_of(gain_db: float) -> float:
    """Factor of a gain; refuses what is not between -60 and 20 dB."""
    given = real_number(
        "gain_db",
        gain_db,
        f"a number from {LOWEST_DB:g} to {HIGHEST_DB:g}",
        least=LOWEST_DB,
        most=HIGHEST_DB,
    )
    return float(10.0 ** (given / 20.0))


class Gain:
    """Goes in a straight line to where it is wanted, so far each sample.

    Attributes
    ----------
    wanted
        Factor that it goes to; may be set from another thread.
    now
        Factor of the last sample.
    """

    def __init__(self, factor: float, sample_rate_hz: int, most_samples: int) -> None:
        self.wanted = self.now = factor
        self._step = 1.0 / (_RAMP_S * sample_rate_hz)
        self._count = np.arange(1.0, most_samples + 1)
        # Counted from where it set out, so that it is the same however it is cut into blocks.
        self._from, self._to, self._gone = factor, factor, 0

    def fill(self, out: Floats) -> None:
        """Factors of the next samples, (n_times,)."""
        wanted, n = self.wanted, out.size
        if wanted != self._to:
            self._from, self._to, self._gone = self.now, wanted, 0
        if self._from == self._to:
            out[:] = wanted
            return
        step = copysign(self._step, self._to - self._from)
        np.add(self._count[:n], self._gone, out=out)
        out *= step
        out += self._from
        (np.minimum if step > 0 else np.maximum)(out, self._to, out=out)
        self._gone += n
        self.now = float(out[-1])
        if self.now == self._to:
            self._from = self._to
