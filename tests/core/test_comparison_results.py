"""Table, front, report and plot of the benchmark."""

import re
import subprocess
import sys
from dataclasses import replace

import pytest

from skinsource.errors import FileFormatError, MissingExtraError
from skinsource.extras import extra_line
from skinsource.method_comparison import plot
from skinsource.method_comparison.engines import ENGINES, engine_of
from skinsource.method_comparison.every_scene import EVERY_ENGINE
from skinsource.method_comparison.machine import Fact, facts
from skinsource.method_comparison.measure import QUICK, Case, cases_of, in_fresh_process, measure
from skinsource.method_comparison.pareto import pareto_front
from skinsource.method_comparison.report import report_of
from skinsource.method_comparison.scenes import SCENES, scene_of
from skinsource.method_comparison.table import Row, read_table, write_table
from skinsource.method_comparison.worker import Task, measured, task_of

ROW = Row(
    scene="S1",
    engine="direct",
    precision="float64",
    setting="exact",
    inputs_changed=1,
    inputs=1,
    samples=1171,
    reference="S1",
    channels=216,
    t_min_ms=1.25,
    t_median_ms=1.5,
    t_mad_ms=0.1,
    t_p95_ms=2.0,
    t_first_ms=10.0,
    runs=20,
    processes=5,
    peak_mb=12.5,
    err_max=1.2345678901234567e-16,
    err_l2=2e-16,
    err_window=3e-12,
    err_silence=0.0,
    ratio=0.01,
    promise="kept",
)
FAILED = Row(
    scene="S1",
    engine="overlap-add",
    precision="float32",
    setting="exact",
    inputs_changed=1,
    inputs=1,
    samples=1171,
    reference="S1",
    failure='would hold "9" GB, that is too much\nof it',
)
RESULT = {
    "first_s": 0.5,
    "run_s": [0.003, 0.001, 0.002],
    "channels": 216,
    "errors": {"peak": 1e-15, "l2": 1e-15, "window": 1e-12, "silence": 0.0},
    "ratio": 0.01,
    "bytes_above_idle": 5_000_000,
}


def at(t_min_ms, err_window, setting="exact"):
    return replace(ROW, t_min_ms=t_min_ms, err_window=err_window, setting=setting)


def test_the_front_holds_what_nothing_beats_in_both():
    fast, middle, exact = at(1.0, 1e-2), at(2.0, 1e-6), at(9.0, 1e-15)
    beaten = [at(2.5, 1e-6), at(10.0, 1e-14), at(1.0, 2e-2)]
    assert pareto_front([exact, *beaten, middle, FAILED, fast]) == [fast, middle, exact]


def test_what_failed_or_is_not_a_number_is_never_on_the_front():
    assert pareto_front([FAILED, at(0.1, float("nan")), at(0.1, float("inf"))]) == []
    assert pareto_front([]) == []


def test_the_table_reads_back_as_it_was(tmp_path):
    rows = [ROW, FAILED, replace(ROW, promise="broken: time in s 11, promised 10", stable=False)]
    write_table(tmp_path / "t.csv", rows)
    assert read_table(tmp_path / "t.csv") == rows


@pytest.mark.parametrize("damage", [("engine,", "motor,"), ("1.25", "soon")])
def test_a_damaged_table_is_explained(damage, tmp_path):
    path = tmp_path / "t.csv"
    write_table(path, [ROW])
    path.write_text(path.read_text().replace(*damage))
    with pytest.raises(FileFormatError, match=r"t\.csv: .*skinsource bench"):
        read_table(path)


def test_rows_put_the_processes_together():
    given = iter([RESULT, {**RESULT, "run_s": [0.0005], "first_s": 0.1}])
    case = Case(
        scene=scene_of("S1"), engine=engine_of("direct"), method=engine_of("direct").methods[0]
    )
    effort = replace(QUICK, processes=2)
    (row,) = measure([case], effort, start=lambda task, timeout_s: next(given))
    assert (row.t_min_ms, row.t_median_ms, row.t_mad_ms) == (0.5, 1.5, 0.75)
    assert (row.runs, row.processes, row.t_first_ms, row.peak_mb) == (4, 2, 100.0, 5.0)
    assert (row.promise, row.stable, row.failure) == ("kept", False, "")


