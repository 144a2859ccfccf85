"""What matches say: the drive at which each vibration feels as strong as the reference."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from skinsource.errors import InvalidInputError
from skinsource.matching.match import Match
from skinsource.quoting import quoted


@dataclass(frozen=True, slots=True)
class Strengths:
    """Drives of equal strength, by place and frequency.

    Attributes
    ----------
    points
        Place, frequency in Hz, and the drive in dB relative to that of the reference: the mean over
        persons of the mean over the matches of each.
    reference
        Place and frequency of the reference, which is 0 dB.
    """

    points: tuple[tuple[int, float, float], ...]
    reference: tuple[int, float]

    @classmethod
    def of(cls, matches: Iterable[Match]) -> "Strengths":
        """Average over the persons of a table.

        Raises
        ------
        InvalidInputError
            There are no matches.
        """
        by_test: dict[tuple[int, float], dict[str, list[float]]] = {}
        reference = None
        for one in matches:
            reference = one.reference_place, one.reference_hz
            of_test = by_test.setdefault((one.place, one.frequency_hz), {})
            of_test.setdefault(one.person, []).append(one.matched_db)
        if reference is None:
            raise InvalidInputError("the table holds no matches, expected at least one")
        points = tuple(
            (place, frequency_hz, float(np.mean([np.mean(own) for own in persons.values()])))
            for (place, frequency_hz), persons in sorted(by_test.items())
        )
        return cls(points, reference)

    def level_db(self, frequency_hz: float, place: int) -> float:
        """Drive that feels as strong as the reference, relative to that of the reference.

        Between measured frequencies in a straight line over the logarithm of the frequency.

        Raises
        ------
        InvalidInputError
            Nothing was matched at the place, or the frequency lies outside of those that were.
        """
        known = {one: level for at, one, level in self.points if at == place}
        if place == self.reference[0]:
            known.setdefault(self.reference[1], 0.0)
        if not known:
            places = ", ".join(str(at) for at in sorted({at for at, *_ in self.points}))
            raise InvalidInputError(
                f"nothing was matched at place {place}; the table has places {quoted(places)}"
            )
        measured_hz = sorted(known)
        if not measured_hz[0] <= frequency_hz <= measured_hz[-1]:
            raise InvalidInputError(
                f"{frequency_hz:g} Hz was not matched at place {place}, expected "
                f"{measured_hz[0]:g} to {measured_hz[-1]:g} Hz. Match it, or leave it out."
            )
        levels_db = [known[one] for one in measured_hz]
        return float(np.interp(np.log(frequency_hz), np.log(measured_hz), levels_db))
