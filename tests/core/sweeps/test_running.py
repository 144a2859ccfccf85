"""Sweeps that are stopped, killed, damaged and run again: no row is lost, none is doubled."""

import csv
import json
import math
import os
import signal
import subprocess
import sys
import time
from contextlib import closing
from dataclasses import replace

import numpy as np
import pytest
import soundfile

import skinsource as ss
from skinsource.base.errors import InvalidInputError, Stopped, StorageError
from skinsource.base.job import never, silent
from skinsource.base.lock import Lock, read_owner
from skinsource.cli.command_line import main
from skinsource.studies.sweeps.plan import Order, Plan
from skinsource.studies.sweeps.running import Sweep, run
from skinsource.studies.sweeps.table import JOURNAL, Journal, StimulusFiles

TONE = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.05)
DESIGN = ss.Design(limb="synthetic-1", inputs=(ss.track(7, TONE),))
FREQUENCIES = (50.0, 80.0, 120.0, 200.0, 300.0, 420.0)


def rows_of(table):
    """Rows without errors, with NaN that equal each other."""
    return [tuple("nan" if value != value else value for value in row) for row in table.rows]


def csv_rows(folder):
    with (folder / "stimuli.csv").open() as file:
        return list(csv.DictReader(file))


def sweep(out, progress=silent, stop=never):
    vary = {"frequency_hz": FREQUENCIES}
    return ss.sweep(DESIGN, vary, out=out, progress=progress, stop=stop)


def test_a_varied_duration_and_that_of_the_stimulus_are_columns_of_their_own(tmp_path):
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(7, TONE, onset_s=0.1),))
    table = ss.sweep(design, {"duration_s": (0.05, 0.1)}, out=tmp_path)
    assert len(set(table.columns)) == len(table.columns)
    assert table.column("duration_s").tolist() == [0.05, 0.1]
    assert table.column("stimulus_duration_s") == pytest.approx([0.15, 0.2])
    assert [float(row["stimulus_duration_s"]) for row in csv_rows(tmp_path)] == [0.15, 0.2]


def test_the_table_has_a_row_for_each_stimulus(tmp_path):
    table = ss.sweep(DESIGN, {"frequency_hz": FREQUENCIES}, out=tmp_path, outputs=(19,))
    assert table.column("stimulus").tolist() == [1, 2, 3, 4, 5, 6]
    assert table.column("frequency_hz").tolist() == list(FREQUENCIES)
    written = csv_rows(tmp_path)
    assert [tuple(row) for row in written] == [table.columns] * 6
    assert [float(row["output_19_rms"]) for row in written] == table.column(
        "output_19_rms"
    ).tolist()


def test_titles_are_no_formulas_of_a_spreadsheet(tmp_path):
    titles = ("=1+1", "plain")
    ss.sweep([replace(DESIGN, title=title) for title in titles], out=tmp_path, processes=1)
    assert [row["design"] for row in csv_rows(tmp_path)] == ["'=1+1", "plain"]


def test_a_bad_row_is_reported_and_the_rest_is_measured(tmp_path):
    table = ss.sweep(DESIGN, {"frequency_hz": (50.0, 700.0, 80.0)}, out=tmp_path)
    assert list(table.failed) == [2]
    assert "650 Hz" in table.failed[2]
    assert math.isnan(table.column("rms")[1])
    assert (table.column("rms")[[0, 2]] > 0.0).all()
    assert [row["error"] != "" for row in csv_rows(tmp_path)] == [False, True, False]


def test_stopped_it_goes_on_where_it_ended(tmp_path):
    progress = []
    with pytest.raises(Stopped):
        sweep(tmp_path, lambda done, *_: progress.append(done), lambda: progress[-1:] == [3])
    assert not (tmp_path / "stimuli.csv").exists()
    begun = []
    table = sweep(tmp_path, lambda done, *_: begun.append(done))
    assert begun[0] == 3
    assert rows_of(table) == rows_of(sweep(None))


