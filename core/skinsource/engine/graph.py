"""Demand-driven evaluation of named quantities.

A *rule* is a pure function.  Its name is the quantity it computes; its parameters name the
quantities it needs.  That is all the wiring there is.
"""

from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from difflib import get_close_matches
from graphlib import TopologicalSorter
from inspect import signature
from operator import is_
from typing import Any, NamedTuple

import numpy as np

from skinsource.base.errors import quoted
from skinsource.base.job import Stop, never, stop_if
from skinsource.base.work import Work, counting


class UnknownQuantity(LookupError):
    """No rule computes the requested quantity."""


class Graph:
    """Computes the requested quantities and nothing else; recomputes only what changed.

    It is not thread-safe: a graph belongs to one thread.

    Attributes
    ----------
    runs
        How often each rule has run.
    work
        Work done by the latest evaluation.

    Raises
    ------
    CycleError
        Rules need each other in a circle.
    """

    def __init__(self, *rules: Callable[..., Any]) -> None:
        self._rules = {_name(rule): rule for rule in rules}
        self._needs = {
            name: tuple(signature(rule).parameters) for name, rule in self._rules.items()
        }
        self._sorted = tuple(TopologicalSorter(self._needs).static_order())
        self._orders: dict[tuple[frozenset[str], frozenset[str]], tuple[_Step, ...]] = {}
        self._memo: dict[str, tuple[list[Any], Any]] = {}
        self.runs: Counter[str] = Counter()
        self.work = Work()

    @property
    def rules(self) -> dict[str, Callable[..., Any]]:
        """The rules, by name."""
        return dict(self._rules)

    @property
    def held_bytes(self) -> int:
        """Memory of the arrays among the latest results."""
        results = [result for _, result in self._memo.values()]
        return sum(result.nbytes for result in results if isinstance(result, np.ndarray))

    def keep_only(self, names: Iterable[str]) -> None:
        """Drop all results but these."""
        self._memo = {name: self._memo[name] for name in names if name in self._memo}

    def needs_of(self, name: str) -> tuple[str, ...]:
        """Return the quantities that a rule needs, in its order; none for a given quantity."""
        return tuple(need for need in self._needs.get(name, ()) if need != "stop")

    def upstream_of(self, names: Iterable[str]) -> frozenset[str]:
        """Return all quantities that ``names`` depend on, computed or given, and themselves."""
        upstream: set[str] = set()
        waiting = set(names)
        while waiting:
            name = waiting.pop()
            if name in self._rules:
                waiting.update(need for need in self.needs_of(name) if need not in upstream)
            upstream.add(name)
        return frozenset(upstream)

    def evaluate(
        self,
        wanted: Iterable[str],
        given: Mapping[str, Any],
        stop: Stop = never,
    ) -> dict[str, Any]:
        """Return the ``wanted`` quantities, starting from the ``given`` ones.

        ``stop`` is called before each rule runs; once it returns True,
        `skinsource.base.errors.Stopped` is raised.  A rule that takes long has a last parameter
        ``stop`` and calls it itself.
        """
        known = {"stop": stop, **given}
        wanted = frozenset(wanted)
        with counting() as self.work:
            for step in self._order(wanted, frozenset(known)):
                known[step.name] = self._refresh(step, known)
        if self._memo.keys() - known.keys():
            self._forget_outdated(known)
        return {name: known[name] for name in wanted}

    def _order(self, wanted: frozenset[str], known: frozenset[str]) -> "tuple[_Step, ...]":
        """Return the rules that lead from known to wanted quantities, each after those it needs."""
        if (wanted, known) not in self._orders:
            steps: dict[str, _Step] = {}
            for name in sorted(wanted):
                self._add(name, known, steps)
            self._orders[wanted, known] = tuple(steps.values())
        return self._orders[wanted, known]

    def _add(self, name: str, known: frozenset[str], steps: "dict[str, _Step]") -> None:
        if name in known or name in steps:
            return
        if name not in self._rules:
            close = get_close_matches(name, list(self._rules), n=1)
            hint = f"; perhaps {quoted(close[0])} is meant" if close else ""
            raise UnknownQuantity(f"no rule computes {quoted(name)}{hint}")
        for need in self._needs[name]:
            self._add(need, known, steps)
        # ``stop`` is passed on, but the result does not depend on it.
        takes_stop = "stop" in self._needs[name]
        steps[name] = _Step(name, self._rules[name], self.needs_of(name), takes_stop)

    def _refresh(self, step: "_Step", known: dict[str, Any]) -> Any:
        name = step.name
        inputs = [known[need] for need in step.needs]
        memo = self._memo.get(name)
        if memo is not None and _all_same(memo[0], inputs):
            return memo[1]
        stop_if(known["stop"])
        if memo is not None and isinstance(memo[1], np.ndarray):
            # Arrays are never compared, so the old one is freed first.
            self._drop(name)
            memo = None
        stop = {"stop": known["stop"]} if step.takes_stop else {}
        result = step.rule(*inputs, **stop)
        self.runs[name] += 1
        self.work.rules_run += 1
        if memo is not None and _same(memo[1], result):
            result = memo[1]  # equal, so that results that depend on it stay valid
        else:
            _freeze(result)  # it is remembered, and other threads read it
        self._memo[name] = inputs, result
        return result

    def _drop(self, name: str) -> None:
        """Drop a result with all that was made of it, and may hold it; small arrays hold little."""
        _, result = self._memo.pop(name)
        if not isinstance(result, np.ndarray) or result.nbytes >= _LARGE_BYTES:
            for user, needs in self._needs.items():
                if name in needs and user in self._memo:
                    self._drop(user)

    def _forget_outdated(self, known: dict[str, Any]) -> None:
        """Drop results of other rules that were computed from what has changed since.

        Nobody can use them again, and they would hold the arrays of designs of long ago.
        """
        for name in self._sorted:
            if name in self._memo and name not in known:
                inputs, _ = self._memo[name]
                present = [
                    known.get(need, self._memo.get(need, (None, _GONE))[1])
                    for need in self.needs_of(name)
                ]
                if not _all_same(inputs, present):
                    del self._memo[name]


_LARGE_BYTES = 2**20
#: In place of a quantity that is neither given nor remembered.
_GONE = object()


class _Step(NamedTuple):
    """A rule and the quantities that it needs."""

    name: str
    rule: Callable[..., Any]
    needs: tuple[str, ...]
    takes_stop: bool


def _all_same(old: list[Any], new: list[Any]) -> bool:
    # Most values are the same objects as before, which is quick to find out.
    return all(map(is_, old, new)) or all(map(_same, old, new))


def _name(rule: Callable[..., Any]) -> str:
    return str(rule.__name__)


def _same(old: Any, new: Any) -> bool:
    # Arrays are compared by identity: a rule that did not run returned the same object.
    if old is new:
        return True
    if isinstance(old, np.ndarray):
        return False
    if isinstance(old, tuple) and isinstance(new, tuple):
        return len(old) == len(new) and all(map(_same, old, new))
    return type(old) is type(new) and bool(old == new)


def _freeze(result: Any) -> None:
    if isinstance(result, np.ndarray):
        result.flags.writeable = False
    elif isinstance(result, tuple):
        for part in result:
            _freeze(part)
