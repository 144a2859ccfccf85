"""When it is heard."""

from dataclasses import dataclass

import numpy as np

from skinsource.playing.mix import Mix

# Blocks that are remembered: a second and more.
_REMEMBERED = 512
# Behind it is all that is played.
_NO_LOOP = (0, -(2**62))


@dataclass(frozen=True, slots=True, kw_only=True)
class Delay:
    """From an edit to the actuator, in its parts.

    Attributes
    ----------
    render_s
        Until the edited design was ready to be played.
    wait_s
        Until the device asked for the next block.
    device_s
        Until that block reached its outputs, as the device says.
    """

    render_s: float
    wait_s: float
    device_s: float

    @property
    def total_s(self) -> float:
        """All of it."""
        return self.render_s + self.wait_s + self.device_s

    @property
    def words(self) -> str:
        """All of it and its parts, in ms."""
        parts = ", ".join(
            f"{name} {seconds * 1e3:.0f} ms"
            for name, seconds in (
                ("computing", self.render_s),
                ("waiting for the device", self.wait_s),
                ("inside the device", self.device_s),
            )
        )
        return f"{self.total_s * 1e3:.0f} ms from an edit to the output: {parts}"


class DeviceClock:
    """Tells the time of a device without asking it: one that is stuck keeps whoever asks.

    One thread notes what the device says whenever it asks for a block, another asks.
    """

    def __init__(self) -> None:
        self._noted = 0
        self._behind_s = np.full(_REMEMBERED, np.inf)

    def note(self, device_s: float, now_s: float) -> None:
        """Note that the clock of the device showed ``device_s`` when here it was ``now_s``."""
        self._behind_s[self._noted % _REMEMBERED] = now_s - device_s
        self._noted += 1

    def at(self, now_s: float) -> float:
        """What it shows when here it is ``now_s``; before anything is noted, long before."""
        # Threads wait for each other: the least that was between the two is nearest to the truth.
        return now_s - float(self._behind_s.min())


class HeardPosition:
    """Tells which sample is heard now, from when blocks reach the outputs.

    One thread notes blocks, another asks.
    """

    def __init__(self, sample_rate_hz: int) -> None:
        self._rate_hz = sample_rate_hz
        self._noted = 0
        self._at_s = np.zeros(_REMEMBERED)
        self._position = np.zeros(_REMEMBERED, np.int64)
        self._loop = np.zeros((_REMEMBERED, 2), np.int64)

    def note(self, at_s: float, position: int, mix: Mix | None) -> None:
        """Note that a block that begins with sample ``position`` is heard from ``at_s`` on."""
        slot = self._noted % _REMEMBERED
        self._at_s[slot] = at_s
        self._position[slot] = position
        self._loop[slot] = _NO_LOOP if mix is None or mix.loop is None else mix.loop
        self._noted += 1

    def at(self, now_s: float) -> float | None:
        """Time in the design, in s, of what is heard at ``now_s``; None: nothing is yet.

        Never before 0, though the fade before the first sample is.
        """
        for block in range(self._noted - 1, max(self._noted - _REMEMBERED, 0) - 1, -1):
            slot = block % _REMEMBERED
            since_s = now_s - float(self._at_s[slot])
            if since_s >= 0.0:
                first, end = (int(one) for one in self._loop[slot])
                position = int(self._position[slot])
                later = position + since_s * self._rate_hz
                if position < end <= later:
                    later = first + (later - first) % (end - first)
                return max(later / self._rate_hz, 0.0)
        return None
