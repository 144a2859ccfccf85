import numpy as np
import pytest

from skinsource.base.decibels import FLOOR_DB, decibels, levels_for_tables


@pytest.mark.parametrize("reference", [5e-324, 1e-320, 1e-6, 1.0, 1e300])
def test_the_reference_has_level_zero_however_extreme_it_is(reference):
    assert decibels(reference, reference) == 0.0
    assert decibels(0.0, reference) == FLOOR_DB


def test_tables_hold_no_number_where_silence_has_no_level():
    held = levels_for_tables(decibels([0.0, 1.0, 10.0]))
    np.testing.assert_array_equal(held, [np.nan, 0.0, 20.0])
    assert np.isnan(levels_for_tables([np.nan, FLOOR_DB + 1e-9])).all()
