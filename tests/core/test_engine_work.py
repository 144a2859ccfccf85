"""What an edit makes the engine do and remember, and above all what it leaves out."""

import gc
import os
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, replace
from inspect import signature
from itertools import count
from threading import Event, get_ident
from weakref import ref

import numpy as np
import pytest

import skinsource as ss
from skinsource import Design, View, track
from skinsource.base.conventions import N_AXES, N_OUTPUTS
from skinsource.base.errors import InvalidInputError, Stopped
from skinsource.base.run_limited import resident_bytes
from skinsource.base.work import counting
from skinsource.design.waveforms import Noise, Tap, Tone
from skinsource.engine import memory as budgets
from skinsource.engine.drives import Drives
from skinsource.engine.evaluation import MOST_GRAPHS, Evaluator, forget_evaluated
from skinsource.engine.memory import ENTRY_BYTES, SURFACES_BYTES, Memory, untouched_array
from skinsource.engine.quantities import RULES, graphs_that_share, new_graph, sources
from skinsource.engine.shared import Shared
from skinsource.engine.spectra import ResponseSpectra
from skinsource.engine.transforms import (
    Blocks,
    ChannelsOnDemand,
    length_at_once,
    rows_of,
    run_on_two_threads,
)
from skinsource.limbs.synthetic import load_synthetic_limb

DESIGN = Design(
    scaling="upstream",
    limb="synthetic-1",
    inputs=(
        track(location=7, waveform=Tone(frequency_hz=100.0)),
        track(location=3, waveform=Noise(seed=2), amplitude=-0.5),
        track(location=18, waveform=Tap(), onset_s=0.1),
    ),
)
OTHER = Design(
    limb="synthetic-2",
    inputs=(track(location=9, waveform=Tap()), track(location=3, waveform=Tone(duration_s=0.4))),
)
LONG = DESIGN.with_clip(1, waveform=Tone(frequency_hz=100.0, duration_s=14.0)).with_clip(
    2, onset_s=6.0
)
VIEW = View(axes="xyz", method="pca", outputs=(29, 52), selected_inputs=(2,))
LOUDEST = replace(VIEW, span="loudest")
ALL = ("output_rms", "selected_traces", "selected_spectra")
SHOWN = (*ALL, "input_waveforms", "response_time_s", "surface_levels_db")
MUTED = DESIGN.adding(track(location=11, waveform=Noise(seed=77), muted=True))
NEW_NOISE = DESIGN.with_clip(2, waveform=Noise(seed=3))
NO_TRANSFORM = {"forward_transforms": 0, "inverse_transforms": 0}
LEVELS = ("output_rms",)


@pytest.mark.parametrize(
    ("design", "view", "quantities", "expected"),
    [
        (DESIGN, VIEW, ALL, {"rules_run": 0}),
        (DESIGN.with_input(1, amplitude=0.7), VIEW, ALL, {**NO_TRANSFORM, "samples_drawn": 0}),
        (DESIGN.with_input(1, muted=True), VIEW, ALL, NO_TRANSFORM),
        (MUTED, VIEW, ALL, {**NO_TRANSFORM, "samples_drawn": 0, "bytes_read": 0}),
        (NEW_NOISE, VIEW, LEVELS, {"forward_transforms": 1, "samples_drawn": 260}),
        # However many outputs: the drive over exactly the samples of the response.
        (NEW_NOISE, VIEW, ("axis_spectra",), {"forward_transforms": 2}),
        (DESIGN.with_clip(2, onset_s=0.05), VIEW, LEVELS, {**NO_TRANSFORM, "samples_drawn": 0}),
        # Two parts (the selected input and the others) of three axes of the new output.
        (
            DESIGN,
            replace(VIEW, outputs=(29, 52, 61)),
            ("selected_traces",),
            {"inverse_transforms": 6},
        ),
        (DESIGN, replace(VIEW, method="rms"), ALL, NO_TRANSFORM),
        (DESIGN, LOUDEST, LEVELS, {"inverse_transforms": 72}),
        (DESIGN, replace(LOUDEST, axes="z"), LEVELS, {"inverse_transforms": 72}),
        (DESIGN, replace(LOUDEST, method="mag"), LEVELS, {"inverse_transforms": 216}),
        (DESIGN, VIEW, ("axis_surface_levels_db",), NO_TRANSFORM),
        (DESIGN, replace(VIEW, playhead_s=36.0), ("moving_z",), {"inverse_transforms": 0}),
    ],
    ids=lambda value: None,
)
def test_an_edit_does_no_more_than_it_must(design, view, quantities, expected):
    graph = new_graph()
    graph.evaluate((*ALL, "surface_levels_db", "moving_z"), sources(DESIGN, VIEW))
    graph.evaluate(quantities, sources(design, view))
    assert {name: getattr(graph.work, name) for name in expected} == expected


