"""What actuators get: the samples that the prediction is made of, at the rate of a device."""

from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource import Clip, Design, Input, effects, stimulus_of, track
from skinsource.base.errors import InvalidInputError
from skinsource.design.waveforms import Gabor, Impulse, Noise, Tone
from skinsource.engine import stimulus

RATE_HZ = 1300.0


def design(*inputs: Input, **changes) -> Design:
    return Design(limb="synthetic-1", inputs=inputs, **changes)


def burst(onset_s: float, **changes) -> Clip:
    return Clip(waveform=Gabor(frequency_hz=200.0), onset_s=onset_s, **changes)


SEVERAL = design(
    Input(
        location=7,
        amplitude=0.5,
        clips=(
            burst(0.1003, gain=-0.7),
            Clip(
                waveform=Tone(frequency_hz=90.0),
                onset_s=0.2001,
                effects=(effects.Trim(start_s=0.01, duration_s=0.04),),
            ),
        ),
        gain_curve=((0.0, 0.2), (0.3, 1.0)),
    ),
    Input(location=12, amplitude=-2.0, clips=(burst(0.05), burst(0.3, muted=True))),
    Input(location=7, clips=(Clip(waveform=Noise(seed=4), onset_s=0.0512),)),
    track(3, muted=True),
)


def test_at_the_rate_of_the_limb_it_is_what_the_engine_predicts_with():
    result = stimulus_of(SEVERAL)
    values = ss.evaluate(SEVERAL, "input_waveforms", "voices", "stimulus_samples")
    expected = np.zeros((2, values["stimulus_samples"]))
    for voice, samples in zip(values["voices"], values["input_waveforms"], strict=True):
        if voice.audible:
            row = {7: 0, 12: 1}[voice.location]
            expected[row, voice.start : voice.start + samples.size] += voice.amplitude * samples
    assert result.sample_rate_hz == RATE_HZ
    np.testing.assert_allclose(result.samples, expected, rtol=0, atol=1e-15)


def test_channels_are_places_in_the_order_of_first_use():
    result = stimulus_of(SEVERAL)
    assert [(channel.number, channel.place, channel.inputs) for channel in result.channels] == [
        (1, 7, (1, 3)),
        (2, 12, (2,)),
    ]
    assert result.channels[0].title == "Digit II, pad"


def test_muting_one_of_two_inputs_at_a_place_does_not_reorder_channels():
    three = design(track(7, muted=True), track(12), track(7))
    assert [channel.place for channel in stimulus_of(three).channels] == [7, 12]
    assert [channel.inputs for channel in stimulus_of(three).channels] == [(3,), (2,)]


def test_only_what_is_chosen_takes_part():
    plain = stimulus_of(SEVERAL, inputs=(3,))
    np.testing.assert_array_equal(
        plain.samples, stimulus_of(replace(SEVERAL, inputs=SEVERAL.inputs[2:3])).samples
    )
    chosen = SEVERAL.inputs[0].clips[1]
    clip = stimulus_of(SEVERAL, clips=(chosen.id,))
    alone = replace(SEVERAL.inputs[0], clips=(chosen,))
    np.testing.assert_array_equal(
        clip.samples, stimulus_of(replace(SEVERAL, inputs=(alone,))).samples
    )


def test_the_band_is_that_of_the_lower_rate():
    assert stimulus_of(design(track(3)), 48_000).band_hz == (25.0, 600.0)
    assert stimulus_of(design(track(3)), 650).band_hz == (25.0, 300.0)


def test_a_part_of_the_time_is_those_samples():
    result = stimulus_of(SEVERAL, 48_000)
    part = stimulus.part_of_time(result, 0.1, 0.2)
    assert part.start_s == 0.1
    np.testing.assert_array_equal(part.samples, result.samples[:, 4800:9600])
    beyond = stimulus.part_of_time(result, result.duration_s - 0.01, result.duration_s + 0.01)
    assert beyond.n_times == 960
    assert not beyond.samples[:, 480:].any()
    for times in ((0.2, 0.1), (0.1, 0.1), (-1.0, 0.1)):
        with pytest.raises(InvalidInputError, match="_s is"):
            stimulus.part_of_time(result, *times)


def test_a_sync_channel_marks_time_0_at_full_scale():
    quiet = stimulus_of(design(track(7, Impulse(), onset_s=0.1, amplitude=0.01)), 8000)
    marked = stimulus.with_sync(stimulus.with_silence(quiet, 0.05))
    assert marked.channels[-1] == stimulus.Channel(number=2, place=None, title="Sync")
    assert np.flatnonzero(marked.samples[1]).tolist() == list(range(400, 480))
    # Neither the factor of the others nor a fade changes it.
    done = stimulus.scaled(marked, stimulus.full_scale_factor(marked))
    assert np.abs(done.samples).max(axis=1) == pytest.approx([1.0, 1.0])
    np.testing.assert_array_equal(stimulus.faded(marked, 0.1, 0.0).samples[1], marked.samples[1])
    # What begins later is marked where it begins.
    late = stimulus.with_sync(stimulus.part_of_time(quiet, 0.09, 0.2), 0.001)
    assert np.flatnonzero(late.samples[1]).tolist() == list(range(8))
    # Or at another time.
    other = stimulus.with_sync(quiet, 0.001, at_s=0.05)
    assert np.flatnonzero(other.samples[1]).tolist() == list(range(400, 408))


def test_a_channel_map_says_what_each_output_gets():
    result = stimulus_of(SEVERAL)
    mapped = stimulus.in_order(result, [0, 2, 0, 1])
    assert [(channel.number, channel.place) for channel in mapped.channels] == [
        (1, None),
        (2, 12),
        (3, None),
        (4, 7),
    ]
    np.testing.assert_array_equal(mapped.samples[[1, 3]], result.samples[[1, 0]])
    assert not mapped.samples[[0, 2]].any()
    for wrong in ([1], [1, 1, 2], [1, 2, 3], [1.5, 2]):
        with pytest.raises(InvalidInputError, match="Channel map"):
            stimulus.in_order(result, wrong)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: stimulus_of("design"), "expected Design"),
        (lambda: stimulus_of(design(track(21))), "location 21"),
        (lambda: stimulus_of(SEVERAL, 44_100.5), "sample_rate_hz"),
        (lambda: stimulus_of(SEVERAL, per="clip"), "per"),
        (lambda: stimulus_of(SEVERAL, inputs=(9,)), "no input has the id 9"),
        (lambda: stimulus_of(SEVERAL, clips=(99,)), "no clip has the id 99"),
    ],
)
def test_what_cannot_be_played_is_refused(call, message):
    with pytest.raises(InvalidInputError, match=message):
        call()


def test_more_than_can_be_held_is_refused_before_it_is_made(monkeypatch):
    monkeypatch.setattr(stimulus, "MOST_SAMPLES", 10_000)
    with pytest.raises(InvalidInputError, match="lower rate") as refused:
        stimulus_of(SEVERAL, 48_000)
    assert "at most 0.1 s for 2 channels at 48000 Hz" in str(refused.value)
    assert stimulus_of(SEVERAL).n_times < 5000
