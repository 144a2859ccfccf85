"""Axes along which outputs measure."""

from typing import Literal, get_args

from skinsource.errors import InvalidInputError
from skinsource.quoting import quoted

Axes = Literal["x", "y", "z", "xy", "xz", "yz", "xyz"]
AXES: tuple[Axes, ...] = get_args(Axes)
#: Of those that a limb has, whichever they are.
ALL_AXES: Axes = "xyz"


def axes_of(measured: Axes, axes: Axes) -> Axes:
    """Those of a limb's axes that ``axes`` asks for; ``"xyz"`` asks for all it has.

    Raises
    ------
    InvalidInputError
        The limb does not measure along one of them.

    Examples
    --------
    >>> axes_of("xz", "z"), axes_of("xz", "xyz")
    ('z', 'xz')
    """
    if axes in (ALL_AXES, measured):
        return measured
    missing = [axis for axis in axes if axis not in measured]
    if missing:
        raise InvalidInputError(
            f"axes is {quoted(axes)}, but this limb measures along {words(measured)} only. Choose "
            f"{quoted(measured)}, or another limb."
        )
    return axes


def axis_numbers(axes: Axes, measured: Axes = ALL_AXES) -> tuple[int, ...]:
    """Where, among the axes that a limb measures along, those are that `axes_of` finds."""
    return tuple(measured.index(axis) for axis in axes_of(measured, axes))


def words(axes: str) -> str:
    """Axes in a sentence: "x and z"."""
    return f"{', '.join(axes[:-1])} and {axes[-1]}" if len(axes) > 1 else axes
