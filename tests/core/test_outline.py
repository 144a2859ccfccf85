from dataclasses import replace

import numpy as np
import pytest

from skinsource.limbs.hand import HAND_LENGTH_PX, HandProportions, hand_shape, skeleton_of, smooth
from skinsource.limbs.synthetic import SYNTHETIC_LIMBS, synthetic_model

PROPORTIONS = HandProportions(
    digit_lengths=(0.36, 0.5, 0.55, 0.51, 0.41),
    digit_widths=(0.118, 0.106, 0.108, 0.101, 0.09),
    digit_angles_deg=(-38.0, -12.0, 0.0, 10.5, 23.0),
    digit_bends_deg=(8.0, 5.0, 0.0, -4.0, -6.0),
    knuckle_spacings=(0.1, 0.095, 0.09),
    knuckle_drops=(0.004, 0.022, 0.07),
    thumb_root=(-0.1, 0.085),
    thumb_metacarpal_length=0.25,
    thumb_metacarpal_angle_deg=-46.0,
    palm_margin=0.022,
    wrist_width=0.31,
    forearm_length=1.45,
    forearm_width=0.49,
)
# Outputs down the middle of digit III and the arm, and their distance from its tip on limb 1.
MIDDLE_PATH = (20, 22, 24, 32, 26, 34, 27, 52, 54, 57, 56, 59, 58, 60, 69, 68)
DISTANCES_MM = (16, 34, 67, 98, 124, 147, 167, 190, 210, 261, 288, 313, 342, 358, 417, 437)
# Beside the nail and on the middle phalanx: ulnar, radial.
SIDE_PAIRS = ((1, 2), (3, 4), (10, 11), (12, 13), (19, 20), (21, 22), (28, 29), (30, 31))


@pytest.fixture(scope="module", params=SYNTHETIC_LIMBS)
def shape(request):
    return synthetic_model(request.param).shape


def inside(points, polygon):
    """Whether points lie inside a polygon, by the crossing number."""
    x, y = points[:, 0, None], points[:, 1, None]
    start, stop = polygon, np.roll(polygon, -1, axis=0)
    spans = (start[:, 1] > y) != (stop[:, 1] > y)
    rise = np.where(start[:, 1] == stop[:, 1], 1.0, stop[:, 1] - start[:, 1])
    at = start[:, 0] + (y - start[:, 1]) / rise * (stop[:, 0] - start[:, 0])
    return np.sum(spans & (x < at), axis=1) % 2 == 1


def crossings(polygon):
    """How many pairs of edges that are no neighbours meet."""
    a, b = polygon, np.roll(polygon, -1, axis=0)

    def turn(p, q, r):
        return (q[..., 0] - p[..., 0]) * (r[..., 1] - p[..., 1]) - (q[..., 1] - p[..., 1]) * (
            r[..., 0] - p[..., 0]
        )

    p, q, r, s = a[:, None], b[:, None], a[None], b[None]
    meets = (turn(p, q, r) * turn(p, q, s) <= 0) & (turn(r, s, p) * turn(r, s, q) <= 0)
    count = len(polygon)
    steps = (np.arange(count)[:, None] - np.arange(count)) % count
    return int(np.sum(meets & (steps > 1) & (steps < count - 1))) // 2


def position(shape, number):
    return shape.output_positions[number - 1]


def test_crossings_are_found_where_there_are_some():
    bow_tie = np.array([[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]])
    assert crossings(bow_tie) == 1


def test_the_outline_is_a_simple_counter_clockwise_polygon(shape):
    x, y = shape.outline.T
    area = np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) / 2
    assert area > 0
    assert crossings(shape.outline) == 0
    assert 400 <= len(shape.outline) <= 800
    assert not np.array_equal(shape.outline[0], shape.outline[-1])


def test_the_outline_is_smooth(shape):
    steps = np.roll(shape.outline, -1, axis=0) - shape.outline
    angle = np.arctan2(steps[:, 1], steps[:, 0])
    turns = np.abs((np.diff(angle, append=angle[:1]) + np.pi) % (2 * np.pi) - np.pi)
    assert np.degrees(turns.max()) < 25
    assert np.linalg.norm(steps, axis=1).max() < 16


def test_a_hand_is_400_pixels_long(shape):
    assert shape.hand_length_px == HAND_LENGTH_PX == 400.0
    assert np.linalg.norm(shape.digit_axes[2][-1] - shape.wrist) == pytest.approx(400.0)


def test_every_place_lies_inside_the_outline(shape):
    dorsal = np.isfinite(shape.output_positions[:, 0])
    assert np.flatnonzero(~dorsal).tolist() == [60, 61, 62, 63, 64, 65]
    places = (shape.output_positions[dorsal], shape.input_positions, shape.volar_positions)
    for points in places:
        assert inside(points, shape.outline).all()
        gaps = np.linalg.norm(points[:, None] - shape.outline, axis=-1).min(axis=1)
        assert gaps.min() > 4, f"{gaps.min():.1f} px from the edge"


