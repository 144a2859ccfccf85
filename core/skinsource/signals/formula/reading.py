"""Reads formulas: from a text to tokens, and from tokens to a program in postfix order.

Operators wait on a stack for their right side, so nothing recurses.  Every mistake is an error that
names the column.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from difflib import get_close_matches
from functools import lru_cache
from typing import Any, Literal

import numpy as np

from skinsource.base.errors import FormulaError
from skinsource.base.quoting import escaped, printable, quoted
from skinsource.signals.formula.functions import COMPARISONS, FUNCTIONS, NAMES, Function
from skinsource.signals.formula.values import LARGEST_SEED

_BEFORE, _AFTER = 24, 16
_COLUMN = re.compile(r'", column ([0-9]{1,6}): ')


def mistake(text: str, column: int, actual: str, expected: str) -> FormulaError:
    """Return the error for a mistake in a formula: the text near it, what is there, what should be.

    >>> print(mistake("2t", 2, "t", "an operator"))
    formula "2t", column 2: found t, expected an operator
    """
    where = f'formula "{around(text, column)}", column {column}'
    return FormulaError(f"{where}: found {printable(actual)}, expected {expected}", column)


def around(text: str, column: int) -> str:
    """Return the text; of a long one the part near a column."""
    start = max(column - 1 - _BEFORE, 0)
    end = column - 1 + _AFTER
    if start <= 1 and len(text) <= end + 1:
        return escaped(text)
    cut = escaped(text[start:end])
    return f"{'…' if start else ''}{cut}{'…' if end < len(text) else ''}"


def column_of(message: str) -> int | None:
    """Return the column that a message of `mistake` names; None where it names none.

    >>> column_of('formula "2t", column 2: found t, expected an operator')
    2
    """
    match = _COLUMN.search(message)
    return int(match.group(1)) if match else None


StepKind = Literal["number", "name", "operator", "function"]


@dataclass(frozen=True, slots=True)
class Step:
    """One node of the tree; its arguments are the results of earlier steps.

    Attributes
    ----------
    kind, name
        ``"number"``, ``"name"`` (``t``, ``pi``, ``duration``), ``"operator"`` (``negative`` is
        the sign before a value) or ``"function"``.
    column
        Its position in the text, from 1.
    number
        Value of a number.
    takes
        Number of its arguments.
    """

    kind: StepKind
    name: str
    column: int
    number: float = 0.0
    takes: int = 0


@dataclass(frozen=True, slots=True)
class Program:
    """A formula that was read, and its steps in the order of computation.

    The last step gives the result.
    """

    text: str
    steps: tuple[Step, ...]


#: Kinds of tokens; ``end`` follows the last character.
Kind = Literal["number", "name", "operator", "(", ")", ",", "end"]

_WORD = re.compile(
    r"(?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
    r"|(?P<name>[A-Za-z_][A-Za-z_0-9]*|π)"
    r"|(?P<operator>\*\*|//|&&|\|\||<=|>=|==|!=|[-+*/^<>=≤≥·×−])"
    r"|[(),]"
)
# Mathematical signs, and how a keyboard writes them.
_SPELLINGS = {"π": "pi", "·": "*", "×": "*", "−": "-", "≤": "<=", "≥": ">="}
_INSTEAD = {
    "**": "^ for a power",
    "//": "/, and floor() around it",
    "=": "== for a comparison",
    "&&": "* between comparisons",
    "||": "max() of comparisons",
}


@dataclass(frozen=True, slots=True)
class Token:
    """A token and the column, from 1, at which it begins."""

    kind: Kind
    text: str
    column: int

    @property
    def shown(self) -> str:
        """Its name in messages."""
        return "the end" if self.kind == "end" else self.text


def tokens(text: str) -> Iterator[Token]:
    """Give the tokens of a text; the last one is the end.

    Raises
    ------
    FormulaError
        A character means nothing here.
    """
    position = 0
    while position < len(text):
        if text[position].isspace():
            position += 1
            continue
        match = _WORD.match(text, position)
        if match is None:
            raise mistake(
                text, position + 1, text[position], "a number, a name, an operator or a bracket"
            )
        word = match.group()
        if word in _INSTEAD:
            raise mistake(text, position + 1, word, _INSTEAD[word])
        # Of a mark, which is its own kind, the group has no name.
        kind: Any = match.lastgroup or word
        yield Token(kind, _SPELLINGS.get(word, word), position + 1)
        position = match.end()
    yield Token("end", "", len(text) + 1)


#: Most characters of a formula.
LONGEST = 1000
#: Most nodes of the tree.
MAX_STEPS = 500
#: Most brackets and operators that wait for their right side.
MAX_DEPTH = 60

_BINDS = {"+": 2, "-": 2, "*": 3, "/": 3, "negative": 4, "^": 5} | dict.fromkeys(COMPARISONS, 1)
_VALUE = "a number, a name, or ("
_OPERATOR = "an operator"


@lru_cache(maxsize=256)
def read(text: str) -> Program:
    """Return the program of a text.

    Raises
    ------
    FormulaError
        It is no formula, or too long; the error knows the column.
    """
    if not isinstance(text, str):
        raise FormulaError(f"a formula is {quoted(text)}, expected a text")
    if len(text) > LONGEST:
        raise mistake(text, LONGEST + 1, f"{len(text)} characters", f"at most {LONGEST}")
    if not text.strip():
        raise mistake(text, 1, "nothing", "a formula such as sin(2*pi*100*t)")
    reader = _Reader(text)
    for token in tokens(text):
        reader.add(token)
    return Program(text, tuple(reader.steps))


@dataclass(slots=True)
class _Waiting:
    """An operator that waits for its right side, or an open bracket.

    ``call`` is the function of the bracket, ``commas`` the number of its commas so far, and
    ``first_step`` the number of steps before it.
    """

    name: str
    column: int
    call: Function | None = None
    commas: int = 0
    first_step: int = 0


@dataclass(slots=True)
class _Reader:
    """Turns tokens into steps; the steps are complete after the last token."""

    text: str
    steps: list[Step] = field(default_factory=list)
    _stack: list[_Waiting] = field(default_factory=list)
    _expects_value: bool = True
    _called: tuple[Token, Function] | None = None

    def add(self, token: Token) -> None:
        """Add the next token."""
        if self._called is not None:
            self._open_call(token, *self._called)
        elif self._expects_value:
            self._add_value(token)
        else:
            self._add_operator(token)

    def _add_value(self, token: Token) -> None:
        if token.kind == "number":
            number = float(token.text)
            if not np.isfinite(number):
                raise mistake(self.text, token.column, token.text, "a number below 1.8e308")
            self._emit(Step("number", token.text, token.column, number=number))
        elif token.kind == "name":
            self._add_name(token)
        elif token.kind == "(":
            self._wait(_Waiting("(", token.column, first_step=len(self.steps)))
        elif token.kind == "operator" and token.text in "+-":
            if token.text == "-":
                self._wait(_Waiting("negative", token.column))
        elif token.kind == ")" and self._stack and self._is_empty_call(self._stack[-1]):
            self._close(token)
        else:
            raise mistake(self.text, token.column, token.shown, _VALUE)

    def _add_name(self, token: Token) -> None:
        if token.text in FUNCTIONS:
            self._called = (token, FUNCTIONS[token.text])
        elif token.text in NAMES:
            self._emit(Step("name", token.text, token.column))
        else:
            known = (*NAMES, *FUNCTIONS)
            near = get_close_matches(token.text[:20].lower(), known, 1, 0.65)
            expected = near[0] if near else f"one of {', '.join(known)}"
            raise mistake(self.text, token.column, token.text, expected)

    def _open_call(self, token: Token, called: Token, call: Function) -> None:
        if token.kind != "(":
            raise mistake(self.text, token.column, token.shown, f"( as in {call.usage}")
        self._called = None
        self._wait(_Waiting(called.text, called.column, call, first_step=len(self.steps)))

    def _add_operator(self, token: Token) -> None:
        if token.kind == "operator":
            self._finish(_BINDS[token.text], token)
            self._wait(_Waiting(token.text, token.column))
            self._expects_value = True
        elif token.kind == ")":
            self._close(token)
        elif token.kind == ",":
            self._add_comma(token)
        elif token.kind == "end":
            self._finish(0, token)
            if self._stack:
                opened = self._stack[-1].column
                expected = f") for the bracket of column {self._bracket_column(opened)}"
                raise mistake(self.text, token.column, "the end", expected)
        else:
            expected = f"{_OPERATOR}, such as *"
            raise mistake(self.text, token.column, token.shown, expected)

    def _add_comma(self, token: Token) -> None:
        self._finish(0, token)
        opened = self._stack[-1] if self._stack else None
        if opened is None or opened.call is None:
            expected = f"{_OPERATOR}; numbers have a point, as in 0.5"
            raise mistake(self.text, token.column, ",", expected)
        opened.commas += 1
        if opened.commas >= max(opened.call.most, 1):
            raise self._wrong_count(opened, opened.call, f"more than {opened.call.most}")
        self._expects_value = True

    def _close(self, token: Token) -> None:
        empty = self._expects_value
        self._finish(0, token)
        if not self._stack:
            raise mistake(self.text, token.column, ")", f"{_OPERATOR}: no bracket is open")
        opened = self._stack.pop()
        self._expects_value = False
        if opened.call is None:
            return
        count = 0 if empty else opened.commas + 1
        if not opened.call.fewest <= count <= opened.call.most:
            raise self._wrong_count(opened, opened.call, str(count))
        if opened.call.seeded:
            self._check_seed(opened)
        self._emit(Step("function", opened.name, opened.column, takes=count))

    def _wrong_count(self, opened: _Waiting, call: Function, count: str) -> FormulaError:
        few, most = call.fewest, call.most
        many = str(few) if few == most else f"{few} to {most}"
        actual = f"{opened.name} of {count} value{'' if count == '1' else 's'}"
        return mistake(self.text, opened.column, actual, f"{many}, as in {call.usage}")

    def _check_seed(self, opened: _Waiting) -> None:
        arguments = self.steps[opened.first_step :]
        number = arguments[0].number
        is_integer = len(arguments) == 1 and arguments[0].kind == "number" and number == int(number)
        if not is_integer or number > LARGEST_SEED:
            column = arguments[0].column
            actual = arguments[0].name if len(arguments) == 1 else "a computed seed"
            expected = f"a whole number from 0 to {LARGEST_SEED}, as in noise(1)"
            raise mistake(self.text, column, actual, expected)

    def _finish(self, binding: int, token: Token) -> None:
        """Emit the waiting operators that bind more strongly than ``token``."""
        while self._stack and self._stack[-1].name in _BINDS:
            waiting = self._stack[-1]
            strength = _BINDS[waiting.name]
            if strength < binding or (strength == binding and token.text == "^"):
                return
            if strength == binding == _BINDS["<"]:
                expected = "one comparison; write (a < b) * (b < c) for both"
                raise mistake(self.text, token.column, token.text, expected)
            self._stack.pop()
            takes = 1 if waiting.name == "negative" else 2
            self._emit(Step("operator", waiting.name, waiting.column, takes=takes))

    def _wait(self, waiting: _Waiting) -> None:
        if len(self._stack) >= MAX_DEPTH:
            actual = "-" if waiting.name == "negative" else waiting.name
            expected = f"at most {MAX_DEPTH} brackets and operators within each other"
            raise mistake(self.text, waiting.column, actual, expected)
        self._stack.append(waiting)

    def _emit(self, step: Step) -> None:
        if len(self.steps) >= MAX_STEPS:
            expected = f"at most {MAX_STEPS} numbers, names and operators"
            raise mistake(self.text, step.column, "one more", expected)
        self.steps.append(step)
        self._expects_value = False

    def _is_empty_call(self, waiting: _Waiting) -> bool:
        return (
            waiting.call is not None
            and waiting.commas == 0
            and waiting.first_step == len(self.steps)
        )

    def _bracket_column(self, column: int) -> int:
        """Return the column of the bracket of a function at ``column``."""
        return self.text.index("(", column - 1) + 1
