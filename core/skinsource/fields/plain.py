"""Plain data whose meaning others know."""

from dataclasses import dataclass
from math import isfinite
from typing import Any

from skinsource.fields.spec import Address, Misfit, Spec, Tree

_MAX_PARTS, _MAX_DEPTH, _MAX_CHARACTERS = 10_000, 8, 10_000
_EXPECTED = "None, True, False, finite numbers, texts, and tuples of them"


@dataclass(frozen=True, slots=True, kw_only=True)
class PlainSpec(Spec):
    """None, True, False, numbers, texts, and tuples of these: what a panel keeps."""

    def checked(self, value: Any) -> Any:
        """Return ``value`` itself."""
        if _parts(value, _MAX_DEPTH) > _MAX_PARTS:
            raise Misfit(f"at most {_MAX_PARTS} parts")
        return value

    def encoded(self, value: Any) -> Tree:
        """Return lists in place of tuples."""
        return [self.encoded(part) for part in value] if isinstance(value, tuple) else value

    def decoded(self, tree: Tree, at: Address) -> Any:
        """Return tuples in place of lists."""
        if isinstance(tree, list):
            return tuple(self.decoded(part, at.inside(k)) for k, part in enumerate(tree))
        return tree


def _parts(value: Any, depth: int) -> int:
    if isinstance(value, tuple):
        if depth == 0:
            raise Misfit(f"tuples in tuples at most {_MAX_DEPTH} deep")
        return 1 + sum(_parts(part, depth - 1) for part in value)
    sound = value is None or isinstance(value, bool)
    sound = sound or (isinstance(value, int) and abs(value) < 2**63)
    sound = sound or (isinstance(value, float) and isfinite(value))
    if not sound and not (isinstance(value, str) and _can_be_written(value)):
        raise Misfit(_EXPECTED)
    return 1


def _can_be_written(text: str) -> bool:
    # Half of a pair of surrogates is no text that a file can hold.
    return len(text) <= _MAX_CHARACTERS and not any("\ud800" <= one <= "\udfff" for one in text)
