"""Sibson's weights in rational arithmetic: ``natural_neighbours.json``, twenty small cases.

The cell that a point takes is clipped out of the plane, and again by each site's own cell; areas
are exact fractions, rounded once.

    python tests/references/make_natural_neighbours.py
"""

import json
from fractions import Fraction
from pathlib import Path

Point = tuple[Fraction, Fraction]

#: Sites on a lattice, so that many of them share a circle; the points are none of them.
N_CASES, N_POINTS = 20, 6
FAR = Fraction(10**9)


def numbers(seed: int):
    """Yield pseudorandom whole numbers below 2**31."""
    state = seed
    while True:
        state = (6364136223846793005 * state + 1442695040888963407) % 2**64
        yield state >> 33


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


def case(seed: int) -> dict:
    """Five to twelve sites, a square around them, and points inside it."""
    numbered = numbers(seed)
    corners = [(0, 0), (16, 0), (16, 16), (0, 16)]
    inner = [(next(numbered) % 15 + 1, next(numbered) % 15 + 1) for _ in range(1 + seed % 8)]
    sites = sorted({*corners, *inner})
    points = [(next(numbered) % 1023 + 1, next(numbered) % 1023 + 1) for _ in range(N_POINTS)]
    exact_sites = [(Fraction(x), Fraction(y)) for x, y in sites]
    exact_points = [(Fraction(x, 64), Fraction(y, 64)) for x, y in points]
    return {
        "sites": sites,
        "points": [[float(x), float(y)] for x, y in exact_points],
        "weights": [[float(value) for value in weights(exact_sites, at)] for at in exact_points],
    }


def main() -> None:
    """Write the file."""
    cases = [json.dumps(case(seed)) for seed in range(1, N_CASES + 1)]
    path = Path(__file__).with_name("natural_neighbours.json")
    path.write_text("[\n" + ",\n".join(cases) + "\n]\n", encoding="utf-8")


if __name__ == "__main__":
    main()
