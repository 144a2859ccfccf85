"""What the view of signals draws, near and far, and what a legend has room for."""

from dataclasses import replace
from functools import partial
from itertools import pairwise

import numpy as np
import pytest
from PySide6.QtCore import QPointF, QSize, QSizeF
from PySide6.QtGui import QColor, QFont, QFontMetrics, QFontMetricsF

from skinsource.signals.resampling import EXTREMES_ERROR, FINER
from skinsource_gui.plots.curves import Curves, output_names
from skinsource_gui.plots.legend import LegendLayout, LegendText
from skinsource_gui.plots.pictures import save_drawing
from skinsource_gui.plots.preview import ClipPictures, ClipStyle
from skinsource_gui.plots.ranges import wave_of
from skinsource_gui.plots.signal_view import copy_of, draw_signals
from skinsource_gui.qt.theme import LIGHT, UNIT_PX
from tests.gui.signal_view.bench import TIME, drawn, header_of, waves


def test_a_curve_is_drawn_at_the_heights_of_its_values(signals):
    curves = waves(1)
    signals.show_curves(waves(3), synthetic=False)
    assert [curve.points.x.size for curve in drawn(signals)] == [651] * 3
    signals.show_curves(curves, synthetic=False)
    visible = [curve.isVisible() for curve in signals.plot.stack.rows[0].curves]
    assert visible == [True, False, False]
    low, high = signals.plot.value_scale.values
    area, view = signals.plot.places.area, signals.plot.stack.rows[0].view
    curve = drawn(signals)[0]
    for k in (0, 7, 400):
        part = (curves.y[0, k] - low) / (high - low)
        at = view.mapViewToScene(QPointF(curve.points.x[k], curve.points.y[k]))
        assert abs(at.y() - (area.bottom() - part * area.height())) < 1e-9
        assert abs(at.x() - (area.left() + k / 650 * area.width())) < 1e-9


def test_stacked_rows_have_equal_heights_and_one_scale(signals):
    signals.resize(500, 500)
    signals.show_curves(waves(4), synthetic=False)
    signals.plot.set_view(TIME, None, stacked=True)
    rows = signals.plot.stack.rows
    geometries = [row.view.geometry() for row in rows]
    assert np.ptp([geometry.height() for geometry in geometries]) < 1e-6
    for above, below in pairwise(geometries):
        assert above.bottom() == pytest.approx(below.top())
    assert [row.number.text for row in rows] == ["1", "2", "3", "4"]
    assert [row.view.viewRange() for row in rows] == [rows[0].view.viewRange()] * 4
    labels = [[text for _, text in row.axis.ticks()] for row in rows]
    assert labels == [labels[0]] * 4
    assert any(labels[0])


def test_more_than_twelve_rows_are_counted_instead_of_drawn(signals):
    signals.show_curves(waves(15), synthetic=False)
    signals.plot.set_view(TIME, None, stacked=True)
    assert len(signals.plot.stack.rows) == 12
    assert header_of(signals).mark == "+3 more"
    assert len(drawn(signals)) == 12
    signals.plot.set_view(TIME, None, stacked=False)
    assert len(drawn(signals)) == 15


def test_a_block_of_strokes_has_no_gaps(signals):
    x = np.arange(26_000) / 1300
    y = np.sin(2 * np.pi * 100 * x + 0.3)[np.newaxis]
    signals.show_curves(Curves(x=x, y=y, names=waves(1).names), synthetic=False)
    picture, area = signals.plot.grab().toImage(), signals.plot.places.area
    middle = area.center().y()
    for row in (int(middle - 0.3 * area.height()), int(middle + 0.3 * area.height())):
        columns = range(int(area.left()) + 2, int(area.right()) - 2)
        assert {picture.pixelColor(column, row).name() for column in columns} == {LIGHT.outputs[0]}


