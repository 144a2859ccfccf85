"""Actuators and resamplers in the benchmark: what is exact, what is not, and what fails."""

import numpy as np
import pytest

from skinsource.errors import FileFormatError
from skinsource.method_comparison import signal_scenes
from skinsource.method_comparison.every_scene import EVERY_ENGINE, EVERY_SCENE, any_scene, is_ours
from skinsource.method_comparison.measure import FULL, QUICK, cases_of, measure
from skinsource.method_comparison.report import report_of
from skinsource.method_comparison.signal_engines import SIGNAL_ENGINES, signal_engine_of
from skinsource.method_comparison.signal_scenes import SIGNAL_SCENES, burst
from skinsource.method_comparison.signal_worker import measured_signal, signal_errors
from skinsource.method_comparison.worker import Task, measured

# What adaptive solvers need seconds for is left to the benchmark itself.
QUICKLY = {"longest_s": 0.001, "most_runs": 1, "warm_ups": 0}


def peak_error(key, engine, setting):
    found = measured_signal(any_scene(key), engine, setting, **QUICKLY)
    return found.get("unfit") or found["errors"]["peak"]


def own_setting(family):
    return signal_engine_of("this program", family).methods[0].setting.name


@pytest.mark.parametrize("key", [scene.key for scene in SIGNAL_SCENES])
def test_this_program_keeps_its_promise(key):
    scene = any_scene(key)
    found = peak_error(key, "this program", own_setting(scene.family))
    assert found <= scene.allowed_error
    if scene.family == "actuator":
        assert found < 1e-13


@pytest.mark.parametrize(
    ("key", "engine", "setting", "least", "most"),
    [
        ("A1", "forward Euler", "16 substeps", 1e-3, 1.0),
        ("A1", "forward Euler", "256 substeps", 1e-4, 0.1),
        ("A1", "bilinear", "1 substep", 1e-2, 3.0),
        ("A1", "scipy.signal.lsim", "held", 0.0, 1e-12),
        ("A1", "RK45", "rtol 1e-06", 1e-9, 1e-2),
        ("A1", "Radau", "rtol 1e-06", 1e-13, 1e-4),
        ("R1", "linear", "between neighbours", 1e-2, 1.0),
        ("R1", "resample_poly", "default", 1e-5, 0.1),
        ("R1", "resample_poly", "80 dB", 1e-6, 1e-3),
        ("R1", "resample_poly", "140 dB", 0.0, 1e-6),
        ("R1", "scipy.signal.resample", "whole signal", 0.0, 1e-12),
        ("R2", "linear", "between neighbours", 1e-5, 1e-2),
    ],
)
def test_others_err_as_their_method_does(key, engine, setting, least, most):
    assert least <= peak_error(key, engine, setting) <= most


def test_what_diverges_is_a_row_that_says_so():
    assert peak_error("A1", "forward Euler", "1 substep") == "diverged"
    assert peak_error("A3", "forward Euler", "256 substeps") == "diverged"


def test_every_engine_is_measured_on_every_scene_of_its_family():
    cases = cases_of(EVERY_SCENE, EVERY_ENGINE)
    pairs = {(case.scene.key, case.engine.name) for case in cases}
    for scene in SIGNAL_SCENES:
        own = {one.name for one in SIGNAL_ENGINES if one.family == scene.family}
        assert {name for key, name in pairs if key == scene.key} == own
    assert {"A1", "R1"} <= {
        case.scene.key for case in cases_of(EVERY_SCENE, EVERY_ENGINE, quick=True)
    }


def test_rows_failed_ones_too_are_in_table_and_report():
    scenes = [any_scene("A1"), any_scene("R1")]
    chosen = [one for one in SIGNAL_ENGINES if one.name not in ("RK45", "Radau")]
    cases = cases_of(scenes, chosen)
    started = []

    def here(task: Task, _):
        started.append((task.scene, task.engine, task.setting))
        return measured(task)

    rows = measure(cases, FULL, start=here)
    # Once each, also in a full run.
    assert len(started) == len(cases)
    assert len(rows) == len(cases)
    ours = [row for row in rows if is_ours(row.engine)]
    assert [row.promise for row in ours] == ["kept", "kept"]
    failed = [row for row in rows if row.failure]
    assert [(row.engine, row.failure) for row in failed] == [("forward Euler", "diverged")]
    assert all(row.promise == "none" for row in rows if not is_ours(row.engine))
    report = report_of(rows, (), QUICK)
    assert "A1: resonant actuator" in report
    assert "forward Euler, float64, 1 substep: diverged" in report


def test_the_signal_is_band_limited_and_begins_and_ends_in_silence():
    signal = burst(48_000)
    spectrum = np.abs(np.fft.rfft(signal))
    assert spectrum[601:].max() < 1e-12 * spectrum.max()
    assert np.abs(signal[[0, -1]]).max() < 1e-14


def test_errors_are_those_of_the_worst_row_and_window():
    exact = np.zeros((2, 260))
    exact[0], exact[1, :130], exact[1, 130:] = 1.0, 10.0, 0.1
    values = exact.copy()
    values[1, 200] += 0.01
    found = signal_errors(values, exact, 1300.0)
    assert found.peak == pytest.approx(1e-3)
    assert found.window == pytest.approx(0.1)
    silent = signal_errors(np.zeros((1, 10)), np.ones((1, 10)), 1300.0)
    assert silent.peak == 1.0


def test_a_missing_reference_is_told(tmp_path, monkeypatch):
    monkeypatch.setattr(signal_scenes, "data_folder", lambda: tmp_path)
    with pytest.raises(FileFormatError, match="A1"):
        any_scene("A1").exact()


def test_names_tell_scenes_and_engines_apart():
    keys = [scene.key for scene in EVERY_SCENE]
    assert len(set(keys)) == len(keys)
    pairs = [(one.name, one.family) for one in SIGNAL_ENGINES]
    assert len(set(pairs)) == len(pairs)
