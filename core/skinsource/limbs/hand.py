"""The drawing of a right hand and forearm, made from proportions.

It has an outline, creases, and the positions of inputs and outputs.  Lengths are fractions
of the hand length: the origin is the middle of the wrist, x points to the right, y towards the
fingertips; the hand is seen from its back, thumb to the left.  `HandShape` is in pixels.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import ArrayLike

from skinsource.base.arrays import Floats
from skinsource.base.measurement_conditions import N_INPUTS, N_OUTPUTS, VOLAR_OUTPUTS
from skinsource.limbs.limb import LimbMap


def smooth(points: ArrayLike, *, closed: bool, per_span: int = 12) -> Floats:
    """Return the centripetal Catmull-Rom curve through points in the plane.

    It passes through every point and, unlike a uniform spline, forms no loops (Yuksel, Schaefer
    and Keyser, 2011).

    Parameters
    ----------
    points : (n, 2)
        No two neighbours may coincide.
    closed
        Whether the curve returns to the first point.
    per_span
        Points per span, its start included.

    Returns
    -------
    (n * per_span, 2) when closed, else ((n - 1) * per_span + 1, 2).
    """
    p = np.asarray(points, dtype=float)
    if closed:
        before, after, ends = np.roll(p, 1, axis=0), np.roll(p, -1, axis=0), np.roll(p, -2, axis=0)
    else:
        padded = np.vstack([2 * p[0] - p[1], p, 2 * p[-1] - p[-2]])
        before, p, after, ends = padded[:-3], padded[1:-2], padded[2:-1], padded[3:]
    d0, d1, d2 = (
        np.sqrt(np.linalg.norm(b - a, axis=1))[:, None]
        for a, b in ((before, p), (p, after), (after, ends))
    )
    start = (d1 * (p - before) / d0 + d0 * (after - p) / d1) / (d0 + d1) * d1
    stop = (d2 * (after - p) / d1 + d1 * (ends - after) / d2) / (d1 + d2) * d1
    t = (np.arange(per_span) / per_span)[None, :, None]
    hermite = (2 * t**3 - 3 * t**2 + 1, t**3 - 2 * t**2 + t, 3 * t**2 - 2 * t**3, t**3 - t**2)
    parts = [w * v[:, None] for w, v in zip(hermite, (p, start, after, stop), strict=True)]
    curve = np.sum(parts, axis=0).reshape(-1, 2)
    return curve if closed else np.vstack([curve, after[-1]])


def bezier(start: Floats, leave: Floats, arrive: Floats, stop: Floats, *, count: int) -> Floats:
    """Return the cubic Bezier curve from ``start`` to ``stop``, both included, (count, 2)."""
    t = np.linspace(0, 1, count)[:, None]
    edges = (1 - t) ** 3 * start + t**3 * stop
    return np.asarray(edges + 3 * t * (1 - t) * ((1 - t) * leave + t * arrive))


def profile(stations: tuple[tuple[float, float], ...], at: ArrayLike) -> Floats:
    """Return the values at ``at`` of a smooth curve through ``stations`` (position, value)."""
    curve = _curve_through(stations)
    return np.asarray(np.interp(np.asarray(at, dtype=float), curve[:, 0], curve[:, 1]))


@cache
def _curve_through(stations: tuple[tuple[float, float], ...]) -> Floats:
    # The same few curves are read at hundreds of places.
    curve = smooth(stations, closed=False)
    curve.flags.writeable = False
    return curve


THUMB, INDEX, MIDDLE, RING, LITTLE = range(5)
# Joints along a digit, as fractions of its length from the base knuckle to the tip.
_FINGER_JOINTS = (0.0, 0.475, 0.755, 1.0)
_THUMB_JOINTS = (0.0, 0.54, 1.0)
# Half-width along a digit relative to its own half-width: it swells at the joints.
_FINGER_STATIONS = (
    (0.0, 1.04),
    (0.2, 0.99),
    (0.34, 0.96),
    (0.475, 1.0),
    (0.63, 0.925),
    (0.77, 0.9),
    (0.88, 0.84),
    (1.0, 0.76),
)
_THUMB_STATIONS = (
    (-0.1, 1.1),
    (0.0, 1.05),
    (0.3, 0.93),
    (0.54, 0.99),
    (0.7, 0.98),
    (0.84, 0.88),
    (1.0, 0.74),
)
# Swelling of the arm between wrist (0) and muscles (1), by fractions of the forearm length.
_RADIAL_ARM_STATIONS = (
    (0.0, 0.03),
    (0.09, 0.0),
    (0.2, 0.1),
    (0.35, 0.36),
    (0.55, 0.78),
    (0.74, 1.0),
    (0.92, 0.95),
    (1.2, 0.84),
)
_ULNAR_ARM_STATIONS = (
    (0.0, 0.03),
    (0.09, 0.0),
    (0.2, 0.13),
    (0.35, 0.46),
    (0.53, 0.87),
    (0.68, 1.0),
    (0.9, 0.94),
    (1.2, 0.86),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class HandProportions:
    """Shape of a hand and arm, in fractions of the hand length and in degrees.

    Tuples run from digit I (thumb) to digit V.  The hand length itself is one by definition:
    the palm takes what the third digit leaves.

    Attributes
    ----------
    digit_lengths
        Base knuckle to tip.
    digit_widths
        At the middle joint.
    digit_angles_deg
        Direction at the base, from straight up, positive to the right (ulnar).
    digit_bends_deg
        How far the direction turns from base to tip.
    knuckle_spacings, knuckle_drops
        Distances between the knuckles II-III, III-IV, IV-V; drop of II, IV, V below III.
    thumb_root, thumb_metacarpal_length, thumb_metacarpal_angle_deg
        Place of the thumb's saddle joint; length and direction of its metacarpal.
    palm_margin
        Flesh between the outer knuckles' digits and the edge of the palm.
    wrist_width, forearm_width
        Widths across the outline where the arm is thinnest and thickest.
    forearm_length
        From the wrist to the elbow.
    """

    digit_lengths: tuple[float, ...]
    digit_widths: tuple[float, ...]
    digit_angles_deg: tuple[float, ...]
    digit_bends_deg: tuple[float, ...]
    knuckle_spacings: tuple[float, ...]
    knuckle_drops: tuple[float, ...]
    thumb_root: tuple[float, float]
    thumb_metacarpal_length: float
    thumb_metacarpal_angle_deg: float
    palm_margin: float
    wrist_width: float
    forearm_length: float
    forearm_width: float


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Digit:
    """One digit's axis, a gentle arc from the base knuckle to the tip.

    Attributes
    ----------
    base : (2,)
        The base knuckle.
    length, width
        Base to tip; width at the middle joint.
    angle_rad, bend_rad
        Direction at the base, from straight up and positive to the right; turn along the digit.
    is_thumb
        The thumb has one joint less.
    """

    base: Floats
    length: float
    width: float
    angle_rad: float
    bend_rad: float
    is_thumb: bool

    @property
    def joint_fractions(self) -> tuple[float, ...]:
        """Base, joints and tip as fractions of the length."""
        return _THUMB_JOINTS if self.is_thumb else _FINGER_JOINTS

    def half_width(self, fraction: ArrayLike) -> Floats:
        """Return half the width at ``fraction`` of the length from the base, same shape."""
        stations = _THUMB_STATIONS if self.is_thumb else _FINGER_STATIONS
        return profile(stations, fraction) * self.width / 2

    def normal(self, fraction: ArrayLike) -> Floats:
        """Return unit vectors across the digit towards its ulnar side, (..., 2)."""
        angle = self.angle_rad + self.bend_rad * np.asarray(fraction, dtype=float)
        return np.stack([np.cos(angle), -np.sin(angle)], axis=-1)

    def point(self, fraction: ArrayLike, side: ArrayLike = 0.0) -> Floats:
        """Return positions on the digit, (..., 2).

        Parameters
        ----------
        fraction
            Along the axis: 0 base, 1 tip.
        side
            Across, in half-widths: -1 left edge (radial on a finger), +1 right edge.
        """
        along = np.asarray(fraction, dtype=float)
        # Integral of (sin, cos) of a linearly turning angle.
        mean_angle = self.angle_rad + self.bend_rad * along / 2
        chord = self.length * along * np.sinc(self.bend_rad * along / (2 * np.pi))
        axis = np.stack([chord * np.sin(mean_angle), chord * np.cos(mean_angle)], axis=-1)
        across = np.asarray(side, dtype=float) * self.half_width(along)
        return np.asarray(self.base + axis + across[..., None] * self.normal(along))

    def joints(self) -> Floats:
        """Return the base, joints and tip, (3 or 4, 2)."""
        return self.point(self.joint_fractions)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Skeleton:
    """Axes of the digits and of the arm, in hand lengths.

    Attributes
    ----------
    proportions
        What it was made from.
    digits
        Digits I to V.
    """

    proportions: HandProportions
    digits: tuple[Digit, ...]

    def arm_edge(self, arm_fraction: ArrayLike, side: int) -> Floats:
        """Return x of the arm's edge at fractions of the forearm length past the wrist.

        ``side`` is -1 for the radial (left) and +1 for the ulnar (right) edge.  Both swell
        towards the elbow; the radial muscles sit nearer to it.
        """
        p = self.proportions
        stations = _RADIAL_ARM_STATIONS if side < 0 else _ULNAR_ARM_STATIONS
        swell = (p.forearm_width - p.wrist_width) / 2
        return side * (p.wrist_width / 2 + swell * profile(stations, arm_fraction))

    def arm_point(self, arm_fraction: float, side: float) -> Floats:
        """Place on the arm, (2,): fraction of the forearm past the wrist, side from -1 to +1."""
        edge = abs(side) * self.arm_edge(arm_fraction, -1 if side < 0 else 1)
        return np.array([float(edge), -arm_fraction * self.proportions.forearm_length])


def skeleton_of(proportions: HandProportions) -> Skeleton:
    """Place the digits so that the hand is exactly one hand length long."""
    p = proportions
    angles, bends = np.radians(p.digit_angles_deg), np.radians(p.digit_bends_deg)
    knuckles = np.zeros((5, 2))
    spacing = p.knuckle_spacings
    knuckles[INDEX] = (-spacing[0], -p.knuckle_drops[0])
    knuckles[RING] = (spacing[1], -p.knuckle_drops[1])
    knuckles[LITTLE] = (spacing[1] + spacing[2], -p.knuckle_drops[2])
    middle = _digit(p, MIDDLE, np.zeros(2), angles, bends).point(1.0)
    # The tip of digit III stands one hand length from the origin, over the middle of the wrist.
    knuckles[1:] += (-middle[0] / 2, np.sqrt(1 - (middle[0] / 2) ** 2) - middle[1])
    root = np.array(p.thumb_root)
    lean = np.radians(p.thumb_metacarpal_angle_deg)
    knuckles[THUMB] = root + p.thumb_metacarpal_length * np.array([np.sin(lean), np.cos(lean)])
    digits = tuple(_digit(p, digit, knuckles[digit], angles, bends) for digit in range(5))
    return Skeleton(proportions=p, digits=digits)


def _digit(
    proportions: HandProportions,
    digit: int,
    base: Floats,
    angles_rad: Floats,
    bends_rad: Floats,
) -> Digit:
    return Digit(
        base=base,
        length=proportions.digit_lengths[digit],
        width=proportions.digit_widths[digit],
        angle_rad=float(angles_rad[digit]),
        bend_rad=float(bends_rad[digit]),
        is_thumb=digit == THUMB,
    )


# Creases across a digit: fraction of its length, sag towards the hand in hand lengths.
_FINGER_CREASES = (0.215, 0.465, 0.49, 0.757)
_THUMB_CREASES = (0.07, 0.525, 0.56)


def creases_of(skeleton: Skeleton) -> list[Floats]:
    """Return the finger, palm and wrist creases, open lines, each (n, 2)."""
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
    """Return the distal, the proximal and the thenar crease."""
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
    """Return the positions of input places 1 to 20, (20, 2)."""
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
    """Return the outputs on the back, (72, 2), NaN where volar, and the volar ones, (6, 2)."""
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
    """Return half the width of the palm at the knuckles, in hand lengths."""
    radial = skeleton.digits[INDEX].point(0.0, -1.0)
    ulnar = skeleton.digits[LITTLE].point(0.0, 1.0)
    return float(ulnar[0] - radial[0]) / 2 + skeleton.proportions.palm_margin


#: Outline pixels in one hand length.
HAND_LENGTH_PX = 400.0

_N_VERTICES = 720
_MARGIN_PX = 20.0
# Spacing of vertices on straight parts, and the largest turn from one to the next.
_STRAIGHT_SPACING = 0.025
_TURN_RAD = np.radians(5.0)
# Heights of the webs between two fingers over the mean of their knuckles, in hand lengths.
_WEB_LEVELS = {(INDEX, MIDDLE): 0.128, (MIDDLE, RING): 0.132, (RING, LITTLE): 0.105}
# Where the palm begins on the outer sides of digits I, II and V, in their lengths.
_THUMB_WEB, _INDEX_FOOT, _LITTLE_FOOT = 0.26, 0.1, 0.32
_FINGERTIP_STARTS = 0.905
_THUMBTIP_STARTS = 0.86


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HandShape:
    """A right hand and arm seen from the back, in outline pixels, x right, y up, thumb left.

    Attributes
    ----------
    outline : (n_vertices, 2)
        Closed simple polygon, counter-clockwise, last vertex not repeated.
    input_positions : (20, 2)
        Input places, seen through the hand.
    output_positions : (72, 2)
        Sensors; the rows of the six volar ones are NaN.
    volar_positions : (6, 2)
        Outputs 61 to 66, seen through the arm, for a palmar drawing.
    digit_axes
        For digits I to V the base knuckle, joints and tip, (3, 2) for the thumb, else (4, 2).
    wrist, elbow : (2,)
        Middle of the wrist; middle of the elbow.
    wrist_ends : (2, 2)
        Radial and ulnar end of the wrist line.
    creases
        Lines of a palmar drawing: fingers, palm, wrist; open polylines (n, 2).
    hand_length_px
        Tip of digit III to the middle of the wrist, 400.
    """

    outline: Floats
    input_positions: Floats
    output_positions: Floats
    volar_positions: Floats
    digit_axes: tuple[Floats, ...]
    wrist: Floats
    elbow: Floats
    wrist_ends: Floats
    creases: tuple[Floats, ...]
    hand_length_px: float = HAND_LENGTH_PX

    def limb_map(self) -> LimbMap:
        """Return the part of this drawing that a `Limb` carries."""
        return LimbMap(
            outline=self.outline,
            output_positions=self.output_positions,
            input_positions=self.input_positions,
            hand_length_px=self.hand_length_px,
        )


def hand_shape(proportions: HandProportions) -> HandShape:
    """Draw a hand and arm of these proportions.

    Parameters
    ----------
    proportions
        In fractions of the hand length; see `HandProportions`.

    Returns
    -------
    HandShape
        Coordinates in pixels, `HAND_LENGTH_PX` to a hand length, all positive.
    """
    skeleton = skeleton_of(proportions)
    contour = _resampled(smooth(_contour(skeleton), closed=True), _N_VERTICES)
    origin = contour.min(axis=0)

    def px(points: Floats) -> Floats:
        return (points - origin) * HAND_LENGTH_PX + _MARGIN_PX

    outputs, volar = output_points(skeleton)
    wrist_ends = np.array([skeleton.arm_point(0.0, -1.0), skeleton.arm_point(0.0, 1.0)])
    return HandShape(
        outline=px(contour),
        input_positions=px(input_points(skeleton)),
        output_positions=px(outputs),
        volar_positions=px(volar),
        digit_axes=tuple(px(digit.joints()) for digit in skeleton.digits),
        wrist=px(np.zeros(2)),
        elbow=px(skeleton.arm_point(1.0, 0.0)),
        wrist_ends=px(wrist_ends),
        creases=tuple(px(line) for line in creases_of(skeleton)),
    )


def _contour(skeleton: Skeleton) -> Floats:
    """Return the outline's control points, counter-clockwise from the arm's ulnar end, (n, 2)."""
    digits = skeleton.digits
    feet = _web_feet(digits)
    parts = [_arm_edge(skeleton, 1), _ulnar_palm(skeleton)]
    for number in range(LITTLE, INDEX - 1, -1):
        down_to, up_from = feet[number]
        parts.append(_digit_sides(digits[number], up_from, down_to, _FINGERTIP_STARTS))
        if number > INDEX:
            parts.append(_web(digits[number - 1], digits[number], feet[number - 1][1], down_to))
    parts.append(_first_web(skeleton))
    parts.append(_digit_sides(digits[THUMB], _THUMB_WEB, 0.05, _THUMBTIP_STARTS))
    parts.append(_radial_palm(skeleton))
    parts.append(_arm_edge(skeleton, -1)[::-1])
    parts.append(_arm_end(skeleton))
    return np.vstack(parts)


def _web_feet(digits: tuple[Digit, ...]) -> dict[int, tuple[float, float]]:
    """Return where the gaps end on each finger's radial and ulnar side, in its lengths.

    Both sides of a gap end at the same height.
    """
    feet = {INDEX: [_INDEX_FOOT], MIDDLE: [], RING: [], LITTLE: []}
    for (radial, ulnar), level in _WEB_LEVELS.items():
        height = (digits[radial].base[1] + digits[ulnar].base[1]) / 2 + level
        along = np.linspace(0, 0.6, 61)
        for number, side in ((radial, 1.0), (ulnar, -1.0)):
            heights = digits[number].point(along, side)[:, 1]
            feet[number].append(float(np.interp(height, heights, along)))
    feet[LITTLE].append(_LITTLE_FOOT)
    return {number: (radial, ulnar) for number, (radial, ulnar) in feet.items()}


def _arm_edge(skeleton: Skeleton, side: int) -> Floats:
    """Return the edge from just before the end of the arm to just past the wrist, (n, 2)."""
    fractions = np.linspace(1.07, 0.09, 15)
    length = skeleton.proportions.forearm_length
    return np.stack([skeleton.arm_edge(fractions, side), -fractions * length], axis=-1)


def _arm_end(skeleton: Skeleton) -> Floats:
    """Return a rounded cut across the arm, from radial to ulnar, (n, 2)."""
    at = np.array([-0.97, -0.88, -0.6, -0.2, 0.2, 0.6, 0.88, 0.97])
    drop = np.array([1.098, 1.108, 1.112, 1.115, 1.115, 1.112, 1.108, 1.098])
    return np.array([skeleton.arm_point(d, s) for d, s in zip(drop, at, strict=True)])


def _digit_sides(digit: Digit, up_from: float, down_to: float, tip_from: float) -> Floats:
    stations = np.linspace(0.0, 1.0, 14)
    up = up_from + (tip_from - up_from) * stations
    down = tip_from + (down_to - tip_from) * stations
    turn = np.linspace(0, np.pi, 15)[1:-1]
    across = np.cos(turn)
    along = tip_from + (1 - tip_from) * np.sin(turn)
    half_width = digit.half_width(tip_from)
    cap = digit.point(along) + (across * half_width)[:, None] * digit.normal(along)
    return np.vstack([digit.point(up, 1.0), cap, digit.point(down, -1.0)])


def _web(radial: Digit, ulnar: Digit, foot_radial: float, foot_ulnar: float) -> Floats:
    """Round bottom of the gap between two fingers, from the ulnar one, (n, 2)."""
    start, stop = ulnar.point(foot_ulnar, -1.0), radial.point(foot_radial, 1.0)
    # 4/3 of the radius makes a Bezier arc a half circle.
    depth = 2 / 3 * float(np.linalg.norm(stop - start))
    leave, arrive = (
        foot - depth * _ahead(digit, fraction)
        for foot, digit, fraction in ((start, ulnar, foot_ulnar), (stop, radial, foot_radial))
    )
    return bezier(start, leave, arrive, stop, count=9)[1:-1]


def _first_web(skeleton: Skeleton) -> Floats:
    """Return the hollow between index and thumb, from the index down, (n, 2)."""
    index, thumb = skeleton.digits[INDEX], skeleton.digits[THUMB]
    start, stop = index.point(_INDEX_FOOT, -1.0), thumb.point(_THUMB_WEB, 1.0)
    back = np.stack([-_ahead(index, _INDEX_FOOT), -_ahead(thumb, _THUMB_WEB)])
    # The two edges, prolonged, meet at these distances.
    reach = np.linalg.solve(np.stack([back[0], -back[1]], axis=1), stop - start)
    leave, arrive = start + 0.48 * reach[0] * back[0], stop + 0.48 * reach[1] * back[1]
    return bezier(start, leave, arrive, stop, count=13)[1:-1]


def _ahead(digit: Digit, fraction: float) -> Floats:
    """Return the unit vector along the digit towards its tip, (2,)."""
    normal = digit.normal(fraction)
    return np.array([-normal[1], normal[0]])


def _ulnar_palm(skeleton: Skeleton) -> Floats:
    """Return the edge from the wrist up to the little finger's knuckle, (n, 2)."""
    p = skeleton.proportions
    knuckle = skeleton.digits[LITTLE].point(0.0, 1.0)
    edge = float(knuckle[0]) + p.palm_margin
    wrist = p.wrist_width / 2
    return np.array(
        [
            (wrist + 0.006, -0.03),
            (wrist + 0.03, 0.04),
            (wrist + 0.7 * (edge - wrist), 0.11),
            (edge - 0.006, 0.19),
            (edge, 0.27),
            (edge + 0.002, float(knuckle[1]) - 0.02),
        ]
    )


