"""Samples in a tree are named by their digest, and held once beside it."""

from typing import Any

from skinsource.errors import FileFormatError
from skinsource.fields import Tree
from skinsource.quoting import quoted
from skinsource.samples import Samples

#: No field of a recipe can be called that.
_REFERENCE = "$samples"


def taken_out(tree: Tree) -> tuple[Tree, dict[str, Samples]]:
    """Return the tree with names in place of samples, and the samples by name."""
    found: dict[str, Samples] = {}

    def walked(part: Tree) -> Tree:
        if isinstance(part, Samples):
            found[part.digest] = part
            return {_REFERENCE: part.digest}
        if isinstance(part, dict):
            return {name: walked(one) for name, one in part.items()}
        return [walked(one) for one in part] if isinstance(part, list) else part

    return walked(tree), found


def put_back(tree: Tree, samples: dict[str, Samples]) -> Tree:
    """Return the tree with samples in place of their names.

    Raises
    ------
    FileFormatError
        Samples are named that are not there, or are there and not named.
    """
    named: set[str] = set()

    def walked(part: Tree) -> Tree:
        if isinstance(part, dict):
            if _REFERENCE in part:
                named.add(_name(part, samples))
                return samples[part[_REFERENCE]]
            return {name: walked(one) for name, one in part.items()}
        return [walked(one) for one in part] if isinstance(part, list) else part

    try:
        whole = walked(tree)
    except RecursionError as error:
        raise FileFormatError("the content is nested too deep") from error
    if len(named) < len(samples):
        raise FileFormatError("the content holds samples that nothing uses")
    return whole


def _name(reference: dict[str, Any], samples: dict[str, Samples]) -> str:
    name = reference[_REFERENCE]
    if len(reference) > 1 or not isinstance(name, str) or name not in samples:
        raise FileFormatError(f"the content names samples {quoted(name)} that are not there")
    return name