def test_a_method_that_fails_stays_listed_and_is_not_tried_again():
    asked = []

    def start(task, timeout_s):
        asked.append(task.engine)
        return {"unfit": "it cannot"} if task.engine == "direct" else RESULT

    cases = cases_of([scene_of("S1")], ENGINES, quick=True)
    rows = measure(cases, replace(QUICK, processes=3), start=start)
    assert [row.engine for row in rows] == [case.engine.name for case in cases]
    failed = [row for row in rows if row.engine == "direct"]
    assert [row.failure for row in failed] == ["it cannot"] * len(failed)
    assert failed
    assert asked.count("direct") == len(failed)
    assert "S1, direct, float64, exact: it cannot" in report_of(rows, [], QUICK)


def test_rounds_run_in_different_orders():
    asked = []

    def start(task, timeout_s):
        asked.append((task.engine, task.precision, task.setting))
        return RESULT

    cases = cases_of([scene_of("S1")], ENGINES, quick=True)
    measure(cases, replace(QUICK, processes=2), start=start)
    first, second = asked[: len(cases)], asked[len(cases) :]
    assert sorted(first) == sorted(second)
    assert first != second


def test_settings_that_trade_error_for_time_promise_nothing():
    cases = [case for case in cases_of([scene_of("S1")], ENGINES) if case.method.setting.cut_db]
    rows = measure(cases, QUICK, start=lambda task, timeout_s: RESULT)
    assert {row.promise for row in rows} == {"none"}


def test_a_broken_promise_is_told_in_row_and_report():
    bad = {**RESULT, "errors": {**RESULT["errors"], "peak": 2e-14}}
    cases = cases_of([scene_of("S1")], [engine_of("this program")], quick=True)
    rows = measure(cases, QUICK, start=lambda task, timeout_s: bad)
    assert rows[0].promise == "broken: error of the peak 2e-14, promised 1e-14"
    report = report_of(rows, [], QUICK)
    assert "breaks 3 of 3 rows' promises" in report
    assert "error of the peak 2e-14, promised 1e-14" in report


def test_the_short_run_is_a_part_of_the_full_one():
    quick, full = (
        {
            (case.scene.key, case.engine.name, case.method.precision, case.method.setting.name)
            for case in cases_of(SCENES, ENGINES, quick=short)
        }
        for short in (True, False)
    )
    assert quick < full
    assert {case[1] for case in quick} == {engine.name for engine in ENGINES}


def test_engines_of_another_family_leave_the_scene_alone():
    other = replace(engine_of("direct"), family="actuator")
    assert cases_of(SCENES, [other]) == []


def task(**changes):
    given = {
        "scene": "S1",
        "engine": "this program",
        "precision": "float64",
        "setting": "map and 6 traces",
        "longest_s": 0.01,
        "most_runs": 2,
        "warm_ups": 0,
    }
    return Task(**{**given, **changes})


def test_a_task_survives_the_command_line():
    assert task_of(task().words()) == task()


def test_a_worker_measures_times_and_errors():
    result = measured(task())
    assert 1 <= len(result["run_s"]) <= 2
    assert result["channels"] == 18
    assert 0.0 < result["errors"]["peak"] < 1e-14
    assert 0.0 < result["ratio"] < 0.1


def test_a_worker_says_what_cannot_be_measured():
    assert measured(task(precision="float32")) == {"unfit": "computes in float64 only"}


def test_a_process_that_crashes_or_hangs_is_a_failed_row():
    crashed = in_fresh_process(task(engine="nonsense"), 60.0)
    assert crashed["unfit"].startswith("ended with code 1: ")
    assert in_fresh_process(task(), 0.001) == {"unfit": "took longer than 0.001 s"}


