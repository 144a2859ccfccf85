"""Words that have too little room: shortened where that is said, never cut in silence."""

import numpy as np
import pytest
from PySide6.QtGui import QImage, QPainter
from PySide6.QtWidgets import QStyleOptionViewItem, QToolButton

from skinsource.engine.stimulus import Channel
from skinsource.export.formats.format import ChannelOverview
from skinsource_gui.pages.stimulus.page import channel_lines
from skinsource_gui.panels.compare.card import fitted_level
from skinsource_gui.panels.history.panel import StepDelegate, StepsModel
from skinsource_gui.panels.skin.map import NoteLine
from skinsource_gui.plots.toolbar import PlotToolbar
from skinsource_gui.state import preferences
from skinsource_gui.state.history import History, Step


def test_large_words_leave_the_gain_its_number(window, settle):
    for _ in range(4):
        window.do("enlarge_text")
    settle()
    field = window.playback.bar.gain
    needed = field.fontMetrics().horizontalAdvance("−20 dB")
    assert field.width() >= needed + 16
    for _ in range(4):
        window.do("shrink_text")


@pytest.mark.parametrize("width", [400, 300, 220])
def test_switches_above_a_plot_are_written_smaller_rather_than_cut(qtbot, width):
    bar = PlotToolbar()
    qtbot.addWidget(bar)
    font = bar.font()
    font.setPointSizeF(font.pointSizeF() * 1.4)
    bar.setFont(font)
    bar.add_switch("log", "Log frequency", "", lambda on: None)
    bar.resize(width, 40)
    bar.show()
    qtbot.waitExposed(bar)
    for button in bar.findChildren(QToolButton):
        if button.isVisible():
            width_px = button.fontMetrics().horizontalAdvance(button.text())
            assert button.width() >= width_px, button.text()


def test_a_long_note_under_the_map_takes_two_lines(qtbot):
    note = NoteLine()
    qtbot.addWidget(note)
    note.resize(200, 20)
    note.show_text("Short")
    line = note.sizeHint().height()
    note.show_text("Part of the map lies outside of all outputs and is extrapolated there")
    assert note.sizeHint().height() == 2 * line
    note.resize(900, 20)
    assert note.sizeHint().height() == line


def painted(label, width):
    """What of a row of the history is painted."""
    model = StepsModel(None)
    model.show_history(History(steps=(Step(label=label, at_s=0.0),), present=1))
    option = QStyleOptionViewItem()
    option.rect.setRect(0, 0, width, 24)
    texts = []

    class Painter(QPainter):
        def drawText(self, *arguments):
            texts.append(arguments[-1])

    image = QImage(width, 24, QImage.Format.Format_RGB32)
    painter = Painter(image)
    StepDelegate().paint(painter, option, model.index(1, 0))
    painter.end()
    return [text for text in texts if text]


def test_a_long_step_of_the_history_is_cut_beside_its_time_and_goes_before_it_in_little_room(qapp):
    assert len(painted("Add input", 300)) == 2
    step = "Change frequency of input at 7 (II pad)"
    assert any(text.startswith("Change frequency") for text in painted(step, 250))
    assert len(painted(step, 250)) == 2
    (label,) = painted(step, 120)
    assert label.startswith("Change")


def test_the_sheet_of_an_export_writes_a_minus(qapp):
    overview = ChannelOverview(
        channel=Channel(number=1, place=20, title="Palm", inputs=(1,)),
        extremes=np.zeros((2, 4)),
        peak=0.5,
        rms=0.25,
        clipped=0,
    )
    assert channel_lines(overview)[1] == "peak −6.0 dB, RMS −12.0 dB"


def test_a_limb_that_others_installed_is_told_of(window, monkeypatch):
    limbs = window.limbs
    names = limbs.names
    monkeypatch.setattr(preferences, "available_limbs", lambda: (*names, "measured-2"))
    limbs.look()
    message = window.statusBar().currentMessage()
    assert message == "Measured 2 (165 mm): installed, choose it under Limb above the panels"
    monkeypatch.setattr(preferences, "available_limbs", lambda: names)
    limbs.look()
    assert window.statusBar().currentMessage() == "Measured 2 (165 mm): no longer installed"


def test_a_level_on_a_narrow_card_goes_without_its_unit(qapp):
    image = QImage(60, 20, QImage.Format.Format_RGB32)
    painter = QPainter(image)
    width = painter.fontMetrics().horizontalAdvance("−14.2 dB")
    assert fitted_level(painter, "−14.2 dB", width) == "−14.2 dB"
    assert fitted_level(painter, "−14.2 dB", width - 1) == "−14.2"
    painter.end()
