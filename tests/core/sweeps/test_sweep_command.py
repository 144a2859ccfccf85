"""``skinsource sweep`` and the files it reads."""

import pytest

import skinsource as ss
from skinsource.base.errors import FileFormatError
from skinsource.cli.command_line import main
from skinsource.studies.sweeps.plan import Order
from skinsource.studies.sweeps.running import read_sweep

TONE = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.05)


@pytest.fixture
def folder(tmp_path):
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(7, TONE), ss.track(3, TONE)))
    ss.save_design(tmp_path / "two.skinsource", design)
    return tmp_path


def written(folder, text):
    path = folder / "sweep.toml"
    path.write_text(text)
    return path


def test_a_file_says_all_that_a_sweep_does(folder):
    path = written(
        folder,
        """
        designs = ["two.skinsource"]
        outputs = [19, 21]
        axes = "z"
        method = "mag"
        level_db = -3
        people = true
        [vary]
        frequency_hz = [50, 80.5]
        2.amplitude = [1, 2]
        location = [[1, 2], [3, 4]]
        [trials]
        order = "counterbalanced"
        participants = 4
        blocks = 2
        seed = 9
        [stimuli]
        format = "wav"
        rate_hz = 48000
        """,
    )
    table = read_sweep(path)
    assert len(table.plan) == 8
    assert table.plan.names == ("frequency_hz", "2.amplitude", "location")
    assert table.plan.outputs == (19, 21)
    assert (table.plan.axes, table.plan.method, table.plan.level_db) == ("z", "mag", -3.0)
    assert table.plan.people
    assert table.order == Order(kind="counterbalanced", seed=9, participants=4, blocks=2)
    assert (table.files.format, table.files.rate_hz) == ("wav", 48_000)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("designs = [", "not TOML"),
        ("", "designs"),
        ('designs = "two.skinsource"', "a list of names"),
        ('designs = ["two.skinsource"]\nvari = 1', "'vari' is not known"),
        ('designs = ["two.skinsource"]\n[trials]\norder = "odd"', "order"),
        ('designs = ["two.skinsource"]\n[trials]\nspeed = 1', "'speed' is not known in"),
        ('designs = ["two.skinsource"]\n[vary]\nfrequency_hz = 50', "a list of values"),
        ('designs = ["two.skinsource"]\noutputs = [0]', "outputs"),
        ('designs = ["two.skinsource"]\nparquet = 1', "parquet is 1, expected true or false"),
        ('designs = ["two.skinsource"]\npeople = "yes"', "people is 'yes', expected true or"),
        ('designs = ["two.skinsource"]\naxes = "w"', "axes"),
        ('designs = ["two.skinsource"]\n[stimuli]\nrate_hz = 0', "rate_hz"),
        ('designs = ["two.skinsource"]\nvary = 3', "expected a table"),
    ],
)
def test_a_file_that_cannot_be_says_where_and_why(folder, text, message):
    with pytest.raises(FileFormatError, match=message) as refused:
        read_sweep(written(folder, text))
    assert "sweep.toml" in str(refused.value)


def test_the_command_measures_names_what_it_left_out_and_ends_with_1_then(folder, capsys):
    path = written(folder, 'designs = ["two.skinsource"]\n[vary]\nfrequency_hz = [50]\n')
    assert main(["sweep", str(path), "--out", str(folder / "whole")]) == 0
    assert capsys.readouterr().out == f"1 stimuli\n{folder / 'whole' / 'stimuli.csv'}\n"
    path = written(folder, 'designs = ["two.skinsource"]\n[vary]\nfrequency_hz = [50, 700]\n')
    for _ in range(2):
        # Run again, it measures nothing anew, and says the same.
        assert main(["sweep", str(path), "--out", str(folder / "out")]) == 1
    printed = capsys.readouterr()
    assert "2 stimuli, 1 of them left out" in printed.out
    assert "stimulus 2 left out" in printed.err
    assert "650 Hz" in printed.err
    assert (folder / "out" / "stimuli.csv").read_text().count("\n") == 3