def test_a_damaged_byte_costs_the_journal_no_line_but_its_own(tmp_path):
    path = tmp_path / JOURNAL
    rows = {1: {"rms": 1.5}, 2: "too loud", 3: {"rms": 3.0}, 4: {"rms": 4.0}}
    with closing(Journal(path, "a" * 64)) as journal:
        for number, row in rows.items():
            journal.add(number, row)
    content = path.read_bytes()
    ends = [k for k, byte in enumerate(content) if byte == ord("\n")]
    for at in range(len(content)):
        damaged = bytearray(content)
        damaged[at] ^= 2
        path.write_bytes(damaged)
        with closing(Journal(path, "a" * 64)) as journal:
            left = dict(journal.rows)
        # The first line names the sweep; the end of a line is also the beginning of the next.
        line = sum(end < at for end in ends)
        lost = {line, line + 1} if at in ends[1:] else {line}
        assert left.items() <= rows.items()
        assert rows.keys() - left.keys() <= lost - {0}
        written = path.read_bytes()
        assert written == damaged[: len(written)]
        assert len(written) >= ends[-2] + 1


def test_what_is_no_journal_is_renamed_and_never_changed(tmp_path):
    foreign = [b"my notes", b"first line\nsecond line\n", bytes(1000)]
    for content in foreign:
        (tmp_path / JOURNAL).write_bytes(content)
        ss.sweep(DESIGN, {"frequency_hz": (50.0,)}, out=tmp_path)
    renamed = [tmp_path / f"measured set aside {number}.jsonl" for number in (1, 2, 3)]
    assert [path.read_bytes() for path in renamed] == foreign


def test_a_folder_of_another_sweep_is_refused(tmp_path):
    ss.sweep(DESIGN, {"frequency_hz": (50.0,)}, out=tmp_path)
    before = (tmp_path / JOURNAL).read_bytes()
    with pytest.raises(InvalidInputError, match="another sweep"):
        ss.sweep(DESIGN, {"frequency_hz": (60.0,)}, out=tmp_path)
    assert (tmp_path / JOURNAL).read_bytes() == before


def test_two_sweeps_do_not_write_to_one_folder(tmp_path):
    code = (
        "import sys; from skinsource.base.lock import Lock, read_owner; from pathlib import Path\n"
        f"Lock(Path({str(tmp_path / JOURNAL)!r})).take(); print('taken', flush=True)\n"
        "sys.stdin.read()"
    )
    with subprocess.Popen(
        [sys.executable, "-c", code], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as other:
        assert other.stdout.readline() == b"taken\n"
        with pytest.raises(StorageError, match="another process"):
            ss.sweep(DESIGN, out=tmp_path)
        other.stdin.close()
    assert len(ss.sweep(DESIGN, out=tmp_path)) == 1
    assert read_owner(Lock(tmp_path / JOURNAL).path) is None


def test_a_stimulus_that_ends_its_process_costs_only_its_own_row(tmp_path, monkeypatch):
    (tmp_path / "sitecustomize.py").write_text(
        "import os, sys\n"
        "if '--process-name' in sys.orig_argv:\n"
        "    from skinsource.studies.sweeps.measuring import Measurer\n"
        "    measure = Measurer.measure\n"
        "    def ending(self, number, *rest):\n"
        "        return os._exit(1) if number == 7 else measure(self, number, *rest)\n"
        "    Measurer.measure = ending\n"
    )
    before = os.environ.get("PYTHONPATH", "")
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(tmp_path), *sys.path, before]))
    plan = Plan(designs=(("one", DESIGN),), variables=(("frequency_hz", tuple(range(50, 90))),))
    table = run(Sweep(plan=plan), None, processes=2)
    assert set(table.failed) == {7}
    assert all("ended, twice" in reason for reason in table.failed.values())
    expected = rows_of(run(Sweep(plan=plan), None, processes=1))
    measured_again = [row for row in rows_of(table) if row[0] not in table.failed]
    assert measured_again == [row for row in expected if row[0] not in table.failed]


