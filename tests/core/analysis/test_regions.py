"""Levels by region, and the spread between people."""

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.design.comparing import REGION_OUTPUTS, mean_and_spread, region_levels_db


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


def test_the_spread_of_people_is_that_of_a_sample():
    mean, spread = mean_and_spread([-20.0, -22.0, -27.0])
    assert mean == pytest.approx(-23.0)
    assert spread == pytest.approx(np.sqrt((9 + 1 + 16) / 2))
    assert np.isnan(mean_and_spread([-20.0])[1])
