import numpy as np
import pytest


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