def test_a_script_without_a_main_guard_runs_once(tmp_path):
    script = tmp_path / "script.py"
    script.write_text(
        "print('runs')\n"
        "import skinsource as ss\n"
        "tone = ss.waveforms.Tone(duration_s=0.05)\n"
        "design = ss.Design(limb='synthetic-1', inputs=(ss.track(7, tone),))\n"
        "table = ss.sweep(design, {'frequency_hz': [50.0, 60.0, 70.0]}, processes=2)\n"
        "print(len(table), table.failed)\n"
    )
    # It lies where a module of the same name as one of the library's would be found.
    (tmp_path / "queue.py").write_text("raise SystemExit('a module of the current folder')\n")
    command = [sys.executable, "-P", str(script)]
    done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, check=True)
    assert done.stdout.split("\n") == ["runs", "3 {}", ""]
    assert done.stderr == ""


@pytest.mark.skipif(os.name == "nt", reason="there is no such signal on Windows")
def test_an_interrupted_and_a_killed_sweep_lose_nothing_and_double_nothing(tmp_path):
    """Ended twice, the sweep still ends with the table of one that never was."""
    import psutil

    ss.save_design(tmp_path / "d.skinsource", DESIGN)
    frequencies = [50 + k / 4 for k in range(1500)]
    (tmp_path / "s.toml").write_text(
        f'designs = ["d.skinsource"]\n[vary]\nfrequency_hz = {frequencies}\n'
    )
    out = tmp_path / "out"
    arguments = ["sweep", str(tmp_path / "s.toml"), "--out", str(out), "--processes"]
    before = 0
    for number, processes in ((signal.SIGINT, "2"), (signal.SIGKILL, "1")):
        process = subprocess.Popen(
            [sys.executable, "-m", "skinsource", *arguments, processes],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            start_new_session=True,
        )
        while process.poll() is None and _size(out / JOURNAL) < before + 3000:
            time.sleep(0.002)
        children = psutil.Process(process.pid).children(recursive=True)
        os.killpg(process.pid, number)
        _, messages = process.communicate()
        assert process.returncode == {signal.SIGINT: 130, signal.SIGKILL: -9}[number]
        assert b"Traceback" not in messages
        assert not psutil.wait_procs(children, timeout=30)[1]
        assert _size(out / JOURNAL) > before
        before = _size(out / JOURNAL)
    assert main([*arguments, "1"]) == 0
    rows = csv_rows(out)
    assert [int(row["stimulus"]) for row in rows] == list(range(1, 1501))
    whole = ss.sweep(DESIGN, {"frequency_hz": frequencies}, processes=1)
    assert [float(row["rms"]) for row in rows] == whole.column("rms").tolist()


def _size(path):
    return path.stat().st_size if path.exists() else 0


