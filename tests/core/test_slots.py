"""Designs side by side: each in a graph of its own, with what they share read and made once."""

import gc
from dataclasses import asdict, replace
from weakref import ref

import pytest

from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.quantities import graphs_that_share, new_graph, sources
from skinsource.engine.shared import Shared

VIEW = View(axes="xyz", method="pca", outputs=(29, 52))
SHOWN = (
    "input_waveforms",
    "response_time_s",
    "selected_spectra",
    "selected_traces",
    "surface_levels_db",
    "trace_error",
)
ONE = Design(
    limb="synthetic-1",
    inputs=(
        track(location=7, waveform=Tone(frequency_hz=100.0)),
        track(location=3, waveform=Noise(seed=2), amplitude=-0.5),
    ),
)
OTHER = Design(
    limb="synthetic-2",
    inputs=(track(location=9, waveform=Tap()), track(location=3, waveform=Tone(duration_s=0.4))),
)
SAME_LIMB = replace(OTHER, limb="synthetic-1")


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


@pytest.mark.parametrize("other", [OTHER, SAME_LIMB], ids=["two limbs", "two designs"])
def test_alternating_costs_what_each_costs_alone(other):
    one_edits, other_edits = edits(ONE, 12), edits(other, 12)
    alone = [
        costs(new_graph(), [first, *designs])[1:]
        for first, designs in ((ONE, one_edits), (other, other_edits))
    ]
    make = graphs_that_share()
    left, right = make(), make()
    costs(left, [ONE])
    costs(right, [other])
    for k in range(12):
        for graph, designs, least in ((left, one_edits, alone[0]), (right, other_edits, alone[1])):
            # What the one has drawn or searched already, the other need not.
            [cost] = costs(graph, [designs[k]])
            assert all(cost[name] <= most for name, most in least[k].items()), k


def test_flipping_between_two_designs_without_an_edit_costs_nothing():
    make = graphs_that_share()
    left, right = make(), make()
    for graph, design in ((left, ONE), (right, OTHER)) * 3:
        [work] = costs(graph, [design])
    assert not any(work.values())


def test_two_designs_on_one_limb_read_transform_and_map_it_once():
    make = graphs_that_share()
    left, right = make(), make()
    costs(left, [ONE])
    [work] = costs(right, [ONE.with_input(0, amplitude=2.0)])
    assert work["bytes_read"] == work["samples_drawn"] == 0
    # The check of traces searches anew each time.
    made_right = make()
    made_right.evaluate(SHOWN[:-1], sources(ONE, VIEW))
    assert made_right.work.search_transforms == 0
    assert work["operators_built"] == 0
    given = sources(ONE, VIEW)
    for name in ("limb_data", "surface"):
        values = [graph.evaluate({name}, given)[name] for graph in (left, right)]
        assert values[0] is values[1]


def test_results_are_the_same_bits_shared_or_not():
    make = graphs_that_share()
    left, right = make(), make()
    for edited, other in zip(edits(ONE, 6), edits(SAME_LIMB, 6), strict=True):
        for graph, design in ((left, edited), (right, other)):
            quantities = graph.evaluate(("output_rms", "selected_traces"), sources(design, VIEW))
            anew = new_graph().evaluate(("output_rms", "selected_traces"), sources(design, VIEW))
            for name, values in quantities.items():
                assert (values == anew[name]).all()


def test_a_limb_that_no_graph_looks_at_is_freed_with_its_spectra():
    shared = Shared()
    left, right = new_graph(shared), new_graph(shared)
    costs(left, [ONE])
    costs(right, [OTHER])
    limb = ref(left.evaluate({"limb_data"}, sources(ONE, VIEW))["limb_data"])
    spectra = shared.remembered().responses
    held = spectra.held_bytes
    costs(left, [OTHER])
    gc.collect()
    assert limb() is None
    costs(left, [OTHER.with_input(0, location=11)])
    assert spectra.held_bytes < held
