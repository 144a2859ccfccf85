"""A formula that was read: its tree in postfix order."""

from dataclasses import dataclass
from typing import Literal

StepKind = Literal["number", "name", "operator", "function"]


@dataclass(frozen=True, slots=True)
class Step:
    """One node of the tree; its arguments are the results of the steps before it.

    Attributes
    ----------
    kind, name
        ``"number"``, ``"name"`` (``t``, ``pi``, ``duration``), ``"operator"`` (``negative`` is
        the one before a value) or ``"function"``.
    column
        Where it stands in the text, from 1.
    number
        Value of a number.
    takes
        How many results it takes.
    """

    kind: StepKind
    name: str
    column: int
    number: float = 0.0
    takes: int = 0


@dataclass(frozen=True, slots=True)
class Program:
    """What a text says, step by step.

    Attributes
    ----------
    text
        As it was written.
    steps
        In the order in which they are computed; the last one gives the result.
    """

    text: str
    steps: tuple[Step, ...]
