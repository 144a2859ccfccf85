"""Processes that have ended, and what they left."""

from dataclasses import replace

import pytest

from skinsource.base.lock import this_process, to_bytes
from skinsource.design.design import Design, track
from skinsource.design.design_file import DesignFile
from skinsource.design.recovery import OWNER, Session


@pytest.fixture
def ended():
    """Give a process that had the number of this one, and ran before it."""
    return replace(this_process(), started_s=1000.0)


@pytest.fixture
def elsewhere():
    """Give a process of another computer."""
    return replace(this_process(), host="lab-3", user="ana")


@pytest.fixture
def work():
    """Make work that is told apart by a number."""

    def make(number: int) -> DesignFile:
        inputs = (track(location=7, amplitude=float(number)),)
        return DesignFile(design=Design(limb="synthetic-1", inputs=inputs), layout=b"docks")

    return make


@pytest.fixture
def left_by_a_killed_studio(tmp_path, work, ended):
    """Leave ``count`` copies in the folder of a studio that has ended; give the folder."""

    def leave(count: int = 2, file=None):
        session = Session(tmp_path)
        for number in range(1, count + 1):
            session.keep(work(number), file, b"picture %d" % number)
        (session.folder / OWNER).write_bytes(to_bytes(ended))
        return session.folder

    return leave
