"""`ss.export_set` and ``skinsource export --vary``: a file for each combination of values."""

import csv
import json
import re
from itertools import cycle

import numpy as np
import pytest
import soundfile

import skinsource as ss
from skinsource.base.errors import InvalidInputError, Stopped, StorageError
from skinsource.cli.command_line import main

VARY = {"1.frequency_hz": [50, 100], "amplitude": [0.5, 1.0], "location": [7, 12]}
LOUDEST = ss.View(axes="xyz", method="mag", span="loudest")


@pytest.fixture
def design():
    tone = ss.track(7, ss.waveforms.Tone(frequency_hz=100.0))
    return ss.Design(limb="synthetic-1", inputs=(tone,))


def table_in(folder):
    with (folder / "conditions.csv").open(newline="") as file:
        return list(csv.DictReader(file))


def content_of(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def test_each_file_is_an_export_of_its_design_and_name_and_row_say_the_values(design, tmp_path):
    folder, options = tmp_path / "set", ss.StimulusOptions(lead_in_s=0.1)
    exported = ss.export_set(design, VARY, folder, rate_hz=8000, options=options)
    written = content_of(folder)
    for condition in exported.written:
        path = tmp_path / condition.name
        ss.export_stimulus(condition.design, path, rate_hz=8000, options=exported.options)
        for each in (path, path.with_name(f"{path.name}.json")):
            assert written.pop(each.name) == each.read_bytes()
    assert list(written) == ["conditions.csv"]
    rows = table_in(folder)
    peaks = [np.abs(soundfile.read(folder / row["file"])[0]).max() for row in rows]
    drives = [float(row["peak_m_per_s2"]) for row in rows]
    np.testing.assert_allclose(peaks, np.divide(drives, max(drives)), rtol=1e-6)
    assert rows[1]["file"] == "002_track1-frequency-50Hz_amplitude-0p5_location-12.wav"
    assert list(rows[1])[1:4] == ["1.frequency_hz", "amplitude_m_per_s2", "location"]
    assert list(rows[1].values())[1:4] == ["50", "0.5", "12"]
    names = {row["file"] for row in rows if re.fullmatch(r"[A-Za-z0-9_-]+\.wav", row["file"])}
    assert len(names) == 8


@pytest.mark.parametrize("level_db", [None, -3.0, [-6.0, 0.0]])
def test_all_files_have_the_same_level_at_the_matched_output_or_each_of_several(
    design, tmp_path, level_db
):
    def level_of(design):
        return ss.evaluate(design, "output_levels_db", view=LOUDEST)["output_levels_db"][28]

    vary, several = {"1.frequency_hz": [50, 100], "location": [7, 12]}, isinstance(level_db, list)
    exported = ss.export_set(design, vary, tmp_path / "s", match_output=29, level_db=level_db)
    targets_db = level_db if several else [level_of(design) if level_db is None else level_db]
    rows = table_in(tmp_path / "s")
    assert len(rows) == 4 * len(targets_db)
    for condition, row, target in zip(exported.written, rows, cycle(targets_db), strict=False):
        target_db = pytest.approx(target)
        assert level_of(condition.design) == target_db == float(row["level_at_output_29_db"])
        assert row.get("level_db") == (f"{target:g}" if several else None)
        amplitude = 10 ** (float(row["gain_db"]) / 20)
        assert condition.design.inputs[0].amplitude == pytest.approx(amplitude)
    assert exported.written[0].name.endswith("_level-minus6dB.wav") == several


def test_what_is_not_possible_is_left_out_and_the_rest_is_written(design, tmp_path):
    options = ss.StimulusOptions(full_scale=1.5)
    vary = {"amplitude": [0, 0.5, 1, 2], "frequency_hz": [100, 700]}
    exported = ss.export_set(design, vary, tmp_path / "set", options=options)
    assert {number for number in exported.refused if number % 2} == {7}
    assert "beyond full scale" in exported.refused[7]
    assert "frequency_hz is 700" in exported.refused[2]
    assert [row["amplitude_m_per_s2"] for row in table_in(tmp_path / "set")] == ["0", "0.5", "1"]
    muted = {"muted": [True, False]}
    matched = ss.export_set(design, muted, tmp_path / "matched", match_output=29)
    assert "silent at output 29" in matched.refused[1]
    confirmed = ss.export_set(design, vary, tmp_path / "all", options=options, confirmed=True)
    assert 7 not in confirmed.refused


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        ({"vary": {"frequency": [1]}}, "perhaps 'frequency_hz'"),
        ({"level_db": 0.0}, "needs an output"),
        ({"match_output": 73, "vary": {}}, "from 1 to 72"),
        ({"match_output": 1, "options": ss.StimulusOptions(to_s=0.1)}, "whole designs"),
        ({"match_output": 1}, "Remove the amplitude, or match no levels"),
        ({"match_output": 1, "vary": {"1.gain": [1, 2]}}, "Remove the gain"),
        ({"match_output": 1, "vary": {}, "level_db": []}, "level_db has no values"),
        ({"match_output": 1, "vary": {}, "level_db": range(1001)}, "1001 files"),
        ({"vary": {"amplitude": range(1001)}}, "1001 files"),
        ({"vary": {"amplitude": [-5000]}}, "all conditions are refused"),
    ],
)
def test_a_set_that_is_not_possible_is_refused_before_anything_is_written(
    design, tmp_path, arguments, reason
):
    with pytest.raises(InvalidInputError, match=reason):
        ss.export_set(design, folder=tmp_path / "set", **{"vary": VARY, **arguments})
    assert list(tmp_path.iterdir()) == []


