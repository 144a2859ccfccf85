"""A scene is called what it is: once it was changed, its title does not go on naming a variant."""

from dataclasses import replace

import pytest

import skinsource as ss
from skinsource.studies.scenes.scenes import title_of
from tests.core.own_limbs.lab_bench import installed

MEASURED = tuple(f"measured-{k}" for k in range(1, 5))


opened = ss.scenes.open_scene


@pytest.mark.parametrize("available", [(), MEASURED], ids=["synthetic", "measured"])
@pytest.mark.parametrize("name", ss.scenes.names())
def test_each_scene_is_called_by_its_title_as_long_as_it_is_that_scene(name, available):
    scene = ss.scenes.scene(name)
    for condition in opened(name, available=available).conditions:
        design = condition.design
        assert title_of(design) == design.title
        # Drives of inverse design are found on limbs that are here.
        for track in design.inputs[:1]:
            louder = design.with_input(0, amplitude=3.25 * track.amplitude)
            assert title_of(louder) == f"{scene.full_title} · edited"


def test_a_scene_on_another_limb_is_no_longer_called_by_the_limb_of_its_title():
    known = next(scene for scene in ss.scenes.all_scenes() if scene.title.endswith(", limb 1"))
    design = opened(known.name, available=()).design
    for limb in ("synthetic-3", "our-arm-1", "arm-1"):
        moved = title_of(replace(design, limb=limb))
        assert moved == f"Fig. {known.name}: {known.title.removesuffix(', limb 1')} · edited"
    chosen = opened(known.name, limb="synthetic-3").design
    assert title_of(chosen) == chosen.title


def test_a_scene_at_another_place_is_edited_and_at_the_places_of_a_lab_it_is_that_scene(user_data):
    design = opened("2B", available=()).design
    moved = design.with_input(0, location=9)
    assert title_of(moved) == f"{design.title.partition(' · ')[0]} · edited"
    installed()
    at_the_lab = opened("1C", limb="lab-1").design
    assert at_the_lab.inputs[0].location != opened("1C", available=()).design.inputs[0].location
    assert title_of(at_the_lab) == at_the_lab.title
    louder = at_the_lab.with_input(0, amplitude=3.25)
    assert title_of(louder).endswith(" · edited")


def test_another_limb_or_colour_leaves_the_title_of_a_scene_that_names_none():
    design = opened("2B", available=()).design
    assert title_of(replace(design, limb="synthetic-3")) == design.title
    assert title_of(design.with_input(0, colour=7)) == design.title


def test_no_title_tells_a_strength_in_a_unit_that_the_drive_of_another_limb_does_not_have(
    user_data,
):
    installed()
    paper, lab = (opened("5D", limb=limb).design for limb in ("synthetic-1", "lab-1"))
    assert (title_of(paper)[-6:], title_of(lab)[-6:]) == ("6 m/s²", "6 a.u.")
    elsewhere = paper.inputs[0].location, lab.inputs[0].location
    assert elsewhere[0] != elsewhere[1]
    moved = replace(paper, limb="lab-1").with_input(0, location=elsewhere[1])
    back = replace(lab, limb="synthetic-1").with_input(0, location=elsewhere[0])
    edited = "Fig. 5D: Output against input · edited"
    assert title_of(moved) == title_of(back) == edited
    velocities = opened("5B", limb="synthetic-1").conditions[0].design
    assert title_of(velocities).endswith(" mm/s")
    assert title_of(replace(velocities, limb="lab-1")).endswith(" · edited")


def test_words_of_the_user_stay_whatever_numbers_they_hold():
    for title in ("", "My 50 Hz", "Fig. 2B: mine · 50 Hz", "Fig. 99: A", "Fig. 3 of my thesis"):
        inputs = (ss.track(7, ss.waveforms.Tone()),)
        design = ss.Design(limb="synthetic-1", title=title, inputs=inputs)
        assert title_of(design) == title
