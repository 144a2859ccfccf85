"""The surface operator on outlines and sets of outputs that nobody published."""

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.limbs.limb import LimbMap
from skinsource.limbs.surface.surface import surface_operator_from_map
from skinsource.limbs.synthetic import load_synthetic_limb

ANGLE = np.arange(64) * np.pi / 32
CIRCLE = 200 * np.column_stack([np.cos(ANGLE), np.sin(ANGLE)])
RECTANGLE = np.array([[0, 0], [300, 0], [300, 500], [0, 500]], dtype=float)


def map_of(outline, outputs, hand_length_px=398.1, **others):
    return LimbMap(
        outline=np.asarray(outline, dtype=float),
        output_positions=np.asarray(outputs, dtype=float),
        input_positions=np.zeros((20, 2)),
        hand_length_px=hand_length_px,
        **others,
    )


def turned(points, scale=1.0, angle_rad=0.0, shift=(0.0, 0.0)):
    cosine, sine = np.cos(angle_rad) * scale, np.sin(angle_rad) * scale
    return points @ np.array([[cosine, sine], [-sine, cosine]]) + np.asarray(shift) * scale


def assert_sound(operator, note=""):
    assert operator.fallback_count == 0, note
    np.testing.assert_allclose(
        operator.weights.sum(axis=1), operator.mask.ravel(), atol=1e-12, err_msg=note
    )
    assert operator.weights.data.min() >= -1e-12, note


@pytest.mark.parametrize("seed", range(8))
def test_any_scale_turn_and_subset_of_outputs_gives_sound_weights(seed):
    random = np.random.default_rng(seed)
    published = load_synthetic_limb(1).map
    scale = 10.0 ** random.uniform(-3, 3)
    placement = {
        "scale": scale,
        "angle_rad": random.uniform(0, 2 * np.pi),
        "shift": random.uniform(-5000, 5000, 2),
    }
    placed = np.flatnonzero(np.isfinite(published.output_positions[:, 0]))
    chosen = random.choice(placed, random.integers(4, 60), replace=False)
    outputs = np.full((72, 2), np.nan)
    outputs[chosen] = turned(published.output_positions[chosen], **placement)
    limb_map = map_of(
        turned(published.outline[:: random.integers(1, 6)], **placement),
        outputs,
        published.hand_length_px * scale,
        densify=bool(seed % 4),
    )
    operator = surface_operator_from_map(limb_map, 175.0, 3.0)
    assert_sound(operator, f"seed {seed}, {len(chosen)} outputs, {placement}")
    used = np.unique(operator.weights.indices)
    np.testing.assert_array_equal(used, np.sort(chosen))


@pytest.mark.parametrize("angle_rad", [0.0, 0.1, 0.7, 2.0])
def test_long_straight_edges_are_split_and_sound_at_any_angle(angle_rad):
    outputs = turned(np.array([[60, 60], [200, 90], [150, 300], [80, 440]]), 1.0, angle_rad)
    operator = surface_operator_from_map(
        map_of(turned(RECTANGLE, 1.0, angle_rad), outputs), 175.0, 2.0
    )
    assert_sound(operator)
    assert operator.warnings == ()


def test_one_output_is_the_value_everywhere():
    operator = surface_operator_from_map(map_of(CIRCLE, [[10, 0]]), 175.0, 4.0)
    picture = operator.interpolate([-12.0])
    np.testing.assert_allclose(picture[operator.mask], -12.0)
    assert np.isnan(picture[~operator.mask]).all()
    assert operator.single_vertices > 0
    assert "see only one output" in " ".join(operator.warnings)


def test_vertices_that_see_no_output_are_counted_and_told():
    fork = [[0, 0], [80, 0], [80, 100], [60, 100], [60, 20], [20, 20], [20, 100], [0, 100]]
    operator = surface_operator_from_map(map_of(fork, [[10, 60], [10, 90]]), 100.0, 1.0)
    assert_sound(operator)
    assert operator.blind_vertices > 0
    assert operator.warnings[0].startswith("Outline points that see no output")
    assert operator.warnings[0].endswith(f": {operator.blind_vertices}.")


def test_an_outline_that_crosses_itself_is_filled_by_the_even_odd_rule_and_told():
    # A small loop beyond a crossing at (100, 100).
    outline = [[0, 0], [300, 0], [300, 300], [100, 300], [100, 50], [200, 100], [0, 100]]
    operator = surface_operator_from_map(map_of(outline, [[20, 20], [250, 250]]), 398.1, 2.0)
    assert_sound(operator)
    assert "Places where the outline crosses itself: 1." in operator.warnings
    assert not operator.mask[40, 60]
    assert operator.mask[75, 100]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"outline": [[0, 0], [1, 1]]}, "enclose no area"),
        ({"outline": [[0, 0], [50, 50], [100, 100], [10, 10]]}, "enclose no area"),
        (
            {"outline": RECTANGLE * [1, 2e-5], "outputs": RECTANGLE[:2], "hand_length_px": 398.1},
            "enclose no area",
        ),
        ({"outline": [[0, 0], [50, np.nan], [100, 0]]}, "finite coordinates"),
        ({"outline": [0.0, 1.0, 2.0]}, "expected \\(n_vertices, 2\\)"),
        ({"outputs": np.full((72, 2), np.nan)}, "Place an output"),
        ({"outputs": np.zeros((72, 3))}, "output positions have shape"),
        ({"hand_length_px": 0.0}, "hand_length_px"),
        ({"visibility": np.ones((3, 72))}, "visibility has shape"),
    ],
)
def test_a_map_that_cannot_be_used_is_refused_with_the_reason(change, message):
    given = {"outline": RECTANGLE, "outputs": [[500000.0, 500000.0]], "hand_length_px": 1e5}
    given |= change
    limb_map = map_of(given.pop("outline"), given.pop("outputs"), **given)
    with pytest.raises(InvalidInputError, match=message):
        surface_operator_from_map(limb_map, 175.0, 1.0)


@pytest.mark.parametrize(
    ("hand_length_mm", "spacing_mm", "message"),
    [
        (398.1, 1000.0, "Choose a narrower spacing"),
        (175.0, 0.0, "spacing_mm is 0.0"),
        (175.0, float("nan"), "spacing_mm is nan"),
        (175.0, 0.001, "Choose a wider spacing"),
        (-1.0, 1.0, "hand_length_mm is -1.0"),
        (float("inf"), 1.0, "hand_length_mm is inf"),
    ],
)
def test_impossible_lengths_are_refused(hand_length_mm, spacing_mm, message):
    limb_map = map_of([[0, -100], [100, 0], [0, 100], [-100, 0]], [[0, 0]])
    with pytest.raises(InvalidInputError, match=message):
        surface_operator_from_map(limb_map, hand_length_mm, spacing_mm)
