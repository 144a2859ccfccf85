"""The map where sites lie on one line, at one place, or where points lie outside their hull."""

import json
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.limbs.surface.natural_neighbour import scattered_sites
from skinsource.limbs.surface.surface import surface_operator_from_map
from skinsource.limbs.synthetic import load_synthetic_limb

SEED = 20240607
SITES = {
    "random": np.random.default_rng(SEED).uniform(0, 1000, (72, 2)),
    "grid": np.stack(np.meshgrid(np.arange(6.0), np.arange(12.0)), axis=-1).reshape(-1, 2),
}


def points_within(sites: np.ndarray, count: int) -> np.ndarray:
    return np.random.default_rng(SEED).dirichlet(np.full(len(sites), 0.2), count) @ sites


@pytest.mark.parametrize("sites", SITES.values(), ids=SITES)
def test_points_outside_the_hull_and_no_others_are_flagged(noted, sites):
    inside = scattered_sites(sites).weights_at(np.concatenate([sites, points_within(sites, 2000)]))
    noted("h flagged", np.count_nonzero(inside.outside))
    low, high = sites.min(axis=0), sites.max(axis=0)
    beyond = low + np.random.default_rng(SEED).uniform(-1, 2, (2000, 2)) * (high - low)
    beyond = beyond[((beyond < low) | (beyond > high)).any(axis=1)]
    assert len(beyond) > 1000, f"{SEED=}"
    interpolation = scattered_sites(sites).weights_at(beyond)
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
        interpolation = scattered_sites(np.array(sites, float)).weights_at(points)
        noted("h outside", np.abs(interpolation.weights.toarray() - expected).max())


@pytest.mark.parametrize("direction", [(1, 0), (0, 1), (3, 4), (-7, 2), (1, 1000)])
@pytest.mark.parametrize("count", [1, 2, 3, 30])
def test_on_a_line_values_run_linearly_from_site_to_site(noted, direction, count):
    random = np.random.default_rng(SEED)
    places = np.sort(random.choice(4000, count, replace=False)) - 1500
    sites = np.outer(places, direction) / 8.0
    points = np.round(random.uniform(-16000, 20000, (60, 1)) * direction) / 64.0
    points[::2] += random.integers(-4000, 4000, (30, 2)) / 8.0
    interpolation = scattered_sites(sites).weights_at(np.concatenate([points, sites]))
    noted("h collinear", np.abs(interpolation.weights.toarray()[60:] - np.eye(count)).max())
    for point, weights in zip(points, interpolation.weights.toarray(), strict=False):
        along = [Fraction(value) * part for value, part in zip(point, direction, strict=True)]
        place = 8 * sum(along) / sum(part * part for part in direction)
        place = min(max(place, Fraction(int(places[0]))), Fraction(int(places[-1])))
        expected = np.zeros(count)
        after = min(int(np.searchsorted(places, float(place), side="right")), count - 1)
        before = max(after - 1, 0)
        length = int(places[after] - places[before])
        share = (place - int(places[before])) / length if length else Fraction(1)
        expected[before], expected[after] = float(1 - share), float(share)
        noted("h collinear", np.abs(weights - expected).max())


@pytest.mark.parametrize("off", [0.0, 1e-15, 1e-12, 1e-10, 1e-9, 1e-8, 1e-6, 1e-3])
@pytest.mark.parametrize("angle_rad", [0.0, 0.7])
def test_hardly_off_a_line_linear_functions_are_kept(noted, off, angle_rad):
    random = np.random.default_rng(SEED)
    straight = np.column_stack([random.uniform(0, 1000, 40), 500 * off * random.uniform(-1, 1, 40)])
    cosine, sine = np.cos(angle_rad), np.sin(angle_rad)
    sites = straight @ np.array([[cosine, sine], [-sine, cosine]])
    points = points_within(sites, 1000)
    interpolation = scattered_sites(sites).weights_at(points)
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
    try:
        operator.interpolate(values)
    except InvalidInputError as error:
        noted("h twice", int("outputs 1 and 2 lie at the same place" not in str(error)))
    else:
        noted("h twice", 1)
    values[1] = -30.0
    noted("h twice", int(abs(operator.interpolate(values)[row, column] + 30) > 1e-12))
