"""Hundreds of deeds at random: nothing fails, and what is shown is what is predicted.

More are done at night: ``python -m tests.nightly.monkey``.
"""

import os
import sys

import numpy as np
import soundfile

from tests.gui.monkey.deeds_in_fields import import_recording
from tests.gui.monkey.monkey import DEEDS, Monkey

COUNT = 400
#: Another one: MONKEY_SEED=7 pytest tests/gui/monkey
SEED = int(os.environ.get("MONKEY_SEED", "20"))


def recording(folder):
    """A file with half a second of a tone that dies away."""
    path, time_s = folder / "tone.wav", np.arange(4000) / 8000.0
    soundfile.write(path, np.exp(-8.0 * time_s) * np.sin(2.0 * np.pi * 150.0 * time_s), 8000)
    return path


def test_whatever_is_done_in_whatever_order_the_studio_holds(window, tmp_path):
    sys.stdout.write(f"seed {SEED}\n")
    window.resize(1024, 700)
    monkey = Monkey(window, SEED, tmp_path, (recording(tmp_path),))
    tally = monkey.play(COUNT)
    assert not tally.faults, f"seed {SEED}: {tally.faults[0]}\nafter\n{monkey.last_deeds}"
    assert tally.deeds.total() == COUNT
    assert set(tally.deeds) == {deed.__name__ for deed in (*DEEDS, import_recording)}
    # What it looked at was worth looking at.
    assert tally.compared - tally.silent >= COUNT // 100
    assert tally.undone >= 50