def test_the_search_for_the_maximum_transforms_few_channels_and_a_map_none():
    graph = new_graph()
    graph.evaluate(LEVELS, sources(replace(DESIGN, scaling="relative"), VIEW))
    assert graph.work.inverse_transforms == 0
    graph.evaluate(LEVELS, sources(DESIGN, VIEW))
    graph.evaluate(LEVELS, sources(NEW_NOISE, VIEW))
    assert 0 < graph.work.search_transforms == graph.work.inverse_transforms < 216 / 4


def test_a_limb_is_read_where_an_input_that_is_heard_needs_it():
    graph, given = new_graph(), sources(DESIGN.with_input(2, muted=True), VIEW)
    graph.evaluate({"limb_map", "input_waveforms", "response_time_s"}, given)
    assert graph.work.bytes_read == 0
    assert not {"others_spectrum", "edited_response", "surface"} & set(graph.runs)
    for design, places in ((DESIGN.with_input(2, muted=True), 2), (DESIGN, 1)):
        graph.evaluate(LEVELS, sources(design, VIEW))
        assert graph.work.bytes_read == places * 72 * 3 * 522 * 8


def test_what_is_hidden_does_not_run_and_nothing_else_is_given():
    graph, given = new_graph(), sources(DESIGN, VIEW)
    graph.evaluate({"selected_traces"}, given)
    unneeded = {"selected_spectra", "output_rms", "output_levels_db", "surface", "limb_map"}
    assert not unneeded & set(graph.runs)
    looked = replace(VIEW, time_range_s=(0.0, 0.1), panels=(("skin", (("map_style", "sensors"),)),))
    texts = dict.fromkeys(("title", "author", "notes", "licence"), "words")
    assert sources(replace(DESIGN, **texts), looked) == given
    rules = (*RULES, *Shared().rules())
    needed = {name for rule in rules for name in signature(rule).parameters}
    assert given.keys() - {"span"} <= needed


def test_old_fields_go_at_once_without_the_garbage_collector():
    graph, given = new_graph(), sources(DESIGN, VIEW)
    gc.collect()
    gc.disable()
    try:
        graph.evaluate(ALL, given)
        old = ref(graph.evaluate({"edited_channels"}, given)["edited_channels"])
        spectrum = ref(graph.evaluate({"others_spectrum"}, given)["others_spectrum"])
        changed = DESIGN.with_input(0, location=9).with_clip(2, waveform=Noise(seed=9))
        graph.evaluate(ALL, sources(changed, VIEW))
        assert old() is None
        assert spectrum() is None
    finally:
        gc.enable()


def edits(design: Design, count: int) -> list[Design]:
    """Edits of every kind, in turn."""
    changes = (
        lambda k: design.with_input(0, amplitude=1.0 + k / 7),
        lambda k: design.with_clip(1, onset_s=k / 130),
        lambda k: design.with_clip(1, waveform=Noise(seed=100 + k)),
    )
    return [changes[k % len(changes)](k) for k in range(count)]


def costs(graph, designs: list[Design]) -> list[dict]:
    counts = []
    for design in designs:
        graph.evaluate(SHOWN, sources(design, VIEW))
        counts.append(asdict(graph.work))
    return counts