def test_stale_curves_are_pale(signals, qtbot):
    signals.show_curves(waves(2), synthetic=False)
    assert [curve.opacity() for curve in drawn(signals)] == [1.0, 1.0]
    signals._staleness.set_stale(True)
    qtbot.waitUntil(lambda: [curve.opacity() for curve in drawn(signals)] == [0.5, 0.5])
    signals.show_curves(waves(2), synthetic=False)
    assert [curve.opacity() for curve in drawn(signals)] == [1.0, 1.0]


@pytest.mark.parametrize("size", [(160, 90), (300, 140)])
@pytest.mark.parametrize("zoom", [None, (0.051, 0.1266)])
def test_both_axes_have_two_labels_at_least_however_small_the_plot(signals, size, zoom):
    plot = signals.plot
    plot.resize(*size)
    for amplitude in (0.09, 0.11, 0.3, 0.47, 0.63, 7.7):
        plot.reset_range()
        plot.show_curves(waves(amplitude=amplitude))
        plot.set_view(TIME, zoom, stacked=False)
        line = plot.stack.rows[0].axis
        metrics = QFontMetricsF(plot.text_font)
        heights = sorted(at for at, text in line.ticks() if text)
        assert len(heights) >= 2
        assert min(np.diff(heights)) >= 0.95 * metrics.height()
        assert len(plot.stack.x_axis.labels()) >= 2


RATE_HZ = 1300.0


CLOSE = (0.4, 0.43)


def tone(at_s, frequency_hz=400.0, phase=0.3):
    return np.sin(2 * np.pi * frequency_hz * at_s + phase)


#: Four samples a period, none of them at a peak.
MISSED = partial(tone, frequency_hz=325.0, phase=np.pi / 4)


def sampled(signal=tone, n_points=1300, n_curves=2):
    """Samples of a tone and of half of it."""
    x = np.arange(n_points) / RATE_HZ
    y = np.outer(1.0 / (1 + np.arange(n_curves)), signal(x))
    names = output_names(tuple(range(1, n_curves + 1)), "synthetic-1")
    return Curves(x=x, y=y, names=names, wave=wave_of(x, y))


def values(signals, heights):
    scale = signals.plot.value_scale
    low, high = scale.values
    return low + (np.asarray(heights) - scale.edge) / (1 - 2 * scale.edge) * (high - low)


@pytest.mark.parametrize("stacked", [False, True])
def test_zoomed_in_it_draws_the_tone_itself_through_every_sample(signals, stacked):
    curves = sampled()
    signals.show_curves(curves, synthetic=False)
    signals.plot.set_view(TIME, CLOSE, stacked=stacked)
    for rank, curve in enumerate(drawn(signals)):
        at_s, levels = curve.points.x, values(signals, curve.points.y)
        assert at_s[0] <= CLOSE[0] <= CLOSE[1] <= at_s[-1]
        np.testing.assert_allclose(levels, tone(at_s) / (1 + rank), rtol=0, atol=1e-4)
        first = round(at_s[0] * RATE_HZ)
        samples = curves.y[rank, first : first + at_s[::FINER].size]
        np.testing.assert_allclose(levels[::FINER], samples, rtol=0, atol=1e-12)
    # Straight lines would miss much of it.
    assert np.abs(np.interp(at_s, curves.x, curves.y[0]) - tone(at_s)).max() > 0.2


def test_samples_are_marked_where_eight_pixels_lie_between_them(signals):
    curves = sampled()
    signals.show_curves(curves, synthetic=False)
    width = signals.plot.places.row(0).width()
    signals.plot.set_view(TIME, (0.1, 0.1 + width / 7 / RATE_HZ), stacked=False)
    assert all(curve.dots is None for curve in drawn(signals))
    signals.plot.set_view(TIME, (0.1, 0.1 + width / 20 / RATE_HZ), stacked=False)
    for rank, curve in enumerate(drawn(signals)):
        dots = [(curve.dots.at(k).x(), curve.dots.at(k).y()) for k in range(curve.dots.count())]
        at_s, heights = np.array(dots).T
        first = round(at_s[0] * RATE_HZ)
        samples = slice(first, first + len(dots))
        np.testing.assert_allclose(at_s, curves.x[samples], atol=1e-9)
        np.testing.assert_allclose(values(signals, heights), curves.y[rank, samples], atol=1e-12)


