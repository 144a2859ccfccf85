"""What of a legend a line has room for."""

from dataclasses import replace

import pytest
from PySide6.QtGui import QFont, QFontMetrics

from skinsource_gui.plots.curves import output_names
from skinsource_gui.plots.legend import PEAK, LegendLayout, LegendText
from skinsource_gui.qt.theme import UNIT_PX

NAMES = output_names(tuple(range(1, 41)), "synthetic-1")


@pytest.mark.parametrize("width", [60, 200, 500, 900, 4000])
@pytest.mark.parametrize("reads", [False, True])
def test_as_many_curves_are_written_as_fit_beside_how_many_do_not(qapp, width, reads):
    text = LegendText(names=NAMES, unit="m/s²", reading_room="−0.123")
    if reads:
        text = LegendText(
            names=NAMES,
            unit="m/s²",
            where="12 ms",
            where_room="1234.5 ms",
            readings=("0.1",) * len(NAMES),
            reading_room="−0.123",
        )
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


def read_of(n_outputs, where="12 ms"):
    names, readings = NAMES[:n_outputs], ("0.216",) * n_outputs
    return LegendText(
        names=names,
        unit="m/s²",
        where=where,
        where_room=where,
        readings=readings,
        reading_room="0.216",
    )


def test_numbers_of_outputs_are_left_out_only_where_all_curves_are_written_then(qapp):
    metrics, layouts = QFontMetrics(QFont()), set()
    for width in range(200, 600):
        layout = LegendLayout(read_of(5), metrics, width)
        detail, fitting = layout.fitting()
        layouts.add((detail.number, fitting))
    assert (False, 5) in layouts
    assert {fitting for number, fitting in layouts if not number} == {5}
    assert {1, 2, 5} <= {fitting for number, fitting in layouts if number}


def test_no_peak_is_written_without_the_output_whose_it_is_nor_without_its_unit(qapp):
    metrics, layouts = QFontMetrics(QFont()), set()
    for width in range(20, 900):
        layout = LegendLayout(read_of(5, PEAK), metrics, width)
        detail, fitting = layout.fitting()
        layouts.add((detail.reading, fitting))
        assert detail.number, width
        # What has the unit, and says what is written, goes with the peaks.
        text = layout.where(PEAK, detail)
        assert bool(text) == detail.reading, width
        assert detail.unit or not detail.reading or text.endswith("m/s²"), width
    # Before numbers of outputs are left out, peaks are.
    assert {(True, 5), (False, 5)} <= layouts


def test_named_curves_share_a_line_where_they_may_take_no_more(qapp):
    text = LegendText(
        names=NAMES[:7], unit="m/s²", where_room="1234.5 Hz", reading_room="−0.1234"
    ).of_axes(("x", "y", "z"))
    metrics = QFontMetrics(QFont())
    for width in (300, 420, 680):
        folded = LegendLayout(text, metrics, width).lines()
        *entries, (where, line) = LegendLayout(text, metrics, width, may_fold=False).lines()
        assert folded[-1][1] > 0
        assert {at for _, at in entries} == {line} == {0}
        assert where + metrics.horizontalAdvance("1234.5 Hz · m/s²") <= width
    # Names are whole, whatever there is room for.
    narrow = LegendLayout(text, metrics, 60, may_fold=False)
    assert narrow.lines()[-1][1] > 0


def relative(where, unit, n_outputs=7):
    """The same curves while nothing is read, and while something is."""
    return replace(
        read_of(n_outputs, where),
        unit=unit,
        where_room="1234.56 ms",
        reading_room="−0.123",
        unit_room="of its peak",
        relative=True,
    )


def test_peaks_take_a_second_line_where_one_is_too_narrow_and_nothing_moves_while_one_reads(qapp):
    metrics, n_lines = QFontMetrics(QFont()), set()
    for width in range(100, 1200, 7):
        idle, read = (
            LegendLayout(text, metrics, width)
            for text in (relative(PEAK, "m/s²"), relative("12 ms", "of its peak"))
        )
        detail = idle.in_lines
        assert read.in_lines == detail, width
        if detail is None:
            continue
        assert (detail.number, detail.reading) == (True, True)
        assert idle.lines(detail) == read.lines(detail), width
        n_lines.add(idle.lines(detail)[-1][1] + 1)
        # One line is enough where there is no room for more.
        assert LegendLayout(idle.text, metrics, width, may_fold=False).in_lines is None
    assert n_lines == {2}
    # Where two are too few too, and where one is enough, there is one.
    for width in (100, 1200):
        assert LegendLayout(relative(PEAK, "m/s²"), metrics, width).in_lines is None


@pytest.mark.parametrize("may_fold", [False, True])
@pytest.mark.parametrize("n_outputs", [3, 7, 40])
def test_less_width_never_makes_a_legend_lower(qapp, n_outputs, may_fold):
    # Where it scrolls, a bar beside it would else come and go until the stack ran out.
    metrics = QFontMetrics(QFont())
    axes = LegendText(
        names=NAMES[:7], unit="m/s²", where_room="1234.5 Hz", reading_room="−0.1234"
    ).of_axes(("x", "y", "z"))
    for text in (relative(PEAK, "m/s²", n_outputs), read_of(n_outputs, PEAK), axes):
        layouts = (LegendLayout(text, metrics, width, may_fold) for width in range(1200, 40, -1))
        n_lines = [layout.n_lines for layout in layouts]
        assert n_lines == sorted(n_lines)
