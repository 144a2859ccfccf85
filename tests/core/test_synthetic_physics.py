"""The nine sanity checks of the synthetic limbs, and a comparison with measured levels."""

from itertools import combinations

import numpy as np
import pytest
from scipy.signal import hilbert

import skinsource as ss
from skinsource.limbs.synthetic import load_synthetic_limb
from tests.core.test_extent import distances_mm

RATE_HZ = 1300.0
TIPS, HAND = (19, 20), (26, 27)
WRIST = (43, 44, 45, 46, 52, 53, 54, 55)
MID_FOREARM = (59, 58)
# From the tip of digit III to the elbow.
PATH = (20, 22, 24, 32, 26, 34, 27, 52, 54, 57, 56, 59, 58, 60, 69, 68)
# Mean of four measured limbs, dB re the fingertip sensors, without the values in the noise.
MEASURED_DB = {
    50: (1, -2, -5, -13, -16, -17, -21, -19, -21, -24, -28, -31, -33, -32, -41, -41),
    100: (0, 1, -3, -14, -14, -19, -27, -33, -36, -36, -40, -42, -44, -43, -47, -49),
    200: (0, -1, -10, -23, -20, -31, -31, -39, -43),
    300: (0, -4, -15, -27, -25, -37, -36, -43),
}


@pytest.fixture(scope="module", params=range(1, 5))
def limb(request):
    return load_synthetic_limb(request.param)


def rows(outputs):
    return np.array(outputs) - 1


def amplitude(response, frequency_hz):
    """Magnitude over the axes of the spectrum at one frequency, (72,)."""
    turn = np.exp(-2j * np.pi * frequency_hz / RATE_HZ * np.arange(response.shape[-1]))
    return np.sqrt(np.sum(np.abs(response @ turn) ** 2, axis=1))


def level_db(response, outputs, frequency_hz):
    """Rms level over outputs re that of the fingertip sensors."""
    power = amplitude(response, frequency_hz) ** 2
    return 10 * np.log10(power[rows(outputs)].mean() / power[rows(TIPS)].mean())


def envelope(response):
    """Hilbert envelope over the three axes, (72, 522)."""
    return np.linalg.norm(np.abs(hilbert(response, 2048)[..., :522]), axis=1)


def width_ms(trace):
    """Time between the first and the last sample within 10 dB of the peak."""
    above = np.flatnonzero(trace >= trace.max() * 10**-0.5)
    return (above[-1] - above[0] + 1) / RATE_HZ * 1e3


def onset_ms(trace):
    """When the envelope first passes a tenth of its peak, interpolated."""
    threshold = 0.1 * trace.max()
    after = int(np.argmax(trace >= threshold))
    before = trace[after - 1]
    return (after - 1 + (threshold - before) / (trace[after] - before)) / RATE_HZ * 1e3


def centroid_hz(response):
    """Spectral centroid from 15 to 600 Hz, (72,)."""
    frequency = np.fft.rfftfreq(2048, 1 / RATE_HZ)
    power = np.sum(np.abs(np.fft.rfft(response, 2048)) ** 2, axis=1)
    band = (frequency >= 15) & (frequency <= 600)
    return power[:, band] @ frequency[band] / power[:, band].sum(axis=1)


def test_1_low_frequencies_attenuate_less(limb):
    levels = [level_db(limb.response_to(8), WRIST, f) for f in (50, 100, 150, 200, 300, 400)]
    assert (np.diff(levels) < 0).all(), np.round(levels, 1)


def test_2_energy_at_50_hz_reaches_the_middle_of_the_forearm(limb):
    level = level_db(limb.response_to(8), MID_FOREARM, 50)
    assert -35 <= level <= -20, f"{level:.1f} dB"


def test_3_the_envelope_widens_threefold_from_tip_to_hand_and_further_on_the_arm(limb):
    traces = envelope(limb.response_to(8))
    tip, hand, arm = (
        np.mean([width_ms(traces[row]) for row in rows(outputs)])
        for outputs in (TIPS, HAND, MID_FOREARM)
    )
    assert hand >= 3 * tip, (tip, hand, arm)
    assert arm > hand, (tip, hand, arm)


def test_4_arrival_grows_with_distance_at_8_to_16_m_per_s(limb):
    traces = envelope(limb.response_to(8))[rows(PATH)]
    onsets = np.array([onset_ms(trace) for trace in traces])
    assert (np.diff(onsets) > 0).all(), onsets.round(1)
    speed = 1 / np.polyfit(distances_mm(limb, 8)[rows(PATH)], onsets, 1)[0]
    assert 8 <= speed <= 16, f"{speed:.1f} m/s"


def test_5_at_most_5_percent_of_the_peak_comes_before_49_ms(limb):
    before = int(np.ceil(0.049 * RATE_HZ))
    for location in range(1, 21):
        response = np.abs(limb.response_to(location))
        share = response[..., :before].max() / response.max()
        assert share <= 0.05, f"input {location}: {100 * share:.1f} %"


def test_6_the_spectral_centroid_falls_from_tip_to_wrist(limb):
    centroid = centroid_hz(limb.response_to(8))
    path = [centroid[rows(outputs)].mean() for outputs in (TIPS, (24,), HAND, WRIST)]
    assert (np.diff(path) < 0).all(), np.round(path)


@pytest.mark.parametrize("cycles", [3, 4, 6])
def test_8_higher_wavelets_stay_closer_to_the_contact(limb, cycles):
    train = ss.waveforms.WaveletTrain(cycles=cycles, slot_s=0.16)
    field = ss.predict(limb, train.samples(RATE_HZ), 7, scaling="relative")
    windows = ss.windowed_rms(np.linalg.norm(field, axis=1), 208, first_sample=67)[:5]
    extents = [ss.extent(window, limb, 7).mean_distance_mm for window in windows]
    assert (np.diff(extents) < 0).all(), np.round(extents, 1)


def test_9_all_four_limbs_differ():
    limbs = [load_synthetic_limb(number) for number in range(1, 5)]
    for first, second in combinations(limbs, 2):
        a, b = first.response_to(8), second.response_to(8)
        likeness = np.sum(a * b) / np.linalg.norm(a) / np.linalg.norm(b)
        assert likeness < 0.9, (first.name, second.name, likeness)
        levels = 20 * np.log10(np.linalg.norm(a, axis=(1, 2)) / np.linalg.norm(b, axis=(1, 2)))
        assert np.std(levels) > 0.8, (first.name, second.name, np.std(levels))
        assert not np.allclose(first.map.outline, second.map.outline, atol=2)


def test_levels_down_digit_3_agree_with_the_measured_ones():
    # About the noise of real recordings.
    noise = 0.006 * np.random.default_rng(8).standard_normal((72, 3, 522))
    responses = [load_synthetic_limb(n).response_to(8) + noise for n in range(1, 5)]
    errors = {}
    for frequency, measured in MEASURED_DB.items():
        levels = [
            [level_db(response, (output,), frequency) for output in PATH[: len(measured)]]
            for response in responses
        ]
        errors[frequency] = float(np.abs(np.mean(levels, axis=0) - measured).mean())
    report = ", ".join(f"{f} Hz: {error:.1f} dB" for f, error in errors.items())
    assert max(errors.values()) < 6, f"mean |error| along digit III: {report}"
