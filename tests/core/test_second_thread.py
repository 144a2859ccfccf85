"""A second thread that helps: whatever it does, each result is there, once, in its place."""

from threading import Event, get_ident

import pytest

from skinsource.engine import prediction as module
from skinsource.engine.prediction import run_with_helper
from skinsource.engine.transforms import run_on_two_threads


@pytest.mark.parametrize("count", [0, 1, 2, 5, 50])
def test_results_come_in_the_order_of_the_tasks(count):
    assert run_with_helper([lambda k=k: k * k for k in range(count)]) == [
        k * k for k in range(count)
    ]


def test_two_threads_take_part():
    # Each waits until the other has begun: one thread alone would never pass.
    begun = Event(), Event()

    def task(own: int) -> int:
        begun[own].set()
        assert begun[1 - own].wait(60)
        return get_ident()

    first, second = run_with_helper([lambda: task(0), lambda: task(1)])
    assert first == get_ident() != second


def test_a_helper_that_never_gets_on_holds_nobody_up():
    me, never, stuck = get_ident(), Event(), Event()

    def task(k: int) -> int:
        if get_ident() != me:
            stuck.set()
            never.wait()
        elif k == 0:
            assert stuck.wait(60)
        return k

    assert run_with_helper([lambda k=k: task(k) for k in range(5)]) == list(range(5))
    never.set()


def test_without_a_second_thread_one_does_it_all(monkeypatch):
    def refuse(*_: object) -> None:
        raise RuntimeError("can't start new thread")

    monkeypatch.setattr(module, "start_new_thread", refuse)
    assert run_with_helper([lambda k=k: k for k in range(5)]) == list(range(5))


@pytest.mark.parametrize("way", [run_with_helper, run_on_two_threads])
@pytest.mark.parametrize("failing", [0, 3, 7])
@pytest.mark.parametrize("kind", [ValueError, IndexError])
def test_what_a_task_raises_is_raised_whoever_did_it(way, failing, kind):
    def task(k: int) -> None:
        if k == failing:
            raise kind("that one")

    with pytest.raises(kind, match="that one"):
        way([lambda k=k: task(k) for k in range(8)])


def test_all_tasks_side_by_side_are_done_once():
    done: list[int] = []
    run_on_two_threads([lambda k=k: done.append(k) for k in range(100)])
    assert sorted(done) == list(range(100))
