import numpy as np

from skinsource.base.decibels import FLOOR_DB, decibels, levels_for_tables


def test_tables_hold_no_number_where_silence_has_no_level():
    held = levels_for_tables(decibels([0.0, 1.0, 10.0]))
    np.testing.assert_array_equal(held, [np.nan, 0.0, 20.0])
    assert np.isnan(levels_for_tables([np.nan, FLOOR_DB + 1e-9])).all()
