"""What equations become between the samples of a held voltage: exact steps."""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal, get_args

import numpy as np

from skinsource.actuators.equations import OUTPUTS, Equations
from skinsource.actuators.whole_numbers import (
    WholeNumbers,
    bits_for,
    exponential,
    powers,
    product,
    rounded,
    whole_numbers,
)
from skinsource.arrays import Floats

Hold = Literal["zero", "first"]
HOLDS: tuple[Hold, ...] = get_args(Hold)

#: Steps of a block, and blocks of a block of blocks.
BLOCK = 32


@dataclass(frozen=True, slots=True, eq=False)
class Level:
    """How states go on over a block of steps; a step is one sample, or a block of the level below.

    Attributes
    ----------
    carried : (n_states, BLOCK n_states)
        From the state before the block to those after each of its steps.
    added : (BLOCK n_states, BLOCK n_states)
        To them from what each step adds.
    """

    carried: Floats
    added: Floats


@dataclass(frozen=True, slots=True, eq=False)
class Steps:
    """Exact steps, rounded once each.

    Attributes
    ----------
    end : (BLOCK + 1, n_states)
        From the voltages of a block, and the first one after it, to the state at its end.
    driven : (BLOCK + 1, 4 BLOCK)
        From the same voltages to the outputs after each step, step by step.
    carried : (n_states, 4 BLOCK)
        To them from the state before the block.
    step : (n_states, n_states)
        What one step makes of the states where no voltage is.
    levels
        For blocks of blocks, as many as a signal needs.
    """

    end: Floats
    driven: Floats
    carried: Floats
    step: Floats
    levels: tuple[Level, ...]


def steps(equations: Equations, step_s: Fraction, hold: Hold, n_steps: int) -> Steps:
    """Exact steps of equations under a voltage that is held between samples.

    The exponential of the matrix that the equations make with the voltage and its slope beside
    the states gives what one step does; all powers and products are taken before anything is
    rounded.

    Parameters
    ----------
    step_s
        Time between two samples.
    hold
        ``"zero"``: the voltage stays until the next sample; ``"first"``: it goes there evenly.
    n_steps
        For how many steps levels are made.
    """
    n = len(equations.drive)
    dynamics, outputs, passed = _scaled(equations, step_s)
    bits = bits_for((dynamics, outputs, [passed]))
    grown = exponential(whole_numbers(dynamics, bits), bits)
    step, still, rising = grown[:n, :n], grown[:n, n : n + 1], grown[:n, n + 1 :]
    # What the voltage before a step adds to the state after it, and the voltage after it.
    before, after = (still, np.zeros_like(still)) if hold == "zero" else (still - rising, rising)
    read, direct = whole_numbers(outputs, bits), whole_numbers([[part] for part in passed], bits)
    advanced = powers(step, BLOCK, bits)
    # What a voltage adds to the state one step after its sample, two steps after, …
    responses = [
        product(advanced[k], before, bits) + product(advanced[k + 1], after, bits)
        for k in range(BLOCK)
    ]
    # Voltage by voltage, the oldest first: what each adds to the state at the end of the block.
    oldest = [product(advanced[BLOCK - 1], before, bits), *reversed(responses[: BLOCK - 1]), after]
    seen = [product(read, response, bits) for response in responses]
    now = product(read, after, bits) + direct
    first = [product(product(read, power, bits), before, bits) for power in advanced[:BLOCK]]
    return Steps(
        end=rounded(np.hstack(oldest).T, bits),
        driven=_driven(
            [rounded(one, bits)[:, 0] for one in seen],
            rounded(now, bits)[:, 0],
            [rounded(one, bits)[:, 0] for one in first],
        ),
        carried=rounded(np.vstack([product(read, power, bits) for power in advanced[1:]]).T, bits),
        step=rounded(step, bits),
        levels=tuple(_levels(advanced[BLOCK], n_steps // BLOCK, bits)),
    )


def _driven(seen: list[Floats], now: Floats, first: list[Floats]) -> Floats:
    """Outputs by voltages: those at once, one step later, …; the first has no step before it."""
    found = np.zeros((BLOCK + 1, BLOCK, len(OUTPUTS)))
    for end in range(1, BLOCK + 1):
        found[end, end - 1] = now
        for start in range(1, end):
            found[start, end - 1] = seen[end - 1 - start]
        found[0, end - 1] = first[end - 1]
    return found.reshape(BLOCK + 1, -1)


def _levels(step: WholeNumbers, n_steps: int, bits: int) -> Iterator[Level]:
    """Levels for so many steps, each ``step``."""
    n = len(step)
    while n_steps > 0:
        advanced = powers(step, BLOCK, bits)
        floats = [rounded(power, bits) for power in advanced]
        added = np.zeros((BLOCK, n, BLOCK, n))
        for start in range(BLOCK):
            for end in range(start, BLOCK):
                added[start, :, end, :] = floats[end - start].T
        yield Level(
            carried=np.hstack([power.T for power in floats[1:]]),
            added=added.reshape(BLOCK * n, BLOCK * n),
        )
        step, n_steps = advanced[BLOCK], n_steps // BLOCK


def _scaled(
    equations: Equations, step_s: Fraction
) -> tuple[list[list[Fraction]], list[list[Fraction]], list[Fraction]]:
    """Equations for one step, states scaled by powers of two near the roots of their energies.

    Beside the states stand the voltage and what it gains in this step.
    """
    n = len(equations.drive)
    scale = [Fraction(2) ** _half_exponent(storage) for storage in equations.storage]
    matrix = [
        [equations.dynamics[k][j] * step_s * scale[k] / scale[j] for j in range(n)]
        + [equations.drive[k] * step_s * scale[k], Fraction(0)]
        for k in range(n)
    ]
    matrix.append([Fraction(0)] * (n + 1) + [Fraction(1)])
    matrix.append([Fraction(0)] * (n + 2))
    outputs = [[row[j] / scale[j] for j in range(n)] for row in equations.outputs]
    return matrix, outputs, list(equations.passed)


def _half_exponent(number: Fraction) -> int:
    return (number.numerator.bit_length() - number.denominator.bit_length()) // 2
