"""The shipped scenes give the numbers that are known of the measured limbs."""

from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.conventions import LIMB_NAMES
from skinsource.signals.analysis.noise import LEAST_ABOVE_NOISE_DB
from skinsource.signals.analysis.wave_speed import arrivals

WRIST = [43, 44, 45, 46, 52, 53, 54, 55]


def levels_of(name: str) -> dict[str, np.ndarray]:
    """RMS of all outputs, (72,), m/s², by the label of each design of a scene."""
    opened = ss.scenes.open_scene(name)
    assert not opened.synthetic
    return {
        condition.label: ss.evaluate(condition.design, "output_rms", view=opened.view)["output_rms"]
        for condition in opened.conditions
    }


def test_figure_2f_cancels_at_output_19_and_adds_up_at_21(measured):
    levels = {label: rms[[18, 20, 23, 31]] for label, rms in levels_of("2F").items()}
    known = {
        "Input 8": [0.2110, 0.1966, 0.0215, 0.0035],
        "Input 13": [0.2119, 0.1828, 0.1346, 0.0286],
        "Both": [0.0240, 0.3570, 0.1301, 0.0296],
    }
    assert levels.keys() == known.keys()
    for label, rms in known.items():
        np.testing.assert_allclose(levels[label], rms, rtol=0, atol=5.1e-5)


@pytest.mark.parametrize(
    ("label", "loudest_db", "hand_db", "wrist_db"),
    [
        ("50 Hz", -7.3, -20.5, -24.8),
        ("100 Hz", -6.2, -26.1, -37.0),
        ("200 Hz", -6.2, -36.1, -44.1),
        ("400 Hz", -6.2, -46.4, -49.2),
    ],
)
def test_figure_2b_falls_with_distance_and_frequency(
    measured, label, loudest_db, hand_db, wrist_db
):
    level_db = ss.decibels(levels_of("2B")[label])
    assert level_db.max() == pytest.approx(loudest_db, abs=0.0501)
    assert np.median(level_db[:42]) == pytest.approx(hand_db, abs=0.0501)
    wrist = level_db[[output - 1 for output in WRIST]]
    assert np.median(wrist) == pytest.approx(wrist_db, abs=0.0501)


@pytest.mark.parametrize("limb", LIMB_NAMES)
def test_arrivals_in_figure_2a_hardly_jump_between_frequencies(measured, limb):
    opened, delays_s = ss.scenes.open_scene("2A"), []
    design, rows = replace(opened.design, limb=limb), np.array(opened.view.outputs) - 1
    (clip,) = design.clips
    for hz in (50.0, 90.0, 200.0, 240.0, 258.0, 300.0, 325.0):
        tone = replace(clip.waveform, frequency_hz=hz)
        played = design.with_input(0, clips=(replace(clip, waveform=tone),))
        found = ss.evaluate(played, "moving_z", "above_noise_db", view=opened.view)
        moving, above_db = found["moving_z"], found["above_noise_db"]
        begin_s = clip.onset_s + moving.delay_s
        delay_s = arrivals(moving.signals[rows, 0], moving.sample_rate_hz, begin_s)
        if above_db is not None:
            delay_s[above_db[rows] < LEAST_ABOVE_NOISE_DB] = np.nan
        delays_s.append(delay_s)
    assert np.isfinite(delays_s).mean() > 0.6
    assert -0.004 < np.nanmin(delays_s) <= np.nanmax(delays_s) < 0.025
    assert np.nanmax(np.abs(np.diff(delays_s, axis=0))) < 0.02


def test_scenes_of_a_pulse_are_the_impulse_responses_themselves(measured):
    for name in ("1C", "1D", "1E", "1F", "1G"):
        for condition in ss.scenes.open_scene(name).conditions:
            design = condition.design
            view = ss.View(axes="z", outputs=tuple(range(1, 73)))
            traces = ss.evaluate(design, "selected_traces", view=view)["selected_traces"]
            response = ss.load_limb(design.limb).response_to(design.inputs[0].location)[:, 2]
            np.testing.assert_allclose(traces, response, rtol=0, atol=1e-12)


def test_the_energy_of_figure_1d_is_that_of_all_axes(measured):
    opened = ss.scenes.open_scene("1D")
    response = ss.load_limb(opened.design.limb).response_to(8)[19]
    power = np.square(np.abs(np.fft.rfft(response))).sum(axis=0)
    above = np.fft.rfftfreq(response.shape[-1], 1.0 / 1300.0) > 200.0
    share = power[above].sum() / power.sum()
    assert f"{100.0 * share:.0f} % of the energy at output 20" in opened.scene.sentence


def test_figure_2h_draws_in_towards_the_finger(measured):
    opened = ss.scenes.open_scene("2H")
    view = ss.View(axes="xyz", method="mag", outputs=tuple(range(1, 73)))
    traces = ss.evaluate(opened.design, "selected_traces", view=view)["selected_traces"]
    windows = ss.windowed_rms(traces, 156, first_sample=67)[:5]
    limb = ss.load_limb(opened.design.limb)
    assert limb.name == "measured-4"
    distances_mm = [ss.extent(window, limb, 7).mean_distance_mm for window in windows]
    np.testing.assert_allclose(distances_mm, [31.9, 27.9, 23.4, 18.8, 17.0], atol=0.5)


@pytest.mark.parametrize(("name", "limb"), [("5B", "measured-1"), ("5B-2", "measured-2")])
def test_the_five_strengths_reach_their_velocities(measured, name, limb):
    opened = ss.scenes.open_scene(name)
    for speed_mm_per_s, condition in zip((5, 10, 20, 40, 80), opened.conditions, strict=True):
        assert condition.design.limb == limb
        (track,) = condition.design.inputs
        for clip in track.clips:
            acceleration = track.amplitude * clip.gain
            velocity = acceleration / (2 * np.pi * clip.waveform.frequency_hz)
            assert velocity == pytest.approx(speed_mm_per_s * 1e-3, rel=1e-12)
