import numpy as np
import pytest

from skinsource.base.decibels import FLOOR_DB, decibels, levels_for_tables


@pytest.mark.parametrize(
    ("amplitude", "level_db"),
    [
        (0.0, -200.0),
        (-0.0, -200.0),
        (5e-324, -200.0),
        (1e-320, -200.0),
        (1e-20, -200.0),
        (1e-10, -200.0),
        (1e-9, -180.0),
        (0.1, -20.0),
        (1.0, 0.0),
        (2.0, 6.020599913279624),
        (1e308, 6160.0),
    ],
)
def test_levels_are_twenty_times_the_logarithm_and_never_below_the_floor(amplitude, level_db):
    assert decibels(amplitude) == pytest.approx(level_db, rel=1e-15, abs=0)


@pytest.mark.parametrize("reference", [5e-324, 1e-320, 1e-6, 1.0, 1e300])
def test_the_reference_has_level_zero_however_extreme_it_is(reference):
    assert decibels(reference, reference) == 0.0
    assert decibels(0.0, reference) == FLOOR_DB


def test_tables_hold_no_number_where_silence_has_no_level():
    held = levels_for_tables(decibels([0.0, 1.0, 10.0]))
    np.testing.assert_array_equal(held, [np.nan, 0.0, 20.0])
    assert np.isnan(levels_for_tables([np.nan, FLOOR_DB + 1e-9])).all()
