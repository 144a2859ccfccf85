"""Counts the work that an evaluation does, so that what is left out can be asserted."""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass


@dataclass(slots=True)
class Work:
    """What was done.

    Attributes
    ----------
    forward_transforms, inverse_transforms
        Fourier transforms of one signal each.
    search_transforms
        Those of the inverse ones that searched for the exact maximum of a unit field.
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


# What is being counted belongs to the running evaluation, not to the functions that do the work.
_counted: ContextVar[Work | None] = ContextVar("counted", default=None)


@contextmanager
def counting() -> Iterator[Work]:
    """Count the work done in this block, by this thread."""
    work = Work()
    token = _counted.set(work)
    try:
        yield work
    finally:
        _counted.reset(token)


def tally(
    *,
    forward_transforms: int = 0,
    inverse_transforms: int = 0,
    search_transforms: int = 0,
    samples_drawn: int = 0,
    bytes_read: int = 0,
    rules_run: int = 0,
    operators_built: int = 0,
    samples_moved: int = 0,
) -> None:
    """Add to what is being counted; nothing where nobody counts."""
    work = _counted.get()
    if work is not None:
        work.forward_transforms += forward_transforms
        work.inverse_transforms += inverse_transforms
        work.search_transforms += search_transforms
        work.samples_drawn += samples_drawn
        work.bytes_read += bytes_read
        work.rules_run += rules_run
        work.operators_built += operators_built
        work.samples_moved += samples_moved


# How many there are, in words.


def counted(count: int, noun: str, plural: str = "") -> str:
    """Return ``"1 clip"``, ``"3 clips"``.

    Parameters
    ----------
    count
        How many.
    noun
        What one is called; the words before it stay as they are: ``"more clip"``.
    plural
        What several are called, where that is not the noun with an s.
    """
    return f"{count} {noun if count == 1 else plural or f'{noun}s'}"
