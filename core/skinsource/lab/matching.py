"""Matching: a person makes one vibration as strong as a reference; strength is not predicted.

A person compares a reference and a test in turn, makes the test stronger or weaker until both are
as strong, and stores the match in a CSV table.  The means of many matches are used in sweeps, see
`Strengths`.
"""

import csv
import io
from collections.abc import Callable, Iterable
from dataclasses import astuple, dataclass, fields
from hashlib import sha256
from itertools import product
from math import inf
from pathlib import Path
from typing import Literal, get_args

import numpy as np

from skinsource.actuators.rigs import Rig
from skinsource.base.arguments import checking, integer, one_of, real_number
from skinsource.base.conventions import MOST_LOCATIONS
from skinsource.base.errors import (
    FileFormatError,
    InvalidInputError,
    counted,
    csv_text,
    printable,
    quoted,
    sentence,
)
from skinsource.base.files import path_exists, path_text, read_bytes, write_bytes
from skinsource.base.lock import Lock
from skinsource.design.design import Design, Input, track
from skinsource.design.waveforms.tones import Tone
from skinsource.lab.playing.devices import Output
from skinsource.lab.playing.session import Playing, Session
from skinsource.lab.playing.stream import START_DB, Stream

Direction = Literal["ascending", "descending"]
DIRECTIONS: tuple[Direction, ...] = get_args(Direction)
#: Range of the test relative to the reference.
LOWEST_DB, HIGHEST_DB = -40.0, 30.0
#: Range of the distance from equal drives at which a test begins.
NEAREST_START_DB, FARTHEST_START_DB = 6.0, 12.0
#: Strongest drive of a reference, so that the strongest test is an amplitude that designs allow.
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
        From 1, in the order of a person.
    frequency_hz, place
        Frequency and input location of the test.
    direction
        ``"ascending"``: it begins weaker than the drive of the reference, else stronger.
    start_db
        Level at which it begins, relative to the reference.
    """

    number: int
    frequency_hz: float
    place: int
    direction: Direction
    start_db: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Procedure:
    """All matches of one person.

    Each test is matched twice, from below and from above, so that the influence of the start
    cancels (Stevens, "Psychophysics", 1975, on the method of adjustment).  Order and starts are
    random, and follow from the seed and the name.

    Attributes
    ----------
    person
        Name of the person: letters, digits, spaces, and any of ``-_.``
    frequencies_hz, places
        The tests are all combinations of these frequencies and input locations.
    reference_hz, reference_place, amplitude
        The reference, and its drive in the unit of the amplitudes of a design, see
        `skinsource.design.signal_path`.
    duration_s, pause_s
        Duration of reference and test, and the pause between them.
    seed
        Seed of order and starts.
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
            integer("a place", place, 1, MOST_LOCATIONS)
        real_number("amplitude", self.amplitude, least=1e-6, most=MOST_AMPLITUDE)
        real_number("duration_s", self.duration_s, least=0.05, most=10.0)
        real_number("pause_s", self.pause_s, least=0.05, most=10.0)
        integer("seed", self.seed, 0, _MOST_SEED)
        if len(self) > _MOST_TRIALS:
            raise InvalidInputError(
                f"{len(self)} matches, expected at most {_MOST_TRIALS}. Leave some frequencies or "
                "places out."
            )

    def __len__(self) -> int:
        """Number of matches."""
        return len(self.frequencies_hz) * len(self.places) * len(DIRECTIONS)

    @property
    def trials(self) -> tuple[Trial, ...]:
        """All trials, in the order for this person."""
        name = np.frombuffer(sha256(self.person.encode()).digest()[:8], np.uint32)
        rng = np.random.default_rng([self.seed, *name.tolist()])
        tests = list(product(self.frequencies_hz, self.places, DIRECTIONS))
        starts_db = rng.uniform(NEAREST_START_DB, FARTHEST_START_DB, len(tests)).round(1)
        trials = []
        for number, test in enumerate(rng.permutation(len(tests)).tolist(), start=1):
            frequency_hz, place, direction = tests[test]
            start_db = float(starts_db[test]) * (-1.0 if direction == "ascending" else 1.0)
            trials.append(Trial(number, float(frequency_hz), place, direction, start_db))
        return tuple(trials)

    def design(self, trial: Trial, level_db: float) -> Design:
        """Return the design that is repeated: the reference, then the test at ``level_db``."""
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
    """Return the name of a person; raise where it could mean something else in a table or file."""
    if (
        not isinstance(person, str)
        or not 0 < len(person) <= _LONGEST_NAME
        or person != person.strip()
        or not all(character.isalnum() or character in " -_." for character in person)
        or not person[0].isalnum()
    ):
        raise InvalidInputError(
            f"person is {quoted(person)}, expected 1 to {_LONGEST_NAME} letters, digits, spaces or "
            "any of -_. that begin with a letter or digit"
        )
    return person


