import json

import numpy as np
import pytest

from skinsource.base.assets import data_folder
from skinsource.limbs.synthetic import (
    SYNTHETIC_LIMBS,
    Pulse,
    Skin,
    load_synthetic_limb,
    paths_in,
    pulse_spectrum,
    synthetic_model,
    wavenumber,
)

# From the description of the model: speed and decay of waves in the skin of limb 1.
FREQUENCIES_HZ = np.array([30, 50, 100, 150, 200, 300, 400, 500], dtype=float)
SPEEDS_M_S = np.array([10.5, 11.1, 12.0, 12.6, 13.0, 13.6, 14.1, 14.4])
DECAYS_DB_CM = np.array([0.26, 0.42, 0.80, 1.15, 1.50, 2.18, 2.82, 3.45])


@pytest.mark.parametrize("number", SYNTHETIC_LIMBS)
def test_a_synthetic_limb_has_the_shape_of_a_measured_one(number):
    limb = load_synthetic_limb(number)
    assert limb.name == f"synthetic-{number}"
    assert limb.synthetic
    assert limb.sample_rate_hz == 1300.0
    responses = limb.impulse_responses
    assert responses.shape == (20, 72, 3, 522)
    assert responses.dtype == np.float64
    assert np.isfinite(responses).all()
    assert (np.abs(responses).max(axis=(2, 3)) > 0).all()


@pytest.mark.parametrize("number", SYNTHETIC_LIMBS)
def test_the_largest_sample_of_input_8_is_20(number):
    response = load_synthetic_limb(number).response_to(8)
    assert np.abs(response).max() == pytest.approx(20.0, rel=1e-12)


def test_speed_and_decay_follow_the_published_table():
    shared = json.loads((data_folder() / "synthetic-limbs.json").read_text(encoding="utf-8"))
    k = wavenumber(FREQUENCIES_HZ, Skin(**shared["skin"]))
    speed = 2 * np.pi * FREQUENCIES_HZ / k.real
    decay = -k.imag * 20 * np.log10(np.e) / 100
    np.testing.assert_allclose(speed, SPEEDS_M_S, atol=0.06)
    np.testing.assert_allclose(decay, DECAYS_DB_CM, atol=0.01)


def test_the_pulse_is_silent_before_it_starts_and_peaks_after_its_delay():
    shared = json.loads((data_folder() / "synthetic-limbs.json").read_text(encoding="utf-8"))
    pulse = np.fft.irfft(pulse_spectrum(Pulse(**shared["pulse"]), 1024, 1300.0))
    start = int(np.floor(0.0515 * 1300))
    assert np.abs(pulse[:start]).max() < 1e-3 * np.abs(pulse).max()
    assert 52.0 <= np.argmax(pulse) / 1.3 <= 54.5


def test_paths_leave_a_digit_through_its_knuckle_and_reach_the_arm_through_the_wrist():
    shape = synthetic_model(1).shape
    paths = paths_in(shape)
    tip_to_neighbour = paths.lengths_px[7, 33 - 1]
    base_3, base_2 = shape.digit_axes[2][0], shape.digit_axes[1][0]
    expected = (
        np.linalg.norm(shape.input_positions[7] - base_3)
        + np.linalg.norm(base_3 - base_2)
        + np.linalg.norm(base_2 - shape.output_positions[32])
    )
    assert tip_to_neighbour == pytest.approx(expected)
    assert paths.knuckles[7, [20 - 1, 26 - 1, 57 - 1, 33 - 1]].tolist() == [0, 1, 1, 2]
    assert paths.knuckles[17, [26 - 1, 57 - 1, 20 - 1]].tolist() == [0, 0, 1]
    assert paths.wrists[7, [26 - 1, 57 - 1, 61 - 1]].tolist() == [0, 1, 1]
    offsets = shape.input_positions[:, None] - shape.output_positions[None]
    straight = np.linalg.norm(offsets, axis=-1)
    assert (paths.lengths_px >= straight - 1e-9).all()
    np.testing.assert_allclose(paths.lengths_px[17, 6:9], straight[17, 6:9])
    np.testing.assert_allclose(paths.lengths_px[7, 18:22], straight[7, 18:22])


@pytest.fixture
def limb(limb_of):
    return limb_of(lambda place: np.full((72, 3, 522), float(place)))


def test_all_responses_are_read_once_and_only_when_touched(limb):
    assert limb.bytes_read == 0
    everything = limb.impulse_responses
    assert everything.shape == (20, 72, 3, 522)
    assert limb.bytes_read == everything.nbytes
    assert limb.impulse_responses is everything
    assert limb.bytes_read == everything.nbytes


def test_responses_cannot_be_written_to(limb):
    for response in (limb.response_to(3), limb.impulse_responses, limb.response_to(3)):
        with pytest.raises(ValueError, match="read-only"):
            response[...] = 0.0
