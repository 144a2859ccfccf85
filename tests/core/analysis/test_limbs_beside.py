"""Which limbs stand beside one, and the mean and spread of levels over them."""

import statistics

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.design.comparing import (
    mean_and_spread_over,
    related_limbs,
    same_outputs,
    scale_end_db,
)
from tests.core.own_limbs.lab_bench import N_OUTPUTS, installed


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
    assert related_limbs("lab-8") == ("lab-8", "lab-1", "lab-2", "lab-4")


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


def test_a_few_large_differences_leave_colours_for_the_others():
    most = np.linspace(-4.0, 4.0, 96)
    assert scale_end_db(most, [-29.0, 29.0]) == 10.0  # a third of the largest
    assert scale_end_db(most, [-9.0]) == 5.0
    assert scale_end_db(np.zeros(71), [25.0]) == 10.0
    assert scale_end_db(np.linspace(-38.0, 2.0, 72)) == 40.0
