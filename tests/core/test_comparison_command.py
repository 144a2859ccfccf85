"""The command ``skinsource bench``, from end to end."""

import subprocess
import sys

import pytest

from skinsource.commands.command_line import main
from skinsource.errors import MissingExtraError
from skinsource.method_comparison import commands
from skinsource.method_comparison.engines import ENGINES, engine_of
from skinsource.method_comparison.measure import measure
from skinsource.method_comparison.scenes import scene_of
from skinsource.method_comparison.table import read_table


def test_a_short_run_writes_table_report_and_plot(tmp_path, monkeypatch, capsys):
    pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    monkeypatch.setattr(commands, "EVERY_SCENE", (scene_of("S1"),))
    chosen = ("this program", "direct")
    monkeypatch.setattr(commands, "EVERY_ENGINE", tuple(e for e in ENGINES if e.name in chosen))
    folder = tmp_path / "new" / "folder"
    assert main(["bench", "--quick", "--out", str(folder)]) == 0
    written = sorted(path.name for path in folder.iterdir())
    assert written == ["report.md", *(f"work_precision.{kind}" for kind in ("csv", "png", "svg"))]
    rows = read_table(folder / "work_precision.csv")
    assert {row.engine for row in rows} == set(chosen)
    assert all(row.t_min_ms > 0.0 and row.err_window > 0.0 for row in rows)
    broken = [row for row in rows if row.promise.startswith("broken")]
    assert not broken, broken
    assert "breaks its promises in 0" in capsys.readouterr().out


def test_without_matplotlib_table_and_report_are_written(tmp_path, monkeypatch, capsys):
    def refuse(rows, stem):
        raise MissingExtraError('Install it with: pip install "skinsource[bench]"')

    monkeypatch.setattr(commands, "EVERY_SCENE", (scene_of("S1"),))
    monkeypatch.setattr(commands, "EVERY_ENGINE", (engine_of("this program"),))
    monkeypatch.setattr(commands, "measure", lambda *_, **__: [])
    monkeypatch.setattr(commands, "write_plots", refuse)
    assert main(["bench", "--quick", "--out", str(tmp_path)]) == 1
    assert sorted(path.name for path in tmp_path.iterdir()) == ["report.md", "work_precision.csv"]
    assert 'pip install "skinsource[bench]"' in capsys.readouterr().err


def test_other_programs_can_read_how_far_the_work_is(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(commands, "EVERY_SCENE", (scene_of("S1"),))
    monkeypatch.setattr(commands, "EVERY_ENGINE", (engine_of("this program"),))
    monkeypatch.setattr(commands, "measure", tell_and_find_nothing)
    monkeypatch.setattr(commands, "write_plots", lambda rows, stem: None)
    assert main(["bench", "--quick", "--progress", "lines", "--out", str(tmp_path)]) == 0
    assert capsys.readouterr().out.splitlines()[:2] == ["0/2 S1 direct", "1/2 S1 this program"]


def tell_and_find_nothing(cases, effort, progress, **_):
    progress(0, 2, "S1 direct")
    progress(1, 2, "S1 this program")
    return []


def test_what_was_measured_until_it_is_stopped_stands_in_table_and_report(
    tmp_path, monkeypatch, capsys
):
    monkeypatch.setattr(commands, "EVERY_SCENE", (scene_of("S1"),))
    monkeypatch.setattr(commands, "EVERY_ENGINE", (engine_of("this program"),))
    monkeypatch.setattr(commands, "measure", measure_until(2))
    monkeypatch.setattr(commands, "write_plots", lambda *_: pytest.fail("who stops does not wait"))
    assert main(["bench", "--quick", "--out", str(tmp_path)]) == 130
    assert str(tmp_path / "report.md") in capsys.readouterr().err
    assert len(read_table(tmp_path / "work_precision.csv")) == 2
    report = (tmp_path / "report.md").read_text()
    assert "Stopped before the end:** 2 of 3 rows are there" in report
    monkeypatch.setattr(commands, "measure", measure_until(0))
    assert main(["bench", "--quick", "--out", str(tmp_path / "nothing")]) == 130
    assert list((tmp_path / "nothing").iterdir()) == []


def measure_until(n_processes):
    """Measure, and press Ctrl+C after so many processes."""

    def stopped(cases, effort, progress, keep, **_):
        left = iter(range(n_processes))

        def start(task, timeout_s):
            if next(left, None) is None:
                raise KeyboardInterrupt
            return {
                "first_s": 0.5,
                "run_s": [0.003],
                "channels": 216,
                "errors": {"peak": 1e-15, "l2": 1e-15, "window": 1e-12, "silence": 0.0},
                "ratio": 0.01,
                "bytes_above_idle": 5_000_000,
            }

        return measure(cases, effort, progress, start, keep=keep)

    return stopped


def test_a_folder_that_cannot_be_written_is_told_before_the_work(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(commands, "measure", lambda *_: pytest.fail("measured for nothing"))
    (tmp_path / "file").write_text("in the way")
    assert main(["bench", "--out", str(tmp_path / "file" / "x")]) == 1
    assert "cannot be written" in capsys.readouterr().err


def test_the_command_line_starts_without_what_only_the_benchmark_needs():
    code = (
        "import sys, skinsource.commands.command_line;"
        "print(sorted({'scipy.signal', 'matplotlib', 'PySide6'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"
