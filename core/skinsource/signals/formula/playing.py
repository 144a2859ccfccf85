"""Computes the samples of a formula."""

from dataclasses import replace

import numpy as np

from skinsource.base.arrays import Floats
from skinsource.base.errors import FormulaError
from skinsource.signals.formula.functions import FUNCTIONS, computed, named
from skinsource.signals.formula.reading import Program, Step, around
from skinsource.signals.formula.values import Grid, Value

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
