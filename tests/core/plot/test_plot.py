"""Drawings with matplotlib: they show what was computed, and need no window."""

import re
import sys
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

import skinsource as ss
from skinsource.actuators.equalising import RegularisedInverse
from skinsource.base.errors import InvalidInputError, MissingExtraError
from skinsource.base.extras import extra_line
from skinsource.export.plot import common_range, draw_map, levels_of
from skinsource.signals.resampling import FINER
from tests.core.own_limbs.lab_bench import N_TAPS, installed

DESIGN = ss.Design(
    limb="synthetic-1",
    inputs=(ss.track(7, ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.1)),),
    scaling="upstream",
)
MAG = ss.View(method="mag")


def image_of(figure):
    return figure.axes[0].images[0]


def test_a_map_of_a_design_shows_its_levels_in_the_range_of_the_studio():
    levels = ss.evaluate(DESIGN, "output_levels_db", view=MAG)["output_levels_db"]
    figure = ss.plot.map(DESIGN, view=MAG)
    low, high = image_of(figure).get_clim()
    assert high == np.ceil(levels.max() / 5) * 5
    assert low == high - 50
    surface = ss.surface_operator(ss.load_limb("synthetic-1"))
    shown = image_of(figure).get_array()
    inside = surface.interpolate(levels)
    np.testing.assert_array_equal(shown[surface.mask], inside[surface.mask])
    assert np.isfinite(shown).all()


def test_a_map_of_a_design_says_whose_levels_along_what_and_over_what_time():
    (note,) = ss.plot.map(DESIGN, view=replace(MAG, span="loudest")).texts
    told = "Synthetic 1 (175 mm); x, y, z, magnitude\nRMS over the loudest 100 ms\n"
    assert note.get_text().startswith(told)
    (note,) = ss.plot.map(np.zeros(72), limb="synthetic-1").texts
    assert "RMS" not in note.get_text()


def test_a_map_lies_where_the_outline_is_and_marks_inputs_and_outputs():
    limb = ss.load_limb("synthetic-1")
    figure = ss.plot.map(DESIGN, view=MAG, outputs=(19, 61))
    ax = figure.axes[0]
    scale = limb.hand_length_mm / limb.map.hand_length_px
    np.testing.assert_allclose(ax.patches[0].get_xy()[:-1], limb.map.outline * scale)
    marked = [(line.get_xdata()[0], line.get_ydata()[0]) for line in ax.lines]
    assert any(np.allclose(point, limb.input_positions_mm[6]) for point in marked)
    assert any(np.allclose(point, limb.output_positions_mm[18]) for point in marked)
    texts = [text.get_text() for text in (*ax.texts, *figure.texts)]
    assert "19" in texts
    assert "61" not in texts  # it has no place on the back
    assert "50 mm" in texts
    assert any("SYNTHETIC" in text for text in texts)


@pytest.mark.parametrize("n_rows", [1, 2, 9])
def test_what_a_limb_is_stands_below_the_label_of_the_axis(n_rows):
    figure = ss.plot.traces(DESIGN, outputs=range(1, n_rows + 1))
    renderer = FigureCanvasAgg(figure).get_renderer()
    figure.draw(renderer)
    (note,), label = figure.texts, figure.axes[0].xaxis.label
    assert "SYNTHETIC" in note.get_text()
    assert note.get_window_extent(renderer).y1 < label.get_window_extent(renderer).y0


def test_traces_are_the_projected_acceleration_over_time():
    view = replace(MAG, outputs=(19, 30), time_range_s=(0.05, 0.1))
    figure = ss.plot.traces(DESIGN, view=view)
    values = ss.evaluate(DESIGN, "selected_traces", "response_time_s", view=view)
    time_s, traces = values["response_time_s"], values["selected_traces"]
    within = (time_s >= 0.05) & (time_s <= 0.1)
    lines = [line for line in figure.axes[0].lines if line.get_xdata().__len__() > 2]
    bases = figure.axes[0].get_yticks()
    heights = np.stack([line.get_ydata() for line in lines]) - bases[:, None]
    # The highest point of all fills its row, a little above the highest sample.
    assert np.abs(heights).max() == pytest.approx(1.0)
    size = np.abs(traces[:, within]).max() / np.abs(heights[:, ::FINER]).max()
    assert size >= np.abs(traces[:, within]).max()
    np.testing.assert_allclose(heights[:, ::FINER], traces[:, within] / size, atol=1e-9)
    for line in lines:
        np.testing.assert_allclose(line.get_xdata()[::FINER], 1e3 * time_s[within])
    labels = [tick_label.get_text() for tick_label in figure.axes[0].get_yticklabels()]
    assert labels == ["Output 19", "Output 30"]


def test_designs_with_and_without_actuators_are_drawn_at_the_same_times():
    coil = ss.ActuatorAt(model=ss.actuators.load("example-voice-coil"))
    actuation = ss.Actuation(actuators=(coil,), equaliser=RegularisedInverse())
    plain_design = replace(DESIGN, scaling="probe")
    equalised = replace(plain_design, actuation=actuation)
    figure = ss.plot.traces([plain_design, equalised], outputs=(30,))
    plain, through = (line.get_ydata() for line in figure.axes[0].get_lines()[-2:])
    assert np.corrcoef(plain, through)[0, 1] > 0.99


