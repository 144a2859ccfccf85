"""Panels out of sight cost nothing; what comes into sight with older results says so."""

from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from threading import Event

import pytest
from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QApplication

from skinsource.design import edits
from skinsource.design.effects.level import Fade
from skinsource_gui.panels.analysis.panel import AnalysisPanel
from skinsource_gui.qt.questions import CopyButton
from skinsource_gui.shell.panels import PANELS
from skinsource_gui.shell.workspaces import WORKSPACES
from tests.gui.analysis.analysis_bench import analysis, look_at
from tests.gui.output.bench import CHOSEN
from tests.gui.shared_window import rest


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
    for hz in (103.0, 109.0, 115.0):
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


SELECTED = (3, 9, 15, 21)
#: What they show is of the selected outputs, or of one of them.
OF_OUTPUTS_IN_ANALYSIS = (
    "statistics",
    "perception",
    "main_axis",
    "wave",
    "transfer",
    "spectrogram",
)
OF_OUTPUTS = {"traces", "spectra", *(f"analysis/{view}" for view in OF_OUTPUTS_IN_ANALYSIS)}
#: Others too ask for results of the design.
COMPUTED = sorted({"skin", "timeline", "clip_editor", "output", "analysis/windowed"} | OF_OUTPUTS)
#: What is known of limbs and snapshots is forgotten, or held against what it is of.
OF_LIMBS = ["analysis/regions"]


@contextmanager
def held(window):
    """Have nothing evaluated meanwhile."""
    let_go = Event()
    window.engine._worker.run(partial(let_go.wait, 60.0))
    try:
        yield
    finally:
        let_go.set()


@pytest.fixture
def studio(open_window, qtbot):
    """A studio with selected outputs, which can hide a panel and bring it forward again."""
    window = open_window()
    window.document.look(replace(window.document.view, outputs=SELECTED))
    window.document.edit("Choose", replace(window.document.design, actuation=CHOSEN))

    def hide(name):
        name = name.partition("/")[0]
        window.docks[name].hide()
        qtbot.waitUntil(lambda: not window.panel(name).isVisible())

    def make_louder():
        design = window.document.design
        clips = design.inputs[0].clips
        other = 93.0 if clips[0].waveform.frequency_hz != 93.0 else 94.0
        waveform = replace(clips[0].waveform, frequency_hz=other)
        clips = (replace(clips[0], waveform=waveform), *clips[1:])
        window.document.edit("Other", design.with_input(0, clips=clips, amplitude=2.5))

    window.look_at, window.hide_panel = partial(look_at, window, qtbot), hide
    window.settled, window.edit_all = partial(rest, window), make_louder
    return window


def offers(panel):
    return [button.isEnabled() for button in panel.findChildren(CopyButton)]


def looks_late(panel):
    """Whether lateness is seen: the panel looks otherwise without it."""
    shown = panel.view if isinstance(panel, AnalysisPanel) else panel
    late = panel.grab().toImage()
    shown._staleness.set_stale(False)
    without = panel.grab().toImage()
    shown._staleness.set_stale(True, at_once=True)
    return late != without


def test_what_comes_into_sight_with_older_results_says_so_until_the_newer_ones_are_there(
    studio, qtbot
):
    for name in COMPUTED:
        panel = studio.look_at(name)
        studio.settled()
        qtbot.waitUntil(lambda waiting=panel: not waiting.is_stale)
        offered = offers(panel)
        studio.hide_panel(name)
        with held(studio):
            studio.edit_all()
            studio.look_at(name)
            assert panel.is_stale, name
            assert not any(offers(panel)), name
            assert looks_late(panel), name
        studio.settled()
        qtbot.waitUntil(lambda waiting=panel: not waiting.is_stale)
        assert offers(panel) == offered, name
        studio.hide_panel(name)


def test_another_selection_makes_late_what_shows_selected_outputs_and_nothing_else(studio, qtbot):
    for name in COMPUTED:
        studio.look_at(name)
        studio.settled()
        studio.hide_panel(name)
    with held(studio):
        studio.document.look(replace(studio.document.view, outputs=(30, 31, 32, 33)))
        late, handed_out = set(), set()
        for name in COMPUTED:
            panel = studio.look_at(name)
            late |= {name} if panel.is_stale else set()
            handed_out |= {name} if panel.is_stale and any(offers(panel)) else set()
    assert late == OF_OUTPUTS
    assert handed_out == set()
    for name in COMPUTED:
        panel = studio.look_at(name)
        qtbot.waitUntil(lambda waiting=panel: not waiting.is_stale, timeout=30_000)


@pytest.mark.parametrize("name", [*OF_LIMBS, "compare"])
def test_what_compares_comes_into_sight_without_what_is_older(name, studio, qtbot):
    studio.do("store_snapshot_1")
    studio.edit_all()
    panel = studio.look_at(name)
    studio.settled()
    offered = offers(panel)
    fresh = panel.grab().toImage()
    studio.hide_panel(name)
    with held(studio):
        studio.edit_all()
        studio.look_at(name)
        assert not any(offers(panel))
        assert panel.grab().toImage() != fresh
    studio.settled()
    qtbot.waitUntil(lambda: offers(panel) == offered, timeout=30_000)


def test_a_late_clip_has_no_curve_that_it_does_not_play_and_one_that_was_moved_keeps_its(
    studio, qtbot
):
    panel = studio.look_at("timeline")
    studio.settled()
    clip = studio.document.design.inputs[0].clips[0].id
    lanes = panel.lanes
    assert clip in lanes.content.waveforms
    with held(studio):
        design = studio.document.design
        moved = replace(design.inputs[0].clips[0], onset_s=0.2)
        studio.document.edit("Move", design.with_input(0, clips=(moved,)))
        qtbot.waitUntil(lambda: panel.is_stale)
        assert clip in lanes.content.waveforms
        assert not lanes.content.awaited
        through = replace(moved, effects=(Fade(),))
        studio.document.edit("Fade", design.with_input(0, clips=(through,)))
        assert lanes.content.awaited == {clip}
        studio.document.undo_stack.undo()
        assert not lanes.content.awaited
        studio.edit_all()
        assert clip not in lanes.content.waveforms
        assert lanes.content.awaited == {clip}
    studio.settled()
    qtbot.waitUntil(lambda: not panel.is_stale)
    assert clip in lanes.content.waveforms
    assert not lanes.content.awaited
