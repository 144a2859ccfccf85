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


def test_too_many_samples_are_refused():
    with pytest.raises(InvalidInputError, match=f"expected 1 to {MAX_SAMPLES}"):
        of(np.broadcast_to(np.float64(0.0), (MAX_SAMPLES + 1,)))
