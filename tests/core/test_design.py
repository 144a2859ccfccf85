"""Designs and their inputs: plain values, copied with changes."""

from dataclasses import replace

import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input, Snapshot, audible_inputs, track
from skinsource.design.waveforms.pulses import Tap

THREE = Design(limb="synthetic-1", inputs=tuple(track(location=k, colour=k) for k in (1, 2, 3)))


def places(design: Design) -> list[int]:
    return [track.location for track in design.inputs]


def test_a_change_of_one_input_leaves_the_others_the_very_same():
    changed = THREE.with_input(1, amplitude=-2).with_clip(2, waveform=Tap())
    clip = Clip(waveform=Tap(), id=2)
    assert changed.inputs[1] == Input(location=2, colour=2, id=2, amplitude=-2.0, clips=(clip,))
    assert changed.inputs[0] is THREE.inputs[0]
    assert changed.inputs[2] is THREE.inputs[2]
    assert THREE.inputs[1].amplitude == 1.0


def test_a_new_input_goes_to_the_end_in_the_first_colour_that_is_free():
    design = THREE.adding(track(location=9, colour=1)).adding(track(location=9))
    assert places(design) == [1, 2, 3, 9, 9]
    assert [track.colour for track in design.inputs] == [1, 2, 3, 0, 4]


@pytest.mark.parametrize(
    ("muted", "solo", "audible"),
    [
        ((0, 0, 0), (0, 0, 0), [1, 2, 3]),
        ((0, 1, 0), (0, 0, 0), [1, 3]),
        ((0, 0, 0), (0, 1, 0), [2]),
        ((0, 0, 0), (1, 0, 1), [1, 3]),
        ((0, 1, 0), (0, 1, 0), []),
        ((1, 0, 0), (1, 1, 0), [2]),
        ((1, 1, 1), (0, 0, 0), []),
    ],
)
def test_solo_inputs_are_heard_alone_and_muted_ones_never(muted, solo, audible):
    inputs = tuple(
        replace(track, muted=bool(is_muted), solo=bool(is_solo))
        for track, is_muted, is_solo in zip(THREE.inputs, muted, solo, strict=True)
    )
    assert [track.location for track in audible_inputs(inputs)] == audible


def test_inputs_without_an_id_get_the_smallest_that_is_free():
    given = (track(location=1, id=2), track(location=2), track(location=3), track(location=4, id=9))
    design = Design(limb="synthetic-1", inputs=given)
    assert design.ids == (2, 1, 3, 9)
    assert design.adding(track(location=5, id=9)).ids == (2, 1, 3, 9, 4)


def test_an_input_is_found_by_its_id_wherever_it_stands():
    turned = replace(THREE, inputs=THREE.inputs[::-1])
    for input_track in THREE.inputs:
        assert turned.input(input_track.id) is input_track
    assert [turned.index_of(id_) for id_ in THREE.ids] == [2, 1, 0]
    with pytest.raises(InvalidInputError, match="no input has the id 7; there are 1, 2, 3"):
        THREE.input(7)


def test_a_snapshot_that_could_not_be_shown_is_none():
    design = Design(limb="synthetic-1", inputs=(track(7, amplitude=2.0),))
    Snapshot(number=1, design=design, gain=500.0)
    with pytest.raises(InvalidInputError, match="amplitude"):
        Snapshot(number=1, design=design, gain=501.0)
