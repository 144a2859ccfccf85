"""The playhead runs where there is nothing to play on."""

from collections.abc import Callable
from time import perf_counter

Loop = tuple[float, float] | None


class SilentRun:
    """Tells where playing would be, from the clock alone.

    Parameters
    ----------
    duration_s
        Where it ends, unless it loops.
    loop_s
        Begin and end of what is played again and again.
    at_s
        Where it begins.
    clock
        Tells seconds.
    slow_motion
        How many times slower than the clock it runs.
    """

    def __init__(
        self,
        duration_s: float,
        loop_s: Loop,
        at_s: float,
        clock: Callable[[], float] = perf_counter,
        slow_motion: float = 1.0,
    ) -> None:
        self._clock, self._slow_motion = clock, slow_motion
        self._duration_s, self._loop_s = duration_s, loop_s
        self._at_s, self._since_s = at_s, clock()

    def position_s(self) -> float:
        """Time in the design, s."""
        later_s = self._at_s + (self._clock() - self._since_s) / self._slow_motion
        if self._loop_s is None or not self._at_s < self._loop_s[1] <= later_s:
            return later_s
        first_s, end_s = self._loop_s
        return first_s + (later_s - first_s) % (end_s - first_s)

    @property
    def over(self) -> bool:
        """Whether all has been passed."""
        loops = self._loop_s is not None and self._at_s < self._loop_s[1]
        return not loops and self.position_s() >= self._duration_s

    def seek(self, at_s: float) -> None:
        """Go on elsewhere."""
        self._at_s, self._since_s = at_s, self._clock()

    def run_at(self, slow_motion: float) -> None:
        """Go on where it is, so many times slower than the clock."""
        self.seek(self.position_s())
        self._slow_motion = slow_motion

    def change(self, duration_s: float, loop_s: Loop) -> None:
        """Go on where it is, in another design; at the beginning of a loop that lies behind."""
        here_s = self.position_s()
        self._duration_s, self._loop_s = duration_s, loop_s
        self.seek(loop_s[0] if loop_s is not None and here_s >= loop_s[1] else here_s)
