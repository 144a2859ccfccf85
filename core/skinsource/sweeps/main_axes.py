"""Main axes of many outputs at once.

A library for linear algebra takes one small matrix after the other, and longer for the way to each
than for the matrix itself.  Jacobi's rotations are done here with all of them side by side (Golub
and Van Loan, "Matrix Computations", 4th ed., 8.5), which is as exact.
"""

import numpy as np

from skinsource.arrays import Floats

# Convergence is quadratic: four sweeps reach rounding, whatever the matrix; most need two.
_SWEEPS = 5
#: An axis that turns less does not move.
_LEAST_TANGENT = 2.0**-54
_PAIRS = ((0, 1, 2), (0, 2, 1), (1, 2, 0))


def main_axes(covariance: Floats) -> Floats:
    """Unit vectors along the largest eigenvalue of symmetric matrices, (n, 3), of (n, 3, 3).

    Of either sign; along the first axis where a matrix is zero.
    """
    # Powers of two, so that nothing over- or underflows, and nothing rounds.
    exponent = np.frexp(np.abs(covariance).max(axis=(1, 2)))[1]
    scaled = np.ldexp(covariance, -exponent[:, None, None])
    rows = [[scaled[:, a, b].copy() for b in range(3)] for a in range(3)]
    vectors = [np.repeat(unit[:, None], len(scaled), axis=1) for unit in np.eye(3)]
    for _ in range(_SWEEPS):
        for p, q, r in _PAIRS:
            _rotate(rows, vectors, p, q, r)
        if _are_diagonal(rows):
            break
    values = np.stack([rows[0][0], rows[1][1], rows[2][2]])
    found: Floats = np.choose(values.argmax(axis=0), vectors).T
    return found


def _are_diagonal(rows: list[list[Floats]]) -> bool:
    """Whether what is left between the axes of all matrices turns none of them."""
    return all(
        bool(np.all(np.abs(rows[p][q]) <= _LEAST_TANGENT * np.abs(rows[q][q] - rows[p][p])))
        for p, q, _ in _PAIRS
    )


def _rotate(rows: list[list[Floats]], vectors: list[Floats], p: int, q: int, r: int) -> None:
    """Turn axes ``p`` and ``q`` so that nothing is left between them.

    Parameters
    ----------
    rows
        Of the matrices, (n,) each; turned in place, as the axes are, (3, n) each.
    """
    between, apart = rows[p][q], rows[q][q] - rows[p][p]
    # tan of the angle, the smaller of the two, in a form that divides by nothing small.
    twice = 2.0 * between
    # Numbers of at most 1: what is lost of a square here is nothing beside the other one.
    longest = np.abs(apart) + np.sqrt(apart * apart + twice * twice)
    tangent = twice * np.copysign(1.0, apart) / (longest + (longest == 0.0))
    cosine = 1.0 / np.sqrt(1.0 + tangent * tangent)
    sine = tangent * cosine
    rows[p][p] = rows[p][p] - tangent * between
    rows[q][q] = rows[q][q] + tangent * between
    rows[p][q] = rows[q][p] = np.zeros_like(between)
    first, second = rows[p][r], rows[q][r]
    rows[p][r] = rows[r][p] = cosine * first - sine * second
    rows[q][r] = rows[r][q] = sine * first + cosine * second
    first, second = vectors[p], vectors[q]
    vectors[p], vectors[q] = cosine * first - sine * second, sine * first + cosine * second