def test_limbs_that_were_not_sampled_at_the_same_times_are_not_drawn_over_each_other(user_data):
    installed(sample_rate_hz=1300.0)
    pair, shifted = [DESIGN, replace(DESIGN, limb="lab-1")], ss.View(axes="z", delay_removed=True)
    assert ss.plot.traces(pair, view=replace(shifted, delay_removed=False), outputs=(30,))
    with pytest.raises(InvalidInputError, match="pre-trigger delay, so their samples lie at other"):
        ss.plot.traces(pair, view=shifted, outputs=(30,))
    installed(sample_rate_hz=1000.0)
    with pytest.raises(InvalidInputError, match="differ in sample rate"):
        ss.plot.traces(pair, view=ss.View(axes="z"), outputs=(30,))


def test_spectra_of_as_many_frequencies_that_are_others_are_not_drawn_over_each_other(user_data):
    installed(sample_rate_hz=1000.0)
    # As long in samples as on the other limb, so not in seconds.
    published, tone = ss.load_limb("synthetic-1"), ss.waveforms.Tone(frequency_hz=100.0)
    lengths_s = 1.0, (1300 + published.n_taps - N_TAPS) / 1000.0
    pair = [
        ss.Design(limb=limb, inputs=(ss.track(7, replace(tone, duration_s=length_s)),))
        for limb, length_s in zip(("synthetic-1", "lab-1"), lengths_s, strict=True)
    ]
    view = ss.View(axes="z", outputs=(30,))
    bins = [ss.result(each, "selected_spectra", view=view).values.shape[-1] for each in pair]
    assert bins[0] == bins[1]
    with pytest.raises(InvalidInputError, match="differ in length or sample rate"):
        ss.plot.spectra(pair, view=view)


def test_several_designs_lie_over_each_other_with_a_legend():
    louder = DESIGN.with_input(0, amplitude=2.0)
    figure = ss.plot.traces([DESIGN, louder], outputs=(30,), labels=["soft", "loud"])
    ax = figure.axes[0]
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["soft", "loud"]
    soft, loud = (line.get_ydata() for line in ax.lines if line.get_xdata().__len__() > 2)
    np.testing.assert_allclose(loud, 2 * soft, atol=1e-12)


def test_spectra_span_the_measured_band_and_peak_where_the_tone_is():
    figure = ss.plot.spectra(DESIGN, outputs=(30,))
    (line,) = [line for line in figure.axes[0].lines if line.get_xdata().__len__() > 2]
    assert line.get_xdata().min() >= 25.0
    assert line.get_xdata().max() <= 600.0
    assert line.get_xdata()[np.argmax(line.get_ydata())] == pytest.approx(100.0, abs=5.0)


@pytest.mark.parametrize(
    ("span", "quantity", "over"),
    [
        ("record", "selected_spectra", "whole record"),
        ("loudest", "selected_peak_spectra", "loudest 250 ms of each frequency"),
    ],
)
def test_spectra_are_those_of_the_span_and_say_it(span, quantity, over):
    view = ss.View(axes="z", span=span, outputs=(30,))
    frequency_hz, magnitude = ss.evaluate(DESIGN, quantity, view=view)[quantity]
    within = (frequency_hz >= 25.0) & (frequency_hz <= 600.0)
    ax = ss.plot.spectra(DESIGN, view=view).axes[0]
    heights = ax.lines[-1].get_ydata()
    np.testing.assert_allclose(heights, magnitude[0, within] / magnitude[0, within].max())
    assert ax.texts[0].get_text().endswith(f"m/s² high; {over}")


def test_a_strip_has_a_map_for_each_window_in_one_scale_and_the_extent():
    inputs = (ss.track(7, ss.waveforms.WaveletTrain()),)
    train = ss.Design(limb="synthetic-4", inputs=inputs, scaling="relative")
    figure = ss.plot.strip(train, window_s=0.12)
    maps = [axes for axes in figure.axes if axes.images]
    assert len(maps) == 5
    assert len({axes.images[0].get_clim() for axes in maps}) == 1
    assert [axes.get_title() for axes in maps][::4] == ["0 to 120 ms", "480 to 600 ms"]
    (mean, _) = (line for ax in figure.axes if ax.get_legend() for line in ax.lines)
    field = ss.predict(
        ss.load_limb("synthetic-4"), train.clips[0].waveform.samples(1300.0), 7, scaling="upstream"
    )
    length = np.sqrt(np.sum(field**2, axis=1))
    windows = ss.windowed_rms(length, 156, first_sample=67)[:5]
    limb = ss.load_limb("synthetic-4")
    expected = [ss.extent(window, limb, 7).mean_distance_mm for window in windows]
    np.testing.assert_allclose(mean.get_ydata(), expected, rtol=1e-6)


