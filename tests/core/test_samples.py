import hashlib

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.specs.samples import MAX_SAMPLES, Samples

VALUES = np.array([0.0, 1.0, -0.5, 5e-324])


def of(values, rate=1300.0, unit="") -> Samples:
    return Samples(values=values, sample_rate_hz=rate, unit=unit)


def test_samples_cannot_be_changed_from_within_or_without():
    given = VALUES.copy()
    samples = of(given)
    given[0] = 9.0
    assert samples.values[0] == 0.0
    with pytest.raises(ValueError, match="read-only"):
        samples.values[0] = 1.0


def test_samples_are_equal_when_every_bit_is():
    assert of(VALUES) == of(VALUES.copy())
    assert hash(of(VALUES)) == hash(of(list(VALUES)))
    for other in (of(VALUES, rate=1300.0000001), of(VALUES, unit="m/s²"), of(VALUES[:3])):
        assert of(VALUES) != other
    assert of([0.0]) != of([-0.0])
    assert of(VALUES) != "samples"


def test_what_they_hold_is_hashed_once(monkeypatch):
    samples, same = of(VALUES), of(VALUES)
    monkeypatch.setattr(hashlib, "sha256", lambda *_: pytest.fail("was hashed again"))
    assert len({samples, same}) == 1
    assert samples == same


@pytest.mark.parametrize(
    "values", [[], [[1.0]], [np.nan], [np.inf], [1j], ["1"], [True], [None], 3.0, np.ma.array([1])]
)
def test_what_is_no_signal_is_refused(values):
    with pytest.raises(InvalidInputError):
        of(values)


def test_too_many_samples_are_refused():
    with pytest.raises(InvalidInputError, match=f"expected 1 to {MAX_SAMPLES}"):
        of(np.broadcast_to(np.float64(0.0), (MAX_SAMPLES + 1,)))


@pytest.mark.parametrize("rate", [0, -1.0, np.inf, np.nan, "1300", True, None, 1e10])
def test_a_rate_that_is_none_is_refused(rate):
    with pytest.raises(InvalidInputError, match="sample_rate_hz is"):
        of(VALUES, rate=rate)
