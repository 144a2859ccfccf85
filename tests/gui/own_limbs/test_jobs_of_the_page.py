"""The page of own limbs tells of its own jobs, and of no other."""

from threading import Event

from skinsource.base.job import Job
from skinsource_gui.pages.limbs.page import PageJobs
from skinsource_gui.state.job_runner import JobProgress, JobRunner


def test_nothing_is_said_of_a_job_of_another_page(qtbot):
    runner, gate, messages, ended = JobRunner(), Event(), [], []
    page = PageJobs(runner, runner)
    page.progressed.connect(messages.append)
    for signal in (page.done, page.failed, page.cancelled):
        signal.connect(lambda *_: ended.append(1))
    own = Job("Importing a limb", lambda progress, stop: gate.wait(30.0))
    other = Job("Exporting a.csv", lambda progress, stop: None)
    page.add(own)
    messages.clear()
    for job in (other, own):
        runner.progressed.emit(job, JobProgress(done=1, total=2))
    # How much there is to do is not known yet.
    runner.progressed.emit(own, JobProgress())
    assert messages == ["Importing a limb: 50 %"]
    runner.done.emit(other, None)
    runner.failed.emit(other, ValueError("x"))
    runner.cancelled.emit(other)
    assert (ended, page.busy) == ([], True)
    gate.set()
    qtbot.waitUntil(lambda: ended == [1])
    assert not page.busy
    runner.close()
