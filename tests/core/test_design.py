"""Designs, their inputs, and settings of panels in the view: plain values, copied with changes."""

import math
from dataclasses import dataclass, replace

import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input, Snapshot, View, audible_inputs, track
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource.design.waveforms.pulses import Tap
from skinsource.specs import fields
from skinsource.specs.numbers import Range, RangeSpec
from skinsource.specs.spec import ChoiceSpec, SwitchSpec, TextSpec

THREE = Design(limb="synthetic-1", inputs=tuple(track(location=k, colour=k) for k in (1, 2, 3)))


def test_a_change_of_one_input_leaves_the_others_the_very_same():
    changed = THREE.with_input(1, amplitude=-2).with_clip(2, waveform=Tap())
    clip = Clip(waveform=Tap(), id=2)
    assert changed.inputs[1] == Input(location=2, colour=2, id=2, amplitude=-2.0, clips=(clip,))
    assert changed.inputs[0] is THREE.inputs[0]
    assert changed.inputs[2] is THREE.inputs[2]
    assert THREE.inputs[1].amplitude == 1.0


def test_a_new_input_goes_to_the_end_in_the_first_colour_that_is_free():
    design = THREE.adding(track(location=9, colour=1)).adding(track(location=9))
    assert [track.location for track in design.inputs] == [1, 2, 3, 9, 9]
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


@pytest.mark.parametrize(
    "panels",
    [
        *[("skin",), (("skin",),), ((1, ()),), (("", ()),)],
        (("skin", ()), ("skin", ())),
        (("skin", (("a", 1), ("a", 2))),),
        *[(("skin", (("a", value),)),) for value in ([1], math.nan, object(), "b" * 20_000)],
        tuple((f"panel {k}", ()) for k in range(10_000)),
    ],
)
def test_settings_that_are_not_plain_pairs_are_refused(panels):
    with pytest.raises(InvalidInputError, match=r"View\.panels is"):
        View(panels=panels)


def test_settings_of_panels_are_held_by_name():
    view = View(panels=(("skin", (("b", 1.5), ("a", None))), ("map", (("c", (1.0, 2.0)),))))
    other = View(panels=(("map", (("c", (1.0, 2.0)),)), ("skin", (("a", None), ("b", 1.5)))))
    assert view == other
    assert hash(view) == hash(other)


@dataclass(frozen=True, slots=True, kw_only=True)
class Settings(fields.CheckedModel):
    style: str = fields.choice("round", ChoiceSpec(label="", options=(("round", ""), ("flat", ""))))
    shown: bool = fields.switch(True, SwitchSpec(label=""))
    zoom: Range | None = fields.interval(None, RangeSpec(label=""))
    note: str = fields.text("", TextSpec(label="", longest=5))


def test_settings_come_back_and_each_panel_has_its_own():
    chosen = Settings(style="flat", shown=False, zoom=(1, 2.5), note="hello")
    view = with_settings(View(axes="z"), "dial", chosen)
    assert settings_of(view, "dial", Settings) == chosen
    assert settings_of(view, "clock", Settings) == Settings()
    assert view.axes == "z"
    # Views that look alike are equal.
    assert with_settings(view, "dial", Settings()) == View(axes="z")


def test_a_field_that_this_version_does_not_know_is_kept():
    view = View(panels=(("dial", (("later", 3), ("style", "flat"))),))
    assert settings_of(view, "dial", Settings) == Settings(style="flat")
    changed = with_settings(view, "dial", Settings(shown=False))
    assert changed.panels == (("dial", (("later", 3), ("shown", False))),)


@pytest.mark.parametrize("field", [("style", "square"), ("shown", 1), ("zoom", (2.0, 1.0))])
def test_a_value_that_does_not_fit_gives_way_to_the_default(field):
    view = View(panels=(("dial", (field,)),))
    assert settings_of(view, "dial", Settings) == Settings()
