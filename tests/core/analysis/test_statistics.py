"""Figures of signals against what is known of the signals."""

import numpy as np
import pytest
import scipy

from skinsource.base.errors import InvalidInputError
from skinsource.signals.analysis.noise import noise_rms, predicted_noise_energy
from skinsource.signals.analysis.statistics import crest_factor, dominant_frequency, onset_time

RATE = 1300.0


def power_of(signals):
    return np.abs(np.fft.rfft(signals)) ** 2


def test_the_crest_factor_of_a_sine_is_the_root_of_two_and_silence_has_none():
    wave = np.sin(2 * np.pi * 0.0213 * np.arange(5000))
    rms = np.sqrt(np.mean(wave**2))
    factors = crest_factor([np.abs(wave).max(), 0.0], [rms, 0.0])
    assert factors[0] == pytest.approx(np.sqrt(2), rel=1e-3)
    assert np.isnan(factors[1])


@pytest.mark.parametrize("frequency_hz", [31.7, 100.0, 187.3, 402.2])
def test_the_dominant_frequency_is_that_of_the_finest_transform(frequency_hz):
    time = np.arange(900) / RATE
    burst = np.exp(-(((time - 0.3) / 0.08) ** 2)) * np.sin(2 * np.pi * frequency_hz * time)
    whole = np.stack([burst, 3.0 + 0.2 * burst])
    frequencies_hz = dominant_frequency(power_of(whole), RATE / 900)
    fine = np.abs(np.fft.rfft(burst, 2**20))
    expected = np.argmax(fine) * RATE / 2**20
    assert frequencies_hz == pytest.approx([expected, expected], abs=0.1)


def test_silence_has_no_dominant_frequency_and_a_constant_neither():
    assert np.isnan(dominant_frequency(np.zeros((2, 8)), 1.0)).all()
    assert np.isnan(dominant_frequency([5.0, 0.0, 0.0], 1.0))


def test_a_signal_begins_where_it_first_reaches_a_tenth_of_its_peak():
    time = np.arange(101) / 100.0 - 0.2
    ramp = np.clip(time - 0.105, 0.0, 0.5) * -8.0
    onsets_s = onset_time([ramp, np.zeros(101), np.ones(101)], time)
    # A straight line: no error between samples, though a tenth lies between two of them.
    assert onsets_s[0] == pytest.approx(0.155, abs=1e-12)
    assert np.isnan(onsets_s[1])
    assert onsets_s[2] == -0.2


def test_the_noise_of_a_prediction_is_that_of_convolving_noise():
    rng = np.random.default_rng(5)
    drives = {3: rng.normal(size=80), 9: np.hanning(40)}
    sigma = {3: np.array([[0.2, 0.1]]), 9: np.array([[0.3, 0.7]])}
    expected = predicted_noise_energy(drives, sigma, 100)
    energies = []
    for _ in range(400):
        total = np.zeros((1, 2, 180))
        for place, played in drives.items():
            noise = rng.normal(size=(1, 2, 100)) * sigma[place][..., None]
            noise_response = scipy.signal.oaconvolve(noise, played[None, None], axes=-1)
            total[..., : noise_response.shape[-1]] += noise_response
        energies.append(np.sum(total**2, axis=-1))
    assert np.mean(energies, axis=0) == pytest.approx(expected, rel=0.05)


def test_wrong_figures_are_refused_in_one_sentence():
    with pytest.raises(InvalidInputError, match="two bins or more"):
        dominant_frequency([1.0], 1.0)
    with pytest.raises(InvalidInputError, match="39 samples before the pulse"):
        noise_rms(np.zeros((2, 39)), RATE)
    with pytest.raises(InvalidInputError, match="place 4 is not given"):
        predicted_noise_energy({4: np.ones(3)}, {}, 10)
    with pytest.raises(InvalidInputError, match="expected \\(n_times,\\)"):
        onset_time(np.ones((2, 5)), np.arange(4.0))
