"""Why a track is silent stands on the ground of its lane, and the grid stops around it."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QImage, QPainter

from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input
from skinsource.design.waveforms.pulses import Tap
from skinsource_gui.qt.theme import LIGHT
from tests.gui.timeline.lanes_bench import LanesBench


@pytest.mark.parametrize("chosen", [(), (1,)])
def test_no_line_of_the_grid_runs_through_why_a_track_is_silent(qtbot, chosen):
    bench = LanesBench(qtbot)
    bench.panel.resize(1000, 400)
    bench.view = replace(bench.view, time_range_s=(0.0, 1.2), selected_inputs=chosen)
    clips = (Clip(onset_s=0.1, waveform=Tap()),)
    bench.show(Design(limb="synthetic-1", inputs=(Input(location=1, clips=clips, muted=True),)))
    item = bench.lanes.item
    item.show_font(bench.panel.font())
    image = QImage(bench.lanes.viewport().size(), QImage.Format.Format_RGB32)
    image.fill(QColor(LIGHT.base))
    painter = QPainter(image)
    painter.setFont(bench.panel.font())
    lane = item._content.lanes[0]
    strip = item._strip(lane)
    flags = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignBottom
    room = QRectF(painter.boundingRect(strip.adjusted(0, 0, -14.0, -3), flags, lane.silent))
    # Lines as close as letters are.
    painter.setPen(QColor(LIGHT.grid))
    for x in range(0, image.width(), 3):
        painter.drawLine(x, 0, x, image.height())
    item._paint_silence_reason(painter, lane)
    painter.end()
    grid = QColor(LIGHT.grid).rgb()
    colours = {
        image.pixel(x, y)
        for x in range(int(room.left()), int(room.right()))
        for y in range(int(room.top()) + 1, int(room.bottom()))
    }
    assert grid not in colours
    assert len(colours) > 2
    outside = {image.pixel(x, int(room.center().y())) for x in range(0, int(room.left()) - 8)}
    assert grid in outside
