"""Forks writers of copies and kills them at random moments; what each had done is printed.

A writer edits without pause and keeps a copy as often as it is told.  It notes each edit in memory
that it shares with the process that kills it, so that the note outlives it.
"""

import json
import mmap
import os
import signal
import struct
import sys
import time
from pathlib import Path

import numpy as np

from skinsource.base.lock import this_process
from skinsource.design.design import Design, track
from skinsource.design.design_file import DesignFile
from skinsource.design.recovery import Session

EDIT = struct.Struct("<qd")
MOST_EDITS = 4000
AT_A_TIME = 25
LONGEST_S = 60.0


def write_until_killed(folder, notes, interval_s):
    session = Session(folder)
    kept_s = time.monotonic()
    for number in range(1, MOST_EDITS):
        design = Design(limb="synthetic-1", inputs=(track(location=7, amplitude=number / 8),))
        now_s = time.monotonic()
        EDIT.pack_into(notes, EDIT.size * number, number, now_s)
        EDIT.pack_into(notes, 0, number, now_s)
        if now_s - kept_s >= interval_s:
            kept_s = now_s
            session.keep(DesignFile(design=design), Path("/designs/tap.skinsource"), b"picture")
        time.sleep(0.004)
    os._exit(1)


def born(folder, interval_s):
    notes = mmap.mmap(-1, EDIT.size * MOST_EDITS)
    pid = os.fork()
    if pid == 0:
        try:
            write_until_killed(folder, notes, interval_s)
        finally:
            os._exit(1)
    return pid, notes


def wait_for(notes, life_s):
    """Until a writer has worked for so long by its own notes, however busy the machine is."""
    latest_s = time.monotonic() + LONGEST_S
    while time.monotonic() < latest_s:
        last, last_s = EDIT.unpack_from(notes, 0)
        if last > 1 and last_s - EDIT.unpack_from(notes, EDIT.size)[1] >= life_s:
            return
        time.sleep(0.001)


def main(folder, kills, interval_s, seed):
    summaries = []
    chance = np.random.default_rng(seed)
    while len(summaries) < kills:
        count = min(AT_A_TIME, kills - len(summaries))
        writers = [born(folder, interval_s) for _ in range(count)]
        lives_s = sorted(chance.uniform(0.5, 5.0) * interval_s for _ in writers)
        for (pid, notes), life_s in zip(writers, lives_s, strict=True):
            wait_for(notes, life_s)
            os.kill(pid, signal.SIGKILL)
            os.waitpid(pid, 0)
            last, _ = EDIT.unpack_from(notes, 0)
            times = [EDIT.unpack_from(notes, EDIT.size * k)[1] for k in range(1, last + 1)]
            summaries.append({"pid": pid, "edits_s": times})
    json.dump(summaries, sys.stdout)


if __name__ == "__main__":
    this_process()
    main(Path(sys.argv[1]), int(sys.argv[2]), float(sys.argv[3]), int(sys.argv[4]))
