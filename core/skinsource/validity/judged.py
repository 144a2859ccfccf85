"""What goes with a result wherever it is taken: notes on its limbs, and conditions not kept."""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from skinsource.quoting import sentence
from skinsource.validity.finding import Findings, words_of

_FIELD = re.compile(r"(\{:[^}]*\})")
_UNJUDGED = "whether conditions of the measurement are kept was not judged"


@dataclass(frozen=True, slots=True, kw_only=True)
class Judged:
    """One of the designs that something shows.

    Attributes
    ----------
    label
        What it is called there, such as the title of its limb.
    note
        What there is to note of its limb; "" where there is nothing.
    findings
        Conditions of the measurement; None: they were not judged.
    """

    label: str
    note: str = ""
    findings: Findings | None = None

    def without_maps(self) -> "Judged":
        """The same for what draws no map: nothing is told of what lies between outputs."""
        if self.findings is None:
            return self
        return replace(self, findings=tuple(one for one in self.findings if not one.of_maps))


def in_short(judged: Sequence[Judged]) -> tuple[str, ...]:
    """Notes and conditions that are not kept, a short sentence each, for a caption.

    Where numbers differ between designs, the smallest and the largest are told.
    """
    numbers: dict[str, list[float]] = {}
    for one in judged:
        for found in one.findings or ():
            if found.number is not None:
                numbers.setdefault(found.in_short, []).append(found.number)
    said = _together(judged, _sentences)
    return tuple(
        sentence(whose + (_with_range(words, numbers[words]) if words in numbers else words))
        for whose, words in said
    )


def in_full(judged: Sequence[Judged]) -> tuple[str, ...]:
    """The same as lines for the head of a table, which name what is unknown too."""
    return tuple(f"{whose}{words}" for whose, words in _together(judged, _lines))


def _together(
    judged: Sequence[Judged], said_of: Callable[[Judged], Sequence[str]]
) -> list[tuple[str, str]]:
    """What holds for all of them once, and what holds for some once, with which they are."""
    labels_of: dict[str, list[str]] = {}
    for one in judged:
        for words in dict.fromkeys(said_of(one)):
            labels_of.setdefault(words, []).append(one.label)
    return [
        ("" if len(labels) == len(judged) else f"{', '.join(labels)}: ", words)
        for words, labels in labels_of.items()
    ]


def _with_range(words: str, numbers: Sequence[float]) -> str:
    """The words with their number; with two where numbers look different."""
    before, field, after = _FIELD.split(words, maxsplit=1)
    ends = dict.fromkeys(field.format(one) for one in (min(numbers), max(numbers)))
    return f"{before}{' to '.join(ends)}{after}"


def _sentences(one: Judged) -> list[str]:
    note = [f"{one.note[:1].upper()}{one.note[1:]}"] if one.note else []
    if one.findings is None:
        return [*note, f"{_UNJUDGED[:1].upper()}{_UNJUDGED[1:]}"]
    return [*note, *(found.in_short for found in one.findings if found.in_short)]


def _lines(one: Judged) -> list[str]:
    note = [f"NOTE on the limb: {one.note}"] if one.note else []
    return note + ([f"validity: {_UNJUDGED}"] if one.findings is None else words_of(one.findings))
