import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.lab.playing.mix import FREQUENCY_HZ, mix_of, tone_of
from tests.core.playing.playing_bench import RATE_HZ


def made(rows, **changes):
    settings = {"outputs": [1, 2], "titles": ["a", "b"], "n_outputs": 4, **changes}
    return mix_of(np.asarray(rows, float), RATE_HZ, **settings)


def test_each_channel_goes_to_its_output():
    mixed = made([[1, 2], [3, 4]], outputs=[4, 2])
    assert mixed.samples.tolist() == [[0, 0], [3, 4], [0, 0], [1, 2]]
    assert mixed.names == ("", "b", "", "a")


def test_channels_at_one_output_add_up():
    mixed = made([[1, 2], [3, 4]], outputs=[2, 2])
    assert mixed.samples.tolist() == [[0, 0], [4, 6], [0, 0], [0, 0]]
    assert mixed.names[1] == "a + b"


@pytest.mark.parametrize(
    ("rows", "changes", "message"),
    [
        ([[1, np.nan], [0, 0]], {}, "finite"),
        ([[1, np.inf], [0, 0]], {}, "finite"),
        ([[1, 1e39], [0, 0]], {}, "1e\\+39"),
        ([[1, 2], [3, 4]], {"loop_s": (0.1, 0.109)}, "lasts 9 ms, expected at least 10 ms"),
        ([[1, 2], [3, 4]], {"loop_s": (0.2, 0.1)}, "expected at least 10 ms"),
    ],
)
def test_what_cannot_be_played_is_refused(rows, changes, message):
    with pytest.raises(InvalidInputError, match=message):
        made(rows, **changes)


def test_the_test_tone_is_on_its_output_alone_and_has_its_frequency():
    samples = tone_of(3, 4, 48_000)
    assert not samples.samples[[0, 1, 3]].any()
    tone = samples.samples[2].astype(float)
    assert np.abs(tone).max() == pytest.approx(1.0, abs=1e-3)
    spectrum = np.abs(np.fft.rfft(tone, 480_000))
    assert spectrum.argmax() / 10 == pytest.approx(FREQUENCY_HZ, abs=0.2)
    assert abs(tone[0]) < 1e-3
    assert abs(tone[-1]) < 1e-3