def _radial_palm(skeleton: Skeleton) -> Floats:
    """Return the edge from the thumb's knuckle along its ball down to the wrist, (n, 2)."""
    thumb = skeleton.digits[THUMB]
    start = thumb.point(0.05, -1.0)
    stop = skeleton.arm_point(0.065, -1.0)
    span = float(np.linalg.norm(stop - start))
    leave = start - 0.6 * span * _ahead(thumb, 0.0)
    arrive = stop + np.array([0.0, 0.4 * span])
    return bezier(start, leave, arrive, stop, count=12)[1:]


def _resampled(curve: Floats, count: int) -> Floats:
    """Resample a closed curve to ``count`` vertices, denser where it bends, (count, 2)."""
    steps = np.roll(curve, -1, axis=0) - curve
    lengths = np.linalg.norm(steps, axis=1)
    angles = np.arctan2(steps[:, 1], steps[:, 0])
    turns = np.abs((angles - np.roll(angles, 1) + np.pi) % (2 * np.pi) - np.pi)
    # A turn belongs to both steps that meet there; averaging keeps spacing from jumping.
    turns = (turns + np.roll(turns, -1)) / 2
    turns = (np.roll(turns, 1) + 2 * turns + np.roll(turns, -1)) / 4
    density = lengths / _STRAIGHT_SPACING + turns / _TURN_RAD
    position = np.concatenate([[0.0], np.cumsum(density)])
    targets = np.arange(count) * position[-1] / count
    closed = np.vstack([curve, curve[:1]])
    return np.stack([np.interp(targets, position, closed[:, axis]) for axis in (0, 1)], axis=-1)
