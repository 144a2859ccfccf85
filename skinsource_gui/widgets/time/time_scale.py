"""From times to pixels and back."""

from dataclasses import dataclass

Range = tuple[float, float]

#: No closer than so much of the design across the whole width.
SHORTEST_S = 0.005


@dataclass(frozen=True, slots=True, kw_only=True)
class TimeScale:
    """Which part of the time is shown, and where.

    Attributes
    ----------
    shown_s
        First and last time that can be seen.
    left_px, width_px
        Where the first one lies, and how far away the last one.
    """

    shown_s: Range
    left_px: float = 0.0
    width_px: float = 1.0

    @property
    def px_per_s(self) -> float:
        """Pixels of a second."""
        return self.width_px / (self.shown_s[1] - self.shown_s[0])

    @property
    def right_px(self) -> float:
        """Where the last time lies."""
        return self.left_px + self.width_px

    def x(self, time_s: float) -> float:
        """Where a time lies, px."""
        return self.left_px + (time_s - self.shown_s[0]) * self.px_per_s

    def time(self, x_px: float) -> float:
        """Time at a position."""
        return self.shown_s[0] + (x_px - self.left_px) / self.px_per_s


def zoomed(shown_s: Range, anchor_s: float, factor: float, whole_s: Range) -> Range | None:
    """The range ``factor`` times narrower around ``anchor_s``; None where it is the whole."""
    low, high = shown_s
    length = max((high - low) / factor, SHORTEST_S)
    share = (anchor_s - low) / (high - low)
    return within((anchor_s - share * length, anchor_s + (1 - share) * length), whole_s)


def panned(shown_s: Range, by_s: float, whole_s: Range) -> Range | None:
    """The range ``by_s`` later, as far as there is any; None where it is the whole."""
    return within((shown_s[0] + by_s, shown_s[1] + by_s), whole_s)


def within(wanted_s: Range, whole_s: Range) -> Range | None:
    """The range of this length that lies in the whole; None where it is the whole."""
    length = wanted_s[1] - wanted_s[0]
    if length >= (whole_s[1] - whole_s[0]) * (1 - 1e-9):
        return None
    low = min(max(wanted_s[0], whole_s[0]), whole_s[1] - length)
    return (low, low + length)
