import threading
from functools import partial
from pathlib import Path

import pytest
from PySide6.QtCore import QThread

from skinsource.base.errors import Stopped
from skinsource.base.job import Job
from skinsource_gui.state.job_runner import JobRunner


class Writer:
    """Work that ends when it is told to, or stopped; what it was asked to do is noted."""

    def __init__(self):
        self.go_on, self.started, self.cleared = threading.Event(), threading.Event(), None
        self.threads, self.error = [], None

    def __call__(self, path, *, progress, stop):
        self.threads.append(QThread.currentThread())
        self.started.set()
        progress(0, 0, "Computing")
        while not self.go_on.wait(0.001):
            if stop():
                if self.cleared:
                    self.cleared.wait()
                raise Stopped
        if self.error:
            raise self.error
        path.write_text("all of it")
        return path.name


@pytest.fixture
def jobs(qtbot):
    """Jobs that are closed at the end; what they tell is noted in `told`."""
    before = set(threading.enumerate())
    jobs = JobRunner()
    jobs.ends = []
    jobs.done.connect(lambda job, result: jobs.ends.append(("done", job.title)))
    jobs.cancelled.connect(lambda job: jobs.ends.append(("cancelled", job.title)))
    jobs.failed.connect(lambda job, error: jobs.ends.append((str(error), job.title)))
    yield jobs
    jobs.close()
    assert set(threading.enumerate()) == before


def order(path: Path, work) -> Job:
    return Job(path.name, partial(work, path))


def ordered(jobs, folder):
    """Order two jobs, and wait until the first one has started."""
    writers = [Writer(), Writer()]
    for name, writer in zip("ab", writers, strict=True):
        jobs.add(order(folder / name, writer))
    assert writers[0].started.wait(5)
    return writers


def test_orders_are_carried_out_one_after_another_away_from_this_thread(qtbot, jobs, tmp_path):
    writers = ordered(jobs, tmp_path)
    assert [job.title for job in jobs.unfinished] == ["a", "b"]
    assert not writers[1].started.is_set()
    writers[0].go_on.set()
    qtbot.waitUntil(lambda: jobs.ends == [("done", "a")])
    assert jobs.current.title == "b"
    writers[1].go_on.set()
    qtbot.waitUntil(lambda: not jobs.busy)
    assert jobs.ends == [("done", "a"), ("done", "b")]
    assert jobs.unfinished == ()
    assert QThread.currentThread() not in writers[0].threads + writers[1].threads


def test_cancelling_shows_at_once_even_where_clearing_away_takes_long(qtbot, jobs, tmp_path):
    writer = Writer()
    writer.cleared = threading.Event()
    jobs.add(order(tmp_path / "a", writer))
    assert writer.started.wait(5)
    jobs.cancel()
    qtbot.waitUntil(lambda: jobs.ends == [("cancelled", "a")])
    assert jobs.busy
    assert jobs.unfinished == ()
    jobs.add(order(tmp_path / "b", Writer()))
    assert jobs.current is None
    writer.cleared.set()
    qtbot.waitUntil(lambda: jobs.current is not None)
    assert jobs.ends == [("cancelled", "a")]


def test_a_cancel_that_comes_too_late_says_that_the_file_was_written(qtbot, jobs, tmp_path):
    writer = Writer()
    writer.go_on.set()
    jobs.add(order(tmp_path / "a", writer))
    assert writer.started.wait(5)
    while not (tmp_path / "a").exists():
        pass
    jobs.cancel()
    qtbot.waitUntil(lambda: not jobs.busy)
    assert jobs.ends == [("done", "a")]


def test_closing_forgets_all_orders_and_waits_for_the_thread(jobs, tmp_path):
    writers = ordered(jobs, tmp_path)
    jobs.close()
    assert not writers[1].started.is_set()
    assert list(tmp_path.iterdir()) == []


def test_progress_is_told_some_times_a_second(qtbot, jobs, tmp_path):
    reports = []
    jobs.progressed.connect(lambda _, progress: reports.append(progress))

    def write(path, *, progress, stop):
        for done in range(100_000):
            progress(done, 100_000, "Writing")

    jobs.add(order(tmp_path / "a", write))
    qtbot.waitUntil(lambda: not jobs.busy)
    assert (reports[0].done, reports[0].total, reports[0].text) == (0, 100_000, "Writing")
    assert len(reports) < 100


def test_a_job_that_waits_is_taken_back_and_the_present_one_goes_on(qtbot, jobs, tmp_path):
    first, second = ordered(jobs, tmp_path)
    jobs.cancel(jobs.unfinished[1])
    first.go_on.set()
    qtbot.waitUntil(lambda: not jobs.busy)
    assert jobs.ends == [("cancelled", "b"), ("done", "a")]
    assert not second.started.is_set()
