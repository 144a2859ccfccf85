"""The command ``skinsource bench``, from end to end."""

import csv

import pytest

from skinsource.base.errors import MissingExtraError
from skinsource.cli import bench_command
from skinsource.cli.command_line import main
from skinsource.studies.accuracy import measuring
from skinsource.studies.accuracy.cases import stored_cases

SHORT = "1300 to 48000 Hz"


@pytest.fixture(autouse=True)
def one_case(monkeypatch):
    chosen = [case for case in stored_cases() if case.name == SHORT]
    monkeypatch.setattr(bench_command, "cases_of", lambda limb, **_: chosen)


def rows_in(folder):
    with (folder / "work_precision.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_a_run_writes_table_report_and_plot(tmp_path, capsys):
    pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    folder = tmp_path / "new" / "folder"
    assert main(["bench", "--quick", "--out", str(folder)]) == 0
    written = sorted(path.name for path in folder.iterdir())
    assert written == ["report.md", *(f"work_precision.{kind}" for kind in ("csv", "png", "svg"))]
    rows = rows_in(folder)
    assert [row["way"] for row in rows] == [
        "SkinSource resample",
        "SciPy resample_poly",
        "SciPy resample",
    ]
    assert all(float(row["error"]) > 0.0 and float(row["time_s"]) > 0.0 for row in rows)
    assert "SkinSource resample" in capsys.readouterr().out
    assert "SkinSource resample" in (folder / "report.md").read_text(encoding="utf-8")
    assert SHORT in (folder / "work_precision.svg").read_text(encoding="utf-8")


def test_without_matplotlib_table_and_report_are_written(tmp_path, monkeypatch, capsys):
    def refuse(name, extra):
        raise MissingExtraError(f'Install it with: pip install "skinsource[{extra}]"')

    monkeypatch.setattr(measuring, "package_of_extra", refuse)
    assert main(["bench", "--quick", "--out", str(tmp_path)]) == 1
    assert sorted(path.name for path in tmp_path.iterdir()) == ["report.md", "work_precision.csv"]
    assert 'pip install "skinsource[bench]"' in capsys.readouterr().err


def test_other_programs_can_read_how_far_the_work_is(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(bench_command, "write_plots", lambda rows, stem: None)
    assert main(["bench", "--progress", "lines", "--out", str(tmp_path)]) == 0
    assert capsys.readouterr().out.startswith(
        f"0/3 {SHORT}: SkinSource resample\n1/3 {SHORT}: SciPy resample_poly\n"
    )


@pytest.mark.parametrize("n_rows", [0, 2])
def test_what_was_measured_until_it_is_stopped_stands_in_table_and_report(
    tmp_path, monkeypatch, capsys, n_rows
):
    whole = measuring.measure

    def stopped(*arguments, **more):
        yield from (row for _, row in zip(range(n_rows), whole(*arguments, **more), strict=False))
        raise KeyboardInterrupt

    monkeypatch.setattr(bench_command, "measure", stopped)
    monkeypatch.setattr(
        bench_command, "write_plots", lambda *_: pytest.fail("who stops does not wait")
    )
    assert main(["bench", "--quick", "--out", str(tmp_path)]) == 130
    if not n_rows:
        assert list(tmp_path.iterdir()) == []
        return
    assert str(tmp_path) in capsys.readouterr().err
    assert len(rows_in(tmp_path)) == 2
    assert "stopped before the end" in (tmp_path / "report.md").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [(["--out", "file/x"], "cannot be written"), (["--limb", "nowhere"], "nowhere")],
)
def test_what_cannot_be_done_is_told_before_the_work(
    tmp_path, monkeypatch, capsys, arguments, message
):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(
        bench_command, "measure", lambda *_, **__: pytest.fail("measured for nothing")
    )
    (tmp_path / "file").write_text("in the way")
    assert main(["bench", *arguments]) == 1
    assert message in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_it_says_what_the_range_between_people_held_where_they_are_installed(
    tmp_path, measured, monkeypatch, capsys
):
    monkeypatch.setattr(bench_command, "write_plots", lambda rows, stem: None)
    assert main(["bench", "--quick", "--out", str(tmp_path)]) == 0
    for text in (capsys.readouterr().out, (tmp_path / "report.md").read_text(encoding="utf-8")):
        assert "range between people: predicted from three" in text
        assert "| tone of 100 Hz |" in text
