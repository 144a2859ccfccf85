"""Levels by region, which limbs stand beside one, and the mean and spread over them."""

import statistics

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.design.comparing import (
    REGION_OUTPUTS,
    mean_and_spread_over,
    region_levels_db,
    related_limbs,
    same_outputs,
    scale_end_db,
)
from tests.core.own_limbs.lab_bench import N_OUTPUTS, installed


def test_each_output_of_a_limb_belongs_to_one_region_besides_all_digits():
    parts = [
        output for name, outputs in REGION_OUTPUTS.items() if name != "Digits" for output in outputs
    ]
    assert sorted(parts) == list(range(1, 73))
    digits = [
        output for name, outputs in REGION_OUTPUTS.items() if "Digit " in name for output in outputs
    ]
    assert sorted(digits) == sorted(REGION_OUTPUTS["Digits"])
    assert REGION_OUTPUTS["Wrist, palm side"] == (61, 62, 63, 64)
    assert set(REGION_OUTPUTS["Elbow"]) == {67, 68, 69, 70, 71, 72}


def test_the_level_of_a_region_is_the_root_of_its_mean_square():
    rms = np.random.default_rng(7).uniform(0.01, 1.0, 72)
    levels_db = region_levels_db(rms)
    of_thumb = np.sqrt((rms[40] ** 2 + rms[41] ** 2) / 2)
    assert levels_db["Digit I"] == pytest.approx(20 * np.log10(of_thumb), abs=1e-12)
    assert levels_db["Wrist, palm side"] == pytest.approx(
        10 * np.log10(np.mean(rms[60:64] ** 2)), abs=1e-12
    )
    assert region_levels_db(np.zeros(72))["Digits"] == -200.0
    with pytest.raises(InvalidInputError, match="published limbs"):
        region_levels_db(np.ones(31))


def test_beside_a_limb_stand_those_of_its_kind_or_own_ones_with_the_same_outputs(user_data):
    assert related_limbs("measured-3") == tuple(f"measured-{k}" for k in (1, 2, 3, 4))
    assert related_limbs("synthetic-1")[3] == "synthetic-4"
    names = tuple(f"sensor {k}" for k in range(N_OUTPUTS))
    for name, output_names in (("lab-1", ()), ("lab-2", ()), ("lab-3", names)):
        installed(name=name, output_names=output_names)
    assert related_limbs("lab-2") == ("lab-2", "lab-1")
    assert related_limbs("lab-3") == ("lab-3",)
    assert same_outputs("measured-1", "synthetic-4")
    assert same_outputs("lab-1", "lab-2")
    assert not same_outputs("lab-1", "lab-3")
    assert not same_outputs("lab-1", "synthetic-1")
    assert not same_outputs("nobody", "nobody")
    for k in range(4, 9):
        installed(name=f"lab-{k}")
    assert related_limbs("lab-8") == ("lab-8", "lab-1", "lab-2", "lab-4", "lab-5", "lab-6")


def test_mean_and_spread_are_those_of_a_sample_and_silence_is_no_difference_of_200_db():
    levels = np.random.default_rng(3).uniform(-40.0, 0.0, (4, 9))
    mean, spread = mean_and_spread_over(levels)
    for k in range(9):
        assert mean[k] == pytest.approx(statistics.mean(levels[:, k]))
        assert spread[k] == pytest.approx(statistics.stdev(levels[:, k]))
    levels[:, 2] = (0.0, -200.0, 0.0, -200.0)
    mean, spread = mean_and_spread_over(levels)
    assert mean[2] == pytest.approx((2 * levels.max() + 2 * (levels.max() - 60.0)) / 4, abs=1e-9)
    assert spread[2] == pytest.approx(statistics.stdev((0.0, -60.0, 0.0, -60.0)), abs=1.0)


@pytest.mark.parametrize("levels", [[[1.0, 2.0]], [1.0, 2.0], [[1.0], [np.nan]], [[], []]])
def test_fewer_than_two_or_what_is_no_table_of_levels_is_refused(levels):
    with pytest.raises(InvalidInputError, match="at least two limbs or designs"):
        mean_and_spread_over(levels)


def test_a_scale_of_differences_ends_at_the_next_round_number():
    ends_db = [scale_end_db(level_db) for level_db in (0.0, -0.4, 1.0, 2.1, -6.01, 99.0)]
    assert ends_db == [1, 1, 1, 3, 10, 60]
    assert scale_end_db(np.array([np.nan, -2.5]), np.array([0.1])) == 3.0
    assert scale_end_db() == 1.0
