"""The plot of traces and spectra, without a panel."""

import numpy as np
from PySide6.QtGui import QFontMetricsF

from tests.gui.signal_plot.bench import TIME, waves


def test_curve_items_live_on_while_data_change(plot):
    plot.show_curves(waves(3), synthetic=False)
    items = list(plot.canvas.layer.items)
    plot.show_curves(waves(3, n_points=900, amplitude=2.0), synthetic=False)
    assert plot.canvas.layer.items == items
    plot.show_curves(waves(2), synthetic=False)
    assert plot.canvas.layer.items == items[:2]


def test_labels_lie_inside_the_canvas_and_do_not_touch(plot):
    metrics = QFontMetricsF(plot.canvas.font())
    for amplitude in (1e-7, 0.05, 123456.0):
        plot.show_curves(waves(4, amplitude=amplitude), synthetic=True)
        for stacked in (False, True):
            plot.set_view(TIME, None, stacked=stacked)
            frame = plot.canvas.frame
            widest = max(metrics.horizontalAdvance(mark.text) for mark in frame.y_marks)
            assert widest * 0.9 <= frame.plot[0]
            labelled = sorted(mark.at for mark in frame.y_marks if mark.text)
            assert np.all(np.diff(labelled) >= 0.7 * metrics.height())


def test_stacked_rows_have_equal_heights_and_one_scale(plot):
    plot.resize(500, 500)
    plot.show_curves(waves(4), synthetic=False)
    plot.set_view(TIME, None, stacked=True)
    frame = plot.canvas.frame
    edges = [frame.plot[1], *frame.row_edges, frame.plot[1] + frame.plot[3]]
    assert np.ptp(np.diff(edges)) < 1e-6
    assert [mark.text for mark in frame.row_numbers] == ["1", "2", "3", "4"]
    labels = [mark.text for mark in frame.y_marks]
    assert labels == labels[: len(labels) // 4] * 4


def test_more_than_twelve_rows_are_counted_instead_of_drawn(plot):
    plot.show_curves(waves(15), synthetic=False)
    plot.set_view(TIME, None, stacked=True)
    assert plot.canvas.rows.count == 12
    assert plot.canvas.frame.mark == "+3 more"
    assert [item.isVisible() for item in plot.canvas.layer.items] == [True] * 12 + [False] * 3
    plot.set_view(TIME, None, stacked=False)
    assert all(item.isVisible() for item in plot.canvas.layer.items)


def test_thin_rows_say_their_range_in_words(plot):
    plot.show_curves(waves(12), synthetic=False)
    plot.set_view(TIME, None, stacked=True)
    assert plot.canvas.frame.unit == "m/s², each row ±0.32"
