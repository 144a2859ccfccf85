"""What is mostly noise is hatched, and many selected outputs hide nothing."""

import numpy as np
from PySide6.QtCore import QRectF
from PySide6.QtGui import QImage, QPainter

from skinsource.design.comparing import Snapshot
from skinsource.design.design import Design, track
from skinsource.engine.evaluation import evaluate
from skinsource_gui.panels.side_by_side.content import Cells
from skinsource_gui.panels.transfer.panel import bar_sizes
from skinsource_gui.plots.small_map import paint_small_map, ring_size
from skinsource_gui.qt.theme import LIGHT
from skinsource_gui.state.compared import Compared

DESIGN = Design(limb="synthetic-1", inputs=(track(7),))


def compared(number, noisy):
    names = ("limb_map", "limb_data", "output_levels_db", "surface", "surface_levels_db")
    values = dict(evaluate(DESIGN, *names))
    above = np.full(72, 20.0)
    above[[output - 1 for output in noisy]] = 5.9
    return Compared(
        snapshot=Snapshot(number=number, design=DESIGN), values={**values, "above_noise_db": above}
    )


def painted(small):
    image = QImage(120, 280, QImage.Format.Format_RGB32)
    image.fill(0xFFFFFF)
    painter = QPainter(image)
    paint_small_map(painter, QRectF(0, 0, 120, 280), small, None, LIGHT)
    painter.end()
    return image


def test_what_is_mostly_noise_is_hatched_on_each_map_and_on_what_is_made_of_several(qapp):
    pair = [compared(1, noisy=(3, 70)), compared(2, noisy=(70, 71))]
    names = [("one",), ("two",)]
    first, second = Cells().of_levels(pair, names)
    assert (first.small.noisy, second.small.noisy) == ((3, 70), (70, 71))
    [difference] = Cells().of_differences(pair, names, 0)
    assert difference.small.noisy == (3, 70, 71)
    assert [cell.small.noisy for cell in Cells().of_spread(pair, names, 0)] == [(3, 70, 71)] * 2
    [quiet, _] = Cells().of_levels([compared(1, noisy=()), pair[1]], names)
    assert painted(first.small) != painted(quiet.small)


def test_rings_and_bars_of_many_outputs_leave_map_and_curves_in_sight():
    assert ring_size(12, 5.0) == (4.0, 2.0)
    radius, width = ring_size(44, 5.0)
    assert 2.0 * (radius + width) <= 5.0
    assert bar_sizes(3, 200.0) == (4.0, 3.0)
    for n in (12, 44, 72):
        step, thick = bar_sizes(n, 200.0)
        assert thick < step
        assert n * step <= 20.0 + 1e-9
