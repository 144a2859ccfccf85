"""Reads formulas, from a text to a program in postfix order, and computes their samples.

A text is read by recursive descent, no deeper than `MAX_DEPTH`.  Every mistake is an error that
names the column.
"""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from difflib import get_close_matches
from functools import lru_cache, reduce
from typing import Any, Literal

import numpy as np

from skinsource.base.conventions import Booleans, Floats
from skinsource.base.errors import FormulaError, escaped, printable, quoted
from skinsource.signals.formula.values import LARGEST_SEED, PI, Grid, Value, band_noise

# Most values of ``min`` and ``max``.
_MOST_VALUES = 20
_TURN = 2 * PI

Compute = Callable[[Grid, tuple[Value, ...]], Value]


@dataclass(frozen=True, slots=True)
class Function:
    """A function of formulas.

    Attributes
    ----------
    usage
        How a user writes it.
    compute
        Computes the result from the values.
    fewest, most
        Limits of the number of its values.
    seeded
        Whether its value is an integer literal.
    """

    usage: str
    compute: Compute
    fewest: int = 1
    most: int = 1
    seeded: bool = False


def _plain(usage: str, compute: Callable[..., Floats], count: int = 1) -> Function:
    """Return a function of the numbers at one instant."""
    return Function(
        usage, lambda _, values: Value(compute(*(value.at for value in values))), count, count
    )


def _angle(grid: Grid, values: tuple[Value, ...]) -> Floats:
    """Return an angle without whole turns, in radians."""
    return 2 * np.pi * values[0].cycles(_TURN, grid)


def _modulo(grid: Grid, values: tuple[Value, ...]) -> Value:
    value, divisor = values
    period = divisor.constant
    if period is None or value.exact is None or period <= 0:
        return Value(np.mod(value.at, divisor.at))
    share = value.cycles(period, grid)
    # A number below an integer by less than a rounding error is that integer.
    rest = np.where(share < -1e-15, share + 1.0, np.maximum(share, 0.0))
    return Value(rest * divisor.at)


def _hann(grid: Grid, _: tuple[Value, ...]) -> Value:
    return Value(0.5 * (1.0 - np.cos(2.0 * np.pi * grid.instants / grid.duration_s)))


def _tukey(grid: Grid, values: tuple[Value, ...]) -> Value:
    share = values[0].at if values else np.float64(0.25)
    t = grid.instants
    taper = np.clip(share, 0.0, 1.0) * grid.duration_s / 2.0
    from_end = np.minimum(t, grid.duration_s - t)
    rising = 0.5 * (1.0 - np.cos(np.pi * from_end / taper))
    return Value(np.where(from_end < taper, rising, 1.0) + 0.0 * share)


def _step(grid: Grid, values: tuple[Value, ...]) -> Value:
    return Value(_or_nan(grid.instants >= values[0].at, values[0].at))


def _pulse(grid: Grid, values: tuple[Value, ...]) -> Value:
    start, length = values[0].at, values[1].at
    since = grid.instants - start
    return Value(_or_nan((since >= 0) & (since < length), start, length))


def _or_nan(yes: Booleans, *values: Floats) -> Floats:
    """Return 1 or 0, or NaN where one of ``values`` is NaN."""
    known = reduce(np.logical_and, (~np.isnan(value) for value in values))
    return np.where(known, yes.astype(float), np.nan)


def _gauss(grid: Grid, values: tuple[Value, ...]) -> Value:
    return Value(np.exp(-0.5 * ((grid.instants - values[0].at) / values[1].at) ** 2))


def _chirp(grid: Grid, values: tuple[Value, ...]) -> Value:
    start, end = values
    t = Value.time(grid)
    twice = Value.of(2.0)
    turns = start * t + (end - start) / (twice * Value.of(grid.duration_s)) * (t * t)
    return Value(np.sin(_angle(grid, (twice * Value.pi() * turns,))))


