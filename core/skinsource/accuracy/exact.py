"""Exact convolutions on any limb: sums of products in whole numbers, without an engine."""

from dataclasses import replace
from fractions import Fraction
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from skinsource.accuracy.cases import Case, Convolution, convolutions, stored_cases
from skinsource.arrays import Floats, Integers
from skinsource.errors import InvalidInputError
from skinsource.job import Progress, Stop, never, silent, stop_if
from skinsource.limb import Limb
from skinsource.quoting import quoted


def cases_of(
    limb: Limb | None, *, quick: bool, progress: Progress = silent, stop: Stop = never
) -> tuple[Case, ...]:
    """The convolutions on a limb, with their exact values; all stored cases where there is none.

    Parameters
    ----------
    quick
        Those of a short run alone.
    progress, stop
        Told and asked before each.

    Raises
    ------
    FileFormatError
        The stored references cannot be read.
    InvalidInputError
        A response of the limb holds what is no finite number.
    Stopped
        ``stop`` said so.
    """
    chosen = [
        case
        for case in (stored_cases() if limb is None else convolutions(limb))
        if case.quick or not quick
    ]
    if limb is None:
        return tuple(chosen)
    found = []
    for k, case in enumerate(chosen):
        stop_if(stop)
        progress(k, len(chosen), f"exact values of {case.name}")
        problem = cast(Convolution, case.problem)
        found.append(replace(case, reference=exact_samples(problem, case.samples)))
    return tuple(found)


def exact_samples(problem: Convolution, samples: Integers) -> Floats:
    """Some samples of the channels asked for, (n_rows, n_samples), rounded once."""
    taps = np.stack([problem.asked_for(response) for response in problem.responses])
    if not np.isfinite(taps).all():
        raise InvalidInputError(
            f"{quoted(problem.limb.name)}: a response is not finite, so there are no exact values. "
            "Install or load the limb again."
        )
    n_taps = taps.shape[-1]
    whole_taps, taps_exponent = _whole(taps[..., ::-1])
    padding = (0, 0), (n_taps - 1, n_taps - 1)
    whole_drives, drives_exponent = _whole(np.pad(problem.drives, padding))
    unit = Fraction(2) ** (taps_exponent + drives_exponent)
    sums = [
        sum(
            response @ drive[sample : sample + n_taps]
            for response, drive in zip(whole_taps, whole_drives, strict=True)
        )
        for sample in samples
    ]
    return np.array([[float(value * unit) for value in row] for row in zip(*sums, strict=True)])


def _whole(values: Floats) -> tuple[NDArray[Any], int]:
    """Whole numbers of any size, and the power of two that they are multiplied with."""
    mantissas, exponents = np.frexp(values)
    lowest = int(exponents.min())
    whole = np.ldexp(mantissas, 53).astype(np.int64).astype(object)
    return whole << (exponents - lowest).astype(object), lowest - 53
