"""Remembers values up to a budget; the least recently used go first."""

from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import Generic, TypeVar

V = TypeVar("V")

#: What an entry takes beside its value: key, and a place in the dictionary.
ENTRY_BYTES = 1000


class Memory(Generic[V]):
    """Values by key; it belongs to one thread.

    Parameters
    ----------
    budget_bytes
        What all entries together may take.
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
        # A key takes longer to hash than to find: no more often than needed.
        try:
            self._values.move_to_end(key)
        except KeyError:
            return None
        return self._values[key]

    def add(self, key: Hashable, value: V) -> None:
        """Remember ``value``, which was not known."""
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
