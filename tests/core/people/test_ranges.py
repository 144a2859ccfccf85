"""Levels of a design on the hand of somebody who was not measured."""

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import DatasetMissingError, InvalidInputError
from skinsource.limbs.limb import limb_like

NAMES = ["synthetic-1", "synthetic-2", "synthetic-3"]
HAND = slice(0, 42)


def tone(place=7, hz=100.0, **changes):
    return ss.track(place, ss.waveforms.Tone(frequency_hz=hz), **changes)


def design_of(*inputs, **changes):
    return ss.Design(limb="synthetic-4", inputs=inputs or (tone(),), **changes)


@pytest.fixture(scope="module")
def own():
    outputs = ss.people.suggested_places(NAMES, 6)
    return ss.people.partial("synthetic-4", outputs)


def levels_on(name, design, view=None):
    there = ss.Design(limb=name, inputs=design.inputs, scaling=design.scaling)
    return ss.evaluate(there, "output_levels_db", view=view)["output_levels_db"]


@pytest.mark.parametrize("view", [None, ss.View(axes="z")], ids=["usual", "z"])
def test_people_are_the_levels_of_the_design_on_each_limb(view):
    found = ss.people.levels(design_of(), view, limbs=NAMES)
    assert found.names == tuple(NAMES)
    for name, levels_db in zip(NAMES, found.people_db, strict=True):
        np.testing.assert_allclose(levels_db, levels_on(name, design_of(), view))


def test_the_range_is_that_of_its_formula():
    found = ss.people.levels(design_of(), limbs=NAMES)
    s = np.sqrt(found.people_db[:, HAND].var(axis=0, ddof=1).mean())
    np.testing.assert_allclose(found.mean_db, found.people_db.mean(axis=0))
    np.testing.assert_allclose(found.high_db - found.mean_db, 1.645 * s * np.sqrt(4.0 / 3.0))
    np.testing.assert_allclose(found.mean_db - found.low_db, 1.645 * s * np.sqrt(4.0 / 3.0))


def test_all_measured_limbs_are_the_people_unless_somebody_says_else(measured):
    found = ss.people.levels(design_of())
    assert found.names == tuple(f"measured-{k}" for k in range(1, 5))


def test_without_the_dataset_it_is_said_that_it_is_missing():
    with pytest.raises(DatasetMissingError):
        ss.people.levels(design_of())


def test_one_person_gives_no_range():
    with pytest.raises(InvalidInputError, match="expected 2 people or more, each once"):
        ss.people.levels(design_of(), limbs=NAMES[:1])
    with pytest.raises(InvalidInputError, match="each once"):
        ss.people.levels(design_of(), limbs=[NAMES[0], NAMES[0]])


def test_people_with_other_places_are_not_compared():
    whole = ss.load_limb("synthetic-1")
    few = limb_like(
        whole,
        name="few",
        shape=(20, 72, 3, 10),
        sample_rate_hz=1000.0,
        read_response=lambda place: whole.response_to(place)[..., :10],
    )
    with pytest.raises(InvalidInputError, match="synthetic-2 and few differ in their places"):
        ss.people.levels(design_of(), limbs=["synthetic-2", few])


def test_the_levels_of_own_places_are_known(own):
    found = ss.people.levels(design_of(), limbs=NAMES, own=own)
    measured = np.array(own.outputs) - 1
    known_db = levels_on("synthetic-4", design_of())[measured]
    for levels_db in (found.mean_db, found.low_db, found.high_db):
        np.testing.assert_allclose(levels_db[measured], known_db)


@pytest.mark.parametrize(
    "inputs", [(tone(),), (tone(), tone(12, 180.0, amplitude=0.5))], ids=["one input", "two"]
)
def test_own_places_draw_the_range_in_on_the_rest_of_the_hand_and_only_there(own, inputs):
    design = design_of(*inputs)
    usual = ss.people.levels(design, limbs=NAMES)
    drawn = ss.people.levels(design, limbs=NAMES, own=own)
    widths = drawn.high_db - drawn.low_db
    assert (widths[HAND] < (usual.high_db - usual.low_db)[HAND]).all()
    np.testing.assert_array_equal(drawn.mean_db[42:], usual.mean_db[42:])
    np.testing.assert_array_equal(drawn.high_db[42:], usual.high_db[42:])


def test_muted_inputs_draw_nothing_in(own):
    muted = tone(12, 180.0, muted=True)
    alone = ss.people.levels(design_of(), limbs=NAMES, own=own)
    with_muted = ss.people.levels(design_of(tone(), muted), limbs=NAMES, own=own)
    np.testing.assert_allclose(with_muted.mean_db, alone.mean_db)


def test_a_person_was_measured_from_each_place_that_plays(own):
    some = ss.people.PartialLimb(
        person="p07",
        like=own.like,
        inputs=own.inputs[7:],
        outputs=own.outputs,
        responses=own.responses[7:],
    )
    with pytest.raises(InvalidInputError, match="p07 was not measured from place 7"):
        ss.people.levels(design_of(), limbs=NAMES, own=some)
    found = ss.people.levels(design_of(tone(12)), limbs=NAMES, own=some)
    assert np.isfinite(found.mean_db).all()


def test_peaks_of_each_input_need_all_outputs_of_a_person(own):
    with pytest.raises(InvalidInputError, match="'upstream' needs all outputs"):
        ss.people.levels(design_of(scaling="upstream"), limbs=NAMES, own=own)


def test_the_person_is_none_of_the_others_unless_named(measured):
    own = ss.people.partial("measured-2", [9])
    found = ss.people.levels(design_of(), own=own)
    assert "measured-2" not in found.names
