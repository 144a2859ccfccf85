from dataclasses import replace
from threading import Event

import numpy as np
import pytest
from PySide6.QtWidgets import QWidget

from skinsource.base.errors import InvalidInputError
from skinsource.design.design import Design, track
from skinsource.design.signal_path import UnplayableInput
from skinsource.engine.graph import Graph
from skinsource_gui.state.conductor import Conductor, PanelController
from skinsource_gui.state.document import Document
from skinsource_gui.state.engine import Engine
from skinsource_gui.state.panel import Panel, PanelRegistry


def loudness(inputs):
    if any(track.amplitude == 13 for track in inputs):
        raise InvalidInputError("thirteen is refused")
    if any(track.amplitude == 14 for track in inputs):
        raise ValueError("shapes (3,) (4,)")
    return np.array([track.amplitude for track in inputs])


def colours(inputs):
    return tuple(track.colour for track in inputs)


def unplayable_inputs(inputs):
    return tuple(
        UnplayableInput(track.id, "too loud", track.location)
        for track in inputs
        if track.amplitude == 15
    )


class Recorder(Panel):
    def __init__(self, *needs):
        super().__init__()
        self.name = "+".join(needs)
        self._needs = frozenset(needs)
        self.results, self.problems, self.stale, self.states = [], [], False, []
        self.story, self.marks, self.newer = [], [], 0
        self.unplayable = ()

    @property
    def needs(self):
        return self._needs

    def show_state(self, design, view):
        self.states.append(design)
        self.story.append("state")
        self.update()

    def show_results(self, results):
        self.results.append(results)
        self.story.append("results")
        self.update()

    def paintEvent(self, event):
        self.story.append("painted")

    def show_stale(self, stale):
        self.stale = stale
        self.marks.append(stale)

    def show_newer(self):
        self.newer += 1

    def show_problem(self, reason):
        self.problems.append(reason)

    def show_unplayable(self, unplayable):
        self.unplayable = unplayable


@pytest.fixture
def stage(qtbot):
    window = QWidget()
    qtbot.addWidget(window)
    document = Document(Design(limb="synthetic-1", inputs=(track(location=7),)))
    gate = Event()
    gate.set()

    def gated_loudness(inputs):
        assert gate.wait(5)
        return loudness(inputs)

    gated_loudness.__name__ = "loudness"
    graph = Graph(gated_loudness, colours, unplayable_inputs)
    engine = Engine(lambda: graph)
    loud, colourful = Recorder("loudness"), Recorder("colours")
    for panel in (loud, colourful):
        panel.setParent(window)
    colourful.move(0, loud.height())
    panels = PanelRegistry({"loud": lambda: loud, "colourful": lambda: colourful})
    panels["loud"], panels["colourful"]
    conductor = Conductor(document, engine, panels)
    PanelController(document, panels)
    window.show()
    qtbot.waitUntil(lambda: not engine.busy)

    class Stage:
        def amplitude(self, value):
            document.edit("amplitude", document.design.with_input(0, amplitude=value))
            qtbot.waitUntil(lambda: not engine.busy)

    stage = Stage()
    stage.document, stage.engine, stage.graph, stage.gate = document, engine, graph, gate
    stage.loud, stage.colourful, stage.conductor = loud, colourful, conductor
    yield stage
    gate.set()
    engine.close()


def test_an_edit_is_painted_once_with_its_results_if_they_are_quick(qtbot, stage):
    qtbot.waitUntil(lambda: stage.loud.story[-1] == "painted")
    stage.loud.story.clear()
    stage.amplitude(2.0)
    qtbot.waitUntil(lambda: stage.loud.story[-1] == "painted")
    assert stage.loud.story == ["state", "results", "painted"]


def test_an_edit_is_painted_at_once_if_its_results_take_long(qtbot, stage):
    qtbot.waitUntil(lambda: stage.loud.story[-1] == "painted")
    stage.loud.story.clear()
    stage.gate.clear()
    stage.document.edit("amplitude", stage.document.design.with_input(0, amplitude=2.0))
    qtbot.waitUntil(lambda: stage.loud.story[-1] == "painted")
    stage.gate.set()
    qtbot.waitUntil(lambda: len(stage.loud.story) == 4)
    assert stage.loud.story == ["state", "painted", "results", "painted"]


def test_results_of_an_edit_that_is_not_the_last_are_marked_as_stale(qtbot, stage):
    drawn = len(stage.loud.results)
    stage.loud.marks.clear()
    stage.gate.clear()
    for amplitude in (2.0, 3.0):
        stage.document.edit("louder", stage.document.design.with_input(0, amplitude=amplitude))
    assert stage.loud.marks == [True, True]
    stage.gate.set()
    qtbot.waitUntil(lambda: len(stage.loud.results) == drawn + 2)
    shown = [results["loudness"].tolist() for results in stage.loud.results[drawn:]]
    assert shown == [[2.0], [3.0]]
    # Marked when they were asked for, twice; the first results are not those of the last edit.
    assert stage.loud.marks == [True, True, True, False]
    # They are newer than what was drawn before: those that are still to come are given time.
    assert stage.loud.newer == 1


