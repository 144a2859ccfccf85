"""What an edit makes the engine do, and above all what it leaves out."""

import gc
import weakref
from dataclasses import replace

import numpy as np
import pytest

from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.quantities import new_graph, sources

DESIGN = Design(
    scaling="upstream",
    limb="synthetic-1",
    inputs=(
        track(location=7, waveform=Tone(frequency_hz=100.0)),
        track(location=3, waveform=Noise(seed=2), amplitude=-0.5, colour=1),
        track(location=18, waveform=Tap(), onset_s=0.1, colour=2),
    ),
)
VIEW = View(axes="xyz", method="pca", outputs=(29, 52), selected_inputs=(2,))
ALL = ("output_rms", "selected_traces", "selected_spectra")


@pytest.fixture
def show():
    graph = new_graph()

    def show(design=DESIGN, view=VIEW, quantities=ALL):
        return graph.evaluate(quantities, sources(design, view)), graph.work

    show()
    return show


def test_an_amplitude_drag_transforms_nothing_and_draws_nothing(show):
    _, work = show(DESIGN.with_input(1, amplitude=0.7))
    assert (work.forward_transforms, work.inverse_transforms, work.samples_drawn) == (0, 0, 0)


def test_muting_the_selected_input_transforms_nothing(show):
    _, work = show(DESIGN.with_input(1, muted=True))
    assert (work.forward_transforms, work.inverse_transforms) == (0, 0)


def test_a_muted_input_is_neither_drawn_nor_transformed_nor_read(show):
    muted = track(location=11, waveform=Noise(seed=77), muted=True, colour=3)
    _, work = show(DESIGN.adding(muted))
    assert work.forward_transforms == work.inverse_transforms == 0
    assert work.samples_drawn == work.bytes_read == 0


def test_adding_a_muted_input_leaves_every_bit_as_it_was(show):
    before, _ = show()
    after, _ = show(DESIGN.adding(track(location=11, waveform=Noise(seed=77), muted=True)))
    for name in ("output_rms", "selected_traces"):
        np.testing.assert_array_equal(after[name], before[name])
    np.testing.assert_array_equal(after["selected_spectra"][1], before["selected_spectra"][1])


def test_a_map_alone_is_made_without_inverse_transforms_of_outputs():
    graph = new_graph()
    graph.evaluate({"output_rms"}, sources(replace(DESIGN, scaling="relative"), VIEW))
    assert graph.work.inverse_transforms == 0


def test_a_waveform_edit_transforms_only_that_waveform(show):
    _, work = show(DESIGN.with_clip(2, waveform=Noise(seed=3)), quantities=("output_rms",))
    assert work.forward_transforms == 1
    assert work.samples_drawn == 260


def test_spectra_of_an_edited_waveform_take_one_transform_more_however_many_outputs(show):
    edited = DESIGN.with_clip(2, waveform=Noise(seed=3))
    _, work = show(edited, quantities=("axis_spectra",))
    assert work.forward_transforms == 2


def test_the_search_for_the_maximum_transforms_few_channels_and_counts_them(show):
    _, work = show(DESIGN.with_clip(2, waveform=Noise(seed=3)), quantities=("output_rms",))
    assert 0 < work.search_transforms == work.inverse_transforms < 216 / 4


def test_an_onset_edit_draws_nothing_and_transforms_no_drive(show):
    _, work = show(DESIGN.with_clip(2, onset_s=0.05), quantities=("output_rms",))
    assert work.samples_drawn == 0
    assert work.forward_transforms == work.inverse_transforms == 0


def test_only_selected_outputs_are_brought_back_to_time(show):
    _, work = show(view=replace(VIEW, outputs=(29, 52, 61)), quantities=("selected_traces",))
    # Two parts (the selected input and the others) of three axes of the one new output.
    assert work.inverse_transforms == 6


def test_a_change_of_method_transforms_nothing(show):
    _, work = show(view=replace(VIEW, method="rms"))
    assert work.forward_transforms == work.inverse_transforms == 0


def test_opening_a_limb_reads_no_responses_until_an_input_needs_them():
    graph = new_graph()
    graph.evaluate({"limb_map"}, sources(DESIGN, VIEW))
    assert graph.work.bytes_read == 0
    graph.evaluate({"output_rms"}, sources(DESIGN, VIEW))
    assert graph.work.bytes_read == 3 * 72 * 3 * 522 * 8


def test_nothing_runs_twice_for_the_same_question(show):
    _, work = show()
    assert work.rules_run == 0


def test_old_fields_go_at_once_without_the_garbage_collector():
    graph = new_graph()
    given = [sources(DESIGN.with_clip(2, onset_s=k / 1300), VIEW) for k in (1, 2)]
    gc.collect()
    gc.disable()
    try:
        graph.evaluate(ALL, given[0])
        old = weakref.ref(graph.evaluate({"edited_channels"}, given[0])["edited_channels"])
        spectrum = weakref.ref(graph.evaluate({"others_spectrum"}, given[0])["others_spectrum"])
        changed = DESIGN.with_input(0, location=9).with_clip(2, waveform=Noise(seed=9))
        graph.evaluate(ALL, sources(changed, VIEW))
        assert old() is None
        assert spectrum() is None
    finally:
        gc.enable()
