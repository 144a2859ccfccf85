from functools import partial
from threading import Event, Timer
from weakref import ref

import pytest

from skinsource.base.errors import Stopped
from skinsource_gui.state.worker import Worker


@pytest.fixture
def gate():
    gate = Event()
    yield gate
    gate.set()


@pytest.fixture
def worker(qtbot, gate):
    worker = Worker("test-worker")
    yield worker
    gate.set()
    worker.close()


def test_of_what_waits_with_a_key_only_the_newest_runs(worker, qtbot, gate):
    arrived = []
    worker.run(gate.wait)
    for k in range(3):
        worker.run_newest("key", lambda k=k: k, lambda *came: arrived.append(came[0]))
    assert [worker.is_outdated(key) for key in ("key", "another")] == [True, False]
    gate.set()
    qtbot.waitUntil(lambda: not worker.busy)
    assert arrived == [2]
    assert not worker.is_outdated("key")


def test_what_stops_for_something_else_keeps_nothing_and_is_run_again_after_it(worker, qtbot):
    began, done, kept = Event(), [], []

    def patient():
        computed = Event()
        kept.append(ref(computed))
        if not began.is_set():
            began.set()
            while not worker.is_outdated("urgent"):
                pass
            raise Stopped
        return "patient"

    worker.run_newest("patient", patient, lambda result, _: done.append(result), again=True)
    assert began.wait(20)
    worker.run_newest("urgent", lambda: "urgent", lambda result, _: done.append(result))
    qtbot.waitUntil(lambda: len(done) == 2)
    assert done == ["urgent", "patient"]
    assert kept[0]() is None


def test_a_task_tells_how_far_it_is(worker, qtbot):
    told = []
    worker.run(lambda: worker.tell(told.append, "half"), lambda *_: told.append("done"))
    qtbot.waitUntil(lambda: told == ["half", "done"])


def test_after_a_wait_what_is_done_has_arrived(worker):
    arrived = []
    worker.wait(worker.run(lambda: 5, lambda result, _: arrived.append(result)), 20.0)
    assert arrived == [5]


def test_what_arrived_together_with_something_that_failed_still_arrives(worker, qtbot, gate):
    arrived = []
    worker.run(gate.wait, lambda *_: arrived[0])
    last = worker.run(lambda: 2, lambda result, _: arrived.append(result))
    Timer(0.05, gate.set).start()  # once it is waited for: until then each sends an event
    with pytest.raises(IndexError):
        worker.wait(last, 20.0)
    qtbot.waitUntil(lambda: arrived == [2])


def test_nothing_arrives_once_it_is_closed_and_what_waits_is_dropped(qtbot, gate):
    worker, done = Worker("test-worker"), []
    worker.run(partial(done.append, "first"), lambda *_: done.append("arrived"))
    worker.run(gate.wait)
    worker.run(partial(done.append, "second"))
    qtbot.waitUntil(lambda: "arrived" in done)
    worker.tell(done.append, "late")
    gate.set()
    worker.close()
    worker.run(partial(done.append, "after"))
    qtbot.wait(1)
    assert not {"late", "after"} & set(done)
    assert not worker.busy


def test_what_waits_is_finished_where_that_is_said_and_the_last_task_comes_last(gate):
    worker, done = Worker("test-worker"), []
    worker.run(partial(done.append, "first"))
    worker.run(partial(done.append, "second"))
    worker.close(partial(done.append, "last"), finish=True)
    assert done == ["first", "second", "last"]


def test_without_a_task_there_is_no_thread_and_nothing_comes_last():
    worker, done = Worker("test-worker"), []
    assert not worker.used
    worker.close(partial(done.append, "last"), finish=True)
    assert not done
