"""Stored convolutions, levels, main axes and weights of neighbours are exact, rounded once.

Convolutions, levels and axes are computed with 50 digits; Sibson's weights in rational arithmetic:
the cell that a point takes is clipped out of the plane, and again by each site's own cell.

    python tests/references/check_numbers.py
"""

import json
from fractions import Fraction
from pathlib import Path

import numpy as np
from mpmath import matrix, mp, mpf

HERE = Path(__file__).parent
Point = tuple[Fraction, Fraction]
FAR = Fraction(10**9)


def convolved(drive: np.ndarray, response: np.ndarray) -> list[float]:
    """Sum of the products of the stored numbers, each sum rounded once."""
    left, right = ([mpf(float(value)) for value in row] for row in (drive, response))
    # Zeros add nothing, and take as long as the rest.
    nonzero = [k for k, value in enumerate(left) if value != 0]
    results = []
    for time in range(len(left) + len(right) - 1):
        first = max(0, time - len(right) + 1)
        products = (left[k] * right[time - k] for k in nonzero if first <= k <= time)
        results.append(float(mp.fsum(products)))
    return results


def level_db(amplitude: str, reference: str) -> str:
    """Level of an amplitude re a reference."""
    ratio = mpf(float.fromhex(amplitude)) / mpf(float.fromhex(reference))
    return float(20 * mp.log10(ratio)).hex()


def axis_and_gap(covariance: list[list[str]]) -> tuple[list[str], str]:
    """Main axis of a covariance, its largest part positive, and its gap to the second."""
    rows = [[float.fromhex(value) for value in row] for row in covariance]
    values, vectors = mp.eigsy(matrix(rows))
    s1, s2 = mp.sqrt(values[2]), mp.sqrt(values[1])
    axis = [vectors[i, 2] for i in range(3)]
    largest = max(axis, key=abs)
    return [float(value * mp.sign(largest)).hex() for value in axis], float((s1 - s2) / s1).hex()


def nearer_half(polygon: list[Point], keep: Point, other: Point) -> list[Point]:
    """The part of a convex polygon that is nearer to ``keep`` than to ``other``."""
    normal = (other[0] - keep[0], other[1] - keep[1])
    level = sum(normal[i] * (other[i] + keep[i]) for i in (0, 1)) / 2
    height = [normal[0] * x + normal[1] * y - level for x, y in polygon]
    kept = []
    for k, here in enumerate(polygon):
        after = (k + 1) % len(polygon)
        if height[k] <= 0:
            kept.append(here)
        if (height[k] < 0) != (height[after] < 0) and height[k] * height[after] != 0:
            share = height[k] / (height[k] - height[after])
            there = polygon[after]
            kept.append(tuple(here[i] + share * (there[i] - here[i]) for i in (0, 1)))
    return kept


def area(polygon: list[Point]) -> Fraction:
    """Area within a polygon that runs counterclockwise."""
    around = zip(polygon, polygon[1:] + polygon[:1], strict=True)
    return sum((p[0] * q[1] - q[0] * p[1] for p, q in around), Fraction(0)) / 2


def weights(sites: list[Point], point: Point) -> list[Fraction]:
    """Shares of the cell of ``point`` in the cells of ``sites``."""
    cell = [(-FAR, -FAR), (FAR, -FAR), (FAR, FAR), (-FAR, FAR)]
    for site in sites:
        cell = nearer_half(cell, point, site)
    areas = []
    for site in sites:
        part = cell
        for other in sites:
            if other != site and part:
                part = nearer_half(part, site, other)
        areas.append(area(part) if len(part) > 2 else Fraction(0))
    return [value / sum(areas) for value in areas]


def stored_rows(name: str) -> list[dict]:
    """Rows of a JSON file beside this one."""
    return json.loads((HERE / name).read_text(encoding="utf-8"))


def main() -> None:
    """Compare all that is stored."""
    mp.dps = 50
    with np.load(HERE / "convolution.npz") as stored:
        drives, responses = stored["drives"], stored["responses"]
        fields = [[convolved(drive, row) for row in responses] for drive in drives]
        np.testing.assert_array_equal(fields, stored["fields"])
    for row in stored_rows("levels.json"):
        assert level_db(row["amplitude"], row["reference"]) == row["level_db"], row
    for row in stored_rows("axes.json"):
        assert axis_and_gap(row["covariance"]) == (row["axis"], row["gap"]), row
    for row in stored_rows("natural_neighbours.json"):
        sites, points = (
            [tuple(map(Fraction, point)) for point in row[name]] for name in ("sites", "points")
        )
        exact = [[float(value) for value in weights(sites, point)] for point in points]
        assert exact == row["weights"], row


if __name__ == "__main__":
    main()
