"""What responses hold in bins of 2 Hz, and lines through it, against plain sums."""

import numpy as np
import pytest

from skinsource.base.measurement_conditions import BAND_HZ
from skinsource.signals.analysis import statistics
from skinsource.studies.checking import straightness
from skinsource.studies.validation import straight_lines

RATE_HZ = 1300.0


def band_rms(signals, band_hz=BAND_HZ):
    return statistics.band_rms(np.fft.rfft(signals), signals.shape[-1], RATE_HZ, band_hz)


def tone(frequency_hz, n_times):
    return np.sin(2.0 * np.pi * frequency_hz * np.arange(n_times) / RATE_HZ + 0.3)


def test_a_tone_has_its_rms_in_its_bin_and_nothing_elsewhere():
    for n_times in (1300, 2600, 5200):
        frequency_hz, rms = band_rms(3.0 * tone(100.0, n_times))
        assert frequency_hz[np.argmax(rms)] == 100.0
        assert rms.max() == pytest.approx(3.0 / np.sqrt(2.0))
        assert np.sort(rms)[-2] < 1e-10


@pytest.mark.parametrize("n_times", [1300, 1301, 7])
def test_bins_hold_all_the_energy_together(n_times):
    signals = np.random.default_rng(3).normal(size=(2, 3, n_times))
    _, rms = band_rms(signals, (0.0, 654.0))
    assert rms.shape[:2] == (2, 3)
    energy = np.sum(np.square(rms), axis=-1)
    np.testing.assert_allclose(energy, np.mean(np.square(signals), axis=-1))


def test_only_whole_bins_are_told():
    noise = np.random.default_rng(4).normal(size=2600)
    assert band_rms(noise)[0][[0, -1]].tolist() == [26.0, 598.0]
    assert band_rms(noise, (40.0, 91.9))[0][[0, -1]].tolist() == [41.0, 89.0]
    assert band_rms(noise, None)[0][[0, -1]].tolist() == [1.0, 649.0]


def test_equal_levels_make_no_line():
    x = np.array([1.0, 2.0, 3.0])
    assert np.isnan(straight_lines(x, np.full(3, 0.1))[2])
    saturated = band_rms(0.1 * tone(100.0, 1300)[None, None])
    assert np.isnan(straightness(x, [saturated] * 3).adjusted_r2).all()
    slope, offset, r2 = straight_lines(x, 2.0 + 1e-12 * x)
    assert slope == pytest.approx(1e-12, rel=1e-3)
    assert offset == pytest.approx(2.0)
    assert r2 == pytest.approx(1.0, abs=1e-3)
