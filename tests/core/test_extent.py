"""How far a vibration reaches, and RMS in windows: against formulas and known figures."""

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import InvalidInputError

LIMB = ss.load_limb("synthetic-1")


def distances_mm(limb, location):
    """From an input place to each output of a limb."""
    ways_mm = limb.output_positions_mm - limb.input_positions_mm[location - 1]
    return np.linalg.norm(ways_mm, axis=1)


def test_each_figure_is_its_formula():
    rms = np.random.default_rng(3).uniform(0.01, 1.0, 72) ** 3
    extent = ss.extent(rms, LIMB, 7)
    distance = distances_mm(LIMB, 7)
    shown = ~np.isnan(distance)
    assert shown.sum() == 66
    w = rms[shown] ** 2 / np.sum(rms[shown] ** 2)
    d = distance[shown]
    below_db = 20 * np.log10(rms[shown] / rms[shown].max())
    assert extent.mean_distance_mm == pytest.approx(np.sum(w * d), rel=1e-12)
    assert extent.share_above_12_db == np.mean(below_db > -12)
    assert extent.share_above_20_db == np.mean(below_db > -20)
    assert extent.participation == pytest.approx(1 / np.sum(w**2), rel=1e-12)
    within = sorted(distance for distance in d if np.sum(w[d <= distance]) >= 0.9)
    assert extent.d90_mm == pytest.approx(within[0], rel=1e-12)


def test_the_unit_of_the_rms_does_not_matter_even_far_out():
    rms = np.random.default_rng(4).uniform(0.1, 1.0, 72)
    plain = ss.extent(rms, LIMB, 7)
    for scale in (2.0**-500, 2.0**500):
        assert ss.extent(rms * scale, LIMB, 7) == plain


def test_of_several_places_the_nearest_counts():
    rms = np.random.default_rng(5).uniform(0.1, 1.0, 72)
    nearest = np.fmin(distances_mm(LIMB, 1), distances_mm(LIMB, 20))
    shown = ~np.isnan(nearest)
    w = rms[shown] ** 2 / np.sum(rms[shown] ** 2)
    both = ss.extent(rms, LIMB, (1, 20))
    assert both.mean_distance_mm == pytest.approx(np.sum(w * nearest[shown]), rel=1e-12)
    assert both == ss.extent(rms, LIMB, (20, 1))


@pytest.mark.parametrize(
    ("rms", "location", "message"),
    [
        (np.ones(71), 7, "shape"),
        (-np.ones(72), 7, "0 or more"),
        (np.zeros(72), 7, "zero"),
        (np.full(72, np.nan), 7, "finite"),
        (np.ones(72), 21, "input location 21"),
        (np.ones(72), (), "expected an input place"),
    ],
)
def test_what_has_no_extent_is_refused(rms, location, message):
    with pytest.raises(InvalidInputError, match=message):
        ss.extent(rms, LIMB, location)


def test_outputs_without_a_place_take_no_part():
    rms = np.ones(72)
    louder = rms.copy()
    louder[60:66] = 100.0
    assert ss.extent(louder, LIMB, 7) == ss.extent(rms, LIMB, 7)


@pytest.mark.parametrize(
    ("length", "first", "n"), [(20, 7, 4), (103, 0, 1), (104, 0, 0), (5, 200, 0)]
)
def test_windows_follow_each_other_and_the_rest_is_left_out(length, first, n):
    signals = np.random.default_rng(6).standard_normal((3, 2, 103))
    rms = ss.windowed_rms(signals, length, first_sample=first)
    assert rms.shape == (n, 3, 2)
    for j in range(n):
        piece = signals[..., first + length * j : first + length * (j + 1)]
        np.testing.assert_allclose(rms[j], np.sqrt(np.mean(piece**2, axis=-1)), rtol=1e-14)


def test_squares_of_windows_do_not_overflow():
    assert ss.windowed_rms([3e200, 4e200], 2)[0] == pytest.approx(3.5355339059327378e200)
    assert ss.windowed_rms([3e-200, 4e-200], 2)[0] == pytest.approx(3.5355339059327378e-200)


@pytest.mark.parametrize("window", [0, 1.5, True, "3"])
def test_a_window_is_a_whole_number_of_samples(window):
    with pytest.raises(InvalidInputError, match="window_samples"):
        ss.windowed_rms(np.ones(10), window)
