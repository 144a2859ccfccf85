"""How long the last edits took until they were seen."""

from collections import deque

import numpy as np

#: Edits that are remembered.
MOST_EDITS = 100
_MS = 1e3
_A_SECOND_MS = 1000.0


class EditTimes:
    """Times of the last edits, oldest first."""

    def __init__(self) -> None:
        self._seconds: deque[float] = deque(maxlen=MOST_EDITS)

    def note(self, seconds: float) -> None:
        """Store a time."""
        self._seconds.append(seconds)

    def seconds(self) -> tuple[float, ...]:
        """Return the stored times."""
        return tuple(self._seconds)


def summary(seconds: tuple[float, ...]) -> str:
    """Return a sentence on several times; "" where there are none."""
    if not seconds:
        return ""
    count = "Last edit" if len(seconds) == 1 else f"Last {len(seconds)} edits"
    return (
        f"{count}: median {milliseconds(float(np.median(seconds)))}, 95 % within "
        f"{milliseconds(most_within(seconds))}, slowest {milliseconds(max(seconds))}."
    )


def most_within(seconds: tuple[float, ...]) -> float:
    """Return the time within which 95 % of ``seconds`` are, one of those that occurred."""
    return sorted(seconds)[-(-95 * len(seconds) // 100) - 1]


def milliseconds(seconds: float) -> str:
    """Return a text such as ``0.4 ms``, ``12 ms`` or ``1.3 s``."""
    shown = seconds * _MS
    if shown >= _A_SECOND_MS:
        return f"{seconds:.1f} s"
    return f"{shown:.0f} ms" if shown >= 9.95 else f"{shown:.1f} ms"
