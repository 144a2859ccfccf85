"""What the diagrams of linearity show, of responses that are bent as well."""

import numpy as np
import pytest

from skinsource.studies.checking import proportion, superposition
from skinsource_gui.panels.analysis.linearity import table_text
from skinsource_gui.panels.analysis.linearity_diagram import (
    diagrams_of_proportion,
    diagrams_of_superposition,
    of_amplitudes,
    part_of,
    proportion_text,
)

RATE_HZ = 1300.0


TIME_S = np.arange(4000) / RATE_HZ


STRENGTHS = np.array([1.0, 2.0, 4.0])


ROWS = (1, 3)


def responses(n_times=4000):
    return np.random.default_rng(5).normal(size=(4, n_times))


def bent():
    saturated = np.tanh(STRENGTHS[:, None, None] * responses())
    return proportion(STRENGTHS, saturated, RATE_HZ, None)


def test_without_a_zoom_the_part_around_the_loudest_instant_is_drawn():
    curves = responses()
    curves[2, 3000] = 50.0
    first, end = part_of(TIME_S, curves, None)
    assert (TIME_S[first], TIME_S[end]) == pytest.approx((3000 / RATE_HZ - 0.015,) * 2, abs=0.04)
    assert first < 3000 < end
    assert TIME_S[end] - TIME_S[first] == pytest.approx(0.03, abs=2 / RATE_HZ)


@pytest.mark.parametrize("zoom", [(-1.0, 100.0), (0.5, 3.0), (0.0, 3.07)])
def test_a_long_part_is_drawn_from_its_begin_on_as_far_as_lines_are_quick(zoom):
    first, end = part_of(TIME_S, responses(), zoom)
    assert TIME_S[first] == pytest.approx(max(zoom[0], 0.0), abs=1 / RATE_HZ)
    assert end - first == 1500


@pytest.mark.parametrize("zoom", [(-2.0, -1.0), (90.0, 91.0), (1.0, 1.0)])
def test_of_a_part_in_which_there_is_nothing_two_samples_are_drawn(zoom):
    first, end = part_of(TIME_S, responses(), zoom)
    assert first >= 0
    assert end - first == 2
    assert end <= TIME_S.size


def test_each_strength_is_seen_below_the_next_one_and_in_the_colour_of_its_output():
    over = diagrams_of_proportion(bent(), ROWS, TIME_S, (0.1, 0.2), of_amplitudes("m/s²"))[0].curves
    assert [curve.rank for curve in over] == [0, 0, 0, 1, 1, 1]
    for curves in (over[:3], over[3:]):
        widths, pale = ([getattr(curve, name) for curve in curves] for name in ("width_px", "pale"))
        assert widths == sorted(widths, reverse=True)
        assert pale == sorted(pale, reverse=True)
        assert (pale[0] > 0.5, pale[-1]) == (True, 0.0)
    # Each is what it is, divided by its strength.
    at = np.searchsorted(over[0].x, 0.15)
    sample = np.argmin(np.abs(TIME_S - over[0].x[at]))
    assert TIME_S[sample] == pytest.approx(over[0].x[at], abs=1 / RATE_HZ)
    divided = bent().divided[:, 3, sample - 1 : sample + 2]
    for curve, around in zip(over[3:], divided, strict=True):
        assert around.min() - 0.5 < curve.y[at] < around.max() + 0.5


def test_dots_stand_at_what_was_found_and_lines_at_what_would_be_straight():
    fits = bent()
    growth, straight = diagrams_of_proportion(fits, ROWS, TIME_S, None, of_amplitudes("V"))[1:]
    assert growth.x.title == "Strength (V)"
    for rank, row in enumerate(ROWS):
        line, dots = growth.curves[2 * rank : 2 * rank + 2]
        np.testing.assert_array_equal(line.y, fits.line[:, row])
        np.testing.assert_array_equal(dots.y, fits.rms[:, row])
        assert (line.width_px > 0.0, dots.width_px) == (True, 0.0)
        np.testing.assert_array_equal(straight.curves[rank].y, fits.adjusted_r2[row])
    assert growth.y.shown[1] >= fits.rms[:, ROWS].max()
    assert growth.x.shown[1] >= STRENGTHS[-1]
    assert straight.x.shown[1] >= fits.frequency_hz[-1]


def test_a_response_without_a_frequency_in_its_band_has_no_straightness_to_tell():
    short = STRENGTHS[:, None, None] * responses(30)
    fits = proportion(STRENGTHS, short, RATE_HZ, (3.0, 5.0))
    assert "R²" not in proportion_text(fits)
    *_, straight = diagrams_of_proportion(fits, ROWS, TIME_S[:30], None, of_amplitudes("×"))
    assert straight.x.shown[1] > 0.0
    least = np.nanmin(bent().adjusted_r2)
    assert f"R² in bands of 2 Hz ≥ {least:.6f}" in proportion_text(bent())


def test_the_sum_is_wide_below_the_joint_response_and_they_are_held_against_each_other():
    parts = responses(), 0.5 * responses()[::-1]
    joint = np.tanh(sum(parts))
    fits = superposition(parts, joint)
    over, against = diagrams_of_superposition(fits, ROWS, TIME_S, (0.1, 0.2))
    first, end = part_of(TIME_S, joint, (0.1, 0.2))
    for rank, row in enumerate(ROWS):
        wide, thin = over.curves[2 * rank : 2 * rank + 2]
        assert wide.width_px > thin.width_px
        assert np.abs(wide.y).max() > 1.0 > np.abs(thin.y).max() - 0.5
        assert np.corrcoef(wide.y, thin.y)[0, 1] < 0.99
        dots = against.curves[rank]
        np.testing.assert_array_equal(dots.x, fits.separate[row, first:end])
        np.testing.assert_array_equal(dots.y, joint[row, first:end])
    assert against.x.title.startswith("Sum")
    assert against.y.title.startswith("Joint")


def test_bands_are_copied_by_strength_output_and_axis():
    fits = bent()
    text = table_text(fits, (20, 26), ("x", "z"), of_amplitudes("m/s²"), bands=True)
    head, *rows = (line.split("\t") for line in text.splitlines())
    columns = dict(zip(head, np.array(rows, float).T, strict=True))
    np.testing.assert_allclose(columns["frequency_hz"], fits.frequency_hz)
    for level, strength in enumerate(STRENGTHS):
        column = columns[f"band_rms_26_z_m_per_s2 at strength {strength:g}"]
        np.testing.assert_allclose(column, fits.band_rms[level, 3])
    np.testing.assert_allclose(columns["adjusted_r2_20_z"], fits.adjusted_r2[1])
