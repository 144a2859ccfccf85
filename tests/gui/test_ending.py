"""Studios that end without asking: told to by the system, or killed."""

import os
import signal
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from skinsource.design import recovery
from skinsource.design.design_file import open_design

# It edits every 10 ms, and says each time which edit was made and when; so it does of copies, when
# they are asked for in the window's thread and when they are written.
STUDIO = """
import sys, time
from pathlib import Path
from PySide6.QtCore import QTimer
from skinsource_gui.pages.files import autosave
from skinsource_gui.shell import keeping
from skinsource_gui.app import app

made, edits = [], 0

def tell(what, design):
    number = round(8 * design.inputs[0].amplitude)
    sys.stdout.write(f"{what} {number} {time.monotonic()}\\n")
    sys.stdout.flush()

class Autosave(autosave.Autosave):
    def _keep(self, seen):
        tell("asked", seen.design)
        return super()._keep(seen)

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
    if sys.argv[1] == "edited":
        edit()
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


def test_unsaved_work_is_kept_when_the_studio_is_told_to_end(tmp_path):
    studio, _ = run_until_ready("edited", tmp_path)
    assert studio.stdout.readline().startswith("edit 1 ")
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


@dataclass
class Told:
    """What a studio said: ``"edit"``, ``"asked"`` or ``"kept"``, of which edit, and when."""

    what: str
    number: int
    at_s: float

    @classmethod
    def of(cls, line):
        what, number, at_s = line.split()
        return cls(what, int(number), float(at_s))


@pytest.fixture(scope="module")
def killed(tmp_path_factory):
    """Kill studios at work one after another; give what each said, found and left."""
    folder = tmp_path_factory.mktemp("killed")
    chance = np.random.default_rng(SEED)
    all_told = []
    for _ in range(KILLS):
        studio, notice = run_until_ready("works", folder)
        most = int(chance.integers(20, 100))
        entries = []
        # Each is killed some time after a first copy, however long that takes here.
        while len(entries) < MOST_TOLD and not (entries and entries[-1].what == "kept"):
            entries.append(Told.of(studio.stdout.readline()))
        entries += [Told.of(studio.stdout.readline()) for _ in range(most)]
        studio.kill()
        rest, _ = studio.communicate()
        entries += [Told.of(line) for line in rest.splitlines(keepends=True) if line.endswith("\n")]
        copies = recovery.find(folder)
        mine = [
            unsaved for unsaved in copies.left if f"-{studio.pid}-" in str(unsaved.copies[0].parent)
        ]
        all_told.append((entries, notice, mine))
    return folder, all_told


def test_a_killed_studio_loses_at_most_one_interval(killed):
    _, all_told = killed
    for entries, _, mine in all_told:
        edits_s = [entry.at_s for entry in entries if entry.what == "edit"]
        asked_s = [entry.at_s for entry in entries if entry.what == "asked"]
        written = [entry.number for entry in entries if entry.what == "kept"]
        assert written
        # What was written is there.
        assert (round(8 * saved_amplitude(mine[0])) if mine else 0) >= max(written, default=0)
        # And it is asked for in time: late at most by what keeps the window from its other work.
        late_s = 0.1 * INTERVAL_S + 2 * max(np.diff(edits_s), default=0.0)
        begun_s = [edits_s[0], *asked_s, edits_s[-1]]
        assert max(np.diff(begun_s)) <= INTERVAL_S + late_s


def test_the_next_start_offers_what_killed_studios_left_with_pictures(killed):
    folder, all_told = killed
    notices = [notice for _, notice, _ in all_told]
    # The very first start has hints; none of the others, for all that ended the first one.
    assert [notice.startswith("1 of 3: ") for notice in notices] == [True, False]
    assert any("before your work on untitled was saved" in notice for notice in notices[1:])
    copies = recovery.find(folder)
    assert copies.set_aside == ()
    pictures = [unsaved.picture() for unsaved in copies.left]
    assert sum(picture.startswith(b"\x89PNG") for picture in pictures) >= len(pictures) // 2
    leftovers = [path.name for path in Path(folder).rglob("*.part")]
    assert leftovers == []
