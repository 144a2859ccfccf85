import os
import subprocess
import sys

import pytest

from skinsource_gui import __main__ as start
from skinsource_gui import system_libraries


def run(*arguments, **environment):
    return subprocess.run(
        [sys.executable, "-m", "skinsource_gui", *map(str, arguments)],
        capture_output=True,
        text=True,
        env={**os.environ, **environment},
        timeout=120,
    )


def test_help_is_given_without_a_display():
    done = run("--help")
    assert done.returncode == 0
    assert "--render" in done.stdout


def test_without_a_display_the_start_design_is_rendered_and_the_files_are_named(
    tmp_path, monkeypatch
):
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.chdir(tmp_path)
    root = os.path.dirname(os.path.dirname(start.__file__))
    done = run(PYTHONPATH=os.pathsep.join([root, os.path.join(root, "core")]))
    assert done.returncode == 0, done.stderr
    assert "There is no display" in done.stdout
    folder = tmp_path / "build" / "first-run"
    names = {"window.png", "rms-map.png", "rms-map.csv", "traces.csv"}
    assert {path.name for path in folder.iterdir()} == names
    for name in names:
        assert os.path.join("build", "first-run", name) in done.stdout
    table = (folder / "rms-map.csv").read_text(encoding="utf-8")
    assert "SYNTHETIC" in table
    assert len([line for line in table.splitlines() if not line.startswith("#")]) == 73


def test_missing_system_libraries_end_in_the_exact_install_line(monkeypatch, capsys):
    monkeypatch.setattr(system_libraries, "_opens", lambda library: "EGL" not in library)
    assert start.main([]) == 1
    assert "apt-get install -y libegl1" in capsys.readouterr().err


def test_missing_packages_of_the_window_end_in_the_pip_line(monkeypatch, capsys):
    monkeypatch.setattr(start.importlib.util, "find_spec", lambda name: None)
    assert start.main([]) == 1
    assert 'pip install "skinsource[gui]"' in capsys.readouterr().err


@pytest.mark.parametrize(
    ("environment", "expected"),
    [
        ({"DISPLAY": ":0"}, True),
        ({"WAYLAND_DISPLAY": "wayland-0"}, True),
        ({}, False),
        ({"DISPLAY": ":0", "QT_QPA_PLATFORM": "offscreen"}, False),
    ],
)
def test_a_display_is_recognised(monkeypatch, environment, expected):
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"):
        monkeypatch.delenv(name, raising=False)
    for name, value in environment.items():
        monkeypatch.setenv(name, value)
    monkeypatch.setattr(system_libraries.sys, "platform", "linux")
    assert system_libraries.has_display() == expected


@pytest.mark.parametrize("module", ["skinsource", "skinsource_gui.app"])
def test_starting_imports_nothing_that_takes_long_and_is_not_needed(module):
    unneeded = ("scipy.signal", "matplotlib", "pandas", "matio", "pooch", "requests")
    probe = f"import sys, {module}; print([m for m in {unneeded} if m in sys.modules])"
    done = subprocess.run(
        [sys.executable, "-c", probe], capture_output=True, text=True, check=True, timeout=60
    )
    assert done.stdout.strip() == "[]"