def _noise(grid: Grid, values: tuple[Value, ...]) -> Value:
    return Value(band_noise(int(values[0].at), grid))


def _reduced(of_two: np.ufunc) -> Compute:
    return lambda _, values: Value(reduce(of_two, (value.at for value in values)))


def _clipped(value: Floats, low: Floats, high: Floats) -> Floats:
    return np.minimum(np.maximum(value, low), high)


def _of_angle(compute: np.ufunc) -> Compute:
    return lambda grid, values: Value(compute(_angle(grid, values)))


#: The functions by name; docs/formulas.md says what they return.
FUNCTIONS: dict[str, Function] = {
    "sin": Function("sin(x)", _of_angle(np.sin)),
    "cos": Function("cos(x)", _of_angle(np.cos)),
    "tan": Function("tan(x)", _of_angle(np.tan)),
    "exp": _plain("exp(x)", np.exp),
    "log": _plain("log(x)", np.log),
    "sqrt": _plain("sqrt(x)", np.sqrt),
    "tanh": _plain("tanh(x)", np.tanh),
    "abs": _plain("abs(x)", np.abs),
    "sign": _plain("sign(x)", np.sign),
    "floor": _plain("floor(x)", np.floor),
    "ceil": _plain("ceil(x)", np.ceil),
    "round": _plain("round(x)", np.rint),
    "min": Function("min(x, y, ...)", _reduced(np.minimum), 2, _MOST_VALUES),
    "max": Function("max(x, y, ...)", _reduced(np.maximum), 2, _MOST_VALUES),
    "clip": _plain("clip(x, low, high)", _clipped, 3),
    "mod": Function("mod(x, y)", _modulo, 2, 2),
    "noise": Function("noise(seed)", _noise, seeded=True),
    "step": Function("step(t0)", _step),
    "pulse": Function("pulse(t0, length)", _pulse, 2, 2),
    "gauss": Function("gauss(centre, sigma)", _gauss, 2, 2),
    "window": Function("window()", _hann, 0, 0),
    "hann": Function("hann()", _hann, 0, 0),
    "tukey": Function("tukey(share)", _tukey, 0, 1),
    "chirp": Function("chirp(f0, f1)", _chirp, 2, 2),
}
#: Names of numbers.
NAMES = ("t", "pi", "duration")
_COMPARISONS: dict[str, Callable[[Floats, Floats], Booleans]] = {
    "<": np.less,
    "<=": np.less_equal,
    ">": np.greater,
    ">=": np.greater_equal,
    "==": np.equal,
    "!=": np.not_equal,
}
COMPARISONS = frozenset(_COMPARISONS)
_ARITHMETIC: dict[str, Callable[[Value, Value], Value]] = {
    "+": Value.__add__,
    "-": Value.__sub__,
    "*": Value.__mul__,
    "/": Value.__truediv__,
    "^": Value.__pow__,
}


def computed(operator: str, values: tuple[Value, ...]) -> Value:
    """Return the result of an operator on one or two values; that of a comparison is 1 or 0."""
    if operator == "negative":
        return -values[0]
    left, right = values
    if operator in _COMPARISONS:
        return Value(_or_nan(_COMPARISONS[operator](left.at, right.at), left.at, right.at))
    return _ARITHMETIC[operator](left, right)


def named(name: str, grid: Grid) -> Value:
    """Return the value of a name."""
    if name == "t":
        return Value.time(grid)
    return Value.pi() if name == "pi" else Value.of(grid.duration_s)


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
    reader.read()
    return Program(text, tuple(reader.steps))


