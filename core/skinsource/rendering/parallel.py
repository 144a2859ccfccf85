"""A few independent computations side by side, with their work counted."""

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

from skinsource.work import Work, counting, tally

V = TypeVar("V")


def in_parallel(tasks: Sequence[Callable[[], V]], *, worthwhile: bool) -> list[V]:
    """Results of ``tasks``, in order; in threads of their own where that is worthwhile.

    Threads end before this returns.
    """
    if not worthwhile or len(tasks) < 2:
        return [task() for task in tasks]
    with ThreadPoolExecutor(len(tasks), thread_name_prefix="skinsource-render") as pool:
        counted = [pool.submit(_counted, task) for task in tasks]
        results = [future.result() for future in counted]
    for _, work in results:
        tally(
            forward_transforms=work.forward_transforms,
            inverse_transforms=work.inverse_transforms,
            samples_drawn=work.samples_drawn,
            bytes_read=work.bytes_read,
        )
    return [value for value, _ in results]


def _counted(task: Callable[[], V]) -> tuple[V, Work]:
    with counting() as work:
        return task(), work
