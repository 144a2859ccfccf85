"""Projection of acceleration along several axes to one signal for each output; main axes.

The sign of a principal axis is that of MATLAB's ``pca`` wherever one is computed.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from skinsource.base.arguments import LARGEST_SAMPLE, one_of, real_array
from skinsource.base.conventions import AXES, Axes, Booleans, Floats, axis_numbers
from skinsource.base.errors import InvalidInputError

Method = Literal["mag", "pca", "rms", "soc"]
METHODS: tuple[Method, ...] = get_args(Method)

#: Below this gap, noise of a millionth turns a main axis by more than 0.06 degrees.
SMALLEST_GAP = 1e-3

_TIE = 1e-9


def project_axes(
    acceleration: ArrayLike, axes: Axes = "xyz", method: Method = "mag", measured: Axes = "xyz"
) -> Floats:
    """Project acceleration along several axes to one signal for each output.

    Parameters
    ----------
    acceleration : (n_outputs, n_axes, n_times)
        In m/s², or any other unit; of three axes, unless ``measured`` names fewer.
    axes
        The axes that take part; ``"xyz"``: all of them.  With a single axis the method does not
        matter.
    method
        ``"mag"`` length of the vector; ``"pca"`` component along the first principal axis of the
        centred data, applied to the data as they are, largest coefficient positive; ``"rms"``
        component along the vector of the axes' RMS values; ``"soc"`` sum of components.
    measured
        The axes of ``acceleration``, in its order, see `Limb.axes`.

    Returns
    -------
    (n_outputs, n_times), in the unit of ``acceleration``.  A silent output stays silent.

    Raises
    ------
    InvalidInputError
        Unknown axes or method, axes that were not measured, wrong shape, no samples, or values
        that are not finite.

    Examples
    --------
    >>> import skinsource as ss
    >>> acceleration = ss.predict("synthetic-1", [ss.sinusoid(100.0)], [7])
    >>> print(ss.project_axes(acceleration, "xyz", method="mag").shape)
    (72, 651)
    """
    one_of("axes", axes, AXES)
    one_of("method", method, METHODS)
    one_of("measured", measured, AXES)
    numbers = axis_numbers(axes, measured)
    expected = f"(n_outputs, {len(measured)}, n_times)"
    data = real_array("acceleration", acceleration, expected)
    if data.ndim != 3 or data.shape[1] != len(measured):
        raise InvalidInputError(f"acceleration has shape {data.shape}, expected {expected}")
    if data.shape[-1] == 0:
        raise InvalidInputError("acceleration has no samples, expected at least one")
    # The maximum of an array with NaN is NaN, which is not below anything.
    if data.size and not np.abs(data).max() <= LARGEST_SAMPLE:
        output, axis, sample = np.argwhere(~(np.abs(data) <= LARGEST_SAMPLE))[0]
        raise InvalidInputError(
            f"acceleration of output {output + 1}, axis {measured[axis]}, sample {sample} "
            f"is {data[output, axis, sample]}, not a finite number of at most {LARGEST_SAMPLE:g}"
        )
    if len(numbers) == 1:
        return data[:, numbers[0]].copy()
    chosen = data if len(numbers) == len(measured) else data[:, list(numbers)]
    if method == "soc":
        return chosen.sum(axis=1)
    if method == "mag":
        return magnitude(chosen)
    direction = principal_axis(chosen) if method == "pca" else rms_direction(chosen)
    return np.einsum("oa,oat->ot", direction, chosen)


def magnitude(data: Floats) -> Floats:
    """Return the length of the vector at each instant, (n_outputs, n_times)."""
    scale = _scale(data)
    squares = np.square(data[:, 0] / scale)
    for axis in range(1, data.shape[1]):
        squares += np.square(data[:, axis] / scale)
    np.sqrt(squares, out=squares)
    squares *= scale
    return squares


def rms_direction(data: Floats) -> Floats:
    """Return unit vectors of the axes' RMS values, (n_outputs, n_axes); zero in silence."""
    energy = np.mean(np.square(data / _scale(data)), axis=-1)
    length = np.sqrt(energy.sum(axis=-1, keepdims=True))
    return np.sqrt(energy) / np.where(length > 0, length, 1.0)


def principal_axis(data: Floats) -> Floats:
    """Return the first principal axis of the centred data, (n_outputs, n_axes), unit vectors.

    Sign as in MATLAB's ``pca``: the coefficient of largest magnitude is positive, of equal ones
    the first.  Where nothing moves, the first axis.
    """
    centred = data / _scale(data)
    centred = centred - centred.mean(axis=-1, keepdims=True)
    return principal_axis_of(centred @ centred.transpose(0, 2, 1))


