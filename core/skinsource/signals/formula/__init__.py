"""A small language for signals: ``sin(2*pi*100*t) * hann()``.

Numbers, ``t`` (s, 0 at the start), ``duration`` (s), ``pi``; ``+ - * / ^`` and brackets as in
mathematics, so that ``-t^2`` is below zero and ``2^3^2`` is 512; comparisons, which are 1 or 0;
and the functions of `FUNCTIONS`.  There is nothing else: a text is read by `read`, never by
Python, and no text takes long, because its length, its nesting and its steps are limited.

The text becomes a `Program`: the tree in postfix order, so that neither reading nor playing it
goes deeper the more it is nested.  `played` is the signal at the samples.
"""

from skinsource.signals.formula.functions import FUNCTIONS, Function
from skinsource.signals.formula.playing import played
from skinsource.signals.formula.reading import (
    LONGEST,
    MAX_DEPTH,
    MAX_STEPS,
    Program,
    column_of,
    read,
)

__all__ = [
    "FUNCTIONS",
    "LONGEST",
    "MAX_DEPTH",
    "MAX_STEPS",
    "Function",
    "Program",
    "column_of",
    "played",
    "read",
]