def test_distances_down_the_middle_match_the_description():
    model = synthetic_model(1)
    tip = model.shape.digit_axes[2][-1]
    mm_per_px = model.hand_length_mm / model.shape.hand_length_px
    lengths_mm = np.array([tip[1] - position(model.shape, n)[1] for n in MIDDLE_PATH]) * mm_per_px
    assert np.abs(lengths_mm - DISTANCES_MM).max() < 5, lengths_mm.round()


def test_digits_stand_in_order_with_the_thumb_on_the_left(shape):
    tips = np.array([axis[-1] for axis in shape.digit_axes])
    knuckles = np.array([axis[0] for axis in shape.digit_axes])
    assert (np.diff(tips[:, 0]) > 0).all()
    assert (np.diff(knuckles[:, 0]) > 0).all()
    height = dict(zip(["I", "II", "III", "IV", "V"], tips[:, 1], strict=True))
    assert height["III"] > height["II"] > height["V"] > height["I"]
    assert abs(height["II"] - height["IV"]) < 0.06 * HAND_LENGTH_PX


def test_ulnar_places_lie_right_of_radial_places(shape):
    for ulnar, radial in SIDE_PAIRS:
        assert position(shape, ulnar)[0] > position(shape, radial)[0]
    rows = ((39, 36, 27, 18, 9), (53, 52, 44, 43), (55, 54, 46, 45), (37, 35, 26, 17, 8))
    for row in (*rows, (40, 38, 34, 25, 16, 7), (67, 68, 69, 70, 71), (57, 48), (58, 49)):
        assert (np.diff([position(shape, number)[0] for number in row]) > 0).all(), row
    assert shape.volar_positions[1, 0] > shape.volar_positions[0, 0]


def test_places_come_in_order_from_fingertip_to_elbow(shape):
    columns = ((20, 22, 24, 23, 26, 34, 27, 52, 54, 57, 56, 59, 58, 60, 69, 68),)
    columns += ((1, 3, 6, 5, 8, 7, 9, 43, 45, 48, 47, 50, 49, 51, 70), (41, 42, 40))
    for column in columns:
        assert (np.diff([position(shape, number)[1] for number in column]) < 0).all(), column
    tips, pads, bases = shape.input_positions[:15].reshape(3, 5, 2)
    assert (tips[:, 1] > pads[:, 1]).all()
    assert (pads[:, 1] > bases[:, 1]).all()


def test_there_is_a_gap_between_neighbouring_fingers(shape):
    beside_nails = ((29, 20), (28, 20), (19, 11), (10, 2))
    gaps = [(position(shape, a) + position(shape, b)) / 2 for a, b in beside_nails[1:]]
    gaps.append((position(shape, 42) + position(shape, 33)) / 2)
    assert not inside(np.array(gaps), shape.outline).any()


def test_creases_lie_inside_the_outline(shape):
    assert len(shape.creases) == 24
    for line in shape.creases:
        assert inside(line, shape.outline).all()


def test_the_limb_map_carries_the_drawing(shape):
    limb_map = shape.limb_map()
    assert limb_map.outline is shape.outline
    assert limb_map.output_positions is shape.output_positions
    assert limb_map.input_positions is shape.input_positions
    assert limb_map.hand_length_px == 400.0
    assert limb_map.visibility is None
    assert limb_map.densify


def test_all_coordinates_are_positive(shape):
    assert shape.outline.min() == pytest.approx(20.0)


def test_a_longer_forearm_moves_the_elbow_and_nothing_on_the_hand():
    short, long = hand_shape(PROPORTIONS), hand_shape(replace(PROPORTIONS, forearm_length=1.6))
    assert np.linalg.norm(short.elbow - short.wrist) == pytest.approx(1.45 * 400)
    assert np.linalg.norm(long.elbow - long.wrist) == pytest.approx(1.6 * 400)
    hand = slice(0, 42)
    np.testing.assert_allclose(
        long.output_positions[hand] - long.wrist, short.output_positions[hand] - short.wrist
    )


def test_wider_digits_make_wider_fingers():
    wide = hand_shape(replace(PROPORTIONS, digit_widths=(0.12, 0.107, 0.12, 0.105, 0.092)))
    normal = hand_shape(PROPORTIONS)
    distances_px = [np.linalg.norm(position(s, 19) - position(s, 20)) for s in (normal, wide)]
    assert distances_px[1] / distances_px[0] == pytest.approx(0.12 / 0.108)


def test_a_smooth_curve_passes_through_its_points():
    points = np.array([[0.0, 0.0], [1.0, 2.0], [3.0, 1.0], [4.0, 4.0]])
    curve = smooth(points, closed=False, per_span=5)
    np.testing.assert_allclose(curve[::5], points)
    loop = smooth(points, closed=True, per_span=5)
    assert loop.shape == (20, 2)
    np.testing.assert_allclose(loop[::5], points)


def test_a_straight_digit_has_the_length_it_was_given():
    middle = skeleton_of(PROPORTIONS).digits[2]
    assert np.linalg.norm(middle.point(1.0) - middle.base) == pytest.approx(0.55)
    np.testing.assert_allclose(middle.joints()[-1], [0.0, 1.0], atol=1e-12)
