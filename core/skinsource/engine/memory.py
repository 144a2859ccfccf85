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


# How much memory may hold what was computed before.
#
# Each is what graphs that share hold together; limbs, with the responses that were read, and the
# latest result of each rule come on top.

_MIB = 2**20

#: Spectra of responses: those of twenty places for stimuli of four seconds.
RESPONSE_SPECTRA_BYTES = 204 * _MIB
#: Samples of clips, before and after their effects.
CLIPS_BYTES = 10 * _MIB
#: Drives, as samples, and as much again as spectra.
DRIVES_BYTES = 11 * _MIB
#: Spectra of single responses at exact lengths.
EXACT_SPECTRA_BYTES = 12 * _MIB
#: Gains of unit voices.
GAINS_BYTES = 1 * _MIB
#: Operators of the maps of a few limbs.
SURFACES_BYTES = 7 * _MIB

#: All of them together.
TOTAL_BYTES = (
    RESPONSE_SPECTRA_BYTES
    + CLIPS_BYTES
    + 2 * DRIVES_BYTES
    + EXACT_SPECTRA_BYTES
    + GAINS_BYTES
    + SURFACES_BYTES
)

#: What `skinsource.predict` remembers, beside all of that: twice what twenty places take for
#: stimuli of one second.
PREDICT_BYTES = 128 * _MIB
#: Gains that it remembers.
PREDICT_GAINS_BYTES = 1 * _MIB
