"""A range of levels that is pulled along its scale."""

from collections.abc import Callable

from skinsource_gui.panels.skin.scale.level_range import Range

#: Makes another range of one and of how far it was pulled, dB.
Change = Callable[[Range, float], Range]

# The scale goes on this part of its range beyond either end, so that handles can be pulled out.
_BEYOND, _LEAST_BEYOND_DB = 0.12, 2.0


class PulledRange:
    """A range and the ends of its scale, which stay where they are while the range is held.

    Attributes
    ----------
    range_db
        The range.
    axis_db
        Levels of the ends of the scale.
    """

    def __init__(self, range_db: Range) -> None:
        self.range_db, self.axis_db = range_db, _axis_of(range_db)
        self._held: Range | None = None

    def show(self, range_db: Range) -> None:
        """Take over another range."""
        self.range_db = range_db
        if self._held is None:
            self.axis_db = _axis_of(range_db)

    def hold(self) -> None:
        """Begin to pull."""
        self._held = self.range_db

    def pulled(self, change: Change, part: float) -> Range | None:
        """What the range becomes, in steps of 0.1 dB; None: it is not held, or stays.

        Parameters
        ----------
        change
            What the pull does to a range.
        part
            How far up it was pulled since it is held, as a part of the scale.
        """
        if self._held is None:
            return None
        low, high = self.axis_db
        by_db = round(part * (high - low), 1)
        if not by_db and self.range_db == self._held:
            return None
        low, high = change(self._held, by_db)
        return round(low, 1), round(high, 1)

    def let_go(self) -> None:
        """Give the scale the ends that go with the range."""
        self._held = None
        self.axis_db = _axis_of(self.range_db)


def _axis_of(range_db: Range) -> Range:
    low, high = range_db
    beyond = max(_BEYOND * (high - low), _LEAST_BEYOND_DB)
    return low - beyond, high + beyond
