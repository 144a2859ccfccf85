"""Which of the designs that are compared are held against each other."""

from collections.abc import Sequence
from dataclasses import dataclass

from skinsource.design.comparing import EDITED
from skinsource.studies.checking import joint_of, strengths_of
from skinsource_gui.compared import Compared

_STORED_ALONE = "snapshots alone"


@dataclass(frozen=True, slots=True, kw_only=True)
class Held:
    """Designs, and what they are to each other.

    Attributes
    ----------
    compared
        Those that count.
    strengths
        Of each of them, where they differ in that alone; else empty.
    whole
        Which of them plays what all the others play; None: none does.
    words
        Which ones count, where it is not all of them.
    """

    compared: Sequence[Compared]
    strengths: tuple[float, ...] = ()
    whole: int | None = None
    words: str = ""

    @property
    def is_linear(self) -> bool:
        """Whether there is something to be held against each other."""
        return bool(self.strengths) or self.whole is not None


def held_of(compared: Sequence[Compared]) -> Held:
    """All of the designs; or, where what is edited is something else, those that are stored."""
    every = _held(compared)
    stored = [one for one in compared if one.snapshot.number != EDITED]
    if every.is_linear or len(stored) == len(compared):
        return every
    alone = _held(stored, _STORED_ALONE)
    return alone if alone.is_linear else every


def _held(compared: Sequence[Compared], words: str = "") -> Held:
    designs = [one.snapshot.design for one in compared]
    return Held(
        compared=compared,
        strengths=strengths_of(designs),
        whole=joint_of(designs),
        words=words,
    )