def test_trials_leave_out_what_could_not_be_measured(tmp_path):
    ss.sweep(
        DESIGN,
        {"frequency_hz": (50.0, 700.0, 80.0)},
        out=tmp_path,
        order=Order(kind="random", participants=2, seed=1),
    )
    with (tmp_path / "trials.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 4
    assert {row["stimulus"] for row in rows} == {"1", "3"}


def test_parquet_holds_the_same_table(tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet", reason="the extra parquet is not installed")
    table = ss.sweep(DESIGN, {"frequency_hz": (50.0, 700.0)}, out=tmp_path, parquet=True)
    columns = parquet.read_table(tmp_path / "stimuli.parquet").to_pydict()
    assert tuple(columns) == table.columns
    np.testing.assert_array_equal(columns["rms"], table.column("rms"))
    assert columns["error"][0] == ""


@pytest.mark.parametrize(
    ("vary", "message"),
    [
        ({"frequency_hz": 50.0}, "a list"),
        ({"frequency_hz": [None]}, "numbers or texts"),
        ({"frequency_hz": [50.0, np.nan]}, "'frequency_hz' holds nan, expected finite numbers"),
        ({"amplitude": [-np.inf]}, "holds -inf, expected finite"),
    ],
)
def test_what_is_no_value_is_refused_before_anything_is_measured(vary, message):
    with pytest.raises(InvalidInputError, match=message):
        ss.sweep(DESIGN, vary)


PAIR = ss.Design(limb="synthetic-1", inputs=(ss.track(7, TONE), ss.track(3, TONE)))
AMPLITUDES = (0.5, 2.0, -1.0)


def test_the_largest_drive_of_all_is_full_scale_in_every_file(tmp_path):
    ss.sweep(PAIR, {"1.amplitude": AMPLITUDES}, out=tmp_path, files=StimulusFiles())
    names = sorted(file.name for file in (tmp_path / "stimuli").iterdir())
    assert names == [f"{k}.wav{end}" for k in (1, 2, 3) for end in ("", ".json")]
    stimuli = [soundfile.read(tmp_path / "stimuli" / f"{k}.wav")[0].T for k in (1, 2, 3)]
    assert max(np.abs(stimulus).max() for stimulus in stimuli) == pytest.approx(1.0, abs=1e-6)
    for amplitude, channels in zip(AMPLITUDES, stimuli, strict=True):
        np.testing.assert_allclose(channels[0], amplitude * channels[1], atol=1e-6)
        np.testing.assert_allclose(channels[1], stimuli[0][1], atol=1e-7)
    scales = {
        json.loads((tmp_path / "stimuli" / f"{k}.wav.json").read_text())["full_scale"]
        for k in (1, 2, 3)
    }
    assert len(scales) == 1


def test_stopped_the_export_goes_on_with_what_is_missing(tmp_path):
    progress = []
    vary = {"1.amplitude": AMPLITUDES}
    with pytest.raises(Stopped):
        ss.sweep(
            PAIR,
            vary,
            out=tmp_path,
            files=StimulusFiles(),
            progress=lambda done, total, text: progress.append(text),
            stop=lambda: progress[-1:] == ["Exporting 2.wav"],
        )
    first = tmp_path / "stimuli" / "1.wav"
    before = first.stat().st_mtime_ns
    assert not (tmp_path / "stimuli" / "2.wav").exists()
    ss.sweep(PAIR, vary, out=tmp_path, files=StimulusFiles())
    assert first.stat().st_mtime_ns == before
    assert (tmp_path / "stimuli" / "3.wav").exists()


def test_asked_for_at_another_rate_no_file_of_the_old_one_stays(tmp_path):
    vary = {"1.amplitude": AMPLITUDES}
    for rate_hz in (8000, 4000):
        ss.sweep(PAIR, vary, out=tmp_path, files=StimulusFiles(rate_hz=rate_hz))
        files = sorted((tmp_path / "stimuli").glob("*.wav"))
        assert [soundfile.info(file).samplerate for file in files] == [rate_hz] * 3
    before = [file.stat().st_mtime_ns for file in files]
    ss.sweep(PAIR, vary, out=tmp_path, files=StimulusFiles(rate_hz=4000))
    assert [file.stat().st_mtime_ns for file in files] == before


def test_files_of_a_chip_with_its_own_rate_stay(tmp_path):
    vary, files = {"1.amplitude": AMPLITUDES[:1]}, StimulusFiles(format="drv2605l")
    ss.sweep(PAIR, vary, out=tmp_path, files=files)
    before = (tmp_path / "stimuli" / "1.h").stat().st_mtime_ns
    ss.sweep(PAIR, vary, out=tmp_path, files=files)
    assert (tmp_path / "stimuli" / "1.h").stat().st_mtime_ns == before
