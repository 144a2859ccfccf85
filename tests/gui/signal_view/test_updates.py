"""The plot of traces and spectra, without a panel."""

import numpy as np
from PySide6.QtCore import QRectF

from skinsource_gui.plots.curves import Curves
from skinsource_gui.qt.theme import DARK, LIGHT
from tests.gui.signal_view.bench import TIME, header_of, waves


def test_ranges_do_not_change_while_data_change_a_little(signals):
    signals.show_curves(waves(2, amplitude=0.3), synthetic=False)
    before = signals.plot.places
    for amplitude in (0.31, 0.25, 0.2, 0.31):
        signals.show_curves(waves(2, amplitude=amplitude), synthetic=False)
        assert signals.plot.places is before


def test_an_edit_that_keeps_times_and_zoom_finds_no_columns_anew(signals):
    signals.show_curves(waves(2, n_points=6000), synthetic=False)
    n_made = signals.plot.columns.made
    for amplitude in (0.1, 0.2, 5.0):
        signals.show_curves(waves(3, n_points=6000, amplitude=amplitude), synthetic=False)
    assert signals.plot.columns.made == n_made
    signals.set_view(TIME, (0.1, 4.0), stacked=False)
    signals.show_curves(waves(2, n_points=6001), synthetic=False)
    assert signals.plot.columns.made == n_made + 2


def test_values_that_are_not_finite_empty_the_picture(signals):
    curves = waves(1)
    curves.y[0, 3] = np.nan
    signals.show_curves(curves, synthetic=False)
    assert signals.plot.curves is None
    assert "not finite" in signals.plot.message


def test_late_results_are_marked_and_quick_ones_are_not(signals, qtbot):
    signals.show_curves(waves(2), synthetic=False)
    signals.set_stale(True)
    assert header_of(signals).mark == ""
    signals.show_curves(waves(2), synthetic=False)
    signals.set_stale(True)
    qtbot.waitUntil(lambda: header_of(signals).mark == "updating…")
    signals.set_stale(False)
    assert header_of(signals).mark == ""


def test_each_theme_has_its_own_background_and_colours(signals, use_theme):
    signals.show_curves(waves(2), synthetic=False)
    for theme in (LIGHT, DARK):
        use_theme(theme)
        picture = signals.plot.grab().toImage()
        assert picture.pixelColor(1, picture.height() // 2).name() == theme.base
        colours = {picture.pixelColor(x, y).name() for x in range(420) for y in range(150)}
        assert set(theme.outputs[:2]) <= colours


def test_what_is_drawn_follows_the_data(signals):
    signals.show_curves(waves(1), synthetic=False)
    before = signals.plot.grab().toImage()
    curves = waves(1)
    signals.show_curves(Curves(x=curves.x, y=-curves.y, names=curves.names), synthetic=False)
    assert signals.plot.grab().toImage() != before
    signals.show_curves(curves, synthetic=False)
    assert signals.plot.grab().toImage() == before


def test_a_narrow_legend_leaves_out_words_but_its_tooltip_has_them_all(signals):
    signals.show_curves(waves(9), synthetic=False)
    signals.plot.crosshair.put(10)
    lines = signals.legend.text.lines().splitlines()
    assert len(lines) == 10
    assert lines[1].startswith("1  Digit V, beside the nail, ulnar: ")
    assert all(line.endswith("m/s²") for line in lines[1:])


def test_a_message_is_in_the_middle_of_the_size_that_the_plot_got_while_there_were_curves(signals):
    signals.show_curves(waves(2), synthetic=False)
    signals.resize(signals.width() + 200, signals.height() + 150)
    plot = signals.plot
    signals.show_message("Select outputs on the skin map")
    away = plot.stack.message.geometry().center() - QRectF(plot.rect()).center()
    assert away.manhattanLength() < 2.0
