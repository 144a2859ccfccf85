"""A match, as it is kept."""

from dataclasses import dataclass

from skinsource.matching.procedure import Direction

#: What tells one match from another in a table.
Key = tuple[str, float, int, Direction]


@dataclass(frozen=True, slots=True, kw_only=True)
class Match:
    """A test that felt as strong as the reference.

    Attributes
    ----------
    person
        Whose match it is.
    frequency_hz, place, direction, start_db
        The test, and where it began, see `skinsource.matching.Trial`.
    matched_db
        Its drive where both felt equally strong, relative to that of the reference.
    reference_hz, reference_place, amplitude
        The reference.
    trial, seed
        Which trial of which random order it was.
    """

    person: str
    frequency_hz: float
    place: int
    direction: Direction
    start_db: float
    matched_db: float
    reference_hz: float
    reference_place: int
    amplitude: float
    trial: int
    seed: int

    @property
    def key(self) -> Key:
        """What tells it from others in one table."""
        return self.person, self.frequency_hz, self.place, self.direction

    @property
    def reference(self) -> tuple[float, int, float]:
        """Frequency, place and drive of the reference."""
        return self.reference_hz, self.reference_place, self.amplitude
