import json

import numpy as np
import pytest

from skinsource.base.assets import data_folder
from skinsource.limbs.synthetic import Skin, wavenumber

# From the description of the model: speed and decay of waves in the skin of limb 1.
FREQUENCIES_HZ = np.array([30, 50, 100, 150, 200, 300, 400, 500], dtype=float)
SPEEDS_M_S = np.array([10.5, 11.1, 12.0, 12.6, 13.0, 13.6, 14.1, 14.4])
DECAYS_DB_CM = np.array([0.26, 0.42, 0.80, 1.15, 1.50, 2.18, 2.82, 3.45])


def test_speed_and_decay_follow_the_published_table():
    shared = json.loads((data_folder() / "synthetic-limbs.json").read_text(encoding="utf-8"))
    k = wavenumber(FREQUENCIES_HZ, Skin(**shared["skin"]))
    speed = 2 * np.pi * FREQUENCIES_HZ / k.real
    decay = -k.imag * 20 * np.log10(np.e) / 100
    np.testing.assert_allclose(speed, SPEEDS_M_S, atol=0.06)
    np.testing.assert_allclose(decay, DECAYS_DB_CM, atol=0.01)


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
