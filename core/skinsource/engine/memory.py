"""Memory for computed values: a store with a budget, and the budgets of all stores.

Spectra of responses have one budget for the process; the others hold for all graphs that share
values together.  Limbs with the responses that were read, and the latest result of each rule, come
on top.
"""

import mmap
from collections import OrderedDict
from collections.abc import Callable, Hashable
from math import prod
from typing import Generic, TypeVar
from weakref import WeakValueDictionary

import numpy as np

from skinsource.base.conventions import Complexes

V = TypeVar("V")

#: Memory that an entry takes beside its value: its key, and its slot in the dictionary.
ENTRY_BYTES = 1000


class Memory(Generic[V]):
    """Values by key, for one thread; beyond a budget the least recently used are dropped.

    Parameters
    ----------
    budget_bytes
        Memory that all entries together may take.
    size_of
        Bytes of one value.
    """

    def __init__(self, budget_bytes: int, size_of: Callable[[V], int]) -> None:
        self._budget_bytes = budget_bytes
        self._size_of = size_of
        self._values: OrderedDict[Hashable, V] = OrderedDict()
        self.held_bytes = 0

    def find(self, key: Hashable) -> V | None:
        """Return the value of ``key``, or None."""
        # Hashing a key takes longer than finding it, so that it is hashed as seldom as possible.
        try:
            self._values.move_to_end(key)
        except KeyError:
            return None
        return self._values[key]

    def add(self, key: Hashable, value: V) -> None:
        """Remember ``value`` under a key that is not known yet."""
        self._values[key] = value
        self.held_bytes += self._size_of(value) + ENTRY_BYTES
        while self.held_bytes > self._budget_bytes and self._values:
            _, oldest = self._values.popitem(last=False)
            self.held_bytes -= self._size_of(oldest) + ENTRY_BYTES

    def get(self, key: Hashable, compute: Callable[[], V]) -> V:
        """Return the value of ``key``; ``compute`` it where it is not remembered."""
        value = self.find(key)
        if value is None:
            value = compute()
            self.add(key, value)
        return value


class MemoryOfHeld(Memory[V]):
    """Memory that finds a value beyond the budget too, as long as somebody else holds it."""

    def __init__(self, budget_bytes: int, size_of: Callable[[V], int]) -> None:
        super().__init__(budget_bytes, size_of)
        self._held: WeakValueDictionary[Hashable, V] = WeakValueDictionary()

    def get(self, key: Hashable, compute: Callable[[], V]) -> V:
        """Return the value of ``key``; ``compute`` it where nobody holds it."""
        value = self.find(key)
        if value is None:
            value = self._held.get(key)
            if value is None:
                value = compute()
                self._held[key] = value
            self.add(key, value)
        return value


_MIB = 2**20

#: Spectra of responses: those of twenty locations for stimuli of four seconds.
RESPONSE_SPECTRA_BYTES = 204 * _MIB
#: Samples of clips, before and after their effects.
CLIPS_BYTES = 10 * _MIB
#: Samples of drives, and as much again for their spectra.
DRIVES_BYTES = 11 * _MIB
#: Spectra of single responses at exact lengths.
EXACT_SPECTRA_BYTES = 12 * _MIB
#: Gains of unit voices.
GAINS_BYTES = 1 * _MIB
#: Operators of the maps of a few limbs.
SURFACES_BYTES = 7 * _MIB

#: Spectra that `skinsource.predict` remembers on top: twice those of twenty locations for stimuli
#: of one second.
PREDICT_BYTES = 128 * _MIB


# Linux begins memory of whole large pages where one begins.
_PAGE_BYTES = 2**21


def untouched_array(shape: tuple[int, ...]) -> Complexes:
    """Return an array; its values mean nothing.

    A large one comes from the system directly, to which it goes back at once.  Linux serves it in
    large pages, without which the first prediction of twenty inputs takes half as long again
    (``benchmarks/predict_speed.py``).
    """
    used_bytes = prod(shape) * np.dtype(np.complex128).itemsize
    if used_bytes < _PAGE_BYTES:
        return np.empty(shape, np.complex128)
    n_bytes = -(-used_bytes // _PAGE_BYTES) * _PAGE_BYTES
    if hasattr(mmap, "MADV_HUGEPAGE"):
        # Only private memory gets them, unless Linux was told otherwise.
        memory = mmap.mmap(-1, n_bytes, flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)
        # Not for an end of less than half a page: a large one would take memory as a whole.
        memory.madvise(mmap.MADV_NOHUGEPAGE)
        memory.madvise(mmap.MADV_HUGEPAGE, 0, round(used_bytes / _PAGE_BYTES) * _PAGE_BYTES)
    else:
        memory = mmap.mmap(-1, n_bytes)
    return np.frombuffer(memory, np.complex128, prod(shape)).reshape(shape)
