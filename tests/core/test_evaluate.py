"""Quantities of designs for scripts: right, remembered, and the same from any thread."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import InvalidInputError
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.evaluation import MOST_GRAPHS, Evaluator
from skinsource.engine.quantities import new_graph, sources

VIEW = ss.View(outputs=(29, 52))
QUANTITIES = ("output_levels_db", "selected_traces")


def scene(n_inputs: int = 5, limb: str = "synthetic-1", first_hz: float = 80.0) -> ss.Design:
    inputs = tuple(
        ss.track(location=k + 1, waveform=Tone(frequency_hz=first_hz + 17.0 * k))
        for k in range(n_inputs)
    )
    return ss.Design(limb=limb, inputs=inputs)


def with_frequency(design: ss.Design, index: int, frequency_hz: float) -> ss.Design:
    clip = design.inputs[index].clips[0]
    return design.with_clip(clip.id, waveform=Tone(frequency_hz=frequency_hz))


def directly(design: ss.Design, view: ss.View = VIEW) -> dict:
    return new_graph().evaluate(QUANTITIES, sources(design, view))


def assert_same(values: dict, expected: dict) -> None:
    assert values.keys() == expected.keys()
    levels = values["output_levels_db"] - expected["output_levels_db"]
    assert np.abs(levels).max() < 1e-9
    largest = np.abs(expected["selected_traces"]).max()
    assert np.abs(values["selected_traces"] - expected["selected_traces"]).max() < 1e-12 * largest


def test_a_sweep_of_any_input_is_right_at_each_step():
    evaluator, design = Evaluator(), scene()
    for index, frequency_hz in [(3, 100.0), (3, 110.0), (1, 200.0), (1, 210.0), (4, 50.0)]:
        design = with_frequency(design, index, frequency_hz)
        assert_same(evaluator.evaluate(design, QUANTITIES, VIEW), directly(design))


def test_a_step_of_a_sweep_costs_what_an_edit_costs_in_the_studio():
    design, index = scene(), 3
    graph, view = new_graph(), replace(VIEW, selected_inputs=(design.inputs[index].id,))
    evaluator = Evaluator()
    for frequency_hz in (100.0, 110.0, 120.0):
        design = with_frequency(design, index, frequency_hz)
        graph.evaluate(QUANTITIES, sources(design, view))
        evaluator.evaluate(design, QUANTITIES, VIEW)
    assert evaluator.work == graph.work
    assert evaluator.work.forward_transforms <= 4
    assert evaluator.work.bytes_read == 0


def test_the_same_again_costs_nothing_and_another_view_reads_nothing():
    evaluator, design = Evaluator(), scene()
    evaluator.evaluate(design, QUANTITIES, VIEW)
    evaluator.evaluate(design, QUANTITIES, VIEW)
    assert evaluator.work.rules_run == 0
    evaluator.evaluate(design, QUANTITIES, replace(VIEW, method="mag"))
    assert evaluator.work.forward_transforms == evaluator.work.bytes_read == 0


def test_two_sweeps_in_turn_cost_what_each_costs_alone():
    alone, both = Evaluator(), Evaluator()
    first, other = scene(), scene(4, "synthetic-2", first_hz=211.0)
    for frequency_hz in (100.0, 110.0, 120.0):
        first = with_frequency(first, 2, frequency_hz)
        other = with_frequency(other, 0, frequency_hz + 3.0)
        alone.evaluate(first, QUANTITIES, VIEW)
        both.evaluate(other, QUANTITIES, VIEW)
        both.evaluate(first, QUANTITIES, VIEW)
    assert both.work == alone.work


def test_only_a_few_designs_are_remembered():
    evaluator = Evaluator()
    designs = [scene(3, first_hz=60.0 + 31.0 * k) for k in range(MOST_GRAPHS + 1)]
    for design in designs:
        evaluator.evaluate(design, QUANTITIES, VIEW)
    evaluator.evaluate(designs[1], QUANTITIES, VIEW)
    assert evaluator.work.rules_run == 0
    evaluator.evaluate(designs[0], QUANTITIES, VIEW)
    assert evaluator.work.rules_run > 0


def test_threads_take_turns_and_each_gets_its_own():
    evaluator = Evaluator()
    designs = [scene(2, first_hz=60.0 + 7.0 * k) for k in range(8)]
    with ThreadPoolExecutor(4) as pool:
        quantities = list(
            pool.map(lambda design: evaluator.evaluate(design, QUANTITIES, VIEW), designs)
        )
    for design, values in zip(designs, quantities, strict=True):
        assert_same(values, directly(design))


def test_what_nothing_computes_is_refused_with_a_hint():
    with pytest.raises(InvalidInputError, match="perhaps 'output_levels_db'"):
        ss.evaluate(scene(1), "output_level_db")


def test_after_a_failure_the_limb_is_opened_anew(monkeypatch):
    evaluator, design = Evaluator(), scene(1, "measured-1")
    with pytest.raises(ss.SkinSourceError, match="not installed"):
        evaluator.evaluate(design, QUANTITIES)
    monkeypatch.setattr(
        "skinsource.engine.shared.load_limb", lambda *_: ss.load_limb("synthetic-3")
    )
    assert np.isfinite(evaluator.evaluate(design, QUANTITIES)["output_levels_db"]).all()
