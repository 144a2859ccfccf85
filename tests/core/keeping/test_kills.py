"""Studios that are killed while they write copies lose at most the one that they are writing."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from skinsource.design import recovery
from skinsource.design.design_file import open_design

#: Forks a writer after the other, each of which keeps copies and tells their numbers, and kills it.
PROGRAM = """
import json, os, random, signal, sys, time
from pathlib import Path
from skinsource.design.design import Design, track
from skinsource.design.design_file import DesignFile
from skinsource.design.recovery import Session

def write_until_killed(told):
    session = Session(Path(sys.argv[1]))
    for number in range(1, 1000):
        design = Design(limb="synthetic-1", inputs=(track(7, amplitude=float(number)),))
        session.keep(DesignFile(design=design), Path("/designs/tap.skinsource"), b"picture")
        os.write(told, b"%04d" % number)

chance, writers = random.Random(20261122), {}
for _ in range(8):
    read, told = os.pipe()
    pid = os.fork()
    if pid == 0:
        write_until_killed(told)
        os._exit(1)
    first = os.read(read, 4)
    time.sleep(chance.uniform(0.0, 0.05))
    os.kill(pid, signal.SIGKILL)
    os.waitpid(pid, 0)
    os.close(told)
    numbers = first + b"".join(iter(lambda: os.read(read, 4096), b""))
    os.close(read)
    writers[pid] = int(numbers[-4:])
print(json.dumps(writers))
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no system call makes so many writers quickly")
def test_of_killed_writers_every_copy_that_was_kept_is_found(tmp_path):
    command = [sys.executable, "-c", PROGRAM, tmp_path]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    kept = {int(pid): number for pid, number in json.loads(done.stdout).items()}
    search = recovery.find(tmp_path)
    assert search.set_aside == ()
    assert len(search.left) == len(kept) == 8
    for work in search.left:
        pid = int(work.copies[0].parent.name.split("-")[2])
        assert len(work.copies) <= 6  # the sixth was being written
        newest, *_ = [open_design(copy).design.inputs[0].amplitude for copy in work.copies]
        assert kept[pid] <= newest <= kept[pid] + 1
        assert (work.name, work.file) == ("tap", Path("/designs/tap.skinsource"))
    assert list(tmp_path.rglob("*.part")) == []
    for work in search.left:
        recovery.discard(work)
    assert [path for path in tmp_path.rglob("*") if path.is_file()] == []