#: Person, frequency, location and direction: a table holds one match for each.
Key = tuple[str, float, int, Direction]


@dataclass(frozen=True, slots=True, kw_only=True)
class Match:
    """A test that a person has made as strong as the reference.

    Attributes
    ----------
    frequency_hz, place, direction, start_db
        The test, and where it began, see `skinsource.lab.matching.Trial`.
    matched_db
        Drive of the test when both felt equally strong, relative to that of the reference.
    reference_hz, reference_place, amplitude
        The reference, see `Procedure`.
    trial, seed
        Number of the trial, and seed of its random order.
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
        """Key of the match in a table."""
        return self.person, self.frequency_hz, self.place, self.direction

    @property
    def reference(self) -> tuple[float, int, float]:
        """Frequency, place and drive of the reference."""
        return self.reference_hz, self.reference_place, self.amplitude


_MOST_BYTES = 64 * 2**20
_COLUMNS = tuple(field.name for field in fields(Match))


@checking
def read_matches(path: Path) -> tuple[Match, ...]:
    """Read a table of matches.

    Raises
    ------
    StorageError
        The file cannot be read.
    FileFormatError
        The file is no table of matches, or holds a match twice, or matches with different
        references.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import skinsource as ss
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "matches.csv"
    ...     match = ss.matching.Match(
    ...         person="A", frequency_hz=50.0, place=7, direction="ascending", start_db=-9.0,
    ...         matched_db=3.0, reference_hz=100.0, reference_place=7, amplitude=1.0,
    ...         trial=1, seed=1,
    ...     )
    ...     matches = ss.matching.add_match(path, match)
    ...     print(ss.matching.read_matches(path) == matches)
    True
    """
    try:
        text = read_bytes(path, most=_MOST_BYTES).decode()
        rows = list(csv.reader(io.StringIO(text, newline=""), strict=True))
    except (ValueError, csv.Error) as error:
        raise FileFormatError(
            f"{path_text(path)}: expected CSV text ({printable(error)})."
        ) from error
    if not rows or tuple(rows[0]) != _COLUMNS:
        raise FileFormatError(
            f"{path_text(path)}: is not a table of matches: its first line is "
            f"{quoted(','.join(rows[0]) if rows else '')}, expected {','.join(_COLUMNS)}. Choose "
            "another file."
        )
    matches: list[Match] = []
    known: dict[object, int] = {}
    for line, row in enumerate(rows[1:], start=2):
        try:
            match = _match(row)
            before = known.setdefault(match.key, line)
            if before != line:
                raise InvalidInputError(f"the same match is in line {before} already")
            if match.reference != (matches or [match])[0].reference:
                raise InvalidInputError("its reference is not that of line 2")
        except InvalidInputError as error:
            raise FileFormatError(
                f"{path_text(path)}, line {line}: {sentence(str(error))} Correct or remove it."
            ) from error
        matches.append(match)
    return tuple(matches)


@checking
def add_match(path: Path, new: Match) -> tuple[Match, ...]:
    """Add a match to a table, which is created if there is none, and return all matches.

    The file is replaced as a whole: after any failure it holds all old rows, or one more.
    Processes that add at the same time wait for each other.

    Raises
    ------
    InvalidInputError
        The table holds this match already, or has another reference.
    FileFormatError, StorageError
        The file is no table of matches, or cannot be read or written.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import skinsource as ss
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "matches.csv"
    ...     match = ss.matching.Match(
    ...         person="A", frequency_hz=50.0, place=7, direction="ascending", start_db=-9.0,
    ...         matched_db=3.0, reference_hz=100.0, reference_place=7, amplitude=1.0,
    ...         trial=1, seed=1,
    ...     )
    ...     print(len(ss.matching.add_match(path, match)))
    1
    """
    with Lock(path).hold():
        before = read_matches(path) if path_exists(path) else ()
        if any(match.key == new.key for match in before):
            raise InvalidInputError(
                f"{path_text(path)} has the {new.direction} match of {new.frequency_hz:g} Hz at "
                f"place {new.place} by {new.person} already. Nothing was changed."
            )
        check_reference(path, before, new.reference)
        matches = (*before, new)
        write_bytes(path, csv_text(_COLUMNS, map(astuple, matches)).encode())
    return matches


def check_reference(
    path: Path, matches: Iterable[Match], reference: tuple[float, int, float]
) -> None:
    """Raise where a table has another reference than ``reference``."""
    for match in matches:
        if match.reference != reference:
            frequency_hz, place, amplitude = match.reference
            raise InvalidInputError(
                f"{path_text(path)} holds matches with another reference: {frequency_hz:g} Hz at "
                f"place {place}, a drive of {amplitude:g}. Choose another file, or that reference."
            )


def _match(row: list[str]) -> Match:
    if len(row) != len(_COLUMNS):
        raise InvalidInputError(f"it has {counted(len(row), 'value')}, expected {len(_COLUMNS)}")
    cells = dict(zip(_COLUMNS, row, strict=True))

    def number(name: str, least: float = -inf, most: float = inf) -> float:
        try:
            value = float(cells[name])
        except ValueError:
            raise InvalidInputError(f"{name} is {quoted(cells[name])}, expected a number") from None
        return real_number(name, value, least=least, most=most)

    def whole(name: str, least: int, most: int) -> int:
        text = cells[name]
        if not (text.isdecimal() and len(text) < 20):
            raise InvalidInputError(f"{name} is {quoted(text)}, expected a whole number")
        return integer(name, int(text), least, most)

    return Match(
        person=check_person(cells["person"]),
        frequency_hz=number("frequency_hz", least=1e-3),
        place=whole("place", 1, MOST_LOCATIONS),
        direction=one_of("direction", cells["direction"], DIRECTIONS),
        start_db=number("start_db"),
        matched_db=number("matched_db", least=LOWEST_DB, most=HIGHEST_DB),
        reference_hz=number("reference_hz", least=1e-3),
        reference_place=whole("reference_place", 1, MOST_LOCATIONS),
        amplitude=number("amplitude", least=1e-6, most=MOST_AMPLITUDE),
        trial=whole("trial", 1, _MOST_SEED),
        seed=whole("seed", 0, _MOST_SEED),
    )


class Presenter:
    """Plays reference and test in turn on a device, or in silence where there is none.

    One thread, which may wait for the device, calls `present` and `close`; any thread may call
    `stop_at_once`.  Playing ends before a sample would pass full scale.

    Parameters
    ----------
    output
        Device, and its outputs.
    finished
        Called from the thread of the device, with its stream, when playing has ended.
    rig
        What is wired to the device, with limits; None where it is not known.
    """

    def __init__(
        self, output: Output, finished: Callable[[Stream], None], rig: Rig | None = None
    ) -> None:
        self._output, self._rig = output, rig
        self._session = Session(finished)
        self._playing: Playing | None = None
        self._stopped = False

    def present(self, design: Design, gain_db: float = START_DB) -> Playing:
        """Play ``design`` again and again, or change to it without a click.

        Raises
        ------
        SkinSourceError
            The design cannot be played, or the device refuses it; nothing is played then.
        """
        if self._stopped:
            self.close()
        if self._playing is not None:
            self._playing = self._session.change(
                self._playing, design, self._output, loops=True, rig=self._rig
            )
        if self._playing is None:
            self._playing = self._session.play(
                design, self._output, loops=True, at_s=0.0, gain_db=gain_db, rig=self._rig
            )
        if self._playing.stream is not None:
            self._playing.stream.queue.set_gain(gain_db)
        return self._playing

    @property
    def reason(self) -> str:
        """Why there is no sound, and what to do; "" where there is, or nothing is played."""
        return "" if self._playing is None else self._playing.reason

    def stop_at_once(self) -> None:
        """Fall silent within a millisecond."""
        self._stopped = True
        playing = self._playing
        if playing is not None and playing.stream is not None:
            playing.stream.queue.stop_at_once()

    def close(self) -> None:
        """Stop playing and close the device."""
        self._stopped, self._playing = False, None
        self._session.close()


#: Change of the level by an arrow key.
STEP_DB = 1.0


class MatchingRun:
    """All matches of a procedure, made by one person, on one day or several.

    Matches that the table holds already are left out.

    Parameters
    ----------
    procedure
        The matches to make.
    path
        Table that matches are added to; None for a rehearsal, whose matches are not stored.

    Attributes
    ----------
    level_db
        Present level of the test relative to the reference.

    Raises
    ------
    InvalidInputError
        The table holds matches with another reference.
    FileFormatError, StorageError
        The file is no table of matches, or cannot be read.
    """

    def __init__(self, procedure: Procedure, path: Path | None) -> None:
        self.procedure, self.path = procedure, path
        known: set[object] = set()
        if path is not None and path_exists(path):
            matches = read_matches(path)
            reference = procedure.reference_hz, procedure.reference_place, procedure.amplitude
            check_reference(path, matches, reference)
            known = {match.key for match in matches}
        self._remaining = [trial for trial in procedure.trials if self._key(trial) not in known]
        self.level_db = 0.0
        self._begin()

    @property
    def trial(self) -> Trial | None:
        """Present trial; None when all matches are made."""
        return self._remaining[0] if self._remaining else None

    @property
    def done(self) -> int:
        """Number of matches that are made."""
        return len(self.procedure) - len(self._remaining)

    @property
    def design(self) -> Design:
        """Design that is repeated now.

        Raises
        ------
        InvalidInputError
            All matches are made.
        """
        return self.procedure.design(self._current(), self.level_db)

    def step(self, by_db: float) -> bool:
        """Make the test stronger or weaker; return whether its level has changed."""
        level_db = round(min(max(self.level_db + by_db, LOWEST_DB), HIGHEST_DB), 6)
        changed = self.trial is not None and level_db != self.level_db
        if changed:
            self.level_db = level_db
        return changed

    def store(self) -> Match:
        """Store that both are equally strong now, and go on to the next trial.

        Raises
        ------
        InvalidInputError
            All matches are made, or the table holds this match already.
        FileFormatError, StorageError
            The table cannot be read or written; the same trial goes on.
        """
        trial, procedure = self._current(), self.procedure
        match = Match(
            person=procedure.person,
            frequency_hz=trial.frequency_hz,
            place=trial.place,
            direction=trial.direction,
            start_db=trial.start_db,
            matched_db=self.level_db,
            reference_hz=float(procedure.reference_hz),
            reference_place=procedure.reference_place,
            amplitude=float(procedure.amplitude),
            trial=trial.number,
            seed=procedure.seed,
        )
        if self.path is not None:
            add_match(self.path, match)
        del self._remaining[0]
        self._begin()
        return match

    def _begin(self) -> None:
        if self.trial is not None:
            self.level_db = self.trial.start_db

    def _current(self) -> Trial:
        if self.trial is None:
            raise InvalidInputError("all matches are made; nothing is left to match")
        return self.trial

    def _key(self, trial: Trial) -> object:
        return self.procedure.person, trial.frequency_hz, trial.place, trial.direction


@dataclass(frozen=True, slots=True)
class Strengths:
    """Drives at which vibrations feel as strong as the reference.

    Attributes
    ----------
    points
        Input location, frequency in Hz, and the drive in dB relative to that of the reference: the
        mean over persons of the mean over the matches of each.
    reference
        Input location and frequency of the reference, which has 0 dB.
    """

    points: tuple[tuple[int, float, float], ...]
    reference: tuple[int, float]

    @classmethod
    def of(cls, matches: Iterable[Match]) -> "Strengths":
        """Return the averages over the persons of a table.

        Raises
        ------
        InvalidInputError
            There are no matches.
        """
        by_test: dict[tuple[int, float], dict[str, list[float]]] = {}
        reference = None
        for match in matches:
            reference = match.reference_place, match.reference_hz
            by_person = by_test.setdefault((match.place, match.frequency_hz), {})
            by_person.setdefault(match.person, []).append(match.matched_db)
        if reference is None:
            raise InvalidInputError("the table holds no matches, expected at least one")
        points = tuple(
            (
                place,
                frequency_hz,
                float(np.mean([np.mean(levels_db) for levels_db in persons.values()])),
            )
            for (place, frequency_hz), persons in sorted(by_test.items())
        )
        return cls(points, reference)

    def level_db(self, frequency_hz: float, place: int) -> float:
        """Return the drive that feels as strong as the reference, relative to its drive.

        Between matched frequencies it is interpolated linearly over the logarithm of the frequency.

        Raises
        ------
        InvalidInputError
            Nothing was matched at the location, or the frequency is outside the matched range.
        """
        known = {at_hz: level for at, at_hz, level in self.points if at == place}
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
        levels_db = [known[at_hz] for at_hz in measured_hz]
        return float(np.interp(np.log(frequency_hz), np.log(measured_hz), levels_db))


__all__ = [
    "Match",
    "MatchingRun",
    "Presenter",
    "Procedure",
    "Strengths",
    "Trial",
    "add_match",
    "read_matches",
]
