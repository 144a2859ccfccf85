"""Proportions of a right hand and forearm, and the axes of its digits.

Lengths here are fractions of the hand length.  The origin is the middle of the wrist, x points
to the right, y towards the fingertips; the hand is seen from its back, thumb to the left.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from skinsource.arrays import Floats
from skinsource.errors import InvalidInputError
from skinsource.hand.curves import profile
from skinsource.quoting import quoted

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

    def __post_init__(self) -> None:
        expected = {
            "digit_lengths": 5,
            "digit_widths": 5,
            "digit_angles_deg": 5,
            "digit_bends_deg": 5,
            "knuckle_spacings": 3,
            "knuckle_drops": 3,
            "thumb_root": 2,
        }
        for name, count in expected.items():
            found = len(getattr(self, name))
            if found != count:
                raise InvalidInputError(
                    f"hand proportions: {name} has {found} entries, expected {count}, from the "
                    "thumb to the little finger. Correct the list."
                )
        positive = ("digit_lengths", "digit_widths", "knuckle_spacings", "wrist_width")
        for name in (*positive, "thumb_metacarpal_length", "forearm_length", "forearm_width"):
            found = getattr(self, name)
            if not np.all(np.asarray(found) > 0):
                raise InvalidInputError(
                    f"hand proportions: {name} is {quoted(found)}, expected positive fractions of "
                    "the hand length. Correct the numbers."
                )


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
        """Half of the width at ``fraction`` of the length from the base, same shape."""
        stations = _THUMB_STATIONS if self.is_thumb else _FINGER_STATIONS
        return profile(stations, fraction) * self.width / 2

    def normal(self, fraction: ArrayLike) -> Floats:
        """Unit vectors across the digit towards its ulnar side, (..., 2)."""
        angle = self.angle_rad + self.bend_rad * np.asarray(fraction, dtype=float)
        return np.stack([np.cos(angle), -np.sin(angle)], axis=-1)

    def point(self, fraction: ArrayLike, side: ArrayLike = 0.0) -> Floats:
        """Places on the digit, (..., 2).

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
        """Base, joints and tip, (3 or 4, 2)."""
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
    thumb_root : (2,)
        The thumb's saddle joint.
    """

    proportions: HandProportions
    digits: tuple[Digit, ...]
    thumb_root: Floats

    def arm_edge(self, arm_fraction: ArrayLike, side: int) -> Floats:
        """X of the arm's edge at fractions of the forearm length past the wrist, same shape.

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
    return Skeleton(proportions=p, digits=digits, thumb_root=root)


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
