"""Studios that end without asking: told to by the system, or killed."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from skinsource.design import recovery
from skinsource.design.design_file import open_design

# It edits every 10 ms, and says each time which edit was made; so it does of copies, once they are
# written.
STUDIO = """
import sys
from pathlib import Path
from PySide6.QtCore import QTimer
from skinsource_gui.pages.files import autosave
from skinsource_gui.shell import keeping
from skinsource_gui.app import app

made, edits = [], 0

def tell(what, design):
    print(what, round(8 * design.inputs[0].amplitude), flush=True)

class Autosave(autosave.Autosave):
    def _write(self, seen, *rest):
        went_well = super()._write(seen, *rest)
        tell("kept", seen.design)
        return went_well

keeping.Autosave = Autosave

def make_window(*words):
    made.append(make(*words))
    made[0].conductor.delivered.connect(begin)
    return made[0]

def edit():
    global edits
    edits += 1
    window = made[0]
    design = window.document.design.with_input(0, amplitude=edits / 8)
    window.document.edit("a", design)
    tell("edit", design)

def begin(_outcome):
    made[0].conductor.delivered.disconnect(begin)
    print("ready", made[0].notice.text, flush=True)
    if sys.argv[1] in ("edited", "asked"):
        edit()
    if sys.argv[1] == "asked":
        QTimer.singleShot(0, made[0].close)
    if sys.argv[1] == "works":
        timer = QTimer(made[0], interval=10)
        timer.timeout.connect(edit)
        timer.start()

make, app.make_window = app.make_window, make_window
sys.exit(app.run(Path(sys.argv[2]) if len(sys.argv) > 2 else None))
"""
KILLS, INTERVAL_S, SEED, MOST_TOLD = 2, 0.2, 8, 5000


def run_until_ready(doing, folder, *file):
    studio = subprocess.Popen(
        [sys.executable, "-c", STUDIO, doing, *map(str, file)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={
            **os.environ,
            "SKINSOURCE_DATA": str(folder),
            "SKINSOURCE_AUTOSAVE_S": str(INTERVAL_S),
        },
    )
    line = studio.stdout.readline()
    assert line.startswith("ready"), studio.stderr.read()
    return studio, line.removeprefix("ready").strip()


def saved_amplitude(left):
    return open_design(left.copies[0]).design.inputs[0].amplitude


@pytest.mark.parametrize("doing", ["edited", "asked"])
def test_unsaved_work_is_kept_when_the_studio_is_told_to_end(tmp_path, doing):
    studio, _ = run_until_ready(doing, tmp_path)
    assert studio.stdout.readline() == "edit 1\n"
    studio.send_signal(signal.SIGTERM)
    _, errors = studio.communicate(timeout=60)
    assert studio.returncode == 0, errors
    assert "Traceback" not in errors
    (left,) = recovery.find(tmp_path).left
    assert saved_amplitude(left) == 1 / 8


def test_where_all_is_saved_nothing_is_kept(tmp_path):
    studio, _ = run_until_ready("nothing", tmp_path)
    studio.send_signal(signal.SIGINT)
    _, errors = studio.communicate(timeout=60)
    assert studio.returncode == 0, errors
    assert recovery.find(tmp_path) == recovery.Found()
    assert list((tmp_path / "logs").iterdir()) == []


def numbers_kept(lines):
    """Which edits a studio said that it kept."""
    return [int(line.split()[1]) for line in lines if line.startswith("kept ")]


@pytest.fixture(scope="module")
def killed(tmp_path_factory):
    """Kill studios at work one after another; give their notices, and what of each is left."""
    folder = tmp_path_factory.mktemp("killed")
    chance, notices, left = np.random.default_rng(SEED), [], []
    for _ in range(KILLS):
        studio, notice = run_until_ready("works", folder)
        lines = []
        # Each is killed some time after a first copy, however long that takes here.
        while len(lines) < MOST_TOLD and not numbers_kept(lines[-1:]):
            lines.append(studio.stdout.readline())
        lines += [studio.stdout.readline() for _ in range(chance.integers(20, 100))]
        studio.kill()
        rest, _ = studio.communicate()
        kept = numbers_kept(lines + rest.splitlines(keepends=True)[:-1])
        mine = [each for each in recovery.find(folder).left if f"-{studio.pid}-" in str(each)]
        notices.append(notice)
        left.append((kept, mine))
    return folder, notices, left


def test_a_killed_studio_loses_nothing_that_it_kept_while_it_worked(killed):
    for kept, mine in killed[-1]:
        assert kept
        assert round(8 * saved_amplitude(mine[0])) >= max(kept)


def test_the_next_start_offers_what_killed_studios_left_with_pictures(killed):
    folder, notices, _ = killed
    # The very first start has hints; none of the others, for all that ended the first one.
    assert [notice.startswith("1 of 3: ") for notice in notices] == [True, False]
    assert any("before your work on untitled was saved" in notice for notice in notices[1:])
    copies = recovery.find(folder)
    assert copies.set_aside == ()
    pictures = [unsaved.picture() for unsaved in copies.left]
    assert sum(picture.startswith(b"\x89PNG") for picture in pictures) >= len(pictures) // 2
    leftovers = [path.name for path in Path(folder).rglob("*.part")]
    assert leftovers == []
