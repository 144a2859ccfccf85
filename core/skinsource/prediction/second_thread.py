"""A second thread that helps where a processor is free, and holds nobody up where none is."""

from _thread import start_new_thread
from collections import deque
from collections.abc import Callable, Sequence
from contextlib import suppress
from math import inf
from queue import Empty, SimpleQueue
from time import perf_counter
from typing import TypeVar

Result = TypeVar("Result")


def helped(tasks: Sequence[Callable[[], Result]]) -> list[Result]:
    """Return what ``tasks`` return, in their order.

    A second thread takes some of them.  What it has begun and not finished in the least time that
    a task took, this one does itself: a task may be done twice, and be done again when this has
    returned.  It may write only what it would write each time, and count no work, which belongs to
    a thread.  What a task raises is raised here.
    """
    waiting = deque(range(len(tasks)))
    done: SimpleQueue[tuple[int, Result]] = SimpleQueue()

    def help_out() -> None:
        try:
            while waiting:
                number = waiting.pop()
                done.put((number, tasks[number]()))
        except Exception:  # noqa: BLE001, S110  this thread finds no more, or fails as the other will
            pass

    found: dict[int, Result] = {}
    if len(tasks) > 1:
        with suppress(RuntimeError):  # no more threads are to be had
            # One of the threading module would be waited for until it runs.
            start_new_thread(help_out, ())
    shortest_s = inf
    while waiting:
        try:
            number = waiting.popleft()
        except IndexError:
            break
        begin = perf_counter()
        found[number] = tasks[number]()
        shortest_s = min(shortest_s, perf_counter() - begin)
    # Others took longer where other programs had the processor meanwhile.
    deadline = perf_counter() + (shortest_s if found else 0.0)
    while len(found) < len(tasks):
        try:
            number, result = done.get(timeout=max(deadline - perf_counter(), 0.0))
        except Empty:
            break
        found[number] = result
    return [found[k] if k in found else tasks[k]() for k in range(len(tasks))]
