"""The words of a formula."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from skinsource.formula.mistake import mistake

#: ``end`` stands after the last character.
Kind = Literal["number", "name", "operator", "(", ")", ",", "end"]

_WORD = re.compile(
    r"(?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
    r"|(?P<name>[A-Za-z_][A-Za-z_0-9]*|π)"
    r"|(?P<operator>\*\*|//|&&|\|\||<=|>=|==|!=|[-+*/^<>=≤≥·×−])"
    r"|(?P<mark>[(),])"
)
#: What mathematics writes, as the keyboard does.
_SAME = {"π": "pi", "·": "*", "×": "*", "−": "-", "≤": "<=", "≥": ">="}
_INSTEAD = {
    "**": "^ for a power",
    "//": "/, and floor() around it",
    "=": "== for a comparison",
    "&&": "* between comparisons",
    "||": "max() of comparisons",
}


@dataclass(frozen=True, slots=True)
class Token:
    """A word and the column, from 1, at which it begins."""

    kind: Kind
    text: str
    column: int

    @property
    def shown(self) -> str:
        """How a message calls it."""
        return "the end" if self.kind == "end" else self.text


def tokens(text: str) -> Iterator[Token]:
    """Take a text apart; the last token is the end.

    Raises
    ------
    FormulaError
        A character means nothing here.
    """
    place = 0
    while place < len(text):
        if text[place].isspace():
            place += 1
            continue
        found = _WORD.match(text, place)
        if found is None:
            raise mistake(
                text, place + 1, text[place], "a number, a name, an operator or a bracket"
            )
        word = found.group()
        if word in _INSTEAD:
            raise mistake(text, place + 1, word, _INSTEAD[word])
        word_as_typed = _SAME.get(word, word)
        yield Token(_kind(found), word_as_typed, place + 1)
        place = found.end()
    yield Token("end", "", len(text) + 1)


def _kind(found: re.Match[str]) -> Kind:
    if found.group("number") is not None:
        return "number"
    if found.group("name") is not None:
        return "name"
    if found.group("operator") is not None:
        return "operator"
    mark = found.group("mark")
    return "(" if mark == "(" else ")" if mark == ")" else ","
