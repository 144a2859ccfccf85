"""Counts of the work that an evaluation does, for tests."""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass


@dataclass(slots=True)
class Work:
    """Counts of work.

    Attributes
    ----------
    forward_transforms, inverse_transforms
        Fourier transforms of one signal each.
    search_transforms
        Inverse transforms that searched for the exact maximum of a unit field.
    samples_drawn
        Samples of waveforms that were computed.
    bytes_read
        Bytes of impulse responses that were read, or computed for synthetic limbs.
    rules_run
        Rules of the graph that ran.
    operators_built
        Operators of maps that were built, not found on disk.
    samples_moved
        Samples of actuators' motions that were simulated.
    """

    forward_transforms: int = 0
    inverse_transforms: int = 0
    search_transforms: int = 0
    samples_drawn: int = 0
    bytes_read: int = 0
    rules_run: int = 0
    operators_built: int = 0
    samples_moved: int = 0


# The counts belong to the running evaluation, not to the functions that do the work.
_counted: ContextVar[Work | None] = ContextVar("counted", default=None)


@contextmanager
def counting() -> Iterator[Work]:
    """Count the work that this thread does in the block."""
    work = Work()
    token = _counted.set(work)
    try:
        yield work
    finally:
        _counted.reset(token)


def tally(**counts: int) -> None:
    """Add to the counts of `counting`, by their names; do nothing outside of it."""
    work = _counted.get()
    if work is not None:
        for name, count in counts.items():
            setattr(work, name, getattr(work, name) + count)
