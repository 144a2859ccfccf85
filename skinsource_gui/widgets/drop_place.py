"""Where something goes that is dropped on a panel."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class DropPlace:
    """An input place, or a track that there is already, and a time on it.

    Attributes
    ----------
    location
        Place of a new input.
    input_id
        Of the track that takes a clip; it goes before ``location``.
    onset_s
        When that starts.
    """

    location: int | None = None
    input_id: int | None = None
    onset_s: float = 0.0