def test_a_figure_shows_itself_in_a_notebook_and_keeps_its_words_in_svg(tmp_path):
    figure = ss.plot.traces(DESIGN, outputs=(30,), title="Only words")
    assert figure._repr_png_().startswith(b"\x89PNG")
    path = tmp_path / "traces.svg"
    figure.savefig(path)
    assert ">Only words</text>" in path.read_text("utf-8")


def test_silence_is_drawn_too():
    silent = ss.Design(limb="synthetic-1")
    assert image_of(ss.plot.map(silent)).get_clim() == (-50.0, 0.0)
    ss.plot.traces(silent, outputs=(3,))
    assert common_range(np.full(72, -200.0)) == (-50.0, 0.0)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: ss.plot.map(np.zeros(72)), "need their limb"),
        (lambda: ss.plot.map(np.zeros(71), limb="synthetic-1"), "shape"),
        (lambda: ss.plot.map(np.zeros(72), limb=3), "expected a Limb"),
        (lambda: ss.plot.traces([]), "expected a Design"),
        (lambda: ss.plot.traces(DESIGN, outputs=()), "no output is selected"),
        (lambda: ss.plot.traces(DESIGN, labels=("a", "b")), "2 labels, expected 1"),
        (lambda: ss.plot.traces(DESIGN, outputs=(99,)), "99"),
        (
            lambda: ss.plot.traces(DESIGN, view=replace(MAG, time_range_s=(5.0, 6.0))),
            "time_range_s",
        ),
        (lambda: ss.plot.strip(DESIGN, count=2, window_s=0.1), "expected one of them"),
        (lambda: ss.plot.strip(DESIGN, window_s=2.0), "no whole window"),
        (lambda: ss.plot.strip("2H"), "expected Design"),
    ],
)
def test_what_cannot_be_drawn_is_refused_in_words(call, message):
    with pytest.raises(InvalidInputError, match=message):
        call()


def test_without_matplotlib_the_extra_is_named(monkeypatch):
    loaded = [module for module in sys.modules if module.partition(".")[0] == "matplotlib"]
    for name in {"matplotlib", *loaded}:
        monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(MissingExtraError, match=re.escape(extra_line("plot"))):
        ss.plot.map(DESIGN)


def test_what_is_mostly_noise_is_hatched_within_the_outline_on_axes_that_are_drawn_on_too():
    ax = Figure().add_subplot()
    ax.add_patch(Rectangle((0, 0), 1, 1))
    limb = ss.load_limb("synthetic-1")
    levels = levels_of(np.zeros(72), limb, None)
    draw_map(ax, replace(levels, noisy=(30, 61)), (-50.0, 0.0))
    (hatched,) = (patch for patch in ax.patches if patch.get_hatch())
    outline = ax.patches[1]
    clip, to_screen = hatched.get_transformed_clip_path_and_affine()
    expected_outline = outline.get_transform().transform(outline.get_path().vertices)
    np.testing.assert_allclose(to_screen.transform(clip.vertices), expected_outline)
    # One disc: output 61 has no place on the back.
    middle = hatched.get_path().get_extents().get_points().mean(axis=0)
    np.testing.assert_allclose(middle, limb.output_positions_mm[29])


# A quarter of the rate of 1300 Hz: where the phase is 45°, all samples miss its peaks by 3 dB.
HZ = 325.0
# Outputs where the phase is such.
MISSED = (23, 35)
LONG = ss.Design(
    limb="synthetic-1",
    inputs=(ss.track(7, ss.waveforms.Tone(frequency_hz=HZ, duration_s=20.0)),),
    scaling="relative",
)
VIEW = ss.View(axes="z", outputs=MISSED)


def drawn(design, view=VIEW):
    """Each row as (times, values in parts of its own peak)."""
    ax = ss.plot.traces(design, view=view, normalised=True).axes[0]
    lines = [line for line in ax.lines if len(line.get_xdata()) > 2]
    bases = [-2.3 * rank for rank in range(len(lines))]
    return [
        (np.asarray(x.get_xdata()), x.get_ydata() - b) for x, b in zip(lines, bases, strict=True)
    ]


def test_columns_of_a_long_tone_reach_its_amplitude_where_samples_miss_it():
    for time_ms, values in drawn(LONG):
        inside = (time_ms > 5e3) & (time_ms < 15e3)
        low, high = values[inside][::2], values[inside][1::2]
        peak = np.abs(values).max()
        assert peak == pytest.approx(1.0)
        # Steady: all columns reach alike, on both sides.
        np.testing.assert_allclose(high, high.mean(), rtol=0.02)
        np.testing.assert_allclose(low, -high.mean(), rtol=0.02)


def test_a_range_of_times_of_a_long_design_is_drawn_alone():
    shown = replace(VIEW, time_range_s=(2.0, 18.5))
    for time_ms, _ in drawn(LONG, shown):
        assert time_ms[0] == pytest.approx(2000.0, abs=1.0)
        assert time_ms[-1] == pytest.approx(18500.0, abs=5.0)
