"""A panel that nobody looks at, or that is told again what it shows, costs nothing."""

from dataclasses import replace

from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QApplication

from skinsource.design import edits
from skinsource_gui.shell.panels import PANELS
from skinsource_gui.shell.workspaces import WORKSPACES
from tests.gui.analysis.analysis_bench import analysis


def made(window):
    return {panel.name for panel in window.panels}


def states_shown(panel, monkeypatch):
    """What a panel is told of the state from now on."""
    states, show = [], panel.show_state

    def show_state(design, view):
        states.append((design, view))
        show(design, view)

    monkeypatch.setattr(panel, "show_state", show_state)
    return states


def test_a_window_makes_the_panels_of_its_workspace_and_no_other(window):
    placed = set(WORKSPACES[0].split.panels())
    assert made(window) == placed
    assert all(dock.is_empty for name, dock in window.docks.items() if name not in placed)


def test_a_panel_is_made_with_the_first_look_and_shows_what_is_now(window, qtbot, monkeypatch):
    document = window.document
    document.edit("louder", document.design.with_input(0, amplitude=3.25))
    assert "statistics" not in made(window)
    panel = analysis(window, "statistics")
    qtbot.waitUntil(lambda: panel.isVisible() and not window.engine.busy)
    late = panel.grab().toImage()
    # One that was there from the beginning shows the same after the same edits.
    document.undo_stack.undo()
    document.undo_stack.redo()
    qtbot.waitUntil(lambda: not window.engine.busy)
    assert panel.grab().toImage() == late
    document.undo_stack.undo()
    qtbot.waitUntil(lambda: not window.engine.busy)
    assert panel.grab().toImage() != late


def test_a_hidden_panel_is_told_nothing_and_takes_over_what_is_now_when_it_is_shown(
    window, monkeypatch
):
    window.docks["inspector"].hide()
    states = states_shown(window.panel("inspector"), monkeypatch)
    document = window.document
    for amplitude in (2.0, 3.0):
        document.edit("louder", document.design.with_input(0, amplitude=amplitude))
    document.look(replace(document.view, playhead_s=0.1))
    assert states == []
    window.docks["inspector"].bring_forward()
    assert states == [(document.design, document.view)]
    window.docks["inspector"].hide()
    window.docks["inspector"].bring_forward()
    assert len(states) == 1


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


def test_edits_lay_nothing_out_and_paint_no_more_than_looks_different(window, qtbot, qapp):
    document, changes = window.document, []
    clock = window.status_line.clock

    def edit(hz):
        document.apply(edits.change_field(document.design, document.view, (1,), "frequency_hz", hz))
        window.catch_up()
        QApplication.processEvents()

    for hz in (101.0, 102.0):
        edit(hz)
    qtbot.waitUntil(lambda: bool(clock.times_s), timeout=10_000)
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
    painted = {name for name, kind in spy.events if kind == "Paint"}
    assert "skin_map" in painted
    assert painted.isdisjoint({"hand_diagram", "range_low_field", "range_high_field"})


def test_panels_say_of_themselves_what_their_table_says(qapp):
    for maker in (spec.panel for spec in PANELS):
        panel_type = getattr(maker, "type", maker)
        assert (panel_type.name, panel_type.title) == (maker.name, maker.title)
