from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import InvalidInputError
from skinsource.lab.playing.devices import Output
from skinsource.lab.playing.session import MOST_SAMPLES, Mixer, analytic, on_two_ears, turned_up

TWO = ss.Design(
    limb="synthetic-1",
    inputs=(
        ss.track(7, ss.waveforms.Tone(frequency_hz=100.0), amplitude=0.5),
        ss.track(12, ss.waveforms.Tone(frequency_hz=180.0), onset_s=0.1, amplitude=0.25),
    ),
)


def test_what_is_played_is_the_stimulus_that_is_exported():
    mixed = Mixer().mix(TWO, Output())
    expected = ss.stimulus_of(TWO, 48_000).samples
    assert np.array_equal(mixed.samples, expected.astype(np.float32))
    assert mixed.names == ("place 7", "place 12")
    assert mixed.loop is None


def test_each_place_plays_on_its_output():
    mixed = Mixer().mix(TWO, Output(outputs=((7, 4), (12, 2))), least_outputs=2)
    assert mixed.names == ("", "place 12", "", "place 7")
    assert [mixed.plays_on(number) for number in range(1, 6)] == [False, True, False, True, False]


def test_what_one_place_drives_does_not_depend_on_whether_another_is_muted():
    muted = TWO.with_input(0, muted=True)
    mixed = Mixer().mix(muted, Output())
    assert mixed.names == ("", "place 12")
    assert not mixed.samples[0].any()


def test_the_loop_of_the_design_goes_before_that_of_all_of_it():
    mixer = Mixer()
    looped = replace(TWO, loop_s=(0.05, 0.25))
    assert mixer.mix(looped, Output(), loops=True).loop == (2400, 12_000)
    assert mixer.mix(looped, Output()).loop == (2400, 12_000)
    whole = mixer.mix(TWO, Output(), loops=True)
    assert whole.loop == (0, whole.n_times)


def test_the_stand_in_plays_on_two_ears_so_many_hertz_higher():
    design = TWO.with_input(1, muted=True)
    mixed = Mixer().mix(design, Output(stand_in=True, shift_hz=250.0, outputs=((7, 9),)))
    assert mixed.names == ("left", "right")
    spectrum = np.abs(np.fft.rfft(mixed.samples[0], 48_000))
    assert spectrum.argmax() == pytest.approx(350, abs=1)
    assert np.allclose(mixed.samples[0], mixed.samples[1])


def test_too_much_to_be_held_is_refused():
    tracks = tuple(ss.track(1 + k, ss.waveforms.Impulse(), onset_s=0.0) for k in range(20))
    late = ss.track(1, ss.waveforms.Impulse(), onset_s=MOST_SAMPLES / 20 / 384_000 + 1)
    with pytest.raises(InvalidInputError, match="Choose a lower rate, or mute inputs"):
        Mixer().mix(replace(TWO, inputs=(*tracks, late)), Output(sample_rate_hz=384_000))


RATE_HZ, THERE_HZ = 1300, 48_000


def shifted(rows, shift_hz):
    whole = analytic(rows)
    parts = ss.resample(np.concatenate((whole.real, whole.imag)), RATE_HZ, THERE_HZ)
    return turned_up(parts, THERE_HZ, shift_hz)


def burst(frequency_hz, rate_hz, n, phase=0.0):
    """A tone under a window that is smooth to a millionth, so that its ends do not ring."""
    time = np.arange(n) / rate_hz
    centre = 1.0
    envelope = np.exp(-0.5 * ((time - centre) / 0.12) ** 2)
    return envelope * np.cos(2 * np.pi * frequency_hz * time + phase)


@pytest.mark.parametrize("frequency_hz", [40.0, 100.0, 250.0, 550.0])
def test_a_tone_is_heard_so_many_hertz_higher_under_the_same_envelope(frequency_hz):
    row = burst(frequency_hz, RATE_HZ, 2600)
    shifted_row = shifted(row[np.newaxis], 300.0)[0]
    expected = burst(frequency_hz + 300.0, THERE_HZ, shifted_row.size)
    assert np.abs(shifted_row - expected).max() < 1e-4


def test_channels_are_spread_from_left_to_right_in_their_order():
    rows = np.eye(2)
    assert on_two_ears(rows).tolist() == [[0.75, 0.25], [0.25, 0.75]]
    assert on_two_ears(np.ones((1, 3))).tolist() == [[0.5] * 3, [0.5] * 3]
    assert on_two_ears(np.zeros((0, 3))).tolist() == [[0.0] * 3, [0.0] * 3]
