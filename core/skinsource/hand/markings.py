"""Nails and skin creases of the drawn hand, in hand lengths."""

import numpy as np

from skinsource.arrays import Floats
from skinsource.hand.anatomy import INDEX, LITTLE, THUMB, Digit, Skeleton
from skinsource.hand.curves import smooth

# Nail of a finger and of the thumb: fractions of the digit from root to free edge, half-width
# in half-widths of the digit, and shift across (the thumb is seen from its side).
_NAIL = (0.87, 0.972, 0.6, 0.0)
_THUMB_NAIL = (0.775, 0.955, 0.6, -0.13)
# Creases across a digit: fraction of its length, sag towards the hand in hand lengths.
_FINGER_CREASES = (0.215, 0.465, 0.49, 0.757)
_THUMB_CREASES = (0.07, 0.525, 0.56)


def nails_of(skeleton: Skeleton) -> list[Floats]:
    """Closed outlines of the nails of digits I to V, each (n, 2)."""
    return [_nail(digit) for digit in skeleton.digits]


def _nail(digit: Digit) -> Floats:
    root, edge, half_width, shift = _THUMB_NAIL if digit.is_thumb else _NAIL
    # Round at the root, straight along the sides, gently bowed at the free edge.
    shape = (
        (0.0, 0.0),
        (0.07, 0.5),
        (0.25, 0.88),
        (0.5, 0.98),
        (0.78, 1.0),
        (0.92, 0.86),
        (1.0, 0.45),
        (1.02, 0.0),
    )
    right = list(shape)
    left = [(along, -across) for along, across in reversed(shape[1:-1])]
    along, across = np.array(right + left).T
    width = half_width * digit.half_width(0.86)
    axis = root + along * (edge - root)
    offset = across * width + shift * digit.half_width(0.86)
    return smooth(digit.point(axis) + offset[:, None] * digit.normal(axis), closed=True, per_span=6)


def creases_of(skeleton: Skeleton) -> list[Floats]:
    """Finger, palm and wrist creases, open lines, each (n, 2)."""
    lines = []
    for number, digit in enumerate(skeleton.digits):
        at = _THUMB_CREASES if number == THUMB else _FINGER_CREASES
        lines += [_across(digit, fraction) for fraction in at]
    return lines + _palm_lines(skeleton) + _wrist_lines(skeleton)


def _across(digit: Digit, fraction: float) -> Floats:
    side = np.linspace(-0.8, 0.8, 5)
    sag = 0.007 * (1 - (side / 0.8) ** 2) / digit.length
    return smooth(digit.point(fraction - sag, side), closed=False, per_span=5)


def _palm_lines(skeleton: Skeleton) -> list[Floats]:
    """The distal, the proximal and the thenar crease."""
    _, index, middle, ring, little = (digit.base for digit in skeleton.digits)
    radial = skeleton.digits[INDEX].point(0.0, -0.78)
    ulnar = skeleton.digits[LITTLE].point(0.0, 1.0)
    wrist = np.zeros(2)
    # From where, and by how much right and up.
    lines = (
        (
            (ulnar, 0.0, -0.045),
            (ring, 0.03, -0.07),
            (middle, 0.0, -0.03),
            ((middle + index) / 2, -0.002, 0.05),
        ),
        (
            (radial, 0.0, -0.075),
            (middle, -0.04, -0.12),
            (ring, -0.02, -0.185),
            (little, 0.01, -0.205),
        ),
        (
            (radial, 0.0, -0.083),
            (index, 0.045, -0.15),
            (wrist, -0.028, 0.2),
            (wrist, -0.035, 0.12),
            (wrist, -0.055, 0.045),
        ),
    )
    return [
        smooth([start + np.array([right, up]) for start, right, up in line], closed=False)
        for line in lines
    ]


def _wrist_lines(skeleton: Skeleton) -> list[Floats]:
    half = 0.8 * skeleton.proportions.wrist_width / 2
    across = np.linspace(-1, 1, 5)
    sag = 0.02 * (1 - across**2)
    return [
        smooth(np.stack([across * half * length, level - sag], axis=-1), closed=False)
        for level, length in ((0.015, 1.0), (-0.025, 0.85))
    ]
