"""What the design was when a gesture began."""

from skinsource.design import Design


class GestureStart:
    """Remembers the design that the first edit of a gesture started from."""

    def __init__(self) -> None:
        self._gesture: int | None = None
        self._design: Design | None = None

    def of(self, gesture: int, design: Design) -> Design:
        """Return the design at the start of ``gesture``, ``design`` if this is its first edit."""
        if gesture != self._gesture or self._design is None:
            self._gesture, self._design = gesture, design
        return self._design
