"""Levels above threshold, against the figures of the model and sums written out."""

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import InvalidInputError
from skinsource.perception.thresholds import (
    sensation_levels_db,
    sensation_magnitude,
    site_offsets_db,
    threshold_rms,
)

NONE = {"P": np.zeros(1), "NP I": np.zeros(1)}


@pytest.mark.parametrize(
    ("frequency_hz", "peak_um", "rms"),
    [
        (10, 7.9, 0.022),
        (16, 5.3, 0.038),
        (25, 3.7, 0.064),
        (31.5, 3.2, 0.088),
        (40, 3.2, 0.141),
        (50, 2.5, 0.173),
        (63, 1.56, 0.174),
        (250, 0.10, 0.174),
        (315, 0.108, 0.30),
        (400, 0.161, 0.72),
        (500, 0.234, 1.63),
        (600, 0.316, 3.18),
    ],
)
def test_the_threshold_has_the_known_figures(frequency_hz, peak_um, rms):
    threshold = float(threshold_rms(frequency_hz))
    assert threshold == pytest.approx(rms, rel=0.03)
    displacement_um = 1e6 * threshold * np.sqrt(2) / (2 * np.pi * frequency_hz) ** 2
    assert displacement_um == pytest.approx(peak_um, rel=0.03)


@pytest.mark.parametrize("frequency_hz", [26.0, 130.0, 400.0])
def test_a_tone_at_threshold_is_0_db_above_it(frequency_hz):
    # Faded: the other channel detects the click of an abrupt begin before the tone.
    tone = ss.sinusoid(frequency_hz, duration_s=2.0, window_name="hann")
    for channel in ("P", "NP I"):
        rms = float(threshold_rms(frequency_hz, channel))
        levels_db = sensation_levels_db(np.sqrt(2) * rms * tone[None, None], 1300.0, NONE)
        # The loudest 100 ms of a Hann window, in which 26 Hz has 2.6 periods.
        assert levels_db[channel][0] == pytest.approx(0.0, abs=0.25)


@pytest.mark.parametrize(
    "waveforms",
    [
        (ss.waveforms.Tone(frequency_hz=100.0),),
        (ss.waveforms.Tone(frequency_hz=40.0), ss.waveforms.Noise()),
        (ss.waveforms.Tap(),),
    ],
)
def test_library_and_panel_have_one_definition_whatever_silence_follows(waveforms):
    places = (7, 9)[: len(waveforms)]
    tracks = [ss.track(place, wave) for place, wave in zip(places, waveforms, strict=True)]
    design = ss.Design(limb="synthetic-1", inputs=tuple(tracks))
    view = ss.View(outputs=tuple(range(1, 73)))
    values = ss.evaluate(design, "axis_traces", "sensation", view=view)
    traces, panel = values["axis_traces"], values["sensation"].by_channel
    for silence in (0, 1300):
        library = sensation_levels_db(np.pad(traces, ((0, 0), (0, 0), (0, silence))), 1300.0)
        for channel in ("P", "NP I"):
            heard = panel[channel] > -30.0
            assert heard.any()
            difference_db = library[channel][heard] - panel[channel][heard]
            # Slow parts at the edge of the band ring into the silence.
            np.testing.assert_allclose(difference_db, 0.0, atol=1.5 if silence else 0.05)


def test_axes_and_frequencies_add_up_as_energies():
    time_s = np.arange(1300) / 1300.0
    low, high = (np.sin(2 * np.pi * f * time_s) for f in (50.0, 200.0))
    levels_db = [
        sensation_levels_db(tone[None, None], 1300.0, NONE)["P"][0] for tone in (low, high)
    ]
    together_db = 10 * np.log10(sum(10 ** (level_db / 10) for level_db in levels_db))
    added = sensation_levels_db((low + high)[None, None], 1300.0, NONE)["P"][0]
    on_two_axes = sensation_levels_db(np.array([[low, high]]), 1300.0, NONE)["P"][0]
    # In 100 ms, products of both tones do not quite cancel.
    assert added == pytest.approx(together_db, abs=0.1)
    assert on_two_axes == pytest.approx(together_db, abs=0.1)


def test_twice_the_amplitude_is_6_db_more_and_silence_is_not_felt():
    signal = np.random.default_rng(2).standard_normal((72, 3, 500))
    once = sensation_levels_db(signal, 1300.0)
    twice = sensation_levels_db(2 * signal, 1300.0)
    np.testing.assert_allclose(twice["NP I"] - once["NP I"], 20 * np.log10(2))
    silent = sensation_levels_db(np.zeros((72, 3, 500)), 1300.0)
    assert (silent["P"] == -300.0).all()
    assert (sensation_magnitude(silent) == 0.0).all()


def test_hairy_skin_and_the_arm_are_less_sensitive():
    offsets = site_offsets_db()
    assert offsets["P"][28] == 10.0
    assert offsets["NP I"][28] == 10.0
    assert offsets["NP I"][55] == 15.0
    assert np.isinf(offsets["P"][55])
    signal = np.tile(np.random.default_rng(2).standard_normal((1, 3, 500)), (72, 1, 1))
    levels_db = sensation_levels_db(signal, 1300.0)
    assert levels_db["NP I"][28] - levels_db["NP I"][55] == pytest.approx(5.0)
    assert levels_db["P"][55] == -300.0


def test_both_channels_together_are_the_larger_and_half_of_the_smaller():
    levels = {"P": np.array([20.0, -5.0, 20.0]), "NP I": np.array([20.0, 20.0, -5.0])}
    p, np_1 = 10**0.6 - 1, 10**0.9 - 1
    np.testing.assert_allclose(sensation_magnitude(levels), [np_1 + p / 2, np_1, p])


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: threshold_rms(0.0), "frequency_hz"),
        (lambda: threshold_rms([50.0, 1e308]), "frequency_hz"),
        (lambda: threshold_rms(50.0, "SA"), "channel"),
        (lambda: threshold_rms(50.0, area_cm2=0.0), "area_cm2"),
        (lambda: sensation_levels_db(np.zeros((3, 5)), 1300.0), "shape"),
        (lambda: sensation_levels_db(np.zeros((7, 3, 5)), 1300.0), "72 of the published"),
        (lambda: site_offsets_db("lab-1"), "where the outputs of others lie is not known"),
        (lambda: sensation_levels_db(np.full((1, 1, 5), np.nan), 1300.0, NONE), "acceleration"),
    ],
)
def test_what_cannot_be_is_refused(call, message):
    with pytest.raises(InvalidInputError, match=message):
        call()
