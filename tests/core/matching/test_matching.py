"""Matches: what is asked in which order, what is stored, and what follows from it."""

import csv
import subprocess
import sys
from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import FileFormatError, InvalidInputError
from skinsource.lab import matching

ANNA = matching.Procedure(person="Anna", frequencies_hz=(50.0, 250.0), places=(3, 7), seed=4)

ADDING = """
import sys
from pathlib import Path
from skinsource.lab.matching import MatchingRun, Procedure
frequencies_hz = tuple(float(hz) for hz in range(50, 100))
procedure = Procedure(person=sys.argv[2], frequencies_hz=frequencies_hz, places=(3,))
run = MatchingRun(procedure, Path(sys.argv[1]))
print("ready", flush=True)
sys.stdin.readline()
while run.trial is not None:
    run.store()
"""


@pytest.fixture
def path(tmp_path):
    """A name for a table of matches."""
    return tmp_path / "matches.csv"


def store_all(procedure, path, level_db=3.0):
    run = matching.MatchingRun(procedure, path)
    while run.trial is not None:
        run.step(level_db - run.level_db)
        run.store()
    return run


def rows_of(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def test_each_test_is_met_once_from_below_and_once_from_above():
    counts = Counter((trial.frequency_hz, trial.place, trial.direction) for trial in ANNA.trials)
    assert len(counts) == len(ANNA) == 8
    assert set(counts.values()) == {1}
    assert [trial.number for trial in ANNA.trials] == list(range(1, 9))
    for trial in ANNA.trials:
        assert 6.0 <= abs(trial.start_db) <= 12.0
        assert (trial.start_db < 0.0) == (trial.direction == "ascending")


def test_order_and_starts_follow_from_seed_and_name():
    assert ANNA.trials == replace(ANNA).trials
    assert ANNA.trials != replace(ANNA, seed=5).trials
    assert ANNA.trials != replace(ANNA, person="Ben").trials
    assert len({trial.start_db for trial in ANNA.trials}) > 4


def test_reference_and_test_follow_each_other_and_come_again():
    trial = next(trial for trial in ANNA.trials if trial.place == 3 and trial.frequency_hz == 250.0)
    design = replace(ANNA, amplitude=2.0).design(trial, 6.0)
    reference, test = design.inputs
    assert (reference.location, test.location) == (7, 3)
    assert reference.amplitude == 2.0
    assert test.amplitude == pytest.approx(2.0 * 10 ** (6 / 20))
    assert test.clips[0].onset_s == pytest.approx(1.2)
    assert test.clips[0].waveform == ss.waveforms.Tone(frequency_hz=250.0, duration_s=0.8)
    assert design.loop_s == pytest.approx((0.0, 2.4))
    played = ss.stimulus_of(design)
    places = [channel.place for channel in played.channels]
    channels = dict(zip(places, played.samples, strict=True))
    assert np.abs(channels[7]).max() == pytest.approx(2.0, rel=0.01)
    assert not channels[3][: round(1.2 * 1300)].any()


def test_arrows_go_by_a_decibel_and_stay_within_what_can_be():
    run = matching.MatchingRun(ANNA, None)
    start_db = run.level_db
    assert run.step(1.0)
    assert run.level_db == pytest.approx(start_db + 1.0)
    assert run.step(-1.0)
    assert run.step(100.0)
    assert run.level_db == matching.HIGHEST_DB
    assert not run.step(1.0)
    assert run.step(-200.0)
    assert run.level_db == matching.LOWEST_DB


def test_what_is_stored_is_a_row_and_is_not_asked_again(path):
    run = matching.MatchingRun(ANNA, path)
    first = run.trial
    run.step(2.0)
    run.store()
    (row,) = rows_of(path)
    assert (row["person"], float(row["frequency_hz"])) == ("Anna", first.frequency_hz)
    assert (int(row["place"]), row["direction"]) == (first.place, first.direction)
    assert float(row["matched_db"]) == pytest.approx(first.start_db + 2.0)
    assert float(row["start_db"]) == first.start_db
    again = matching.MatchingRun(ANNA, path)
    assert again.done == 1
    assert again.trial == run.trial == ANNA.trials[1]
    assert again.level_db == again.trial.start_db
    store_all(ANNA, path)
    assert matching.MatchingRun(ANNA, path).trial is None
    with pytest.raises(InvalidInputError, match="all matches are made"):
        matching.MatchingRun(ANNA, path).store()
    store_all(replace(ANNA, person="Ben"), path)
    rows = rows_of(path)
    assert len(rows) == 16
    assert len({(r["person"], r["frequency_hz"], r["place"], r["direction"]) for r in rows}) == 16


def test_a_match_is_never_stored_twice(path):
    first, other = matching.MatchingRun(ANNA, path), matching.MatchingRun(ANNA, path)
    first.store()
    before = path.read_bytes()
    with pytest.raises(InvalidInputError, match="already"):
        other.store()
    assert path.read_bytes() == before
    assert other.trial == ANNA.trials[0]


def test_two_processes_that_add_matches_at_the_same_time_lose_none(tmp_path, path):
    people = [
        subprocess.Popen(
            [sys.executable, "-c", ADDING, path, name],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
        )
        for name in ("Anna", "Ben")
    ]
    for person in people:
        assert person.stdout.readline() == b"ready\n"
    for person in people:
        person.stdin.close()
    for person in people:
        with person:
            assert person.stdout.read() == b""
        assert person.returncode == 0
    assert Counter(row.person for row in matching.read_matches(path)) == {"Anna": 100, "Ben": 100}
    assert list(tmp_path.iterdir()) == [path]


def test_another_reference_needs_another_table(path):
    run = matching.MatchingRun(ANNA, path)
    match = run.store()
    with pytest.raises(InvalidInputError, match="another reference"):
        matching.MatchingRun(replace(ANNA, reference_hz=80.0), path)
    with pytest.raises(InvalidInputError, match="another reference"):
        matching.add_match(path, replace(match, person="Ben", amplitude=0.5))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda text: "", "not a table of matches"),
        (lambda text: "a,b\n1,2\n", "not a table of matches"),
        (lambda text: text + text.splitlines()[1] + "\n", "line 10: .*is in line 2"),
        (lambda text: text.replace("Anna", "=Anna", 1), "line 2: person"),
        (lambda text: text.replace(",100.0,7,1.0,", ",100.0,7,2.0,", 1), "line 3: its reference"),
        (lambda text: text.replace(",3.0,", ",nan,", 1), "matched_db"),
        (lambda text: text.replace(",3.0,", ",1e9,", 1), "matched_db"),
        (lambda text: text.replace("ending,", "ending,x", 1), "start_db"),
        (lambda text: text.replace("scending", "scended", 1), "direction"),
        (lambda text: text[:-4] + "\n", "it has 10 values"),
        (lambda text: text + '"', "expected CSV"),
        (lambda text: "\0" + text, "not a table|expected CSV"),
    ],
)
def test_a_damaged_table_is_one_error_that_says_where(path, change, message):
    store_all(ANNA, path)
    path.write_text(change(path.read_text()))
    before = path.read_bytes()
    with pytest.raises(FileFormatError, match=message) as refused:
        matching.MatchingRun(ANNA, path)
    assert "matches.csv" in str(refused.value)
    assert path.read_bytes() == before


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"person": ""}, "person"),
        ({"person": "a\nb"}, "person"),
        ({"person": "+1"}, "person"),
        ({"frequencies_hz": ()}, "frequencies_hz"),
        ({"frequencies_hz": (50.0, 50.0)}, "each once"),
        ({"frequencies_hz": (0.0,)}, "a frequency"),
        ({"places": (0,)}, "a place"),
        ({"amplitude": 1e6}, "amplitude"),
        ({"pause_s": 0.0}, "pause_s"),
        ({"seed": -1}, "seed"),
        ({"frequencies_hz": tuple(map(float, range(20, 120))), "places": tuple(range(1, 12))},
         "at most 2000"),
    ],
)  # fmt: skip
def test_a_procedure_that_cannot_be_is_refused(changes, message):
    with pytest.raises(InvalidInputError, match=message):
        replace(ANNA, **changes)


def test_strengths_average_persons_and_lie_between_what_was_measured(path):
    store_all(ANNA, path, level_db=2.0)
    store_all(replace(ANNA, person="Ben", frequencies_hz=(50.0,)), path, level_db=8.0)
    strengths = matching.Strengths.of(matching.read_matches(path))
    assert strengths.level_db(50.0, 3) == pytest.approx(5.0)
    assert strengths.level_db(250.0, 3) == pytest.approx(2.0)
    middle_hz = np.sqrt(50.0 * 250.0)
    assert strengths.level_db(middle_hz, 3) == pytest.approx(3.5)
    # The reference is as strong as itself.
    assert strengths.level_db(100.0, 7) == 0.0
    assert 0.0 < strengths.level_db(99.0, 7) < 5.0
    with pytest.raises(InvalidInputError, match="place 5"):
        strengths.level_db(50.0, 5)
    with pytest.raises(InvalidInputError, match="50 to 250 Hz"):
        strengths.level_db(260.0, 3)
    with pytest.raises(InvalidInputError, match="no matches"):
        matching.Strengths.of(())
