"""2000 damaged files: read as their headers say, or refused with one clear sentence."""

import pytest

from tests.core.recordings.mutants import FORMATS, try_mutants

#: Of each format; together 2030.
COUNT = 290
SEED = 20261122


@pytest.mark.parametrize("file_format", FORMATS)
def test_no_mutant_takes_the_studio_down_or_is_misread(file_format, tmp_path, process):
    tally = try_mutants(file_format, COUNT, SEED, tmp_path, process)
    assert tally.wrong == []
    assert sum(tally.outcomes.values()) == COUNT
    # Of some the damage is in numbers, of some it is where it counts.
    assert tally.outcomes["read"] > 5
    assert tally.outcomes["refused"] > 20
    assert tally.outcomes["process lost"] < 20
