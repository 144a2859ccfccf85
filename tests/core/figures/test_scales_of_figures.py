"""What the numbers of figures are relative to, smoothed over, and cut to."""

import numpy as np

import skinsource as ss
from skinsource.engine import evaluation
from skinsource.studies.figures.writing import draw_figure
from tests.core.own_limbs.lab_bench import keep


def table_of(name):
    opened = ss.scenes.open_scene(name, available=())
    return opened, draw_figure(opened).tables[""]


def test_maps_of_axes_are_relative_to_the_loudest_of_all_of_them():
    _, columns = table_of("1E")
    loudest = sorted(levels.max() for name, levels in columns.items() if name != "output")
    assert loudest[-1] == 0.0
    assert loudest[0] < -0.1


def test_maps_of_places_are_relative_to_the_loudest_of_each():
    _, columns = table_of("1F")
    assert [levels.max() for name, levels in columns.items() if name != "output"] == [0.0] * 3


def test_an_output_that_is_silent_has_no_level_in_the_table_of_a_figure(user_data):
    responses = np.random.default_rng(2).normal(size=(7, 5, 3, 60))
    responses[:, 1] = 0.0
    keep("deaf", responses)
    # What an earlier test evaluated was read from a folder that is gone.
    evaluation._evaluator.cache_clear()
    for name in ("1F", "2B"):
        table = draw_figure(ss.scenes.open_scene(name, limb="deaf")).tables[""]
        levels = np.column_stack(list(table.values()))[:, 1:]
        assert np.isnan(levels[1]).all()
        assert np.isfinite(np.delete(levels, 1, axis=0)).all()


def test_spectra_of_noise_are_means_over_ten_bins():
    opened, columns = table_of("2D")
    raw_hz, raw = ss.evaluate(opened.design, "selected_spectra", view=opened.view)[
        "selected_spectra"
    ]
    smooth = columns["output_1_x_m_per_s2"]
    at = int(np.searchsorted(raw_hz, columns["frequency_hz"][200]))
    means = [raw[0, at + shift - 5 : at + shift + 5].mean() for shift in (0, 1)]
    assert np.isclose(smooth[200], means, rtol=1e-9).any()