class _Reader:
    """Turns the tokens of a text into steps, each part by a method of its own."""

    def __init__(self, text: str) -> None:
        self.steps: list[Step] = []
        self._text, self._depth = text, 0
        self._rest = tokens(text)
        self._token = next(self._rest)

    def read(self) -> None:
        """Read the whole text."""
        self._add_expression(0)
        if self._token.kind != "end":
            raise self._misplaced(None)

    def _take(self) -> None:
        self._token = next(self._rest)

    def _add_expression(self, binding: int) -> None:
        """Read a value, and the operators after it that bind more strongly."""
        self._add_value()
        while self._token.kind == "operator":
            token = self._token
            strength = _BINDS[token.text]
            if strength == binding == _BINDS["<"]:
                expected = "one comparison; write (a < b) * (b < c) for both"
                raise mistake(self._text, token.column, token.text, expected)
            if strength < binding or (strength == binding and token.text != "^"):
                return
            self._take()
            self._add_inner(token.text, token.column, strength)
            self._emit(Step("operator", token.text, token.column, takes=2))

    def _add_inner(self, name: str, column: int, binding: int) -> None:
        """Read what stands in a bracket, or on the right of an operator."""
        if self._depth >= MAX_DEPTH:
            expected = f"at most {MAX_DEPTH} brackets and operators within each other"
            raise mistake(self._text, column, name, expected)
        self._depth += 1
        self._add_expression(binding)
        self._depth -= 1

    def _add_value(self) -> None:
        while self._token.kind == "operator" and self._token.text == "+":
            self._take()
        token = self._token
        if token.kind == "number":
            number = float(token.text)
            if not np.isfinite(number):
                raise mistake(self._text, token.column, token.text, "a number below 1.8e308")
            self._take()
            self._emit(Step("number", token.text, token.column, number=number))
        elif token.kind == "name":
            if token.text in FUNCTIONS:
                self._take()
                self._add_call(token, FUNCTIONS[token.text])
            elif token.text in NAMES:
                self._take()
                self._emit(Step("name", token.text, token.column))
            else:
                known = (*NAMES, *FUNCTIONS)
                near = get_close_matches(token.text[:20].lower(), known, 1, 0.65)
                expected = near[0] if near else f"one of {', '.join(known)}"
                raise mistake(self._text, token.column, token.text, expected)
        elif token.kind == "(":
            self._take()
            self._add_inner("(", token.column, 0)
            if self._token.kind != ")":
                raise self._misplaced(token.column)
            self._take()
        elif token.text == "-":
            self._take()
            self._add_inner("-", token.column, _BINDS["negative"])
            self._emit(Step("operator", "negative", token.column, takes=1))
        else:
            raise mistake(self._text, token.column, token.shown, _VALUE)

    def _add_call(self, name: Token, call: Function) -> None:
        opened = self._token
        if opened.kind != "(":
            raise mistake(self._text, opened.column, opened.shown, f"( as in {call.usage}")
        self._take()
        first, count = len(self.steps), 0
        while count or self._token.kind != ")":
            self._add_inner(name.text, name.column, 0)
            count += 1
            if self._token.kind != ",":
                break
            if count >= max(call.most, 1):
                raise self._wrong_count(name, call, f"more than {call.most}")
            self._take()
        if self._token.kind != ")":
            raise self._misplaced(opened.column)
        if not call.fewest <= count <= call.most:
            raise self._wrong_count(name, call, str(count))
        if call.seeded:
            self._check_seed(self.steps[first:])
        self._emit(Step("function", name.text, name.column, takes=count))
        self._take()

    def _misplaced(self, opened: int | None) -> FormulaError:
        """Return the error for what stands where only an operator can, or the end of a bracket."""
        token, expected = self._token, f"{_OPERATOR}, such as *"
        if token.kind == "end":
            expected = f") for the bracket of column {opened}"
        elif token.kind == ",":
            expected = f"{_OPERATOR}; numbers have a point, as in 0.5"
        elif token.kind == ")":
            expected = f"{_OPERATOR}: no bracket is open"
        return mistake(self._text, token.column, token.shown, expected)

    def _wrong_count(self, name: Token, call: Function, count: str) -> FormulaError:
        few, most = call.fewest, call.most
        many = str(few) if few == most else f"{few} to {most}"
        actual = f"{name.text} of {count} value{'' if count == '1' else 's'}"
        return mistake(self._text, name.column, actual, f"{many}, as in {call.usage}")

    def _check_seed(self, arguments: list[Step]) -> None:
        number = arguments[0].number
        is_integer = len(arguments) == 1 and arguments[0].kind == "number" and number == int(number)
        if not is_integer or number > LARGEST_SEED:
            column = arguments[0].column
            actual = arguments[0].name if len(arguments) == 1 else "a computed seed"
            expected = f"a whole number from 0 to {LARGEST_SEED}, as in noise(1)"
            raise mistake(self._text, column, actual, expected)

    def _emit(self, step: Step) -> None:
        if len(self.steps) >= MAX_STEPS:
            expected = f"at most {MAX_STEPS} numbers, names and operators"
            raise mistake(self._text, step.column, "one more", expected)
        self.steps.append(step)


