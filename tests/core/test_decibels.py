import math

import numpy as np
import pytest

from skinsource.base.decibels import FLOOR_DB, decibels, levels_for_tables
from skinsource.base.errors import InvalidInputError


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


@pytest.mark.parametrize("amplitude", [math.nan, math.inf, -math.inf, -1.0, -5e-324])
def test_what_has_no_level_is_refused(amplitude):
    with pytest.raises(InvalidInputError, match="expected a finite number of zero or more"):
        decibels(amplitude)
    with pytest.raises(InvalidInputError, match=r"amplitude at index \(1, 2\) is"):
        decibels([[1.0, 1.0, 1.0], [1.0, 1.0, amplitude]])


@pytest.mark.parametrize("shape", [(0,), (3, 0), (72,), (2, 3, 4), ()])
def test_shapes_are_kept_and_everything_is_finite(shape):
    amplitude = np.zeros(shape)
    level = decibels(amplitude)
    assert np.shape(level) == shape
    assert np.isfinite(level).all()
    assert np.asarray(level).dtype == np.float64


def test_a_level_turned_into_an_amplitude_and_back_is_the_same():
    for exponent in range(-19, 40):
        level_db = np.linspace(10 * exponent, 10 * exponent + 10, 101)
        back = decibels(10 ** (level_db / 20))
        np.testing.assert_allclose(back, level_db, rtol=0, atol=1e-12)


def test_an_amplitude_turned_into_a_level_and_back_is_the_same():
    amplitude = np.logspace(-9.9, 9.9, 999)
    np.testing.assert_allclose(10 ** (decibels(amplitude) / 20), amplitude, rtol=1e-13)


@pytest.mark.parametrize("reference", [5e-324, 1e-320, 1e-6, 1.0, 1e300])
def test_the_reference_has_level_zero_however_extreme_it_is(reference):
    assert decibels(reference, reference) == 0.0
    assert decibels(0.0, reference) == FLOOR_DB


def test_quotients_beyond_all_floats_have_levels():
    assert decibels(1e300, 1e-300) == pytest.approx(12000.0, rel=1e-14)
    assert decibels(1e-300, 1e300, floor_db=-20000.0) == pytest.approx(-12000.0, rel=1e-14)


@pytest.mark.parametrize("reference", [0.0, -1.0, math.nan, math.inf])
def test_a_reference_that_is_no_positive_amplitude_is_refused(reference):
    with pytest.raises(InvalidInputError, match="reference is"):
        decibels(1.0, reference)


def test_the_floor_can_be_chosen():
    levels = decibels([0.0, 1e-20, 1e-3, 1.0], floor_db=-50.0)
    np.testing.assert_allclose(levels, [-50.0, -50.0, -50.0, 0.0], rtol=0, atol=1e-12)


def test_what_is_handed_over_is_not_changed():
    amplitude = np.array([0.0, 1.0, 2.0])
    amplitude.flags.writeable = False
    decibels(amplitude)
    np.testing.assert_array_equal(amplitude, [0.0, 1.0, 2.0])


def test_tables_hold_no_number_where_silence_has_no_level():
    held = levels_for_tables(decibels([0.0, 1.0, 10.0]))
    np.testing.assert_array_equal(held, [np.nan, 0.0, 20.0])
    assert np.isnan(levels_for_tables([np.nan, FLOOR_DB + 1e-9])).all()
