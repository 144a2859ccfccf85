"""Help pages, lists of limbs, folders, and what is missing: the same in all commands."""

import os
import re
import sys

import numpy as np
import pytest

import skinsource as ss
from skinsource.cli.command_line import main
from tests.core.frozen.read_frozen import commands

DESIGN = ss.Design(limb="synthetic-1", inputs=(ss.track(7),))


def help_of(command, capsys):
    with pytest.raises(SystemExit):
        main([*command.split()[1:], "--help"])
    return capsys.readouterr().out


@pytest.mark.parametrize("command", [name for name in commands() if "[" not in name])
def test_help_is_wrapped(command, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    text = help_of(command, capsys)
    assert max(map(len, text.splitlines())) < 80
    # Long lists of options stand in groups.
    parts = re.split(r"\n\n(?=[\w ]+:\n)", text)
    assert max(part.count("\n  --") for part in parts) <= 9


def test_commands_stand_in_groups(capsys):
    text = help_of("skinsource", capsys)
    assert re.search(r"\n  limbs:\n    limbs .*\n    limb .*\n    dataset ", text)
    listed = set(re.findall(r"^    (\w+) ", text, re.MULTILINE))
    assert listed == {name.split()[1] for name in commands() if name.count(" ") == 1}


def test_a_command_whose_output_nobody_reads_ends_quietly(monkeypatch, capfd):
    reading, writing = os.pipe()
    os.close(reading)
    with os.fdopen(writing, "w") as unread:
        monkeypatch.setattr(sys, "stdout", unread)
        assert main(["limbs"]) == 141
    assert capfd.readouterr() == ("", "")


def test_there_is_one_list_of_limbs(run):
    _, listed, _ = run("limbs")
    assert run("limb", "list")[1].startswith(listed)
    assert [line.split()[0] for line in listed.splitlines()] == list(ss.available_limbs())


@pytest.mark.parametrize(
    "arguments",
    [
        ("export", "DESIGN", "--out", "drive.wav"),
        ("pack", "DESIGN", "--out", "all.zip"),
        ("check", "DESIGN", "--out", "report.html"),
        ("render", "DESIGN", "--out", "levels"),
        ("scenes", "2F", "--out", "2F.skinsource"),
    ],
)
def test_folders_are_made(run, tmp_path, arguments):
    design, out = tmp_path / "a.skinsource", tmp_path / "new" / "folder" / arguments[-1]
    ss.save_design(design, DESIGN)
    words = [design if word == "DESIGN" else word for word in arguments[:-1]]
    code, _, err = run(*words, out)
    assert (code, err) == (0, "")
    assert out.exists()


def test_the_import_of_a_limb_names_all_that_is_missing_by_option(run, tmp_path):
    path = tmp_path / "ir.npz"
    np.savez(path, responses=np.ones((2, 3, 1, 40)))
    code, _, err = run("limb", "import", path, "--name", "ours")
    assert code == 1
    needed = ("--axes", "--rate", "--hand-length", "--inputs", "--outputs")
    assert [option for option in needed if f"({option})" in err] == list(needed)
    _, _, err = run("limb", "import", path, "--name", "ours", "--rate", "1000", "--axes", "z")
    assert [option for option in needed if f"({option})" in err] == list(needed[2:])


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("export", "--format", "flac", "--out", "d.wav"), "d.wav has the ending of wav files"),
        (("export", "--format", "wav", "--out", "d.csv"), "d.csv has the ending of csv files"),
        (("pack", "--out", "p.txt"), "p.txt is not the name of a zip file"),
    ],
)
def test_an_ending_that_says_something_else_is_refused(run, tmp_path, arguments, message):
    ss.save_design(tmp_path / "a.skinsource", DESIGN)
    command, *options, name = arguments
    code, _, err = run(command, tmp_path / "a.skinsource", *options, tmp_path / name)
    assert code == 1
    assert message in err
    assert [path.name for path in tmp_path.iterdir()] == ["a.skinsource"]


@pytest.mark.parametrize("equaliser", [(), ("--equalise", "none")])
def test_a_boost_without_an_equaliser_is_refused(run, tmp_path, equaliser):
    ss.save_design(tmp_path / "a.skinsource", DESIGN)
    export = "export", tmp_path / "a.skinsource", "--out", tmp_path / "a.wav", "--boost", "3"
    code, _, err = run(*export, *equaliser)
    assert code == 1
    assert "--boost 3 has no equaliser that it limits" in err
    assert not (tmp_path / "a.wav").exists()
