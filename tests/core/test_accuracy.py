"""The harness of error against run time: its exact values, its errors, its table."""

import csv
import io
import math
from dataclasses import replace

import numpy as np
import pytest

from skinsource.base.errors import FileFormatError, Stopped
from skinsource.limbs.catalog import load_limb
from skinsource.studies.accuracy import cases as cases_module
from skinsource.studies.accuracy.cases import (
    Actuation,
    Convolution,
    Inversion,
    Resampling,
    cases_of,
    stored_cases,
)
from skinsource.studies.accuracy.measuring import WAYS, Row, measure, table_csv, table_text
from tests.core.own_limbs.lab_bench import installed

CASES = {case.name: case for case in stored_cases()}
#: Largest error of this program, by case and else by kind of problem.
MOST = {
    Convolution: 1e-14,
    Resampling: 10.0 ** (-115 / 20),
    Actuation: 1e-13,
    Inversion: 1e-7,
    "burst at -120 dB": 1e-9,
    "offset of 1e8": 1e-6,
    "peak of 1e-310": 1e-12,
}
OWN = [way for way in WAYS if way.name.startswith("SkinSource")]
(PREDICT,) = (way for way in WAYS if way.name == "SkinSource predict")


@pytest.mark.parametrize(
    "case", [case for case in CASES.values() if case.quick], ids=lambda case: case.name
)
def test_this_program_errs_no_more_than_it_promises(case):
    rows = list(measure([case], OWN, repeats=1))
    assert {row.case for row in rows} == {case.name}
    most = MOST.get(case.name, MOST[type(case.problem)])
    assert max(row.error for row in rows) <= most


@pytest.mark.parametrize(
    ("fault", "least"),
    [
        (lambda rows: rows * (1.0 + 1e-12), 9e-13),
        (lambda rows: rows[::-1], 0.1),
        (lambda rows: np.roll(rows, 1, axis=-1), 0.1),
        (lambda rows: rows * (np.arange(len(rows)) > 0)[:, None], 1.0),
        (lambda rows: rows + np.nan, math.inf),
    ],
    ids=["scaled", "channels swapped", "a sample late", "a channel lost", "no numbers"],
)
def test_a_wrong_way_has_a_large_error(fault, least):
    def prepare(problem):
        run = PREDICT.prepare(problem)
        return lambda: fault(run())

    wrong = replace(PREDICT, prepare=prepare)
    (row,) = measure([CASES["1 input, 0.5 s"]], [wrong], repeats=1)
    assert row.error >= least


def test_errors_and_fastest_runs_are_measured_on_any_limb(user_data):
    installed()
    cases = cases_of(load_limb("lab-1"), quick=True)
    assert {case.problem.limb.axes for case in cases} == {"xz"}
    assert "1 input, 60 s" not in {case.name for case in cases}
    rows = list(measure(cases, repeats=2))
    assert len(rows) == len(cases) * sum(way.kind is Convolution for way in WAYS)
    assert all(row.time_s > 0.0 and row.runs >= 1 for row in rows)
    short = [row.error for row in rows if row.case in ("1 input, 0.5 s", "20 inputs, 2 s")]
    assert 0.0 < max(short) <= 1e-14


def test_measuring_is_told_and_can_be_stopped():
    progress = []
    cases = [case for case in CASES.values() if isinstance(case.problem, Resampling)]
    rows = measure(
        cases,
        repeats=1,
        progress=lambda *step: progress.append(step),
        stop=lambda: len(progress) > 1,
    )
    assert next(rows).way == "SkinSource resample"
    with pytest.raises(Stopped):
        list(rows)
    assert progress[0] == (0, 9, "1300 to 48000 Hz: SkinSource resample")


def test_tables_hold_every_row():
    rows = [
        Row(case="a", way="b, c", error=1.24e-16, time_s=0.1 / 3, runs=2),
        Row(case="longer", way="d", error=math.inf, time_s=1.5, runs=1),
    ]
    read = list(csv.DictReader(io.StringIO(table_csv(rows))))
    assert [(line["way"], float(line["time_s"])) for line in read] == [
        ("b, c", 0.1 / 3),
        ("d", 1.5),
    ]
    assert table_text(rows).splitlines() == [
        "| Case   | Way  |   Error | Time (ms) |",
        "| ---    | ---  |    ---: |      ---: |",
        "| a      | b, c | 1.2e-16 |      33.3 |",
        "| longer | d    |     inf |      1500 |",
    ]


def test_a_damaged_file_of_references_is_told(tmp_path, monkeypatch):
    monkeypatch.setattr(cases_module, "data_folder", lambda: tmp_path)
    (tmp_path / cases_module.FILE_NAME).write_bytes(b"PK damaged")
    with pytest.raises(FileFormatError, match="Install SkinSource studio again"):
        stored_cases()