def test_a_worker_ends_with_whoever_started_it():
    code = (
        "import time; from skinsource.method_comparison.worker import end_with_parent;"
        "end_with_parent(); print('up', flush=True); time.sleep(600)"
    )
    worker = subprocess.Popen(
        [sys.executable, "-c", code], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    )
    with worker:
        assert worker.stdout.readline().strip() == b"up"
        # A pipe is closed when the process that holds it ends, whatever ends it.
        worker.stdin.close()
        assert worker.wait(timeout=30) == 1


def test_the_report_names_machine_versions_and_hashes():
    report = report_of([ROW, FAILED], facts(), QUICK)
    for words in ("processor: ", "NumPy, SciPy: ", "SHA-256 of the responses: 3735"):
        assert words in report
    assert "| **direct** | float64 | exact | 1.25 | 1.5 ± 0.1 |" in report
    assert report_of([ROW], [Fact(name="a", value="b")], QUICK).count("- a: b\n") == 1
    rows = [replace(ROW, processes=3), replace(ROW, processes=2), FAILED]
    stopped = report_of(rows, [], QUICK, n_cases=9)
    assert "3 of 9 rows are there, each from 2 fresh process(es) or more" in stopped


def test_a_ratio_to_unavoidable_rounding_is_told_of_convolutions_alone():
    rows = (replace(ROW, scene=scene, ratio=0.0123) for scene in ("S1", "A1", "R1"))
    lines = [line for line in report_of(list(rows), [], QUICK).splitlines() if "| kept |" in line]
    assert ["0.012" in line for line in lines] == [True, False, False]


def test_without_matplotlib_the_line_to_type_is_told(monkeypatch, tmp_path):
    def absent(name):
        raise ImportError(f"No module named {name!r}")

    monkeypatch.setattr(plot.importlib, "import_module", absent)
    with pytest.raises(MissingExtraError, match=re.escape(extra_line("bench"))):
        plot.write_plots([ROW], tmp_path / "p")
    assert list(tmp_path.iterdir()) == []


def test_engines_that_share_a_legend_have_a_colour_each():
    colours = plot._colours(engine.name for engine in EVERY_ENGINE)
    assert len(set(colours.values())) == len(colours) == 14


def test_the_plot_shows_every_scene_and_tells_of_failures(tmp_path):
    pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    rows = [
        ROW,
        FAILED,
        at(0.5, float("nan"), "cut -60 dB"),
        replace(ROW, scene="S5", err_window=0.0, engine="this program"),
    ]
    svg, png = plot.write_plots(rows, tmp_path / "work_precision")
    assert (svg.name, png.name) == ("work_precision.svg", "work_precision.png")
    drawing = svg.read_text(encoding="utf-8")
    for words in ("S1: 1 input × 0.5 s", "S5: 20 inputs × 600 s", "1 could not: see the report"):
        assert words in drawing
    for words in ("16 ms", "100 ms", "10 s", "1e-9 window, float64", "overlap-add"):
        assert words in drawing
    assert png.read_bytes().startswith(b"\x89PNG")
    again, _ = plot.write_plots(rows, tmp_path / "again")
    assert again.read_bytes() == svg.read_bytes()


def test_rows_are_given_as_they_come_and_all_once_before_any_again():
    seen = []
    cases = cases_of([scene_of("S1")], ENGINES, quick=True)
    measure(
        cases,
        replace(QUICK, processes=2),
        start=lambda task, timeout_s: RESULT,
        keep=lambda rows: seen.append(
            [(row.engine, row.precision, row.setting, row.processes) for row in rows]
        ),
    )
    n = len(cases)
    assert [len(rows) for rows in seen] == [*range(1, n + 1), *[n] * n]
    assert {processes for *_, processes in seen[n - 1]} == {1}
    assert {processes for *_, processes in seen[-1]} == {2}
    keys = [(case.engine.name, case.method.precision, case.method.setting.name) for case in cases]
    assert [row[:3] for row in seen[-1]] == keys
    # In their order, too, while some are still missing.
    half = [row[:3] for row in seen[n // 2]]
    assert half == [key for key in keys if key in half]
