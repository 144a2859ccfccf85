"""The plot of traces and spectra, without a panel."""

import numpy as np

from skinsource_gui.theme import DARK, LIGHT
from skinsource_gui.widgets.plot.curves import Curves
from tests.gui.signal_plot.bench import waves


def test_ranges_do_not_change_while_data_change_a_little(plot):
    plot.show_curves(waves(2, amplitude=0.3), synthetic=False)
    before = plot.canvas.frame
    for amplitude in (0.31, 0.25, 0.2, 0.31):
        plot.show_curves(waves(2, amplitude=amplitude), synthetic=False)
        assert plot.canvas.frame is before


def test_values_that_are_not_finite_empty_the_picture(plot):
    curves = waves(1)
    curves.y[0, 3] = np.nan
    plot.show_curves(curves, synthetic=False)
    assert plot.canvas.curves is None
    assert "not finite" in plot.canvas.message


def test_late_results_are_marked_and_quick_ones_are_not(plot, qtbot):
    plot.show_curves(waves(2), synthetic=False)
    plot.set_stale(True)
    assert plot.canvas.frame.mark == ""
    plot.show_curves(waves(2), synthetic=False)
    plot.set_stale(True)
    qtbot.waitUntil(lambda: plot.canvas.frame.mark == "updating…")
    plot.set_stale(False)
    assert plot.canvas.frame.mark == ""


def test_each_theme_has_its_own_background_and_colours(plot):
    plot.show_curves(waves(2), synthetic=False)
    for theme in (LIGHT, DARK):
        plot.set_theme(theme)
        picture = plot.canvas.grab().toImage()
        assert picture.pixelColor(1, picture.height() // 2).name() == theme.base
        seen = {picture.pixelColor(x, y).name() for x in range(420) for y in range(150)}
        assert set(theme.outputs[:2]) <= seen


def test_what_is_drawn_follows_the_data(plot):
    plot.show_curves(waves(1), synthetic=False)
    before = plot.canvas.grab().toImage()
    curves = waves(1)
    plot.show_curves(Curves(x=curves.x, y=-curves.y, names=curves.names), synthetic=False)
    assert plot.canvas.grab().toImage() != before
    plot.show_curves(curves, synthetic=False)
    assert plot.canvas.grab().toImage() == before


def test_a_narrow_legend_leaves_out_words_but_its_tooltip_has_them_all(plot):
    plot.show_curves(waves(9), synthetic=False)
    plot.canvas.set_cursor(10)
    lines = plot.legend.text.lines().splitlines()
    assert len(lines) == 10
    assert lines[1].startswith("1  Digit V, beside the nail, ulnar: ")
    assert all(line.endswith("m/s²") for line in lines[1:])
