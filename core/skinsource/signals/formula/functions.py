"""The functions, names and operators of formulas."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import reduce

import numpy as np

from skinsource.base.conventions import Booleans, Floats
from skinsource.signals.formula.values import PI, Grid, Value, band_noise

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