def test_peaks_between_samples_are_in_the_range_and_readings_stay_those_of_samples(signals):
    curves = sampled(MISSED)
    assert curves.y.max() < 0.75
    signals.show_curves(curves, synthetic=False)
    whole = signals.plot.value_scale.values
    assert whole[1] >= 1.0
    signals.plot.set_view(TIME, CLOSE, stacked=False)
    assert signals.plot.value_scale.values == whole
    assert values(signals, drawn(signals)[0].points.y).max() == pytest.approx(1.0, abs=1e-3)
    signals.plot.crosshair.put(curves.nearest(0.4102))
    index = signals.plot.crosshair.index
    assert index == round(0.4102 * RATE_HZ)
    reading = float(signals.legend.text.readings[0].replace("−", "-"))
    assert reading == pytest.approx(curves.y[0, index], abs=1e-3)


def test_values_that_are_not_finite_empty_the_picture(signals):
    curves = waves(1)
    curves.y[0, 3] = np.nan
    signals.show_curves(curves, synthetic=False)
    assert signals.plot.curves is None
    assert "not finite" in signals.plot.message


def test_words_above_that_are_too_long_for_a_line_are_broken(signals, tmp_path):
    long = "made from files that are not the published ones: " + "responses.mat " * 4
    signals.show_curves(replace(waves(2), heading=("A", long)), synthetic=False)
    save_drawing(tmp_path / "a.svg", partial(draw_signals, plot=signals.plot), 250, 300)
    drawing = (tmp_path / "a.svg").read_text("utf-8").replace("\N{NO-BREAK SPACE}", " ")
    assert "published ones" in drawing
    assert long not in drawing
    assert drawing.count("responses.mat") == 4


NAMES = output_names(tuple(range(1, 41)), "synthetic-1")


@pytest.mark.parametrize("width", [60, 200, 500, 900, 4000])
@pytest.mark.parametrize("reads", [False, True])
def test_as_many_curves_are_written_as_fit_beside_how_many_do_not(qapp, width, reads):
    text = LegendText(names=NAMES, unit="m/s²", reading_room="−0.123")
    if reads:
        readings = ("0.1",) * len(NAMES)
        text = replace(text, where="12 ms", where_room="1234.5 ms", readings=readings)
    metrics = QFontMetrics(QFont())
    layout = LegendLayout(text, metrics, width)
    detail, fitting = layout.fitting()
    where = metrics.horizontalAdvance(layout.where(text.where_room, detail)) if reads else 0
    room = width - UNIT_PX - where
    entries = [layout.entry_px(rank, detail) for rank in range(len(NAMES))]
    if fitting < len(NAMES):
        room -= metrics.horizontalAdvance("+00")
        assert sum(entries[: fitting + 1]) > room
    assert fitting == 0 or sum(entries[:fitting]) <= room
    assert detail.reading == reads


@pytest.mark.parametrize("width", [200, 460, 4000])
def test_what_cursors_measure_stands_in_columns_with_the_number_of_each_curve(qapp, width):
    text = LegendText(
        names=NAMES[7:13],
        where="Δt 40 ms",
        where_room="Δt 40 ms",
        readings=("0.1, 0.2",) * 6,
        reading_room="0.0000, 0.0000",
        details=("line",) * 6,
    )
    layout = LegendLayout(text, QFontMetrics(QFont()), width)
    detail, places, last = layout.placed()
    assert detail.number
    assert detail.reading
    assert len(places) == 6 or width == 200
    assert all(line <= last < layout.n_lines for _, line in places)
    assert (layout.n_lines == 1) == (width == 4000)
    ends = [x + layout.entry_px(rank, detail) for rank, (x, _) in enumerate(places)]
    for end, (x, _) in zip(ends, places[1:], strict=False):
        assert x >= end or x == places[0][0]
    assert layout.n_lines == 1 or {x for x, line in places if line} <= {x for x, _ in places[:3]}


