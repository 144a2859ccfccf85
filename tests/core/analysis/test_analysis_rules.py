"""What the graph hands to the panels of analysis, against predictions and other ways to it."""

from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource import Design, View, evaluate, track
from skinsource.design.panel_settings import SpectrogramSettings, with_settings
from skinsource.design.waveforms import Tap, Tone
from skinsource.engine.quantities import new_graph, sources
from skinsource.signals.analysis.spectrogram import spectrogram
from tests.core.own_limbs.lab_bench import installed

TONE = ss.waveforms.Tone(frequency_hz=120.0, duration_s=0.1)
DESIGN = ss.Design(
    limb="synthetic-1",
    inputs=(ss.track(8, TONE, onset_s=0.02), ss.track(13, TONE, amplitude=0.5, onset_s=0.05)),
)
VIEW = View(outputs=(20, 24, 69), method="mag")
LINE = (20, 22, 24, 26)
COIL, PIEZO = (
    ss.Actuation(actuators=(ss.ActuatorAt(model=ss.actuators.load(name)),), equaliser=equaliser)
    for name, equaliser in (
        ("kastor-2023-air", ss.equalising.RegularisedInverse()),
        ("example-piezo", None),
    )
)


def test_statistics_are_those_of_the_traces():
    values = ss.evaluate(DESIGN, "output_statistics", "selected_traces", "axis_traces", view=VIEW)
    figures, traces = values["output_statistics"], values["selected_traces"]
    assert figures.rms == pytest.approx(np.sqrt(np.mean(traces**2, axis=1)), rel=1e-9)
    # The peak is that of what moves between the samples too.
    dense = np.linalg.norm(ss.resample(values["axis_traces"], 1300, 48000), axis=1)
    assert figures.peak == pytest.approx(dense.max(axis=1), rel=1e-3)
    assert figures.crest == pytest.approx(figures.peak / figures.rms)
    # The tone, not the double of it that a rectified magnitude shows; far away noise-free too.
    assert figures.dominant_hz[:2] == pytest.approx([120.0, 120.0], abs=5.0)
    # From the first input's start, about the pre-trigger later, and later with distance.
    assert 0.050 < figures.delay_s[0] < 0.070
    assert figures.delay_s[0] < figures.delay_s[1] < figures.delay_s[2]


def test_delays_follow_the_pre_trigger():
    [plain, removed] = (
        ss.evaluate(DESIGN, "output_statistics", view=view)["output_statistics"].delay_s
        for view in (VIEW, replace(VIEW, delay_removed=True))
    )
    assert plain - removed == pytest.approx(np.full(3, 0.052))


def test_muted_inputs_leave_figures_without_numbers_and_no_error():
    muted = replace(DESIGN, inputs=tuple(replace(track, muted=True) for track in DESIGN.inputs))
    names = ("output_statistics", "output_spectrogram", "output_main_axes", "line_wave", "transfer")
    values = ss.evaluate(muted, *names, "above_noise_db", view=VIEW)
    figures = values["output_statistics"]
    assert np.isnan([*figures.crest, *figures.dominant_hz, *figures.delay_s]).all()
    assert values["output_spectrogram"].amplitude.max() == 0.0
    assert values["output_main_axes"].none.all()
    assert np.isnan(values["line_wave"].wave.speed_m_per_s)
    # What the limb does from that place does not depend on what plays.
    assert values["transfer"].magnitude.max() > 0.0
    assert values["above_noise_db"] is None


def test_nothing_selected_gives_nothing_and_no_error():
    view = replace(VIEW, outputs=())
    names = ("output_statistics", "output_spectrogram", "output_main_axes", "line_wave", "transfer")
    values = ss.evaluate(DESIGN, *names, view=view)
    assert values["output_statistics"].rms.shape == (0,)
    assert values["output_main_axes"].direction.shape == (0, 3)
    assert [values[name] for name in ("output_spectrogram", "line_wave", "transfer")] == [None] * 3
    assert ss.evaluate(ss.Design(limb="synthetic-1"), "transfer", view=VIEW)["transfer"] is None


