"""The part of a recording that is taken, dragged along a strip that shows all of it."""

from collections.abc import Callable

_HANDLE_PX = 6
_LEAST_PX = 3.0


class TakenPart:
    """A part of a recording, and what a drag makes of it.

    Parameters
    ----------
    longest_s
        Of the part.
    width_px
        How wide the strip is.

    Attributes
    ----------
    start_s, end_s
        The part.
    lasts_s
        How long the recording is.
    """

    def __init__(self, longest_s: float, width_px: Callable[[], int]) -> None:
        self._longest_s, self._width_px = longest_s, width_px
        self.start_s, self.end_s, self.lasts_s = 0.0, 1.0, 1.0
        # What is dragged: an end, the part, or a new one; and where it was taken, s.
        self._held: tuple[str, float] | None = None

    def show(self, lasts_s: float, start_s: float, duration_s: float) -> None:
        """Take over another part, of a recording of that length."""
        self.lasts_s = lasts_s
        self.start_s, self.end_s = start_s, min(start_s + duration_s, lasts_s)

    def take_all(self) -> None:
        """Take all, as far as it may be taken."""
        self.start_s, self.end_s = 0.0, min(self.lasts_s, self._longest_s)

    @property
    def held(self) -> bool:
        """Whether it is dragged."""
        return self._held is not None

    def hold(self, x_px: float) -> bool:
        """Begin to drag there; whether the part came there already."""
        end = self.end_at(x_px)
        if end:
            self._held = (end, 0.0)
        elif self._all_is_taken:
            self._held = ("new", self._time_of(x_px))
        elif self.x_of(self.start_s) <= x_px <= self.x_of(self.end_s):
            self._held = ("part", self._time_of(x_px) - self.start_s)
        else:
            self._held = ("part", (self.end_s - self.start_s) / 2.0)
            return self.drag(x_px)
        return False

    def drag(self, x_px: float) -> bool:
        """Follow the pointer; whether there is a part to be told of."""
        held, offset_s = self._held or ("part", 0.0)
        start_s, end_s = self.start_s, self.end_s
        least_s = self.lasts_s / max(self._width_px(), 1)
        at_s = self._time_of(x_px)
        if held == "new":
            if abs(self.x_of(at_s) - self.x_of(offset_s)) < _LEAST_PX:
                return False
            at_s = min(max(at_s, offset_s - self._longest_s), offset_s + self._longest_s)
            start_s, end_s = sorted((offset_s, at_s))
        elif held == "start":
            start_s = min(max(at_s, end_s - self._longest_s), end_s - least_s)
        elif held == "end":
            end_s = max(min(at_s, start_s + self._longest_s), start_s + least_s)
        else:
            length_s = end_s - start_s
            start_s = min(max(at_s - offset_s, 0.0), self.lasts_s - length_s)
            end_s = start_s + length_s
        self.start_s, self.end_s = max(start_s, 0.0), end_s
        return True

    def let_go(self) -> None:
        """The drag has ended."""
        self._held = None

    def x_of(self, time_s: float) -> float:
        """Where a time lies, px."""
        return self._width_px() * time_s / self.lasts_s

    def end_at(self, x_px: float) -> str:
        """Which end of the part is meant there: "start" or "end"; empty for none."""
        ends = {"start": self.start_s, "end": self.end_s}
        near = [name for name, at_s in ends.items() if abs(self.x_of(at_s) - x_px) <= _HANDLE_PX]
        return near[-1] if near else ""

    @property
    def _all_is_taken(self) -> bool:
        return self.x_of(self.start_s) < 1.0 and self.x_of(self.end_s) > self._width_px() - 1.0

    def _time_of(self, x_px: float) -> float:
        return min(max(x_px / max(self._width_px(), 1), 0.0), 1.0) * self.lasts_s
