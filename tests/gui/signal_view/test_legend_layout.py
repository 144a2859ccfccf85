"""What of a legend a line has room for."""

import pytest
from PySide6.QtGui import QFont, QFontMetrics

from skinsource_gui.plots.curves import output_names
from skinsource_gui.plots.legend import LegendLayout, LegendText
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
