"""What was done, in the order in which it was done."""

from dataclasses import dataclass

#: So many can be taken back; the oldest ones are forgotten first.
MOST_STEPS = 1000


@dataclass(frozen=True, slots=True)
class Step:
    """One step that can be taken back.

    Attributes
    ----------
    label
        What was done: "Mute input at 7 (II pad)".
    at_s
        When, in seconds of the epoch; of a gesture, its end.
    """

    label: str
    at_s: float


@dataclass(frozen=True, slots=True)
class History:
    """Steps since a design was begun or opened.

    Attributes
    ----------
    start
        What was before all steps: "Opened tap.skinsource".
    steps
        The oldest first; those behind the present one were taken back.
    present
        How many of them are done.
    saved
        How many were done when the file was written; None: that is forgotten, or never was.
    """

    start: str = ""
    steps: tuple[Step, ...] = ()
    present: int = 0
    saved: int | None = None
