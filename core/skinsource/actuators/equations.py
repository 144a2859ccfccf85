"""The linear equations of an actuator, in exact numbers."""

from dataclasses import dataclass
from fractions import Fraction

Row = tuple[Fraction, ...]

#: What comes out of a simulation, row by row.
OUTPUTS = ("acceleration", "velocity", "displacement", "current")


@dataclass(frozen=True, slots=True, kw_only=True)
class Equations:
    """x' = A x + b u and y = C x + d u: states x, voltage u, outputs y.

    Attributes
    ----------
    dynamics, drive
        A, (n_states, n_states), in 1/s, and b, (n_states,).
    outputs, passed
        C, (4, n_states), and d, (4,); rows as in `OUTPUTS`.
    storage : (n_states,)
        Twice the energy that a state of 1 holds, in J, or an inertia in its place where a state
        holds none; above 0.  States are scaled by its root.
    """

    dynamics: tuple[Row, ...]
    drive: Row
    outputs: tuple[Row, ...]
    passed: Row
    storage: Row


def row(*numbers: float | Fraction) -> Row:
    """Exact numbers of a row."""
    return tuple(Fraction(number) for number in numbers)


def held(stiffness: Fraction, inertia: Fraction, step_s: Fraction) -> Fraction:
    """Storage of a displacement: its stiffness, or more, where it is nearly free for one step."""
    return max(stiffness, inertia / step_s**2)