def test_a_stopped_set_leaves_nothing_and_an_older_folder_stays(design, tmp_path):
    folder, seen = tmp_path / "set", [""]
    told = {"progress": lambda *now: seen.append(now[2]), "stop": lambda: "003" in seen[-1]}
    with pytest.raises(Stopped):
        ss.export_set(design, VARY, folder, **told)
    assert list(tmp_path.iterdir()) == []
    folder.mkdir()
    (folder / "answers.csv").write_text("mine")
    with pytest.raises(StorageError, match="is not replaced"):
        ss.export_set(design, VARY, folder)
    assert content_of(folder) == {"answers.csv": b"mine"}


def test_the_command_writes_what_the_function_writes(design, tmp_path, capsys):
    ss.save_design(tmp_path / "a.skinsource", design)
    out = tmp_path / "set"
    call = ["export", str(tmp_path / "a.skinsource"), "--out", str(out), "--format", "flac"]
    call += ["--vary", "1.frequency_hz = [50, 700]", "--vary", "location = [7, 12]"]
    assert main([*call, "--match-output", "29", "--level-db", "-2", "--equalise", "none"]) == 1
    printed = capsys.readouterr()
    assert "condition 3 left out: " in printed.err
    assert f"{out / 'conditions.csv'}\n  2 stimuli in a new folder, 2 left out; " in printed.out
    vary = {"1.frequency_hz": [50], "location": [7, 12]}
    ss.export_set(design, vary, tmp_path / "own", "flac", match_output=29, level_db=-2.0)
    assert content_of(out) == content_of(tmp_path / "own")
    capsys.readouterr()
    assert main([*call[:4], "--vary", "location = 7, 12"]) == 1
    assert "not TOML" in capsys.readouterr().err


def test_a_set_says_which_tracks_become_alike(design):
    second = ss.track(9, ss.waveforms.Tone(frequency_hz=100.0), amplitude=2.0)
    unlike = ss.Design(limb="synthetic-1", inputs=(*design.inputs, second))
    vary = {"amplitude": [1], "2.amplitude": [1], "frequency_hz": [50], "location": [(7, 12)]}
    summary = ss.export_set(unlike, vary, None).summary
    assert re.findall(r"\. (\w+) becomes the same", summary) == ["Amplitude"]


def test_a_set_names_the_files_that_the_equaliser_weakens(tmp_path, capsys):
    coil = ss.ActuatorAt(actuator="x", model=ss.actuators.load("kastor-2023-air"))
    inverse = ss.equalising.RegularisedInverse()
    gabor = ss.track(7, ss.waveforms.Gabor(frequency_hz=200.0, cycles=8.0))
    chosen = ss.Actuation(actuators=(coil,), equaliser=inverse, on=False)
    ss.save_design(
        tmp_path / "a.skinsource", ss.Design(limb="synthetic-1", inputs=(gabor,), actuation=chosen)
    )
    folder = tmp_path / "set"
    call = ["export", str(tmp_path / "a.skinsource"), "--out", str(folder)]
    assert main([*call, "--vary", "frequency_hz = [50, 200]", "--match-output", "29"]) == 0
    first, second = (folder / row["file"] for row in table_in(folder))
    loses = json.loads(first.with_name(f"{first.name}.json").read_text(encoding="utf-8"))["loses"]
    assert "loses most at place 7, at 50 Hz" in loses
    said = capsys.readouterr().out
    assert f"{first.name}: {loses}" in said
    assert f"{second.name}: " not in said
