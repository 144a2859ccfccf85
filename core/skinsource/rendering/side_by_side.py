"""Two threads for work that leaves Python's lock alone: large array operations."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor


def side_by_side(first: Callable[[], None], second: Callable[[], None]) -> None:
    """Call both at the same time; neither may count work, which belongs to a thread."""
    with ThreadPoolExecutor(1) as helper:
        other = helper.submit(first)
        second()
        other.result()
