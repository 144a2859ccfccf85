"""Decibels of extreme amplitudes, the map between any sites, and the table of promises."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from skinsource import Design, View, track
from skinsource.base.decibels import FLOOR_DB, decibels, levels_for_tables
from skinsource.base.errors import InvalidInputError
from skinsource.engine.quantities import new_graph, sources
from skinsource.limbs.surface.natural_neighbour import (
    natural_neighbour_weights,
    snapped_to_lattice,
    triangulate,
)
from skinsource.limbs.surface.operator import (
    check_values_of_shared_places,
    first_at_same_place,
    pairs_at_same_place,
)
from skinsource.limbs.surface.surface import surface_operator, surface_operator_from_map
from skinsource.limbs.synthetic import load_synthetic_limb
from tests.core.conftest import refused

SEED = 20240607
GRID = np.stack(np.meshgrid(np.arange(6.0), np.arange(12.0)), axis=-1).reshape(-1, 2) * 64
SITES = {
    "random": np.random.default_rng(SEED).integers(0, 2**16, (72, 2)) / 64,
    "grid": GRID,
    "flat": np.random.default_rng(SEED).integers(0, 2**16, (72, 2)) / np.array([64, 64 * 2**10]),
}


def weights_at(sites: np.ndarray, points: np.ndarray) -> tuple[np.ndarray, int]:
    """Weights, (n_points, n_sites), and how many points went by the way out."""
    interpolation = natural_neighbour_weights(triangulate(sites), points)
    return interpolation.weights.toarray(), int(interpolation.fallback.sum())


def points_within(sites: np.ndarray, count: int, seed: int = SEED) -> np.ndarray:
    """Random means of the sites: always inside their hull."""
    shares = np.random.default_rng(seed).dirichlet(np.full(len(sites), 0.2), count)
    return shares @ sites


def test_levels_of_fifty_digits_are_met(references, noted):
    rows = json.loads((references / "levels.json").read_text(encoding="utf-8"))
    for row in rows:
        amplitude, reference, level_db = map(float.fromhex, row.values())
        levels_db = float(decibels(amplitude, reference, floor_db=-1e4))
        noted("g accuracy", abs(levels_db - level_db) / max(1.0, abs(level_db)))


def test_a_level_turned_into_an_amplitude_comes_back(noted):
    level_db = np.linspace(-190, 600, 100_001)
    noted("g back", np.abs(decibels(10 ** (level_db / 20)) - level_db).max())


@pytest.mark.parametrize("reference", [1e-6, 1.0, 9.81])
@pytest.mark.parametrize("floor_db", [FLOOR_DB, -120.0])
def test_nothing_lies_below_the_floor(noted, reference, floor_db):
    low = 10 ** (floor_db / 20) * reference
    faint = np.array([0.0, -0.0, 5e-324, 1e-320, 1e-308, 1e-30, low / 2, low * 0.9999])
    level_db = decibels(faint, reference, floor_db=floor_db)
    noted("g floor", np.count_nonzero(level_db != floor_db))
    assert decibels(np.zeros((3, 0)), reference).shape == (3, 0)
    assert decibels(low * 1.001, reference, floor_db=floor_db) > floor_db


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, -1.0, -5e-324])
def test_what_has_no_level_is_refused_by_index(noted, value):
    amplitude = np.ones((3, 4))
    amplitude[1, 2] = value
    noted("g bad", refused(lambda: decibels(amplitude), "index (1, 2)"))
    noted("g bad", refused(lambda: decibels(1.0, value), "reference"))
    noted("g bad", refused(lambda: decibels(0.0, 0.0), "reference"))


@pytest.mark.parametrize("inputs", [(), (track(location=7, muted=True),)])
def test_a_silent_design_has_levels_and_a_map_at_the_floor(noted, inputs):
    design = Design(limb="synthetic-1", inputs=inputs)
    quantities = {"output_levels_db", "surface_levels_db"}
    values = new_graph().evaluate(quantities, sources(design, View()))
    inside = ~np.isnan(values["surface_levels_db"])
    noted("g silence", np.count_nonzero(values["output_levels_db"] != FLOOR_DB))
    off = np.abs(values["surface_levels_db"][inside] - FLOOR_DB) > 1e-9
    noted("g silence", np.count_nonzero(off))
    assert inside.any()


def test_weights_of_rational_arithmetic_are_met(references, noted):
    cases = json.loads((references / "natural_neighbours.json").read_text(encoding="utf-8"))
    assert len(cases) == 20
    for case in cases:
        weights, astray = weights_at(np.array(case["sites"], float), np.array(case["points"]))
        noted("h exact", np.abs(weights - case["weights"]).max())
        noted("h negative", astray)


@pytest.mark.parametrize("kind", SITES)
def test_ten_thousand_points_are_interpolated_soundly(noted, kind):
    sites = SITES[kind]
    points = points_within(sites, 10_000)
    weights, astray = weights_at(sites, points)
    noted("h negative", np.count_nonzero(~(weights >= 0)) + astray)
    noted("h sum", np.abs(weights.sum(axis=1) - 1).max())
    noted("h linear", (np.abs(weights @ sites - points) / np.ptp(sites, axis=0).max()).max())
    at_sites, astray = weights_at(sites, sites)
    noted("h sites", np.count_nonzero(at_sites != np.eye(len(sites))) + astray)


@pytest.mark.parametrize("kind", SITES)
def test_weights_do_not_jump_where_neighbours_change(noted, kind):
    sites = SITES[kind]
    extent = np.ptp(sites, axis=0).min()
    triangulation = triangulate(sites)
    a, b = (sites[triangulation.corners[~triangulation.flat, k]] for k in range(2))
    random = np.random.default_rng(SEED)
    share = random.uniform(0.1, 0.9, (len(a), 1))
    on_edges, across_edges = a + share * (b - a), (b - a)[:, ::-1] * [1, -1]
    k, x, y, constant = np.tile(triangulation.circles[~triangulation.flat], (8, 1)).T
    centre = np.column_stack([-x, -y]) / (2 * k[:, None])
    radius = np.sqrt(np.square(centre).sum(axis=1) - constant / k)
    angle = random.uniform(0, 2 * np.pi, len(radius))
    outward = np.column_stack([np.cos(angle), np.sin(angle)])
    on_circles = centre + triangulation.centre + radius[:, None] * outward
    inside = (np.abs(on_circles - sites.mean(axis=0)) < np.ptp(sites, axis=0) * 0.4).all(axis=1)
    assert inside.sum() > 10, f"{SEED=}"
    places = np.concatenate([on_edges, on_circles[inside]])
    across = np.concatenate([across_edges, outward[inside]])
    across *= 0.5e-12 * extent / np.linalg.norm(across, axis=1, keepdims=True)
    before, _ = weights_at(sites, places - across)
    after, _ = weights_at(sites, places + across)
    noted("h step", np.abs(after - before).max())


@pytest.mark.parametrize("kind", SITES)
@pytest.mark.parametrize("change", ["turn", "shift", "shrink", "grow"])
def test_weights_depend_on_nothing_but_the_shape(noted, kind, change):
    sites = SITES[kind]
    # On a lattice, so that the shift rounds nothing.
    points = np.round(points_within(sites, 1000) * 2**20) / 2**20
    points = points if change != "shift" else np.round(points * 2**12) / 2**12
    plain, _ = weights_at(sites, points)
    cosine, sine = np.cos(0.7), np.sin(0.7)
    turn = np.array([[cosine, sine], [-sine, cosine]])
    moved = {
        "turn": lambda xy: xy @ turn,
        "shift": lambda xy: xy + np.array([1e8, -1e8]),
        "shrink": lambda xy: xy * 1e-3,
        "grow": lambda xy: xy * 1e6,
    }[change]
    weights, _ = weights_at(moved(sites), moved(points))
    noted("h moved", np.abs(weights - plain).max())


@pytest.mark.parametrize("number", [1, 2, 3, 4])
def test_the_maps_of_the_synthetic_limbs_are_sound(noted, number):
    operator = surface_operator(load_synthetic_limb(number), 2.0)
    total = operator.weights.sum(axis=1)[operator.mask.ravel()]
    noted("h map", np.abs(total - 1).max())
    negative = np.count_nonzero(~(operator.weights.data >= 0))
    noted("h map negative", negative + operator.fallback_count)


@pytest.mark.parametrize("sites", SITES.values(), ids=SITES)
def test_points_outside_the_hull_and_no_others_are_flagged(noted, sites):
    triangulation = triangulate(sites)
    points = np.concatenate([sites, points_within(sites, 2000)])
    inside = natural_neighbour_weights(triangulation, points)
    noted("h flagged", np.count_nonzero(inside.outside))
    low, high = sites.min(axis=0), sites.max(axis=0)
    beyond = low + np.random.default_rng(SEED).uniform(-1, 2, (2000, 2)) * (high - low)
    beyond = beyond[((beyond < low) | (beyond > high)).any(axis=1)]
    assert len(beyond) > 1000, f"{SEED=}"
    interpolation = natural_neighbour_weights(triangulation, beyond)
    noted("h flagged", np.count_nonzero(~interpolation.outside))


def test_outside_a_square_the_nearest_place_on_it_counts(references, noted):
    corners = [(0, 0), (0, 16), (16, 0), (16, 16)]
    points = np.random.default_rng(SEED).integers(-2048, 4096, (2000, 2)) / 64
    points = points[((points < 0) | (points > 16)).any(axis=1)]
    x, y = (np.clip(points, 0, 16) / 16).T  # exact: the points are sixty-fourths
    shares = np.column_stack([(1 - x) * (1 - y), (1 - x) * y, x * (1 - y), x * y])
    for case in json.loads((references / "natural_neighbours.json").read_text(encoding="utf-8")):
        sites = [tuple(site) for site in case["sites"]]
        expected = np.zeros((len(points), len(sites)))
        expected[:, [sites.index(corner) for corner in corners]] = shares
        interpolation = natural_neighbour_weights(triangulate(np.array(sites, float)), points)
        noted("h outside", np.abs(interpolation.weights.toarray() - expected).max())


@pytest.mark.parametrize("off", [1e-6, 1e-3])
def test_hardly_off_a_line_linear_functions_are_kept(noted, off):
    random = np.random.default_rng(SEED)
    sites = np.column_stack([random.uniform(0, 1000, 40), 500 * off * random.uniform(-1, 1, 40)])
    points = points_within(sites, 1000)
    interpolation = natural_neighbour_weights(triangulate(sites), points)
    missed = np.abs(interpolation.weights @ sites - points).max() / np.ptp(sites, axis=0).max()
    noted("h nearly", missed)
    astray = np.abs(interpolation.weights.sum(axis=1) - 1) > 1e-12
    noted("h sound", astray.sum() + np.count_nonzero(~(interpolation.weights.data >= 0)))


@pytest.mark.parametrize("off", [0.0, 1e-12, 1e-9, 1e-7, 1e-5, 1e-3, 1e-1])
@pytest.mark.parametrize("count", [1, 2, 12])
def test_outputs_on_a_line_are_interpolated_within_any_outline(noted, off, count):
    along = np.linspace(100, 300, count)
    positions = np.full((72, 2), np.nan)
    positions[:count] = np.column_stack([along, 50 + off * (np.arange(count) % 2)])
    square = np.array([[0.0, 0.0], [400.0, 0.0], [400.0, 100.0], [0.0, 100.0]])
    limb_map = replace(load_synthetic_limb(1).map, outline=square, output_positions=positions)
    thin = replace(limb_map, outline=square * [1.0, off])
    for outline, any_area in ((limb_map, True), (thin, off > 1e-8)):
        try:
            operator = surface_operator_from_map(outline, 175.0, 5.0)
        except InvalidInputError as error:
            noted("h thin", int(any_area or "no area" not in str(error)))
            continue
        inside = operator.interpolate(np.where(np.arange(72) < count, 7.0, 0.0))[operator.mask]
        noted("h thin", np.count_nonzero(~(np.abs(inside - 7.0) < 1e-9)) + (not any_area))


@pytest.mark.parametrize("distance_mm", [0.0, 1e-9, 1e-7, 1e-6, 1e-4])
def test_two_outputs_at_one_place_have_one_value(noted, distance_mm):
    positions = np.full((72, 2), np.nan)
    positions[:4] = [[100, 50], [100 + distance_mm, 50], [200, 50], [300, 25]]
    square = np.array([[0.0, 0.0], [400.0, 0.0], [400.0, 100.0], [0.0, 100.0]])
    limb_map = replace(
        load_synthetic_limb(1).map, outline=square, output_positions=positions, hand_length_px=400.0
    )
    operator = surface_operator_from_map(limb_map, 400.0, 5.0)
    row, column = np.argmin(np.abs(operator.y_mm - 50)), np.argmin(np.abs(operator.x_mm - 100))
    assert (operator.x_mm[column], operator.y_mm[row]) == (100.0, 50.0)
    values = np.zeros(72)
    values[:4] = -30.0, -50.0, -10.0, -20.0
    if distance_mm > 1e-9 * 400:
        noted("h close", abs(operator.interpolate(values)[row, column] + 40) / 40)
        return
    same_place = "outputs 1 and 2 lie at the same place"
    noted("h twice", refused(lambda: operator.interpolate(values), same_place))
    values[1] = -30.0
    noted("h twice", int(abs(operator.interpolate(values)[row, column] + 30) > 1e-12))


@pytest.mark.parametrize("reference", [5e-324, 1e-320, 1e-6, 1.0, 1e300])
def test_the_reference_has_level_zero_however_extreme_it_is(reference):
    assert decibels(reference, reference) == 0.0
    assert decibels(0.0, reference) == FLOOR_DB


def test_tables_hold_no_number_where_silence_has_no_level():
    held = levels_for_tables(decibels([0.0, 1.0, 10.0]))
    np.testing.assert_array_equal(held, [np.nan, 0.0, 20.0])
    assert np.isnan(levels_for_tables([np.nan, FLOOR_DB + 1e-9])).all()


def test_every_promise_is_measured_by_a_test(documented):
    paths = Path(__file__).parent.glob("test_stability_*.py")
    text = "".join(path.read_text(encoding="utf-8") for path in paths)
    assert [key for key in documented if f'"{key}"' not in text] == []


RANDOM = np.random.default_rng(20240607).uniform(0, 1000, (60, 2))


@pytest.mark.parametrize("distance", [1e-12, 1e-9, 1e-8, 1e-7, 1e-5, 1e-2])
def test_near_a_site_the_weights_stay_sound(distance):
    sites = snapped_to_lattice(RANDOM)
    offsets = np.random.default_rng(1).normal(size=sites.shape) * distance
    inner = np.all((sites > 150) & (sites < 850), axis=1)
    points = (sites + offsets)[inner]
    weights = natural_neighbour_weights(triangulate(sites), points).weights
    np.testing.assert_allclose(weights @ sites, points, atol=1e-7)
    assert weights.toarray()[:, inner].diagonal().min() >= 1 - distance


def test_on_an_edge_of_the_hull_interpolation_is_linear_between_its_ends():
    sites = np.array([[0, 0], [8, 0], [12, 3], [8, 10], [0, 10], [3, 4], [7, 6]], dtype=float)
    points = np.array([[2, 0], [7.5, 0], [0, 2.5], [10, 1.5], [4, 10]])
    result = natural_neighbour_weights(triangulate(sites), points)
    weights, fallback = result.weights, result.fallback
    expected = np.zeros((5, 7))
    expected[0, [0, 1]] = 0.75, 0.25
    expected[1, [0, 1]] = 0.0625, 0.9375
    expected[2, [0, 4]] = 0.75, 0.25
    expected[3, [1, 2]] = 0.5, 0.5
    expected[4, [3, 4]] = 0.5, 0.5
    assert not fallback.any()
    np.testing.assert_allclose(weights.toarray(), expected, atol=1e-14)


def test_a_cavity_that_runs_in_a_ring_is_cut_and_interpolated_linearly():
    sound = triangulate(RANDOM)
    everything_inside = np.tile([0.0, 0.0, 0.0, -1.0], (len(sound.corners), 1))
    # The area of each triangle stays: the linear weights need it.
    everything_inside[:, 0] = sound.circles[:, 0]
    everything_inside[:, 3] = -1e12
    points = points_within(RANDOM, 50, 2)
    result = natural_neighbour_weights(replace(sound, circles=everything_inside), points)
    weights, fallback = result.weights, result.fallback
    assert fallback.all()
    assert np.diff(weights.indptr).max() <= 3
    np.testing.assert_allclose(weights.sum(axis=1), 1.0, atol=1e-13)
    np.testing.assert_allclose(weights @ RANDOM, points, atol=1e-9)


def test_the_lattice_keeps_half_pixels_of_the_published_size_and_is_fine_elsewhere():
    halves = np.array([[0.0, 0.0], [395.0, 1054.0], [10.5, 700.5], [11.5, 3.5]])
    np.testing.assert_array_equal(snapped_to_lattice(halves), halves)
    for scale in (1e-3, 1.0, 1e3):
        moved = snapped_to_lattice(RANDOM * scale) - RANDOM * scale
        assert np.abs(moved).max() <= 1000 * scale / 2**14


def test_a_chain_of_near_duplicates_is_one_site():
    # The first and the third are one only through the last.
    sites = np.array([[0.0, 0], [500, 500], [1.6e-6, 0], [0.8e-6, 0], [1000, 0]])
    np.testing.assert_array_equal(first_at_same_place(sites, 1000.0), [0, 1, 0, 0, 4])


def test_two_values_for_one_place_are_refused_by_both_names():
    outputs = np.array([[np.nan, np.nan], [10, 10], [500, 20], [10, 10 + 1e-8], [700, 900]])
    pairs = pairs_at_same_place(outputs, 1000.0)
    assert pairs == ((1, 3),)
    check_values_of_shared_places(np.array([1.0, 2.0, 3.0, 2.0, 5.0]), pairs)
    with pytest.raises(InvalidInputError, match=r"outputs 2 and 4 .* given 2 and 7"):
        check_values_of_shared_places(np.array([1.0, 2.0, 3.0, 7.0, 5.0]), pairs)
    frames = np.zeros((5, 3))
    frames[3, 2] = -0.5
    with pytest.raises(InvalidInputError, match=r"outputs 2 and 4 .* given 0 and -0\.5"):
        check_values_of_shared_places(frames, pairs)
    assert pairs_at_same_place(outputs, 1.0) == ()
