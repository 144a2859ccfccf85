"""A second thread that helps: each task is done once, whoever does it."""

from threading import Event, get_ident

import pytest

from skinsource.engine.transforms import run_on_two_threads


def test_two_threads_take_part():
    # Each waits until the other has begun: one thread alone would never pass.
    begun, threads = (Event(), Event()), [0, 0]

    def task(own: int) -> None:
        begun[own].set()
        assert begun[1 - own].wait(60)
        threads[own] = get_ident()

    run_on_two_threads([lambda: task(0), lambda: task(1)])
    assert get_ident() in threads
    assert threads[0] != threads[1]


def test_without_a_second_thread_one_does_it_all(monkeypatch):
    def refuse(*_: object) -> None:
        raise RuntimeError("can't start new thread")

    monkeypatch.setattr("concurrent.futures.ThreadPoolExecutor.submit", refuse)
    done: list[int] = []
    run_on_two_threads([lambda k=k: done.append(k) for k in range(5)])
    assert done == list(range(5))


def test_a_second_thread_that_is_busy_elsewhere_is_not_waited_for():
    done: list[int] = []

    def task() -> None:
        # Both threads are here, so that nobody helps with what each of them has to do.
        run_on_two_threads([lambda k=k: done.append(k) for k in range(3)])

    run_on_two_threads([task, task])
    assert sorted(done) == [0, 0, 1, 1, 2, 2]


@pytest.mark.parametrize("failing", [0, 3, 7])
@pytest.mark.parametrize("kind", [ValueError, IndexError])
def test_what_a_task_raises_is_raised_whoever_did_it(failing, kind):
    def task(k: int) -> None:
        if k == failing:
            raise kind("that one")

    with pytest.raises(kind, match="that one"):
        run_on_two_threads([lambda k=k: task(k) for k in range(8)])


@pytest.mark.parametrize("count", [0, 1, 100])
def test_all_tasks_are_done_once(count):
    done: list[int] = []
    run_on_two_threads([lambda k=k: done.append(k) for k in range(count)])
    assert sorted(done) == list(range(count))
