"""Where the inputs and outputs sit on a hand of given proportions, in hand lengths."""

import numpy as np

from skinsource.arrays import Floats
from skinsource.hand.anatomy import INDEX, LITTLE, MIDDLE, RING, THUMB, Skeleton
from skinsource.limb import N_INPUTS, N_OUTPUTS, VOLAR_OUTPUTS

# Along a digit as fractions of its length from the base knuckle, across in half-widths
# (+1 ulnar edge of a finger).
_BESIDE_NAIL, _MIDDLE_PHALANX, _PROXIMAL_PHALANX = 0.833, 0.647, 0.304
_NAIL_SIDE, _PHALANX_SIDE = 0.62, 0.55
_TIP, _PAD, _BASE = 0.965, 0.86, 0.3
_THUMB_PAD, _THUMB_BASE = 0.8, 0.42

# Beside the nail, middle phalanx (ulnar, radial each), proximal phalanx, knuckle.
_ON_FINGERS = {
    LITTLE: (1, 2, 3, 4, 6, 5),
    RING: (10, 11, 12, 13, 15, 14),
    MIDDLE: (19, 20, 21, 22, 24, 23),
    INDEX: (28, 29, 30, 31, 33, 32),
}
_KNUCKLE_SIDE = {LITTLE: 0.75}
_ON_THUMB = {41: 0.74, 42: 0.3}

# Back of the hand: across in palm half-widths from the axis of the arm (negative radial), up
# from the wrist in hand lengths.
_ON_HAND = {
    8: (0.76, 0.262),
    17: (0.39, 0.283),
    26: (-0.02, 0.291),
    35: (-0.44, 0.285),
    37: (-0.8, 0.225),
    7: (0.8, 0.165),
    16: (0.48, 0.165),
    25: (0.14, 0.165),
    34: (-0.2, 0.16),
    38: (-0.56, 0.155),
    40: (-0.98, 0.165),
    9: (0.53, 0.05),
    18: (0.26, 0.05),
    27: (0.0, 0.046),
    36: (-0.29, 0.05),
    39: (-0.6, 0.055),
}
# Arm: down from the wrist in forearm lengths, across in half-widths of the arm there.
_ON_ARM = {
    43: (0.059, 0.82),
    44: (0.059, 0.3),
    52: (0.059, -0.26),
    53: (0.059, -0.8),
    45: (0.138, 0.82),
    46: (0.138, 0.3),
    54: (0.138, -0.26),
    55: (0.138, -0.8),
    48: (0.276, 0.58),
    47: (0.38, 0.58),
    50: (0.5, 0.56),
    49: (0.6, 0.55),
    51: (0.71, 0.54),
    57: (0.339, -0.05),
    56: (0.445, -0.05),
    59: (0.544, -0.05),
    58: (0.658, -0.05),
    60: (0.721, -0.05),
    69: (0.954, 0.0),
    68: (1.032, -0.4),
    67: (0.97, -0.76),
    70: (0.99, 0.36),
    72: (0.93, 0.76),
    71: (1.035, 0.72),
}
_ON_VOLAR_ARM = {
    61: (0.059, 0.0),
    62: (0.059, 0.55),
    63: (0.138, 0.0),
    64: (0.138, 0.55),
    65: (0.66, 0.5),
    66: (0.36, 0.5),
}
_ON_PALM = {
    16: (0.19, 0.37),
    17: (-0.47, 0.3),
    18: (0.04, 0.235),
    19: (0.66, 0.2),
    20: (0.02, 0.085),
}


def input_points(skeleton: Skeleton) -> Floats:
    """Input places 1 to 20, (20, 2)."""
    places = np.empty((N_INPUTS, 2))
    for number, digit in enumerate(skeleton.digits):
        pad, base = (_THUMB_PAD, _THUMB_BASE) if number == THUMB else (_PAD, _BASE)
        for row, fraction in enumerate((_TIP, pad, base)):
            places[5 * row + number] = digit.point(fraction)
    half_palm = _half_palm(skeleton)
    for number, (across, up) in _ON_PALM.items():
        places[number - 1] = across * half_palm, up
    return places


def output_points(skeleton: Skeleton) -> tuple[Floats, Floats]:
    """Output places 1 to 72 on the back, (72, 2), NaN where volar; volar ones, (6, 2)."""
    places = np.full((N_OUTPUTS, 2), np.nan)
    for finger, numbers in _ON_FINGERS.items():
        digit = skeleton.digits[finger]
        spots = (
            (_BESIDE_NAIL, _NAIL_SIDE),
            (_BESIDE_NAIL, -_NAIL_SIDE),
            (_MIDDLE_PHALANX, _PHALANX_SIDE),
            (_MIDDLE_PHALANX, -_PHALANX_SIDE),
            (_PROXIMAL_PHALANX, 0.0),
            (0.0, _KNUCKLE_SIDE.get(finger, 0.0)),
        )
        for number, (fraction, side) in zip(numbers, spots, strict=True):
            places[number - 1] = digit.point(fraction, side)
    for number, fraction in _ON_THUMB.items():
        places[number - 1] = skeleton.digits[THUMB].point(fraction)
    half_palm = _half_palm(skeleton)
    for number, (across, up) in _ON_HAND.items():
        places[number - 1] = across * half_palm, up
    for number, (down, across) in _ON_ARM.items():
        places[number - 1] = skeleton.arm_point(down, across)
    volar = [skeleton.arm_point(*_ON_VOLAR_ARM[number]) for number in VOLAR_OUTPUTS]
    return places, np.array(volar)


def _half_palm(skeleton: Skeleton) -> float:
    """Half the width of the palm at the knuckles, in hand lengths."""
    radial = skeleton.digits[INDEX].point(0.0, -1.0)
    ulnar = skeleton.digits[LITTLE].point(0.0, 1.0)
    return float(ulnar[0] - radial[0]) / 2 + skeleton.proportions.palm_margin