def principal_axis_of(covariance: Floats) -> Floats:
    """Return principal axes of covariances, (n_outputs, n_axes, n_axes), as `principal_axis`."""
    _, vectors = np.linalg.eigh(covariance)
    axis = vectors[:, :, -1]
    still = ~covariance.any(axis=(1, 2))
    axis[still] = np.arange(axis.shape[1]) == 0
    size = np.abs(axis)
    # Equal coefficients differ in their last digits, which depend on the machine.
    largest = (size >= (1.0 - _TIE) * size.max(axis=1, keepdims=True)).argmax(axis=1)
    axis *= np.sign(axis[np.arange(len(axis)), largest])[:, None]
    return axis


def main_axis_gap(covariance: Floats) -> Floats:
    """Return how distinct the main axis is, (s1 - s2) / s1 of the data's singular values.

    The data are centred.  Noise of relative size e turns the main axis by about e / gap (Davis and
    Kahan, "The rotation of eigenvectors by a perturbation", SIAM J. Numer. Anal. 7, 1970).

    Parameters
    ----------
    covariance : (n_outputs, n_axes, n_axes)
        Of each output's axes, up to a positive factor; its eigenvalues are s².

    Returns
    -------
    (n_outputs,), from 0 for motion on a circle to 1 for motion on a line; 0 where nothing moves.
    """
    # Rounding makes some of them slightly negative.
    values = np.sqrt(np.maximum(np.linalg.eigvalsh(covariance), 0.0))
    first = values[:, -1]
    second = values[:, -2] if values.shape[1] > 1 else np.zeros_like(first)
    return (first - second) / np.where(first > 0, first, 1.0)


def no_main_axis(covariance: Floats) -> Booleans:
    """Return for which outputs the motion has no main axis, (n_outputs,).

    It is True where the gap is below `SMALLEST_GAP`, and where nothing moves.  `project_axes` still
    uses the axis that it computes, as the published toolbox does: its direction means nothing.
    """
    return main_axis_gap(covariance) < SMALLEST_GAP


def _scale(data: Floats) -> float:
    # A power of two near the largest sample: squares neither over- nor underflow, nothing rounds.
    largest = np.abs(data).max(initial=0.0)
    return float(2.0 ** np.floor(np.log2(largest))) if largest > 0 else 1.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MainAxes:
    """Ellipsoids of motion.

    Attributes
    ----------
    covariance : (n_outputs, n_axes, n_axes)
        Mean products of the centred axes, m²/s⁴.
    direction : (n_outputs, n_axes)
        Principal axis, as `principal_axis` has it.
    deviation : (n_outputs, n_axes)
        Standard deviation along the axes of the ellipsoid, m/s², largest first.
    share : (n_outputs,)
        Part of the variance along the main axis, from 1 / n_axes to 1; NaN where nothing moves.
    none : (n_outputs,) of bool
        No main axis: the two largest deviations differ by less than 1e-3 of the largest, so that
        the direction means nothing (`skinsource.signals.projection.no_main_axis`); or nothing
        moves.
    """

    covariance: Floats
    direction: Floats
    deviation: Floats
    share: Floats
    none: Booleans


def main_axes(traces: Floats) -> MainAxes:
    """Return the ellipsoid of motion of each output.

    Parameters
    ----------
    traces : (n_outputs, n_axes, n_times)
        Accelerations along two axes or more, m/s².
    """
    mean = traces.mean(axis=-1)
    second = np.matmul(traces, traces.transpose(0, 2, 1)) / traces.shape[-1]
    covariance = second - mean[:, :, None] * mean[:, None, :]
    values = np.maximum(np.linalg.eigvalsh(covariance)[:, ::-1], 0.0)
    total = values.sum(axis=1)
    silent = np.full(total.shape, np.nan)
    return MainAxes(
        covariance=covariance,
        direction=principal_axis_of(covariance),
        deviation=np.sqrt(values),
        share=np.divide(values[:, 0], total, out=silent, where=total > 0.0),
        none=no_main_axis(covariance),
    )


def ellipse(covariance: Floats, axes: tuple[int, int]) -> Floats:
    """Return the outline of one standard deviation in the plane of two axes, (73, 2).

    It is the projection of the ellipsoid on that plane.  Its points x solve x' C⁻¹ x = 1.
    """
    plane = covariance[np.ix_(axes, axes)]
    values, vectors = np.linalg.eigh(plane)
    angle = np.linspace(0.0, 2.0 * np.pi, 73)
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return (circle * np.sqrt(np.maximum(values, 0.0))) @ vectors.T
