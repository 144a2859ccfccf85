"""The application's own drawing of a right hand and arm, made from proportions."""

from dataclasses import dataclass

import numpy as np

from skinsource.arrays import Floats
from skinsource.hand.anatomy import (
    INDEX,
    LITTLE,
    MIDDLE,
    RING,
    THUMB,
    Digit,
    HandProportions,
    Skeleton,
    skeleton_of,
)
from skinsource.hand.curves import bezier, smooth
from skinsource.hand.markings import creases_of, nails_of
from skinsource.hand.places import input_points, output_points
from skinsource.limb import LimbMap

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
    thumb_root, wrist, elbow : (2,)
        Saddle joint of the thumb; middle of the wrist; middle of the elbow.
    wrist_ends : (2, 2)
        Radial and ulnar end of the wrist line.
    creases
        Lines of a palmar drawing: fingers, palm, wrist; open polylines (n, 2).
    nails
        Nails of a dorsal drawing, digits I to V; closed polylines (n, 2).
    hand_length_px
        Tip of digit III to the middle of the wrist, 400.
    """

    outline: Floats
    input_positions: Floats
    output_positions: Floats
    volar_positions: Floats
    digit_axes: tuple[Floats, ...]
    thumb_root: Floats
    wrist: Floats
    elbow: Floats
    wrist_ends: Floats
    creases: tuple[Floats, ...]
    nails: tuple[Floats, ...]
    hand_length_px: float = HAND_LENGTH_PX

    def limb_map(self) -> LimbMap:
        """The part of this drawing that a `Limb` carries."""
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
        thumb_root=px(skeleton.thumb_root),
        wrist=px(np.zeros(2)),
        elbow=px(skeleton.arm_point(1.0, 0.0)),
        wrist_ends=px(wrist_ends),
        creases=tuple(px(line) for line in creases_of(skeleton)),
        nails=tuple(px(line) for line in nails_of(skeleton)),
    )


def _contour(skeleton: Skeleton) -> Floats:
    """Control points of the outline, counter-clockwise from the ulnar end of the arm, (n, 2)."""
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
    """Where the gaps end on each finger: radial and ulnar side, in its lengths.

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
    """From just before the end of the arm up to just past the wrist, (n, 2)."""
    fractions = np.linspace(1.07, 0.09, 15)
    length = skeleton.proportions.forearm_length
    return np.stack([skeleton.arm_edge(fractions, side), -fractions * length], axis=-1)


def _arm_end(skeleton: Skeleton) -> Floats:
    """A soft cut across the arm, from radial to ulnar, (n, 2)."""
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
    """The hollow between index and thumb, from the index down, (n, 2)."""
    index, thumb = skeleton.digits[INDEX], skeleton.digits[THUMB]
    start, stop = index.point(_INDEX_FOOT, -1.0), thumb.point(_THUMB_WEB, 1.0)
    back = np.stack([-_ahead(index, _INDEX_FOOT), -_ahead(thumb, _THUMB_WEB)])
    # The two edges, prolonged, meet at these distances.
    reach = np.linalg.solve(np.stack([back[0], -back[1]], axis=1), stop - start)
    leave, arrive = start + 0.48 * reach[0] * back[0], stop + 0.48 * reach[1] * back[1]
    return bezier(start, leave, arrive, stop, count=13)[1:-1]


def _ahead(digit: Digit, fraction: float) -> Floats:
    """Unit vector along the digit towards its tip, (2,)."""
    normal = digit.normal(fraction)
    return np.array([-normal[1], normal[0]])


def _ulnar_palm(skeleton: Skeleton) -> Floats:
    """From the wrist up to the little finger's knuckle, (n, 2)."""
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
    """From the thumb's knuckle along its ball down to the wrist, (n, 2)."""
    thumb = skeleton.digits[THUMB]
    start = thumb.point(0.05, -1.0)
    stop = skeleton.arm_point(0.065, -1.0)
    span = float(np.linalg.norm(stop - start))
    leave = start - 0.6 * span * _ahead(thumb, 0.0)
    arrive = stop + np.array([0.0, 0.4 * span])
    return bezier(start, leave, arrive, stop, count=12)[1:]


def _resampled(curve: Floats, count: int) -> Floats:
    """A closed curve with ``count`` vertices, denser where it bends, (count, 2)."""
    steps = np.roll(curve, -1, axis=0) - curve
    lengths = np.linalg.norm(steps, axis=1)
    angles = np.arctan2(steps[:, 1], steps[:, 0])
    turns = np.abs((angles - np.roll(angles, 1) + np.pi) % (2 * np.pi) - np.pi)
    # A turn belongs to both steps that meet there; averaging keeps spacing from jumping.
    turns = (turns + np.roll(turns, -1)) / 2
    turns = (np.roll(turns, 1) + 2 * turns + np.roll(turns, -1)) / 4
    density = lengths / _STRAIGHT_SPACING + turns / _TURN_RAD
    position = np.concatenate([[0.0], np.cumsum(density)])
    wanted = np.arange(count) * position[-1] / count
    closed = np.vstack([curve, curve[:1]])
    return np.stack([np.interp(wanted, position, closed[:, axis]) for axis in (0, 1)], axis=-1)
