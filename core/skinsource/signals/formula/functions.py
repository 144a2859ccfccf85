"""The functions, names and operators of formulas."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import reduce

import numpy as np

from skinsource.base.arrays import Booleans, Floats
from skinsource.signals.formula.values import PI, Grid, Value, band_noise

# Most values of ``min`` and ``max``.
_MOST_VALUES = 20
_TURN = 2 * PI

Compute = Callable[[Grid, tuple[Value, ...]], Value]


@dataclass(frozen=True, slots=True, kw_only=True)
class Function:
    """A function of formulas.

    Attributes
    ----------
    usage, text
        How a user writes it, and what it returns.
    fewest, most
        Limits of the number of its values.
    compute
        Computes the result from the values.
    seeded
        Whether its value is an integer literal.
    """

    usage: str
    text: str
    fewest: int
    most: int
    compute: Compute
    seeded: bool = False


def _plain(usage: str, text: str, compute: Callable[..., Floats], count: int = 1) -> Function:
    """Return a function of the numbers at one instant."""
    return Function(
        usage=usage,
        text=text,
        fewest=count,
        most=count,
        compute=lambda _, values: Value(compute(*(value.at for value in values))),
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


def _of_time(
    usage: str,
    text: str,
    compute: Compute,
    fewest: int = 1,
    most: int | None = None,
    *,
    seeded: bool = False,
) -> Function:
    """Return a function that depends on the instants or on exact values."""
    return Function(
        usage=usage,
        text=text,
        fewest=fewest,
        most=fewest if most is None else most,
        compute=compute,
        seeded=seeded,
    )


#: The functions by name.
FUNCTIONS: dict[str, Function] = {
    "sin": _of_time("sin(x)", "sine of an angle in rad", _of_angle(np.sin)),
    "cos": _of_time("cos(x)", "cosine of an angle in rad", _of_angle(np.cos)),
    "tan": _of_time("tan(x)", "tangent of an angle in rad", _of_angle(np.tan)),
    "exp": _plain("exp(x)", "e to the power of x", np.exp),
    "log": _plain("log(x)", "natural logarithm", np.log),
    "sqrt": _plain("sqrt(x)", "square root", np.sqrt),
    "tanh": _plain("tanh(x)", "hyperbolic tangent, which limits softly to 1", np.tanh),
    "abs": _plain("abs(x)", "magnitude", np.abs),
    "sign": _plain("sign(x)", "-1, 0 or 1", np.sign),
    "floor": _plain("floor(x)", "next whole number below", np.floor),
    "ceil": _plain("ceil(x)", "next whole number above", np.ceil),
    "round": _plain("round(x)", "nearest whole number", np.rint),
    "min": _of_time("min(x, y, ...)", "the smallest", _reduced(np.minimum), 2, _MOST_VALUES),
    "max": _of_time("max(x, y, ...)", "the largest", _reduced(np.maximum), 2, _MOST_VALUES),
    "clip": _plain("clip(x, low, high)", "x within low and high", _clipped, 3),
    "mod": _of_time("mod(x, y)", "rest of x / y, with the sign of y", _modulo, 2),
    "noise": _of_time(
        "noise(seed)",
        "Gaussian noise from 25 to 600 Hz, RMS 1/3; a seed from 0 to 2147483647",
        _noise,
        seeded=True,
    ),
    "step": _of_time("step(t0)", "1 from the time t0 on, 0 before", _step),
    "pulse": _of_time("pulse(t0, length)", "1 from t0 on, for a length", _pulse, 2),
    "gauss": _of_time("gauss(centre, sigma)", "bell in time, of peak 1", _gauss, 2),
    "window": _of_time("window()", "the same as hann()", _hann, 0),
    "hann": _of_time("hann()", "Hann window over the duration", _hann, 0),
    "tukey": _of_time(
        "tukey(share)", "Tukey window over the duration; share of taper, 0.25", _tukey, 0, 1
    ),
    "chirp": _of_time(
        "chirp(f0, f1)", "sine whose frequency goes from f0 to f1 over the duration", _chirp, 2
    ),
}
#: Names of numbers, with what they are.
NAMES = {
    "t": "time since the start, in s",
    "pi": "3.14159…",
    "duration": "duration of the formula, in s",
}
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
