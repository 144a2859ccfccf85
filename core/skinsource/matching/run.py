"""One person makes all matches of a procedure, today or on several days."""

from pathlib import Path

from skinsource.design import Design
from skinsource.errors import InvalidInputError
from skinsource.files import is_there
from skinsource.matching.match import Match
from skinsource.matching.match_file import add_match, check_reference, read_matches
from skinsource.matching.procedure import HIGHEST_DB, LOWEST_DB, Procedure, Trial

#: What an arrow key changes.
STEP_DB = 1.0


class MatchingRun:
    """Knows what is to be matched next; what was stored is not asked again.

    Parameters
    ----------
    procedure
        What is matched.
    path
        Table that matches are added to, and that says what was stored already; None: a rehearsal,
        of which nothing is kept.

    Attributes
    ----------
    level_db
        The test relative to the reference, now.

    Raises
    ------
    InvalidInputError
        The table holds matches with another reference.
    FileFormatError, StorageError
        It is no table of matches; it cannot be read.
    """

    def __init__(self, procedure: Procedure, path: Path | None) -> None:
        self.procedure, self.path = procedure, path
        known: set[object] = set()
        if path is not None and is_there(path):
            matches = read_matches(path)
            reference = procedure.reference_hz, procedure.reference_place, procedure.amplitude
            check_reference(path, matches, reference)
            known = {one.key for one in matches}
        self._left = [one for one in procedure.trials if self._key(one) not in known]
        self.level_db = 0.0
        self._begin()

    @property
    def trial(self) -> Trial | None:
        """What is matched now; None: all is done."""
        return self._left[0] if self._left else None

    @property
    def done(self) -> int:
        """How many matches there are already."""
        return len(self.procedure) - len(self._left)

    @property
    def design(self) -> Design:
        """What is to be played now, again and again.

        Raises
        ------
        InvalidInputError
            All is done.
        """
        return self.procedure.design(self._now(), self.level_db)

    def step(self, by_db: float) -> bool:
        """Make the test stronger or weaker; whether that could be."""
        wanted_db = round(min(max(self.level_db + by_db, LOWEST_DB), HIGHEST_DB), 6)
        changed = self.trial is not None and wanted_db != self.level_db
        if changed:
            self.level_db = wanted_db
        return changed

    def store(self) -> Match:
        """Keep that both are as strong now, and go on to the next.

        Raises
        ------
        InvalidInputError
            All is done, or the match is in the table already.
        FileFormatError, StorageError
            The table cannot be read or written; the same trial goes on.
        """
        trial, procedure = self._now(), self.procedure
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
        del self._left[0]
        self._begin()
        return match

    def _begin(self) -> None:
        if self.trial is not None:
            self.level_db = self.trial.start_db

    def _now(self) -> Trial:
        if self.trial is None:
            raise InvalidInputError("all matches are made; nothing is left to match")
        return self.trial

    def _key(self, trial: Trial) -> object:
        return self.procedure.person, trial.frequency_hz, trial.place, trial.direction