def test_the_spectrogram_is_of_the_chosen_output_or_the_last_one():
    traces = ss.evaluate(DESIGN, "selected_traces", view=VIEW)["selected_traces"]
    for number, row in ((0, 2), (24, 1), (7, 2)):
        view = with_settings(
            VIEW, "spectrogram", SpectrogramSettings(output=number, window_ms="100")
        )
        output_spectrogram = ss.evaluate(DESIGN, "output_spectrogram", view=view)[
            "output_spectrogram"
        ]
        expected = spectrogram(traces[row], 1300.0, 0.1)
        assert output_spectrogram.amplitude == pytest.approx(expected.amplitude, abs=1e-12)


def test_main_axes_are_those_that_the_projection_takes():
    view = replace(VIEW, method="pca")
    values = ss.evaluate(DESIGN, "output_main_axes", "projection", view=view)
    directions = values["projection"].directions[[19, 23, 68]]
    along = np.abs(np.einsum("oa,oa->o", directions, values["output_main_axes"].direction))
    assert along == pytest.approx(np.ones(3), abs=1e-9)
    single = replace(VIEW, axes="z")
    assert ss.evaluate(DESIGN, "output_main_axes", view=single)["output_main_axes"] is None


def test_a_transfer_function_predicts_what_a_tone_does():
    long = replace(DESIGN, inputs=(ss.track(8, ss.waveforms.Tone(duration_s=1.0)),))
    view = replace(VIEW, axes="z", outputs=(20, 24))
    values = ss.evaluate(long, "transfer", "selected_traces", view=view)
    at = int(np.argmin(np.abs(values["transfer"].frequency_hz - 100.0)))
    steady = np.abs(values["selected_traces"][:, 700:1200]).max(axis=1)
    assert values["transfer"].magnitude[:, at] == pytest.approx(steady, rel=0.05)


@pytest.mark.parametrize(
    ("scaling", "actuation"),
    [("probe", None), ("relative", None), ("upstream", None), ("probe", COIL), ("probe", PIEZO)],
)
def test_noise_of_a_prediction_is_that_of_a_limb_that_is_noise(scaling, actuation, limb_of):
    # Give a limb whose responses are white noise from the first sample to the last.
    def noise(place):
        return np.random.default_rng(place).normal(0.0, 0.0062, (72, 3, 522))

    noisy_limb = limb_of(noise, synthetic=False)
    rough = ss.waveforms.Noise(duration_s=0.4)
    inputs = (ss.track(8, rough), ss.track(8, rough, onset_s=0.1), ss.track(13, rough))
    design = replace(DESIGN, scaling=scaling, inputs=inputs, actuation=actuation)
    view = replace(
        VIEW, method="mag", windows_cut="length", window_s=0.1, outputs=tuple(range(1, 73))
    )
    given = sources(design, view, match_gain=1.7) | {"limb_data": noisy_limb}
    levels = "output_noise_rms", "record_rms"
    windows = "noise_rms_of_windows", "rms_of_windows"
    quantities = {*levels, *windows, "above_noise_db", "transfer"}
    values = new_graph().evaluate(quantities, given)
    computed, is_there = (np.mean(values[name] ** 2) for name in levels)
    assert computed == pytest.approx(is_there, rel=0.03)
    ratio_db = 20.0 * np.log10(values["record_rms"] / values["output_noise_rms"])
    assert values["above_noise_db"] == pytest.approx(ratio_db)
    computed, is_there = (np.mean(values[name] ** 2, axis=1) for name in windows)
    assert computed == pytest.approx(is_there, rel=0.1, abs=0.02 * is_there.max())
    transfer = values["transfer"]
    computed, is_there = (
        np.mean(magnitude**2, axis=0) for magnitude in (transfer.noise, transfer.magnitude)
    )
    assert computed.sum() == pytest.approx(is_there.sum(), rel=0.03)