def test_the_extremes_of_a_wave_are_found_once_for_all_who_draw_it():
    x = np.arange(300) / RATE_HZ
    y = tone(x, 90.0)[np.newaxis]
    first, again, part, other = (
        wave_of(x, signals).extremes(start, 300)
        for signals, start in ((y, 0), (y.copy(), 0), (y, 1), (2 * y, 0))
    )
    assert again is first
    assert part.low.shape == (1, 299)
    assert other.sizes[0, 0] == pytest.approx(2 * first.sizes[0, 0])


def envelope(signals, rank, n_windows=40):
    """Highest value in each of some parts of the visible width.

    Not where the record begins and ends hard: there it rings.
    """
    points, (begin, end) = drawn(signals)[rank].points, signals.plot.x_window.shown
    at = np.floor((points.x - begin) / (end - begin) * n_windows).astype(int)
    heights, parts = values(signals, points.y), range(n_windows // 5, n_windows - n_windows // 5)
    return np.array([heights[at == k].max() for k in parts])


@pytest.mark.parametrize(
    ("frequency_hz", "per_px", "stacked"),
    [(325.0, 0.6, False), (1300 / 3, 1.5, True), (325.0, 3.0, True), (1300 / 3, 60.0, False)],
)
def test_a_tone_reaches_its_peak_everywhere_whatever_its_samples_miss(
    signals, frequency_hz, per_px, stacked
):
    signals.show_curves(waves(), synthetic=False)
    width = signals.plot.places.row(0).width()
    signals.plot.reset_range()
    curves = sampled(partial(MISSED, frequency_hz=frequency_hz), int(per_px * width))
    signals.plot.set_view(TIME, None, stacked=stacked)
    signals.show_curves(curves, synthetic=False)
    for rank in range(2):
        peak = 1.0 / (1 + rank)
        # Blocks end with a whole row of pixels.
        low, high = signals.plot.value_scale.values
        near = EXTREMES_ERROR * peak + (high - low) / signals.plot.places.row(0).height()
        tops = envelope(signals, rank)
        assert peak - near <= tops.min() <= tops.max() <= peak + near
    # On paper, where dots are finer, the range is the same.
    paper = copy_of(signals.plot, QSize(900, 600))
    assert paper.value_scale.values == signals.plot.value_scale.values
    paper.deleteLater()


def test_curves_whose_wave_is_not_known_are_joined_as_they_are(signals):
    curves = replace(sampled(MISSED, 6500), wave=None)
    signals.show_curves(curves, synthetic=False)
    assert envelope(signals, 0).max() < 0.75


def inked_rows(samples, columns):
    """The rows in which the picture of a clip, 412 x 138, has ink in one of these columns."""
    style = ClipStyle(1300.0, QColor("black").rgba(), 1.0)
    picture = ClipPictures().picture(samples, QSizeF(412, 138), style).toImage()
    return [y for y in range(138) if any(picture.pixelColor(x, y).alpha() > 100 for x in columns)]


def test_one_loud_sample_in_a_minute_of_a_clip_is_seen(qapp):
    samples = np.zeros(78_000)
    samples[41_234] = 1.0
    assert min(inked_rows(samples, range(216, 220))) <= 2
    assert min(inked_rows(samples, range(200, 215))) > 60


@pytest.mark.parametrize("n_samples", [600, 2600])
def test_a_clip_whose_samples_miss_its_peak_is_drawn_up_to_it(qapp, n_samples):
    tone = np.sin(0.5 * np.pi * np.arange(n_samples) + np.pi / 4)
    # Samples alone end 20 px below the top.
    assert all(min(inked_rows(tone, range(x, x + 5))) <= 8 for x in range(100, 300, 10))
