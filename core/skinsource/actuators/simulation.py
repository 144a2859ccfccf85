"""Motion of an actuator under a sampled voltage, exact for the way the voltage is held."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from skinsource.base.arguments import finite_array, one_of
from skinsource.base.conventions import Floats
from skinsource.base.errors import InvalidInputError
from skinsource.base.work import tally
from skinsource.signals.generators import MAX_SAMPLES


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ActuatorMotion:
    """Motion of what touches the skin, at the samples of the voltage.

    Attributes
    ----------
    acceleration, velocity, displacement : (n_times,)
        In m/s², m/s and m.
    current : (n_times,)
        Into the actuator, in A.
    """

    acceleration: Floats
    velocity: Floats
    displacement: Floats
    current: Floats


Hold = Literal["zero", "first"]
HOLDS: tuple[Hold, ...] = get_args(Hold)
OUTPUTS = ("acceleration", "velocity", "displacement", "current")

# Steps that one matrix product computes.
_BLOCK = 32


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Equations:
    """The linear equations of an actuator: x' = A x + b u, states x and voltage u.

    Attributes
    ----------
    dynamics, drive
        A, (n_states, n_states), in 1/s, and b, (n_states,); b changes no velocity at once.
    velocity, displacement, current : (n_states,)
        What the states give.
    passed_a_per_v
        Current that a voltage gives at once.
    """

    dynamics: ArrayLike
    drive: ArrayLike
    velocity: ArrayLike
    displacement: ArrayLike
    current: ArrayLike
    passed_a_per_v: float = 0.0


def simulated(
    equations: Equations, voltage: ArrayLike, step_s: float, hold: Hold
) -> ActuatorMotion:
    """Return the motion at the samples of a voltage, (n_times,), from rest.

    A sum over blocks of samples and over blocks of blocks: rounding grows with their number only
    where nothing is damped.
    """
    samples = samples_of(voltage, hold)
    tally(samples_moved=samples.size)
    # At rest, but what the first sample passes on at once.
    outputs = np.zeros((len(OUTPUTS), samples.size))
    outputs[-1, :1] = equations.passed_a_per_v * samples[:1]
    if samples.size > 1:
        _fill_outputs(outputs[:, 1:], samples, step_matrix(equations, step_s, hold))
    if not np.isfinite(outputs).all():
        raise InvalidInputError(
            "the motion overflows; lower the voltage, or choose parameters nearer to those of real "
            "actuators"
        )
    return ActuatorMotion(**dict(zip(OUTPUTS, outputs, strict=True)))


def samples_of(voltage: ArrayLike, hold: Hold) -> Floats:
    """Return the voltage as one row of floats; raise where it or ``hold`` is unusable."""
    samples = finite_array("voltage", voltage, "finite numbers in V, (n_times,)")
    if samples.ndim != 1 or samples.size > MAX_SAMPLES:
        raise InvalidInputError(
            f"voltage has the shape {samples.shape}, expected (n_times,) of at most {MAX_SAMPLES}"
        )
    one_of("hold", hold, HOLDS)
    return samples


def step_matrix(equations: Equations, step_s: float, hold: Hold) -> Floats:
    """Return the matrix of a step: from states before and both voltages to states and outputs.

    Of the shape (n_states + 4, n_states + 2).
    """
    # The voltage, and what it gains in the step, are two more states.
    dynamics = np.asarray(equations.dynamics)
    n = len(dynamics)
    matrix = np.zeros((n + 2, n + 2))
    matrix[:n, :n] = dynamics * step_s
    matrix[:n, n] = np.asarray(equations.drive) * step_s
    matrix[n, n + 1] = 1.0
    gained, rates = exponential_less_1(matrix)
    states = (gained + np.eye(n + 2))[:n]
    read = np.array([equations.velocity, equations.displacement, equations.current])
    # The sum of the forces would lose the digits of a light mass.
    acceleration = read[0] @ rates[:n] / step_s
    result = np.vstack((states, acceleration, read @ states))
    # From what the voltage gains to the voltage after the step.
    rising = result[:, n + 1] * (hold == "first")
    result[:, n] -= rising
    result[:, n + 1] = rising
    result[-1, n + 1] += equations.passed_a_per_v
    return result


def exponential_less_1(matrix: Floats) -> tuple[Floats, Floats]:
    """Return the exponential of a matrix less the identity, and the exponential times the matrix.

    The series of a small part of the matrix, doubled repeatedly.  Less the identity, slow parts
    keep their digits beside parts that are 1e100 times as fast, and no state needs to be scaled.

    References
    ----------
    Moler and Van Loan, Nineteen dubious ways to compute the exponential of a matrix, twenty-five
    years later, SIAM Review 45(1), 2003: method 3, which loses them otherwise.
    """
    doublings = max(int(np.frexp(np.abs(matrix).sum(axis=1).max())[1]) + 1, 0)
    small = np.ldexp(matrix, -doublings)
    gained = np.zeros_like(matrix)
    for k in range(16, 0, -1):
        gained = (small + small @ gained) / k
    rates = matrix + gained @ matrix
    for _ in range(doublings):
        rates = rates + gained @ rates
        gained = 2.0 * gained + gained @ gained
    return gained, rates


def _fill_outputs(outputs: Floats, samples: Floats, step: Floats) -> None:
    """Fill in the outputs after each step, (4, n_steps)."""
    n_steps = outputs.shape[1]
    n_blocks = -(-n_steps // _BLOCK)
    padded = np.zeros(n_blocks * _BLOCK + 1)
    padded[: samples.size] = samples
    blocks = np.lib.stride_tricks.sliding_window_view(padded, _BLOCK + 1)[::_BLOCK]
    output_matrices, end = _block_matrices(step)
    ends = _accumulated(blocks @ end[:, : _BLOCK + 1].T, end[:, _BLOCK + 1 :])
    # Voltages of each block, and the states that all blocks before it have left.
    known = np.hstack((blocks, np.pad(ends[:-1], ((1, 0), (0, 0)))))
    for row, after in zip(outputs, output_matrices, strict=True):
        row[:] = (known @ after.T).ravel()[:n_steps]


def _block_matrices(step: Floats) -> tuple[Floats, Floats]:
    """Return the matrices from voltages and states to a block's outputs and to its last states.

    Of the shapes (4, _BLOCK, n) and (n_states, n): n is _BLOCK + 1 voltages and the states before.
    """
    n_states = len(step) - len(OUTPUTS)
    known = np.eye(_BLOCK + 1 + n_states)
    voltages, states = known[: _BLOCK + 1], known[_BLOCK + 1 :]
    outputs = []
    for k in range(_BLOCK):
        after = step @ np.vstack((states, voltages[k : k + 2]))
        states = after[:n_states]
        outputs.append(after[n_states:])
    return np.stack(outputs, axis=1), states


def _accumulated(added: Floats, step: Floats) -> Floats:
    """Return the states after each step from what each step adds, (n_steps, n_states) both.

    What one step adds is carried on by one step, then what two have added by two, and so on.
    """
    states, stride = added, 1
    while stride < len(states):
        states = states + np.pad(states[:-stride] @ step.T, ((stride, 0), (0, 0)))
        step, stride = step @ step, 2 * stride
    return states