@pytest.mark.parametrize(
    "other", [OTHER, replace(OTHER, limb="synthetic-1")], ids=["two limbs", "one"]
)
def test_designs_in_turn_cost_what_each_costs_alone_and_nothing_without_an_edit(other):
    make = graphs_that_share()
    graphs = make(), make()
    all_edits = [[design, *edits(design, 6)] for design in (DESIGN, other)]
    alone = [costs(new_graph(), designs) for designs in all_edits]
    for k in range(7):
        for graph, designs, least in zip(graphs, all_edits, alone, strict=True):
            # What the one has drawn or searched already, the other need not.
            [cost] = costs(graph, [designs[k]])
            assert all(cost[name] <= most for name, most in least[k].items()), k
    for graph, designs in zip(graphs, all_edits, strict=True):
        assert not any(costs(graph, [designs[-1]])[0].values())


def test_two_designs_on_one_limb_read_transform_and_map_it_once():
    make = graphs_that_share()
    left, right = make(), make()
    costs(left, [DESIGN])
    [work] = costs(right, [DESIGN.with_input(0, amplitude=2.0)])
    spared = ("bytes_read", "samples_drawn", "search_transforms", "operators_built")
    assert [work[name] for name in spared] == [0] * 4
    given = sources(DESIGN, VIEW)
    for name in ("limb_data", "surface"):
        assert left.evaluate({name}, given)[name] is right.evaluate({name}, given)[name]


def test_a_limb_that_no_graph_looks_at_is_freed_with_its_spectra():
    shared = Shared()
    left, right = new_graph(shared), new_graph(shared)
    costs(left, [DESIGN])
    costs(right, [OTHER])
    limb = ref(left.evaluate({"limb_data"}, sources(DESIGN, VIEW))["limb_data"])
    held = shared.remembered().responses._sum()
    costs(left, [OTHER])
    gc.collect()
    assert limb() is None
    assert shared.remembered().responses._sum() < held


def test_every_memory_is_held_to_its_budget_and_all_to_256_mebibytes():
    shared = Shared()
    remembered = shared.remembered()
    drives = remembered.drives
    held_to = [
        remembered.responses._budget_bytes,
        drives._drawn._budget_bytes,
        drives._spectra._budget_bytes,
        drives.clips._known._budget_bytes,
        remembered.exact_spectra._known._budget_bytes,
        remembered.gains._budget_bytes,
        shared._surfaces._budget_bytes,
    ]
    assert sum(held_to) <= 256 * 2**20
    operators = [
        new_graph().evaluate({"surface"}, sources(design, VIEW))["surface"].weights
        for design in (DESIGN, OTHER)
    ]
    held = [each.data.nbytes + each.indices.nbytes + each.indptr.nbytes for each in operators]
    assert sum(held) <= SURFACES_BYTES


@pytest.mark.parametrize("n_places", [1, 4, 5, 10, 19, 20])
def test_whatever_is_transformed_at_once_fits(n_places):
    longest = max(n for n in range(500, 40_000, 97) if length_at_once(n, n_places, 216) is not None)
    n_bins = length_at_once(longest, n_places, 216) // 2 + 1
    held = n_places * N_OUTPUTS * N_AXES * n_bins * 16
    assert held <= budgets.RESPONSE_SPECTRA_BYTES
    # Nor is less transformed at once than there is room for.
    assert n_places < 5 or held > budgets.RESPONSE_SPECTRA_BYTES / 2


def test_the_least_recently_used_goes_first():
    memory = Memory[bytes](budget_bytes=2 * ENTRY_BYTES + 10, size_of=len)
    memory.add("a", b"1234")
    memory.add("b", b"1234")
    assert memory.find("a") == b"1234"
    memory.add("c", b"1234")
    assert (memory.find("a"), memory.find("b"), memory.find("c")) == (b"1234", None, b"1234")
    assert memory.held_bytes == 2 * ENTRY_BYTES + 8


