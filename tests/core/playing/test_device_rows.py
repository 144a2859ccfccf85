import numpy as np
import pytest

import skinsource as ss
from skinsource.lab.playing import devices
from skinsource.lab.playing.devices import DeviceRows

FROM_HZ = 1300


def rows(seed=0, n=2600):
    """A tone in the middle, one that starts at once and one that ends last, and silence."""
    noise = np.random.default_rng(seed).standard_normal((4, n))
    noise[0, :900] = noise[0, 1200:] = 0.0
    noise[1, 300:] = 0.0
    noise[2, : n - 50] = 0.0
    noise[3] = 0.0
    return noise


@pytest.mark.parametrize("to_hz", [48_000, 44_100, 8_000, 1_300, 1_000])
def test_it_is_the_same_as_resampling_everything_to_the_last_bit(to_hz):
    resampled = DeviceRows().at(rows(), FROM_HZ, to_hz)
    assert np.array_equal(resampled, ss.resample(rows(), FROM_HZ, to_hz))


def test_only_rows_that_have_changed_go_through_the_filter(monkeypatch):
    filtered = []
    monkeypatch.setattr(
        devices, "resample", lambda row, *rates: filtered.append(row) or ss.resample(row, *rates)
    )
    memory, before = DeviceRows(), rows()
    first = memory.at(before, FROM_HZ, 48_000)
    after = before[[1, 0, 3, 2]].copy()
    assert np.array_equal(memory.at(after, FROM_HZ, 48_000), first[[1, 0, 3, 2]])
    assert len(filtered) == 4
    after[0, 5] += 1.0
    changed = memory.at(after, FROM_HZ, 48_000)
    assert np.array_equal(changed, ss.resample(after, FROM_HZ, 48_000))
    assert len(filtered) == 5


def test_what_is_given_out_does_not_change_what_is_kept():
    memory = DeviceRows()
    first = memory.at(rows(), FROM_HZ, 8_000)
    given = rows()
    again = memory.at(given, FROM_HZ, 8_000)
    again[:] = 7.0
    given[:] = 7.0
    assert np.array_equal(memory.at(rows(), FROM_HZ, 8_000), ss.resample(rows(), FROM_HZ, 8_000))
    assert np.array_equal(first, ss.resample(rows(), FROM_HZ, 8_000))
