"""Two threads for work that leaves Python's lock alone: large array operations."""

from collections.abc import Callable, Iterable
from threading import Thread


def side_by_side(tasks: Iterable[Callable[[], None]]) -> None:
    """Run all of ``tasks``, by two threads; none may count work, which belongs to a thread.

    Each thread takes the next one that nobody took: where other programs keep the second one
    waiting, the first does it all.  What a task raises is raised here.
    """
    waiting = iter(tuple(tasks))
    failures: list[BaseException] = []

    def work() -> None:
        while not failures and (task := next(waiting, None)) is not None:
            try:
                task()
            except BaseException as error:  # noqa: BLE001  of whichever thread
                failures.append(error)

    helper = Thread(target=work)
    helper.start()
    work()
    helper.join()
    if failures:
        raise failures[0]