def test_what_a_panel_ends_while_it_is_told_is_a_later_step_and_all_panels_know_it(stage):
    document, start = stage.document, stage.document.design

    def end_typing(design, view):
        if not design.title:
            document.edit("title", replace(design, title="Soft"))

    stage.loud.show_state = end_typing
    document.edit("louder", start.with_input(0, amplitude=2.0))
    assert stage.colourful.states[-1] == document.design
    assert (document.design.title, document.design.inputs[0].amplitude) == ("Soft", 2.0)
    assert [document.undo_stack.text(step) for step in range(2)] == ["louder", "title"]
    stage.loud.show_state = lambda *_: None
    document.go_to(0)
    assert document.design == start


def test_what_cannot_be_computed_is_not_stale_and_what_replaces_it_is_awaited(qtbot, stage):
    stage.amplitude(2.0)
    with qtbot.waitSignal(stage.conductor.failed) as failed:
        stage.amplitude(13)
    assert failed.args == stage.loud.problems == ["thirteen is refused"]
    assert not stage.loud.stale
    drawn = len(stage.colourful.results)
    stage.gate.clear()
    stage.document.edit("softer", stage.document.design.with_input(0, amplitude=2.0))
    # The same as before, but the problem is what is seen.
    assert stage.loud.stale
    stage.gate.set()
    qtbot.waitUntil(lambda: not stage.loud.stale)
    assert len(stage.colourful.results) == drawn + 1  # its picture was emptied


def test_panels_are_told_which_inputs_results_are_without(stage):
    stage.amplitude(15)
    unplayable = (UnplayableInput(1, "too loud", 7),)
    assert (stage.loud.unplayable, stage.colourful.unplayable) == (unplayable, unplayable)
    assert stage.loud.results[-1]["loudness"].tolist() == [15.0]
    stage.amplitude(13)
    assert stage.loud.unplayable == ()


def test_a_fault_of_the_studio_is_told_as_one(qtbot, stage):
    with qtbot.waitSignal(stage.conductor.failed) as failed:
        stage.amplitude(14)
    assert failed.args[0].startswith("The studio made a mistake: ValueError")


def test_a_panel_that_makes_a_mistake_says_so_and_recovers_and_the_others_show_theirs(qtbot, stage):
    show = stage.loud.show_results

    def fail(results):
        raise TypeError("no colour")

    stage.loud.show_results = fail
    before = len(stage.colourful.results)
    with qtbot.captureExceptions() as caught:
        stage.document.edit(
            "both", stage.document.design.with_input(0, amplitude=2.0).with_input(0, colour=3)
        )
        qtbot.waitUntil(lambda: not stage.engine.busy)
    assert [kind for kind, *_ in caught] == [TypeError]
    assert "TypeError: no colour" in stage.loud.problems[-1]
    assert not stage.loud.stale
    assert len(stage.colourful.results) == before + 1
    stage.loud.show_results = show
    stage.amplitude(3.0)
    assert stage.loud.results[-1]["loudness"].tolist() == [3.0]
    assert not stage.loud.stale


def test_what_takes_too_long_on_a_limb_is_not_asked_for_and_all_else_is(qtbot, stage, monkeypatch):
    shown = len(stage.loud.results)
    stage.gate.clear()
    stage.document.edit("amplitude", stage.document.design.with_input(0, amplitude=3.0))
    module = "skinsource_gui.state.conductor"
    monkeypatch.setattr(f"{module}.FROM_THE_LIMB", frozenset({"loudness"}))
    monkeypatch.setattr(f"{module}.too_large", lambda limb: f"{limb} is too large")
    runs, n_results = stage.graph.runs["loudness"], len(stage.colourful.results)
    stage.document.edit("colour", stage.document.design.with_input(0, colour=4))
    stage.gate.set()
    qtbot.waitUntil(lambda: not stage.engine.busy)
    # What was on its way comes too late to take the place of the reason.
    assert stage.graph.runs["loudness"] == runs + 1
    assert stage.loud.problems[-1] == "synthetic-1 is too large"
    assert len(stage.loud.results) == shown
    assert stage.colourful.problems == []
    assert stage.colourful.results[-1]["colours"] == (4,)
    assert len(stage.colourful.results) > n_results
    # Another limb is shown in all panels again.
    monkeypatch.setattr(f"{module}.too_large", lambda limb: "")
    stage.amplitude(2.0)
    assert list(stage.loud.results[-1]["loudness"]) == [2.0]
