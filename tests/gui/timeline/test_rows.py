from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QObject, QPoint, Qt
from PySide6.QtWidgets import QApplication, QLabel, QToolButton

from skinsource.design.design import Design, track
from skinsource.design.waveforms.samples import Recording
from skinsource.design.waveforms.tones import Tone
from skinsource.specs.samples import Samples
from skinsource_gui.panels.timeline.head_row import row_places
from tests.gui.timeline.bench import PLACES, Bench, click, design_of, results_of


def test_there_is_one_row_for_each_input_in_the_order_of_the_design(bench):
    assert [row.state.track.location for row in bench.rows.rows] == list(PLACES)
    assert "7, Digit II, pad: Tone 100 Hz" in bench.row(0).accessibleName()


def test_an_empty_list_says_what_to_do(bench):
    bench.show(Design(limb="synthetic-1"))
    label = bench.panel.findChild(QLabel, "inputs_empty")
    assert label.isVisible()
    assert label.text() == "Click a place on the hand to add a track"
    assert bench.rows.rows == ()


def test_a_click_on_a_row_selects_its_input_and_takes_the_keys(bench):
    click(bench.row(2), QPoint(60, 10))
    assert bench.view.selected_input == 3
    assert bench.rows.hasFocus()
    assert bench.edits == []


def test_the_arrow_keys_select_and_stop_at_the_ends(bench):
    bench.key(Qt.Key.Key_Up)
    assert bench.view.selected_input == 1
    for _ in range(5):
        bench.key(Qt.Key.Key_Down)
    assert bench.view.selected_input == 3
    bench.key(Qt.Key.Key_Home)
    assert bench.view.selected_input == 1


def test_the_arrow_keys_begin_at_the_ends_where_nothing_is_selected(qtbot):
    bench = Bench(qtbot, design_of(*PLACES), selected=-1)
    bench.key(Qt.Key.Key_Down)
    assert bench.view.selected_input == 1


def test_a_selection_that_does_not_exist_is_none(qtbot):
    bench = Bench(qtbot, design_of(*PLACES), selected=7)
    assert bench.rows.last_row is None
    bench.key(Qt.Key.Key_Delete)
    assert bench.edits == []


def test_the_keys_m_and_s_mute_and_solo_the_selected_input(bench):
    bench.key(Qt.Key.Key_M)
    assert bench.design.inputs[0].muted
    bench.key(Qt.Key.Key_M)
    assert not bench.design.inputs[0].muted
    bench.key(Qt.Key.Key_S)
    assert bench.design.inputs[0].solo
    assert bench.labels == [
        "Mute input at 7 (II pad)",
        "Unmute input at 7 (II pad)",
        "Solo input at 7 (II pad)",
    ]
    assert bench.row(0).solo.isChecked()


def test_the_keys_m_and_s_also_work_while_a_number_has_the_focus(bench):
    click(bench.row(1).amplitude)
    bench.key(Qt.Key.Key_M)
    assert [track.muted for track in bench.design.inputs] == [False, True, False]


def test_buttons_act_on_their_own_row_and_leave_the_selection(bench):
    click(bench.row(1).mute)
    click(bench.row(2).solo)
    assert bench.design.inputs[1].muted
    assert bench.design.inputs[2].solo
    assert bench.view.selected_input == 1


def test_what_is_not_heard_is_shown_as_silent(bench):
    bench.show(bench.design.with_input(1, muted=True))
    assert [row.state.silent for row in bench.rows.rows] == [False, True, False]
    bench.show(bench.design.with_input(1, solo=True))
    assert [row.state.silent for row in bench.rows.rows] == [True, True, True]
    bench.show(bench.design.with_input(0, solo=True))
    assert [row.state.silent for row in bench.rows.rows] == [False, True, True]


def test_a_muted_row_looks_different(bench):
    bench.panel.show_results(results_of(bench.design))
    before = bench.row(1).grab().toImage()
    bench.show(bench.design.with_input(1, muted=True))
    assert bench.row(1).grab().toImage() != before


