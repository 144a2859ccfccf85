"""What is told again as it is costs nothing: no layout, no tooltip, no painting."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QApplication

from skinsource.design import edits
from skinsource.design.view import View
from skinsource_gui.panels.skin.panel import SkinPanel
from skinsource_gui.state.preferences import start_design

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


def test_another_waveform_changes_nothing_on_the_skin_before_it_is_computed(qtbot, events_of):
    panel, design, view = SkinPanel(), start_design("synthetic-1"), View()
    qtbot.addWidget(panel)
    panel.show_state(design, view)
    panel.show()
    qtbot.waitExposed(panel)
    shown = []
    panel._show = lambda: shown.append(1)
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


def test_edits_lay_nothing_out_in_the_window(window, qtbot, qapp):
    document, changes = window.document, []
    clock = window.status_line.clock

    def edit(hz):
        document.apply(edits.change_field(document.design, document.view, (1,), "frequency_hz", hz))
        window.catch_up()
        QApplication.processEvents()

    for hz in (101.0, 102.0):
        edit(hz)
    qtbot.waitUntil(lambda: bool(clock.times.seconds()), timeout=10_000)
    for _ in range(3):
        QApplication.processEvents()
    spy = Events()
    qapp.installEventFilter(spy)
    clock.noted.connect(lambda: changes.append(1))
    for hz in (103.0, 104.0, 105.0):
        edit(hz)
    qapp.removeEventFilter(spy)
    assert changes
    assert [event for event in spy.events if event[1] == "LayoutRequest"] == []