# Long signals are computed in parts of this many samples, to limit the memory.
_CHUNK = 2**16


def played(
    program: Program, count: int, sample_rate_hz: float, shift_s: float, duration_s: float
) -> Floats:
    """Return the formula at ``k / sample_rate_hz - shift_s``, k = 0 … count - 1, (count,).

    It is 0 before time 0 and from ``duration_s`` on.  The phase of ``sin``, ``cos`` and
    ``tan``, as far as it is a number times ``t`` or ``t^2``, is exact to 1e-12 up to an hour; so
    is ``mod``.  All else is float64, as Python computes it.

    Raises
    ------
    FormulaError
        A result is no finite number; the error names the instant and the part of the formula.
    """
    samples = np.zeros(count)
    for first in range(0, count, _CHUNK):
        grid = Grid(
            first=first,
            count=min(_CHUNK, count - first),
            rate_hz=float(sample_rate_hz),
            shift_s=float(shift_s),
            duration_s=float(duration_s),
        )
        is_playing = (grid.instants >= 0.0) & (grid.instants < duration_s)
        part = np.where(is_playing, _result(program, grid), 0.0)
        if not np.isfinite(part).all():
            raise _not_finite(program, grid, int(np.argmin(np.isfinite(part))))
        samples[first : first + grid.count] = part
    return samples


def _result(program: Program, grid: Grid) -> Floats:
    stack: list[Value] = []
    with np.errstate(all="ignore"):
        for step in program.steps:
            _compute(step, grid, stack)
    return np.broadcast_to(stack[0].at, (grid.count,))


def _compute(step: Step, grid: Grid, stack: list[Value]) -> None:
    arguments = tuple(stack[len(stack) - step.takes :])
    del stack[len(stack) - step.takes :]
    if step.kind == "number":
        stack.append(Value.of(step.number))
    elif step.kind == "name":
        stack.append(named(step.name, grid))
    elif step.kind == "function":
        stack.append(FUNCTIONS[step.name].compute(grid, arguments))
    else:
        stack.append(computed(step.name, arguments))


def _not_finite(program: Program, grid: Grid, index: int) -> FormulaError:
    """Return the error for a sample that is no number; compute it alone to find the step."""
    alone = replace(grid, first=grid.first + index, count=1)
    column, text, value = 1, "", np.nan
    stack: list[Value] = []
    with np.errstate(all="ignore"):
        for step in program.steps:
            _compute(step, alone, stack)
            value = float(np.broadcast_to(stack[-1].at, (1,))[0])
            if not np.isfinite(value):
                column = step.column
                text = "-" if step.name == "negative" else step.name
                break
    kind = "no number" if np.isnan(value) else "infinite"
    return FormulaError(
        f'formula "{around(program.text, column)}", column {column}: {text} is {kind} at '
        f"{alone.instants[0]:.6g} s, expected finite numbers; divide by what is never 0, or clip()",
        column,
    )