class Paints(QObject):
    """Counts how often a widget is painted."""

    def __init__(self, widget):
        super().__init__(widget)
        self.times = 0
        widget.installEventFilter(self)

    def eventFilter(self, watched, event):
        self.times += event.type() == QEvent.Type.Paint
        return False


def test_a_row_is_painted_anew_only_for_what_is_seen_on_it(bench):
    QApplication.processEvents()
    parts = [Paints(part) for part in (bench.row(1), bench.row(1).amplitude)]

    def painted(index, **changes):
        for part in parts:
            part.times = 0
        bench.show(bench.design.with_input(index, **changes))
        QApplication.processEvents()
        return [part.times for part in parts]

    clip = bench.design.inputs[1].clips[0]
    played = replace(clip, waveform=Tone(180.0, 0.0, 0.3))
    assert painted(1, clips=(played,)) == [0, 0]
    # It says so all the same.
    assert "180 Hz" in bench.row(1).toolTip()
    assert painted(0, location=3) == [0, 0]
    for changes in ({"location": 4}, {"colour": 5}):
        assert painted(1, **changes)[0] == 1
    # Silent, because of another one.
    assert painted(0, solo=True)[0] == 1
    assert painted(1, amplitude=0.25)[1] == 1


@pytest.mark.parametrize("scale", [1.0, 1.3, 2.0])
def test_heads_and_the_buttons_above_them_have_room_for_larger_text(bench, scale):
    font = bench.panel.font()
    font.setPointSizeF(font.pointSizeF() * scale)
    bench.panel.setFont(font)
    QApplication.processEvents()
    buttons = bench.panel.findChildren(QToolButton)
    snap = next(button for button in buttons if button.objectName() == "timeline_snap")
    assert snap.width() >= snap.sizeHint().width()
    places = row_places(bench.row(0).width(), bench.row(0).fontMetrics().height())
    number = bench.row(0).fontMetrics().horizontalAdvance("15")
    assert places.swatch.width() >= number
    assert places.name.left() >= places.swatch.right()


def test_the_row_that_has_the_keyboard_may_give_way_to_others(bench):
    """As when another design is opened while a number of the list is selected."""
    first = bench.row(0)
    first.amplitude.setFocus()
    new = Design(
        limb="synthetic-1", inputs=tuple(replace(track(location=k), id=50 + k) for k in (4, 5))
    )
    bench.show(new)
    assert [row.id for row in bench.rows.rows] == [54, 55]
    assert bench.rows.hasFocus()
    assert all(row.state.list_focused for row in bench.rows.rows)


def test_the_head_of_a_recording_that_keeps_its_size_says_the_peak_beside_a_gain(bench):
    first, other = bench.row(0), bench.row(1)
    beside = other.amplitude.geometry()
    samples = Samples(values=4.88 * np.hanning(301), sample_rate_hz=1300.0, unit="m/s²")
    clip = replace(bench.design.inputs[0].clips[0], waveform=Recording(samples))
    bench.show(bench.design.with_input(0, clips=(clip,), amplitude=-0.5))
    assert (first.amplitude.spec.label, first.amplitude.spec.unit) == ("Gain", "")
    assert first.amplitude.text() == "\N{MINUS SIGN}0.5"
    assert first.state.peak == "2.44 m/s²"
    assert "Peak 2.44 m/s²" in first.toolTip()
    places = row_places(first.width(), first.fontMetrics().height(), peak=True)
    assert first.amplitude.geometry() == places.amplitude
    assert places.amplitude.right() < places.peak.left()
    assert places.peak.right() < places.remove.left()
    assert first.fontMetrics().horizontalAdvance(first.state.peak) <= places.peak.width()
    assert (other.amplitude.spec.unit, other.amplitude.geometry()) == ("m/s²", beside)
    bench.show(bench.design.with_clip(clip.id, waveform=Tone()))
    assert first.amplitude.spec.unit == "m/s²"
    assert first.amplitude.geometry() == beside
