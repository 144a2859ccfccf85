"""Along which direction outputs move most, and how round their motion is."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from skinsource.arguments import finite_array
from skinsource.arrays import Booleans, Floats
from skinsource.errors import InvalidInputError
from skinsource.projection import no_main_axis


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MainAxes:
    """Ellipsoids of motion.

    Attributes
    ----------
    covariance : (n_outputs, n_axes, n_axes)
        Mean products of the centred axes, m²/s⁴; ellipses are drawn from it.
    direction : (n_outputs, n_axes)
        Unit vector along which an output varies most; its largest component is positive.
    deviation : (n_outputs, n_axes)
        Standard deviation along the axes of the ellipsoid, m/s², largest first.
    share : (n_outputs,)
        Part of the variance along the main axis, from 1 / n_axes to 1; NaN where nothing moves.
    none : (n_outputs,) of bool
        No main axis: the two largest deviations differ by less than 1e-3 of the largest, so that
        the direction means nothing (`skinsource.projection.no_main_axis`); or nothing moves.
    """

    covariance: Floats
    direction: Floats
    deviation: Floats
    share: Floats
    none: Booleans


def main_axes(traces: ArrayLike) -> MainAxes:
    """Return the ellipsoid of motion of each output.

    Parameters
    ----------
    traces : (n_outputs, n_axes, n_times)
        Accelerations along two axes or more, m/s².

    Raises
    ------
    InvalidInputError
        Another shape, or samples that are not finite.
    """
    data = finite_array("traces", traces, "(n_outputs, n_axes, n_times)")
    if data.ndim != 3 or data.shape[1] < 2 or not data.shape[2]:
        raise InvalidInputError(
            f"traces have shape {data.shape}, expected (n_outputs, n_axes, n_times) with two axes "
            "or more"
        )
    mean = data.mean(axis=-1)
    second = np.matmul(data, data.transpose(0, 2, 1)) / data.shape[-1]
    covariance = second - mean[:, :, None] * mean[:, None, :]
    values, vectors = np.linalg.eigh(covariance)
    values = np.maximum(values[:, ::-1], 0.0)
    direction = vectors[:, :, -1]
    rows = np.arange(len(direction))
    leading = direction[rows, np.abs(direction).argmax(axis=1)]
    total = values.sum(axis=1)
    silent = np.full(total.shape, np.nan)
    return MainAxes(
        covariance=covariance,
        direction=direction * np.where(leading < 0.0, -1.0, 1.0)[:, None],
        deviation=np.sqrt(values),
        share=np.divide(values[:, 0], total, out=silent, where=total > 0.0),
        none=no_main_axis(covariance),
    )


def ellipse(covariance: ArrayLike, axes: tuple[int, int], n_points: int = 73) -> Floats:
    """Return the outline of one standard deviation in the plane of two axes, (n_points, 2).

    Where a motion is as long as it likes in one direction: the shadow of the ellipsoid on that
    plane.  Points x of the outline solve x' C⁻¹ x = 1.
    """
    matrix = finite_array("covariance", covariance, "(n_axes, n_axes)")
    plane = matrix[np.ix_(axes, axes)]
    values, vectors = np.linalg.eigh(plane)
    angle = np.linspace(0.0, 2.0 * np.pi, n_points)
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    points: Floats = (circle * np.sqrt(np.maximum(values, 0.0))) @ vectors.T
    return points