def test_outputs_near_the_elbow_are_noise_on_the_measured_limbs(measured):
    design = ss.Design(limb="measured-1", inputs=(ss.track(7, ss.waveforms.Tone()),))
    design = design.with_clip(
        design.clips[0].id, waveform=ss.waveforms.Tone(frequency_hz=200.0, duration_s=0.2)
    )
    above_noise_db = ss.evaluate(design, "above_noise_db")["above_noise_db"]
    assert (above_noise_db[66:72] < 6.0).all()
    assert (above_noise_db[27:29] > 30.0).all()


def test_a_wave_on_the_synthetic_finger_has_the_speed_of_its_model():
    view = replace(VIEW, outputs=LINE)
    tap = ss.Design(limb="synthetic-1", inputs=(ss.track(8, ss.waveforms.Tap()),))
    line_wave = ss.evaluate(tap, "line_wave", view=view)["line_wave"]
    # 10 to 14 m/s between 30 and 300 Hz, after the model's own formula.
    assert 7.0 < line_wave.wave.speed_m_per_s < 18.0
    assert line_wave.wave.attenuation_db_per_cm > 0.2
    assert line_wave.outputs == LINE


def test_a_line_leaves_out_what_is_not_on_the_map():
    view = replace(VIEW, outputs=(20, 61, 24))
    line_wave = ss.evaluate(DESIGN, "line_wave", view=view)["line_wave"]
    assert line_wave.outputs == (20, 24)
    a, b = ss.load_limb("synthetic-1").output_positions_mm[[19, 23]]
    assert line_wave.wave.distance_m[1] * 1e3 == pytest.approx(np.hypot(*(a - b)))
    alone = replace(VIEW, outputs=(61, 24))
    assert ss.evaluate(DESIGN, "line_wave", view=alone)["line_wave"] is None


def test_a_long_design_has_them_all():
    long = replace(
        DESIGN,
        inputs=(ss.track(8, ss.waveforms.Tone(duration_s=60.0)), ss.track(9, TONE, onset_s=200.0)),
    )
    names = ("output_statistics", "output_spectrogram", "output_main_axes", "line_wave")
    values = ss.evaluate(long, *names, "n_fft", view=replace(VIEW, outputs=(20, 24)))
    assert values["n_fft"] is None
    assert values["output_statistics"].dominant_hz == pytest.approx([100.0, 100.0], abs=0.1)
    assert values["output_spectrogram"].time_s[-1] > 200.0
    assert values["line_wave"].wave.counted.all()


PAIRS = (
    ("axis_levels_db", "output_levels_db"),
    ("axis_surface_levels_db", "surface_levels_db"),
    ("axis_above_noise_db", "above_noise_db"),
)


def levels_of(design, view, of_axes):
    return evaluate(design, *(pair[not of_axes] for pair in PAIRS), view=view)


def same_for_each_axis(design, view, axes):
    levels = levels_of(design, view, True)
    assert len(levels["axis_levels_db"]) == len(axes)
    for k, axis in enumerate(axes):
        alone = levels_of(design, replace(view, axes=axis), False)
        for of_axes, name in PAIRS:
            if alone[name] is None:
                assert levels[of_axes][k] is None
            else:
                np.testing.assert_allclose(levels[of_axes][k], alone[name], rtol=0, atol=1e-9)
    return levels


def test_a_limb_of_a_lab_has_the_axes_it_was_measured_along_and_their_noise(user_data):
    installed(pre_trigger_delay_s=0.005)
    on_lab = Design(limb="lab-1", inputs=(track(3, Tap()), track(6, Tone(frequency_hz=300.0))))
    levels = same_for_each_axis(on_lab, View(axes="xyz", method="mag"), "xz")
    along_x, along_z = levels["axis_above_noise_db"]
    assert not np.allclose(along_x, along_z)


def test_one_axis_alone_has_one_map_and_silence_is_silent(user_data):
    installed(axes="z")
    on_lab = Design(limb="lab-1", inputs=(track(3, Tap()),))
    same_for_each_axis(on_lab, View(axes="z"), "z")
    nothing = Design(limb="synthetic-1", inputs=())
    values = same_for_each_axis(nothing, View(), "xyz")
    assert all((levels <= -200.0).all() for levels in values["axis_levels_db"])
