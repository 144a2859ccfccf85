"""Which vibrations are made as strong as a reference, and in which order."""

from dataclasses import dataclass
from hashlib import sha256
from itertools import product
from typing import Literal, get_args

import numpy as np

from skinsource.arguments import real_number, whole_number
from skinsource.design import Design, Input, track
from skinsource.errors import InvalidInputError
from skinsource.limb import MOST_PLACES
from skinsource.quoting import quoted
from skinsource.waveforms import Tone

Direction = Literal["ascending", "descending"]
DIRECTIONS: tuple[Direction, ...] = get_args(Direction)
#: The test relative to the reference, in dB, at most.
LOWEST_DB, HIGHEST_DB = -40.0, 30.0
#: How far from equal drives a test begins.
NEAREST_START_DB, FARTHEST_START_DB = 6.0, 12.0
#: Drives that a reference can have: the strongest test stays within what a design can hold.
MOST_AMPLITUDE = 30.0
_LOWEST_HZ, _HIGHEST_HZ = 1.0, 1000.0
_MOST_TRIALS, _LONGEST_NAME = 2000, 40
_MOST_SEED = 2**63 - 1


@dataclass(frozen=True, slots=True)
class Trial:
    """A test that is made as strong as the reference.

    Attributes
    ----------
    number
        From 1, in the order in which a person meets them.
    frequency_hz, place
        What the test is.
    direction
        ``"ascending"``: it begins weaker than the drive of the reference, else stronger.
    start_db
        Where it begins, relative to that.
    """

    number: int
    frequency_hz: float
    place: int
    direction: Direction
    start_db: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Procedure:
    """All matches of one person.

    Each test is met twice, from below and from above, so that what people do because of where they
    begin cancels (Stevens, "Psychophysics", 1975, on the method of adjustment); where they begin
    and the order are random, and follow from the seed and the name.

    Attributes
    ----------
    person
        Who matches: letters, digits, spaces, and any of ``-_.``
    frequencies_hz, places
        The tests are all combinations.
    reference_hz, reference_place, amplitude
        The reference, and its drive in the unit of the design's amplitudes, see `skinsource.chain`.
    duration_s, pause_s
        Of each of both, and between them.
    seed
        Of what is random.
    limb
        Limb of the designs that are played.
    """

    person: str
    frequencies_hz: tuple[float, ...]
    places: tuple[int, ...]
    reference_hz: float = 100.0
    reference_place: int = 7
    amplitude: float = 1.0
    duration_s: float = 0.8
    pause_s: float = 0.4
    seed: int = 0
    limb: str = "synthetic-1"

    def __post_init__(self) -> None:
        check_person(self.person)
        for name, values in (("frequencies_hz", self.frequencies_hz), ("places", self.places)):
            if not values or len(set(values)) < len(values):
                raise InvalidInputError(
                    f"{name} is {quoted(values)}, expected at least one value, each once"
                )
        for frequency_hz in (*self.frequencies_hz, self.reference_hz):
            real_number("a frequency", frequency_hz, least=_LOWEST_HZ, most=_HIGHEST_HZ)
        for place in (*self.places, self.reference_place):
            whole_number("a place", place, 1, MOST_PLACES)
        real_number("amplitude", self.amplitude, least=1e-6, most=MOST_AMPLITUDE)
        real_number("duration_s", self.duration_s, least=0.05, most=10.0)
        real_number("pause_s", self.pause_s, least=0.05, most=10.0)
        whole_number("seed", self.seed, 0, _MOST_SEED)
        if len(self) > _MOST_TRIALS:
            raise InvalidInputError(
                f"{len(self)} matches, expected at most {_MOST_TRIALS}. Leave some frequencies or "
                "places out."
            )

    def __len__(self) -> int:
        """How many matches there are."""
        return len(self.frequencies_hz) * len(self.places) * len(DIRECTIONS)

    @property
    def trials(self) -> tuple[Trial, ...]:
        """The matches, in the order in which this person makes them."""
        name = np.frombuffer(sha256(self.person.encode()).digest()[:8], np.uint32)
        rng = np.random.default_rng([self.seed, *name.tolist()])
        tests = list(product(self.frequencies_hz, self.places, DIRECTIONS))
        starts_db = rng.uniform(NEAREST_START_DB, FARTHEST_START_DB, len(tests)).round(1)
        found = []
        for number, which in enumerate(rng.permutation(len(tests)).tolist(), start=1):
            frequency_hz, place, direction = tests[which]
            start_db = float(starts_db[which]) * (-1.0 if direction == "ascending" else 1.0)
            found.append(Trial(number, float(frequency_hz), place, direction, start_db))
        return tuple(found)

    def design(self, trial: Trial, level_db: float) -> Design:
        """What is played again and again: the reference, then the test at ``level_db``."""
        level = real_number("level_db", level_db, least=LOWEST_DB, most=HIGHEST_DB)
        second_s = self.duration_s + self.pause_s
        return Design(
            limb=self.limb,
            inputs=(
                self._input(self.reference_hz, self.reference_place, self.amplitude, 0.0),
                self._input(
                    trial.frequency_hz,
                    trial.place,
                    self.amplitude * 10.0 ** (level / 20.0),
                    second_s,
                ),
            ),
            loop_s=(0.0, 2.0 * second_s),
            title="Matching",
        )

    def _input(self, frequency_hz: float, place: int, amplitude: float, onset_s: float) -> Input:
        tone = Tone(frequency_hz=frequency_hz, duration_s=self.duration_s)
        return track(place, tone, onset_s=onset_s, amplitude=amplitude)


def check_person(person: object) -> str:
    """Return the name of a person; refuse what a table or a file could take for something else."""
    if (
        not isinstance(person, str)
        or not 0 < len(person) <= _LONGEST_NAME
        or person != person.strip()
        or not all(one.isalnum() or one in " -_." for one in person)
        or not person[0].isalnum()
    ):
        raise InvalidInputError(
            f"person is {quoted(person)}, expected 1 to {_LONGEST_NAME} letters, digits, spaces or "
            "any of -_. that begin with a letter or digit"
        )
    return person
