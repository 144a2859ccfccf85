import os
import signal
import subprocess
import sys
from functools import partial
from pathlib import Path

import pytest

import skinsource as ss
from skinsource.base.extras import extra_line
from skinsource.design.design import View
from skinsource.export.tables import export_levels
from skinsource_gui import __main__ as start
from skinsource_gui.qt import system_libraries

UNNEEDED = (
    # What opens a page, reads a file, plays or exports comes with that.
    "skinsource.design.recordings",
    "skinsource.engine.prediction",
    "skinsource_gui.pages.library",
    "skinsource_gui.pages.scenes",
    # Modules that nothing of the start calls, and large packages.
    "skinsource.export.stimulus_export",
    "skinsource.export.formats",
    "sounddevice",
    "scipy.signal",
    "matplotlib",
    "pandas",
    "matio",
    "requests",
)
#: What only the worker needs, once the window is painted.
LATE = ("scipy.fft", "scipy.spatial", "scipy.ndimage", "scipy.sparse", "h5py")


def python(*arguments, **environment):
    return subprocess.run(
        [sys.executable, *map(str, arguments)],
        capture_output=True,
        text=True,
        env={**os.environ, **environment},
        timeout=120,
    )


run = partial(python, "-m", "skinsource_gui")


def test_help_is_given_without_a_display():
    done = run("--help")
    assert done.returncode == 0
    assert "--render" in done.stdout


@pytest.fixture
def run_without_display(tmp_path, monkeypatch):
    """Start the studio in an empty folder, without a display."""
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.chdir(tmp_path)
    root = os.path.dirname(os.path.dirname(start.__file__))
    return partial(run, PYTHONPATH=os.pathsep.join([root, os.path.join(root, "core")]))


def design(frequency_hz=200.0):
    return ss.Design(
        limb="synthetic-1", inputs=(ss.track(5, ss.waveforms.Tone(frequency_hz=frequency_hz)),)
    )


def test_without_a_display_the_design_that_is_named_is_rendered(tmp_path, run_without_display):
    ss.save_design(tmp_path / "d.skinsource", design())
    done = run_without_display("d.skinsource")
    assert done.returncode == 0, done.stderr
    assert "There is no display here. Rendering d.skinsource to" in done.stdout
    export_levels(tmp_path / "expected.csv", design(), View())
    folder = tmp_path / "build" / "first-run"
    names = {"window.png", "rms-map.png", "rms-map.csv", "traces.csv"}
    assert {path.name for path in folder.iterdir()} == names
    for name in names:
        assert os.path.join("build", "first-run", name) in done.stdout
    assert (folder / "rms-map.csv").read_bytes() == (tmp_path / "expected.csv").read_bytes()


def test_what_cannot_be_rendered_is_one_sentence_and_leaves_no_file(tmp_path):
    path = tmp_path / "d.skinsource"
    ss.save_design(path, design(frequency_hz=2000.0))
    done = run("--render", tmp_path / "folder", path)
    assert (done.returncode, done.stdout, len(done.stderr.splitlines())) == (1, "", 1)
    assert done.stderr.startswith("skinsource-gui: ")
    assert "650 Hz" in done.stderr
    assert list(tmp_path.iterdir()) == [path]


INTERRUPTED = """
import signal, sys
import skinsource.export.tables
from skinsource_gui.__main__ import main
skinsource.export.tables.export_levels = lambda *_: signal.raise_signal(signal.SIGINT)
main(["--render", sys.argv[1]])
"""


@pytest.mark.skipif(os.name == "nt", reason="Windows tells no process what signal ended another")
def test_ctrl_c_ends_rendering_without_a_word_and_without_a_file(tmp_path):
    done = python("-c", INTERRUPTED, tmp_path / "folder")
    assert (done.returncode, done.stdout, done.stderr) == (-signal.SIGINT, "", "")
    assert list(tmp_path.iterdir()) == []


WITHOUT_CONSOLE = """
import sys
from skinsource_gui.__main__ import main
sys.stdout = sys.stderr = None
sys.exit(main(["--render", sys.argv[1]]))
"""


def test_a_start_without_a_console_as_on_windows_needs_none(tmp_path):
    done = python("-c", WITHOUT_CONSOLE, tmp_path / "folder")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    assert (tmp_path / "folder" / "window.png").is_file()


def test_missing_system_libraries_end_in_the_exact_install_line(monkeypatch, capsys):
    monkeypatch.setattr(system_libraries, "_opens", lambda library: "EGL" not in library)
    assert start.main([]) == 1
    assert "apt-get install -y libegl1" in capsys.readouterr().err
    assert "apt-get install -y libegl1" in system_libraries.started_platform(Path())


def test_missing_packages_of_the_window_end_in_the_pip_line(monkeypatch, capsys):
    monkeypatch.setattr(start.importlib.util, "find_spec", lambda name: None)
    assert start.main([]) == 1
    assert extra_line("gui") in capsys.readouterr().err


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


FIRST_PAINT = """
import os, sys
from pathlib import Path
from PySide6.QtCore import QEvent, QObject, QTimer
from PySide6.QtWidgets import QWidget
from skinsource_gui.app.app import make_application, make_window
from skinsource_gui.state.preferences import Preferences

names, application = sys.argv[2].split(), make_application()
window = make_window(None, Preferences(Path(sys.argv[1])))
painted = set()

class Watch(QObject):
    def eventFilter(self, watched, event):
        if event.type() == QEvent.Type.Paint:
            painted.add(watched)
            if watched is window:
                QTimer.singleShot(0, tell)
        return False

def tell():
    widgets = window.findChildren(QWidget)
    visible = [widget for widget in widgets if not widget.visibleRegion().isEmpty()]
    print(len(visible), [widget.objectName() for widget in visible if widget not in painted])
    print([name for name in names if name in sys.modules])
    sys.stdout.flush()
    os._exit(0)

watch = Watch()
application.installEventFilter(watch)
window.show()
application.exec()
"""


def test_the_whole_window_is_painted_before_anything_is_imported_for_computing(tmp_path):
    names = " ".join((*UNNEEDED, *LATE))
    done = python("-c", FIRST_PAINT, tmp_path / "studio.ini", names)
    assert done.returncode == 0, done.stderr
    painted, imported = done.stdout.splitlines()
    count, _, unpainted = painted.partition(" ")
    assert int(count) > 80
    assert unpainted == "[]"
    assert imported == "[]"


RENDERED = """
import inspect, sys
from skinsource_gui.__main__ import main
read, source = [], inspect.getsource

def note(module):
    read.append(module.__name__)
    return source(module)

inspect.getsource = note
ended = main(["--render", sys.argv[1]])
print(ended, "pyqtgraph" in sys.modules, "scipy.fft" in sys.modules)
print(*read)
import numpy.testing
numpy.testing.assert_allclose(1.0, 1.0)
"""


def test_qt_reads_the_source_of_nothing_that_is_imported_after_it(tmp_path):
    done = python("-c", RENDERED, tmp_path)
    assert done.returncode == 0, done.stderr
    *_, ended, read = done.stdout.splitlines()
    assert ended == "0 True True"
    # What was read before it could be told is of Qt and Python alone.
    others = ("skinsource", "pyqtgraph", "numpy", "scipy")
    assert not [name for name in read.split() if name.startswith(others)]
