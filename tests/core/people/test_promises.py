"""What is promised of a person who was not measured, each published person left out in turn."""

import numpy as np
import pytest

import skinsource as ss
from benchmarks.people import (
    ALL,
    focus_trial,
    levels_trial,
    neighbours,
    octaves_of,
    places_trial,
    usual_bins_hz,
)
from skinsource.inverse.focusing import energy_of
from skinsource.inverse.responses import responses_of
from skinsource.people.likeness import MARGIN_OF_ONE_AXIS
from skinsource.people.others import band_levels_db, people_of
from skinsource.people.trials import range_held


@pytest.fixture
def people(measured):
    return people_of(None, 4)


@pytest.fixture
def octaves_db(people):
    return octaves_of(people)


@pytest.mark.parametrize(
    ("rig", "least_db"),
    [
        ({}, 11.5),
        ({"steady": False}, 11.5),
        ({"axes": "xyz"}, 9.5),
        ({"inputs": range(6, 21, 2)}, 7.0),
        ({"inputs": range(6, 14)}, 7.0),
    ],
    ids=["20 inputs", "errors after measuring", "three axes", "8 inputs", "8 finger inputs"],
)
def test_one_own_row_focuses_as_promised(people, rig, least_db):
    found = focus_trial(people, **rig)
    own_db = found["own row"]
    assert np.median(own_db) >= least_db
    assert np.median(own_db, axis=(1, 2)).min() >= least_db - 1.0
    assert np.median(own_db) > np.median(found["time reversal"]) - 0.1
    if "inputs" not in rig and "axes" not in rig:
        assert np.median(own_db - found["best single"], axis=(1, 2)).min() >= 3.5


def test_five_finger_pads_gain_nothing_at_300_hz(people):
    found = focus_trial(people, inputs=range(6, 11), frequencies_hz=np.array([300.0]))
    assert np.median(found["own row"]) <= np.median(found["by hindsight"])


@pytest.mark.parametrize(("count", "most_db"), [(4, 3.7), (8, 3.3), (12, 3.1)])
def test_levels_from_own_places_are_as_near_as_promised(octaves_db, count, most_db):
    errors_db, held = levels_trial(octaves_db, count)
    assert np.sqrt(np.square(errors_db).mean()) <= most_db
    assert held.min() >= 0.78


def test_ranges_held_what_they_are_said_to_have_held(people):
    shares = np.array([shares for _, shares in range_held(people).values()])
    assert shares.min() >= 0.78
    assert shares.max() < 0.975


def test_a_sensor_on_the_wrong_place_is_doubted_far_more_often_than_on_the_right_one(
    people, octaves_db
):
    alarms, hits = places_trial(octaves_db, neighbours(people[0]))
    assert alarms.mean() <= 0.055
    assert hits.mean() >= 0.5
    assert (hits.sum(axis=1) > 5 * alarms.sum(axis=1)).all()


def test_a_sensor_of_one_axis_is_doubted_as_seldom_where_it_should_be(people):
    along_z = np.stack([band_levels_db(limb, ALL, axes="z")[:, :42] for limb in people])
    alarms, hits = places_trial(along_z, neighbours(people[0]), MARGIN_OF_ONE_AXIS)
    assert alarms.mean() <= 0.055
    assert hits.mean() >= 0.5


def test_what_a_focus_expects_of_others_is_what_the_person_gets(people):
    expected_db, got_db = [], []
    at_hz = usual_bins_hz(people[0])
    for person in people:
        others = [each for each in people if each is not person]
        for target in range(1, 43, 7):
            own = ss.people.partial(person, [target])
            found = ss.people.focus(own, target, others=others, frequencies_hz=at_hz)
            whole = ss.inverse.time_reversal(person, target, frequencies_hz=at_hz)
            responses = responses_of(person, inputs=found.inputs, frequencies_hz=at_hz)
            energy = np.delete(energy_of(responses, found.used_drives)[:, :42], target - 1, axis=1)
            np.testing.assert_allclose(found.row, whole.row)
            got_db.append(-10.0 * np.log10(energy.mean(axis=1)))
            expected_db.append(found.unseen_contrast_db)
    assert abs(np.median(expected_db) - np.median(got_db)) < 1.0
