"""Levels and main axes to 50 digits: ``levels.json`` and ``axes.json``.

python tests/references/make_levels_and_axes.py
"""

import json
from pathlib import Path

from mpmath import matrix, mp, mpf

AMPLITUDES = (
    *(f"1e{power}" for power in range(-9, 10, 3)),
    *("1e-30", "1e30", "1e-300", "1e300", "2.2250738585072014e-308", "1.7976931348623157e308"),
    *("5e-324", "1e-320", "0.1", "0.3", "0.7071067811865476", "0.9999999999999999"),
    *("1.0000000000000002", "2", "3.3", "7.25", "1234.5678"),
)
REFERENCES = ("1", "1e-6", "9.81")
#: Singular values of the data, relative to the largest.
SHAPES = (
    *(("0.5", "0.25"), ("0.9", "0.1"), ("0.99", "0.5"), ("0.998", "0.3"), ("0.5", "0.5")),
    *(("0.999999", "0.2"), ("0.9", "0.9"), ("0.01", "0.001"), ("1e-6", "1e-9")),
)


def levels() -> list[dict]:
    """Level of each amplitude re each reference."""
    return [
        {
            "amplitude": float(amplitude).hex(),
            "reference": float(reference).hex(),
            "level_db": float(20 * mp.log10(mpf(float(amplitude)) / mpf(float(reference)))).hex(),
        }
        for amplitude in AMPLITUDES
        for reference in REFERENCES
    ]


def turned(angles: tuple[mpf, mpf, mpf]) -> matrix:
    """A rotation about z, y and x."""
    (cz, cy, cx), (sz, sy, sx) = ([f(angle) for angle in angles] for f in (mp.cos, mp.sin))
    about_z = matrix([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]])
    about_y = matrix([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    about_x = matrix([[1, 0, 0], [0, cx, -sx], [0, sx, cx]])
    return about_z * about_y * about_x


def axes() -> list[dict]:
    """Covariances, rounded to floats, with the axis and gap of the rounded ones."""
    result = []
    for number, (middle, small) in enumerate(SHAPES):
        turn = turned((mpf(number) + mpf("0.3"), mpf("0.7") * number, mpf("1.9") - number))
        rough = turn * mp.diag([1, mpf(middle) ** 2, mpf(small) ** 2]) * turn.T
        stored = [[float(rough[min(i, j), max(i, j)]) for j in range(3)] for i in range(3)]
        values, vectors = mp.eigsy(matrix(stored))
        s1, s2 = mp.sqrt(values[2]), mp.sqrt(values[1])
        axis = [vectors[i, 2] for i in range(3)]
        largest = max(axis, key=abs)
        result.append(
            {
                "covariance": [[value.hex() for value in row] for row in stored],
                "gap": float((s1 - s2) / s1).hex(),
                "axis": [float(value * mp.sign(largest)).hex() for value in axis],
            }
        )
    return result


def main() -> None:
    """Write both files."""
    mp.dps = 50
    for name, rows in (("levels", levels()), ("axes", axes())):
        text = "[\n" + ",\n".join(json.dumps(row) for row in rows) + "\n]\n"
        Path(__file__).with_name(f"{name}.json").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
