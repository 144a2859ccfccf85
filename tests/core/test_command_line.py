"""The command ``skinsource``: what it writes, and its exit codes."""

import io
import sys

import pytest

from skinsource.base.errors import Stopped
from skinsource.cli.command_line import main
from skinsource.limbs.dataset import commands
from skinsource.limbs.dataset.commands import ProgressBar
from skinsource.version import __version__
from tests.core.dataset_bench import flip, offset_of


def test_the_version_is_told(capsys):
    with pytest.raises(SystemExit) as stop:
        main(["--version"])
    assert stop.value.code == 0
    assert capsys.readouterr().out == f"skinsource {__version__}\n"


@pytest.mark.parametrize(
    "arguments",
    [[], ["nonsense"], ["dataset"], ["dataset", "install"], ["dataset", "list", "more"]],
)
def test_a_wrong_call_ends_with_code_2(arguments, capsys):
    with pytest.raises(SystemExit) as stop:
        main(arguments)
    assert stop.value.code == 2
    assert "usage: skinsource" in capsys.readouterr().err


def test_limbs_lists_the_synthetic_limbs_and_says_what_they_are(run):
    code, out, err = run("limbs")
    assert (code, err) == (0, "")
    lines = out.splitlines()
    assert [line.split()[0] for line in lines] == [f"synthetic-{k}" for k in (1, 2, 3, 4)]
    assert all("SYNTHETIC" in line and "not measured" in line for line in lines)
    assert lines[0].startswith("synthetic-1   Synthetic 1 (175 mm)")


def test_limbs_lists_installed_limbs_first(run, synthetic_installed):
    _, out, _ = run("limbs")
    assert out.startswith("measured-1    Measured 1 (175 mm)     Impulse responses measured")
    assert "NOTE: made from files that are not the published ones" in out
    assert len(out.splitlines()) == 8


def test_install_list_verify_remove(run, synthetic_download, user_data):
    code, out, err = run("dataset", "install", synthetic_download, "--unpublished")
    store = user_data / "measured.npz"
    assert (code, err) == (0, "")
    first, second = out.splitlines()
    assert first == f"Installed measured-1 to measured-4 (73.4 MB) in {store}"
    assert second.startswith("NOTE       made from files that are not the published ones: ")

    code, out, err = run("dataset", "list")
    assert (code, err) == (0, "")
    assert "measured-3  hand length 185 mm\n" in out
    assert f"store      {store} (73.4 MB)\n" in out
    assert "made from  impulseResponses.mat" in out
    assert "NOTE       made from files that are not the published ones: " in out

    code, out, err = run("dataset", "verify")
    assert (code, err) == (0, "")
    assert "every checksum matches" in out
    assert "NOTE       made from files that are not the published ones: " in out

    code, out, err = run("dataset", "remove", "--yes")
    assert (code, err) == (0, "")
    assert out == f"{store} (73.4 MB)\nDeleted.\n"
    assert not store.exists()

    code, out, _ = run("dataset", "remove", "--yes")
    assert (code, out) == (0, "Nothing is installed.\n")


def test_verify_names_what_is_damaged_and_ends_with_code_1(run, synthetic_installed):
    flip(synthetic_installed, offset_of(synthetic_installed, "responses/4-19") + 12_345)
    code, out, err = run("dataset", "verify")
    assert (code, out) == (1, "")
    first, second = err.splitlines()
    assert "limb 4, input 19 is damaged" in first
    assert "dataset is damaged" in second


@pytest.mark.parametrize("answer", ["\n", "n\n", "", "yess\n", "Yes\n"])
def test_remove_deletes_after_a_yes_alone(run, synthetic_installed, monkeypatch, answer):
    monkeypatch.setattr(sys, "stdin", io.StringIO(answer))
    code, out, _ = run("dataset", "remove")
    refused = answer != "Yes\n"
    assert code == refused
    assert out.endswith("Nothing was deleted.\n") is refused
    assert synthetic_installed.exists() is refused


def test_an_error_is_one_line_on_stderr_with_code_1(run, tmp_path):
    code, out, err = run("dataset", "install", tmp_path / "absent")
    assert (code, out) == (1, "")
    assert err.startswith("skinsource: ")
    assert err.count("\n") == 1
    assert "no such file or folder" in err


@pytest.mark.parametrize("stop", [KeyboardInterrupt(), Stopped("Stopped.")])
def test_ctrl_c_ends_with_code_130(run, monkeypatch, stop):
    def interrupted(**_):
        raise stop

    monkeypatch.setattr(commands, "fetch", interrupted)
    code, out, err = run("dataset", "fetch")
    assert (code, out) == (130, "")
    assert err.lower() == "skinsource: stopped.\n"


def test_the_bar_draws_on_a_terminal_and_wipes_itself():
    terminal = io.StringIO()
    terminal.isatty = lambda: True
    with ProgressBar(terminal) as bar:
        bar(1, 2, "Checking")
        bar(1, 2, "Checking")
        bar(2, 2, "Done")
    lines = terminal.getvalue().split("\r")
    assert lines[1] == "[" + "#" * 15 + "." * 15 + "]  50% Checking"
    assert lines[2].rstrip() == "[" + "#" * 30 + "] 100% Done"
    assert lines[3].strip() == ""
    assert len(lines[3]) >= len(lines[2].rstrip())


LONG_NAME = "n" * 300


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has other limits")
@pytest.mark.parametrize("message", [("list",), ("remove", "--yes"), ("install", ".")])
def test_a_data_folder_that_cannot_be_looked_into_is_one_clear_line(
    run, tmp_path, monkeypatch, message
):
    monkeypatch.setenv("SKINSOURCE_DATA", str(tmp_path / LONG_NAME))
    code, _, err = run("dataset", *message)
    assert code == 1
    assert "File name too long" in err or message[0] == "install"
    assert len(err.splitlines()) == 1