ONE = 216 * (576 // 2 + 1) * 16


def transformed(spectra, limb, locations, scaling="relative", n_fft=576) -> int:
    """How many responses a request transforms."""
    with counting() as work:
        responses = spectra.of(limb, locations, scaling, n_fft)
    for response, place in zip(responses, locations, strict=True):
        expected = np.fft.rfft(response.taps[:2], n_fft)
        np.testing.assert_allclose(response.values[:2], expected, rtol=0, atol=1e-12)
        assert scaling == "probe" or (response.taps == limb.response_to(place)).all()
    return work.forward_transforms // 216


def test_spectra_that_were_not_used_for_longest_go_first_with_their_limb_or_when_there_is_no_room():
    first, second = load_synthetic_limb(1), load_synthetic_limb(2)
    spectra = ResponseSpectra(budget_bytes=3 * ONE)
    asked = [(first, [1]), (first, [1], "probe"), (second, [1]), (first, [1]), (first, [2])]
    assert [transformed(spectra, *each) for each in asked] == [1, 1, 1, 0, 1]
    assert spectra._sum() == 3 * ONE
    asked = [(first, [2, 1, 1]), (first, [1], "probe"), (first, [1], "upstream"), (second, [1])]
    assert [transformed(spectra, *each) for each in asked] == [0, 0, 0, 1]
    # More places than there is room for: those that are in use stay.
    asked = [(second, [3]), (second, [4]), (second, [3, 4, 5]), (second, [5, 4, 3])]
    assert [transformed(spectra, *each) for each in asked] == [1, 1, 1, 0]
    stack = spectra.stack(second, (3, 7), "relative", 576)
    assert spectra.stack(second, (3, 7), "relative", 576) is stack
    assert 0 < spectra._sum() <= 3 * ONE
    del second, stack, asked
    gc.collect()
    assert spectra._sum() == 0


def test_what_has_no_room_is_freed_before_its_place_is_taken(monkeypatch):
    limb, spectra, freed = load_synthetic_limb(1), ResponseSpectra(budget_bytes=3 * ONE), []
    other = ref(spectra.of(limb, [9], "upstream", 768)[0])
    first, second = map(ref, spectra.of(limb, [1, 2], "upstream", 576))

    def seen(shape):
        freed.append((other() is None, first() is None, second() is None))
        return np.empty(shape, np.complex128)

    monkeypatch.setattr("skinsource.engine.spectra.untouched_array", seen)
    spectra.of(limb, [2, 3], "upstream", 576)
    spectra.of(limb, [2, 3, 4], "upstream", 576)
    assert freed == [(True, False, False), (True, True, False)]


def test_spectra_of_all_lengths_share_calibrated_responses_and_all_engines_one_budget():
    limb, spectra = load_synthetic_limb(1), ResponseSpectra()
    (short,), (long,) = (spectra.of(limb, [3], "probe", n_fft) for n_fft in (768, 1536))
    assert short.taps is long.taps
    assert Shared().remembered().responses is Shared().remembered().responses


def test_traces_of_all_channels_that_are_requested_in_turn_are_in_memory_once():
    rows = np.ones((72, 3, 577), np.complex128)
    vibration = ChannelsOnDemand(
        lambda channels: rows_of(rows, channels), 1152, np.ones(1152, bool)
    )
    every = tuple(range(1, 73))
    for outputs in (every[:40], every, (5, 7), every):
        vibration.traces(outputs, (0, 1, 2))
        vibration.trace_spectra(outputs, (0, 1, 2))
    for known, (_, latest) in (
        (vibration._traces, vibration._latest_traces),
        (vibration._trace_spectra, vibration._latest_spectra),
    ):
        assert all(np.shares_memory(row, latest) for row in known.values())


@pytest.mark.skipif(sys.platform != "linux", reason="Only Linux tells how much memory is in use.")
def test_a_large_array_takes_no_more_memory_than_its_numbers_and_half_a_large_page():
    before = resident_bytes(os.getpid())
    arrays = [untouched_array((72, 3, 769)) for _ in range(8)]
    for each in arrays:
        each[:] = 1.0
    taken = resident_bytes(os.getpid()) - before
    assert taken < 8 * (arrays[0].nbytes + 2**20)


def test_what_moments_follow_from_is_kept_for_the_present_projection_only():
    graph = new_graph()
    for method, products in (("mag", False), ("pca", True), ("mag", False)):
        values = graph.evaluate(
            {"output_rms", "cross_matrix", "own_matrix"},
            sources(DESIGN, replace(VIEW, method=method)),
        )
        for name in ("own_matrix", "cross_matrix"):
            rows = vars(values[name])["_rows"]
            assert rows.shape[1] == (6 if products else 3)


@pytest.mark.parametrize("fitting", [0, 2])
def test_spectra_that_exceed_the_budget_are_given_and_kept_as_far_as_they_fit(fitting):
    limb, spectra = load_synthetic_limb(1), ResponseSpectra(budget_bytes=fitting * ONE)
    for expected in (4, 4 - fitting):
        assert transformed(spectra, limb, [3, 3, 4, 5, 6]) == expected
        assert spectra._sum() == fitting * ONE


def test_a_spectrum_that_is_in_use_when_all_are_dropped_holds_no_memory_of_others():
    limb, spectra = load_synthetic_limb(1), ResponseSpectra(budget_bytes=40 * ONE)
    (used,), _ = spectra.of(limb, [1], "upstream", 4608), spectra.of(limb, [2], "upstream", 4608)
    memory = used.values
    while isinstance(memory.base, np.ndarray):
        memory = memory.base
    assert memory.nbytes == used.values.nbytes


def stop_after(times: int):
    """Asks to stop once it was asked so many times."""
    asked = count()
    return lambda: next(asked) >= times


@pytest.mark.parametrize("view", [VIEW, LOUDEST], ids=["record", "loudest"])
@pytest.mark.parametrize("design", [DESIGN, LONG], ids=["at once", "streamed"])
def test_it_stops_wherever_it_is_asked_to_and_is_right_afterwards(design, view):
    asked = count()
    expected = new_graph().evaluate(ALL, sources(design, view), lambda: next(asked) < 0)
    needed = next(asked)
    # No more than some blocks lie between two chances.
    assert needed > (14 * 1300 / Blocks(522).n_samples if design is LONG else 10)
    graph = new_graph()
    for times in np.linspace(0, needed - 1, 5).astype(int):
        with pytest.raises(Stopped):
            new_graph().evaluate(ALL, sources(design, view), stop_after(times))
    with pytest.raises(Stopped):
        graph.evaluate(ALL, sources(design, view), stop_after(needed // 2))
    # The old request to stop is of no concern any more.
    values = graph.evaluate(ALL, sources(design, view))
    np.testing.assert_array_equal(values["output_rms"], expected["output_rms"])
    np.testing.assert_array_equal(values["selected_traces"], expected["selected_traces"])


def test_each_waveform_in_use_is_drawn_once_however_small_the_memory(monkeypatch):
    monkeypatch.setattr(
        "skinsource.engine.drives.Drives", lambda: Drives(budget_bytes=0, clips_bytes=0)
    )
    graph = new_graph()
    graph.evaluate((*ALL, "input_waveforms", "trace_error"), sources(LONG, VIEW))
    drawn = sum(clip.waveform.samples(1300.0).size for clip in LONG.clips)
    assert graph.work.samples_drawn == drawn


def test_of_a_long_design_the_playhead_asks_for_the_next_block_alone():
    graph, transforms = new_graph(), []
    noise = track(7, Noise(duration_s=60.0, seed=4))
    design = Design(limb="synthetic-1", inputs=(noise,), scaling="relative")
    for playhead_s in (0.0, 13.0, 14.0):
        graph.evaluate({"moving_z"}, sources(design, replace(VIEW, playhead_s=playhead_s)))
        transforms.append(graph.work.inverse_transforms)
    # None of the pass that looked for the largest.
    assert 0 < transforms[1] < transforms[0] / 2
    assert transforms[2] == 0


def test_a_step_of_a_sweep_by_script_costs_what_an_edit_costs_in_the_studio():
    evaluator, both, graph = Evaluator(), Evaluator(), new_graph()
    for k, (design, other) in enumerate(zip(edits(DESIGN, 6), edits(OTHER, 6), strict=True)):
        graph.evaluate(SHOWN, sources(design, replace(VIEW, selected_inputs=(1,))))
        evaluator.evaluate(design, SHOWN, VIEW)
        both.evaluate(other, SHOWN, VIEW)
        both.evaluate(design, SHOWN, VIEW)
        if k > 2:
            assert evaluator.work == graph.work
            # Both designs play the same noise.
            assert replace(both.work, samples_drawn=graph.work.samples_drawn) == graph.work
    evaluator.evaluate(design, SHOWN, VIEW)
    assert evaluator.work.rules_run == 0


def test_scripts_remember_only_a_few_designs():
    evaluator = Evaluator()
    designs = [DESIGN.with_clip(1, onset_s=0.1 * k).with_clip(2, onset_s=0.1 * k) for k in range(5)]
    assert len(designs) == MOST_GRAPHS + 1
    for design in designs:
        evaluator.evaluate(design, LEVELS, VIEW)
    evaluator.evaluate(designs[1], LEVELS, VIEW)
    assert evaluator.work.rules_run == 0
    evaluator.evaluate(designs[0], LEVELS, VIEW)
    assert evaluator.work.rules_run > 0


def test_what_scripts_remember_can_be_dropped():
    limb = ref(ss.evaluate(DESIGN, "limb_data")["limb_data"])
    assert limb() is ss.evaluate(DESIGN, "limb_data")["limb_data"]
    forget_evaluated()
    gc.collect()
    assert limb() is None


def test_threads_of_scripts_take_turns_and_each_gets_its_own():
    evaluator, designs = Evaluator(), edits(DESIGN, 6)
    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(lambda design: evaluator.evaluate(design, LEVELS, VIEW), designs))
    for design, values in zip(designs, found, strict=True):
        expected = new_graph().evaluate(LEVELS, sources(design, VIEW))["output_rms"]
        np.testing.assert_allclose(values["output_rms"], expected, rtol=1e-10)


def test_a_name_that_is_no_quantity_is_refused_with_one_that_is_like_it():
    with pytest.raises(InvalidInputError, match="perhaps 'output_levels_db'"):
        ss.evaluate(DESIGN, "output_level_db")


def test_after_a_failure_the_limb_is_opened_anew(monkeypatch):
    evaluator, design = Evaluator(), replace(DESIGN, limb="measured-1")
    with pytest.raises(ss.SkinSourceError, match="not installed"):
        evaluator.evaluate(design, LEVELS)
    monkeypatch.setattr(
        "skinsource.engine.shared.load_limb", lambda *_: ss.load_limb("synthetic-3")
    )
    assert np.isfinite(evaluator.evaluate(design, LEVELS)["output_rms"]).all()


def test_two_threads_take_part():
    # Each waits until the other has begun: one thread alone would never pass.
    begun, threads = (Event(), Event()), [0, 0]

    def task(own: int) -> None:
        begun[own].set()
        assert begun[1 - own].wait(60)
        threads[own] = get_ident()

    run_on_two_threads([lambda: task(0), lambda: task(1)])
    assert get_ident() in threads
    assert threads[0] != threads[1]


@pytest.mark.parametrize("count", [0, 1, 100])
@pytest.mark.parametrize("alone", [False, True])
def test_all_tasks_are_done_once_with_a_second_thread_or_without(monkeypatch, count, alone):
    def refuse(*_: object) -> None:
        raise RuntimeError("can't start new thread")

    if alone:
        monkeypatch.setattr("concurrent.futures.ThreadPoolExecutor.submit", refuse)
    done: list[int] = []
    run_on_two_threads([lambda k=k: done.append(k) for k in range(count)])
    assert sorted(done) == list(range(count))


@pytest.mark.parametrize("failing", [0, 3, 7])
def test_what_a_task_raises_is_raised_whoever_did_it(failing):
    def task(k: int) -> None:
        if k == failing:
            raise IndexError("that one")

    with pytest.raises(IndexError, match="that one"):
        run_on_two_threads([lambda k=k: task(k) for k in range(8)])
