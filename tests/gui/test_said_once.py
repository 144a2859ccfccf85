"""What is told again as it is costs nothing: no layout, no tooltip, no painting."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QApplication, QHBoxLayout, QWidget

from skinsource.design import edits
from skinsource.design.design import Design, track
from skinsource.design.panel_settings import settings_of
from skinsource.design.view import View
from skinsource.design.waveforms.tones import Tone
from skinsource.specs.numbers import NumberSpec
from skinsource_gui.fields.editors import FieldCell
from skinsource_gui.panels.clip_editor import panel as editor_panel
from skinsource_gui.panels.hand import panel as hand_panel
from skinsource_gui.panels.inspector.panel import InspectorPanel
from skinsource_gui.panels.skin.panel import SkinPanel
from skinsource_gui.panels.skin.settings import SkinSettings
from skinsource_gui.qt.theme import DARK
from skinsource_gui.shell.limb_note import LimbNote
from skinsource_gui.state.preferences import start_design
from tests.gui.clip_editor.bench import Bench

_Type = QEvent.Type
_COSTLY = {_Type.LayoutRequest, _Type.ToolTipChange, _Type.Paint}


class Events(QObject):
    """Counts costly events, of all widgets."""

    def __init__(self):
        super().__init__()
        self.events = []

    def eventFilter(self, watched, event):
        if event.type() in _COSTLY:
            self.events.append((watched.objectName() or type(watched).__name__, event.type().name))
        return False


@pytest.fixture
def events_of(qapp):
    """What an action costs, once everything before it is done."""
    QApplication.processEvents()
    spy = Events()

    def count(act):
        for _ in range(3):
            QApplication.processEvents()
        qapp.installEventFilter(spy)
        spy.events.clear()
        act()
        QApplication.processEvents()
        qapp.removeEventFilter(spy)
        return spy.events

    return count


def test_a_limb_that_stays_lays_nothing_out(qtbot, events_of, use_theme):
    bar, note = QWidget(), LimbNote()
    qtbot.addWidget(bar)
    QHBoxLayout(bar).addWidget(note)
    note.show_limb("synthetic-1")
    bar.show()
    qtbot.waitExposed(bar)
    assert events_of(lambda: note.show_limb("synthetic-1")) == []
    assert events_of(lambda: note.show_available(("measured-1",)))
    assert events_of(lambda: use_theme(DARK))
    assert events_of(lambda: note.show_limb("measured-1"))


def test_a_field_says_only_once_that_inputs_differ(qtbot, events_of):
    cell = FieldCell("one", NumberSpec(label="Frequency", unit="Hz"))
    qtbot.addWidget(cell)
    qtbot.addWidget(cell.label)
    cell.label.show()
    assert events_of(lambda: cell.show_differs(False)) == []
    assert events_of(lambda: cell.show_differs(True))
    assert cell.label.text() == "Frequency ≠"
    assert cell.label.toolTip()
    assert events_of(lambda: cell.show_differs(True)) == []
    assert events_of(lambda: cell.show_differs(False))
    assert (cell.label.text(), cell.label.toolTip()) == ("Frequency", "")


def test_an_inspector_that_is_told_the_same_again_does_nothing(qtbot, events_of):
    panel, design = InspectorPanel(), start_design("synthetic-1")
    view = View(selected_inputs=design.ids[:1])
    qtbot.addWidget(panel)
    panel.show_state(design, view)
    panel.show()
    qtbot.waitExposed(panel)
    assert events_of(lambda: panel.show_state(design, view)) == []


def test_words_on_a_clip_are_made_once_for_each_design(qtbot, monkeypatch):
    bench, made = Bench(qtbot, Tone(100.0, 0.0, 0.2)), []
    figure = editor_panel.clip_text
    monkeypatch.setattr(editor_panel, "clip_text", lambda clip: made.append(1) or figure(clip))
    bench.show()
    assert made == []
    bench.design = replace(bench.design, inputs=bench.design.inputs)
    bench.show()
    assert made == [1]


def test_another_waveform_changes_nothing_on_the_skin_before_it_is_computed(qtbot, events_of):
    panel, design, view = SkinPanel(), start_design("synthetic-1"), View()
    qtbot.addWidget(panel)
    panel.show_state(design, view)
    panel.show()
    qtbot.waitExposed(panel)
    shown = []
    panel._display.show = lambda: shown.append(1)
    panel.show_state(design, view)
    panel.show_state(edits.change_field(design, view, (1,), "frequency_hz", 200.0).design, view)
    assert shown == []
    for state in (
        (edits.toggle_mute(design, view, (1,)).design, view),
        (design, replace(view, outputs=(3,))),
        (design, replace(view, span="loudest")),
        (replace(design, limb="synthetic-2"), replace(view, span="loudest")),
    ):
        shown.clear()
        panel.show_state(*state)
        assert shown == [1]


def test_words_of_inputs_on_the_hand_are_made_for_those_that_changed(qtbot, monkeypatch):
    inputs = tuple(track(location=k, waveform=Tone(100.0)) for k in (3, 7, 12))
    design, view, made = Design(limb="synthetic-1", inputs=inputs), View(), []
    text_of = hand_panel._text
    monkeypatch.setattr(hand_panel, "_text", lambda track: made.append(track.id) or text_of(track))
    panel = hand_panel.HandPanel()
    qtbot.addWidget(panel)
    panel.show_state(design, view)
    assert made == [1, 2, 3]
    muted = edits.toggle_mute(design, view, (2,)).design
    panel.show_state(muted, view)
    assert made == [1, 2, 3, 2]
    assert [mark.text for mark in panel.diagram.state.marks] == ["Tone", "Tone, muted", "Tone"]


def test_edits_lay_nothing_out_in_the_window(window, qtbot, qapp):
    document, changes = window.document, []
    label = window.status_line.timing

    def edit(hz):
        document.apply(edits.change_field(document.design, document.view, (1,), "frequency_hz", hz))
        window.catch_up()
        QApplication.processEvents()

    for hz in (101.0, 102.0):
        edit(hz)
    qtbot.waitUntil(lambda: bool(label.text()), timeout=10_000)
    for _ in range(3):
        QApplication.processEvents()
    spy = Events()
    qapp.installEventFilter(spy)
    label.noted.connect(lambda: changes.append(label.text()))
    for hz in (103.0, 104.0, 105.0):
        edit(hz)
        label._show_text()
    qapp.removeEventFilter(spy)
    assert changes
    assert [event for event in spy.events if event[1] == "LayoutRequest"] == []


def test_a_long_time_has_room(window):
    label = window.status_line.timing
    for text in ("8 ms", "123456 ms"):
        label.setText(text)
        label._fit()
        assert label.width() >= label.fontMetrics().horizontalAdvance(text)


def test_settings_of_a_panel_are_read_once_from_each_view():
    view = View(panels=(("skin", (("colours", "magma"),)),))
    first = settings_of(view, "skin", SkinSettings)
    assert settings_of(replace(view, playhead_s=0.1), "skin", SkinSettings) is first
    assert settings_of(View(), "skin", SkinSettings).colours == SkinSettings().colours
    assert settings_of(view, "skin", SkinSettings) == first
    assert settings_of(view, "other", SkinSettings) == SkinSettings()
