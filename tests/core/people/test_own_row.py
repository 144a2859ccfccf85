"""A focus from one measured place, where to measure, and where a sensor was."""

from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import InvalidInputError
from skinsource.people.carrying import carried
from skinsource.people.others import band_levels_db

NAMES = ["synthetic-1", "synthetic-2", "synthetic-3"]
AT_HZ = np.array([60.0, 100.0, 200.0])
EVERY = slice(0, 42)


@pytest.fixture(scope="module")
def own():
    return ss.people.partial("synthetic-4", [9, 21, 30])


def rows_of(name, inputs, axes=slice(2, 3)):
    """Spectra on the hand, (n_bins, 42, n_axes, n_used)."""
    taps = ss.load_limb(name).impulse_responses[np.array(inputs) - 1][:, EVERY, axes]
    phase = np.exp(-2j * np.pi * AT_HZ / 1300.0 * np.arange(522)[:, None])
    return np.moveaxis(taps @ phase, (3, 0), (0, 3))


def test_the_drives_are_those_of_the_own_row_and_the_mean_quiet_matrix(own):
    found = ss.people.focus(own, 9, others=NAMES, frequencies_hz=AT_HZ)
    row = rows_of("synthetic-4", found.inputs)[:, 8, 0]
    quiet = [np.delete(rows_of(name, found.inputs), 8, axis=1)[:, :, 0] for name in NAMES]
    gram = np.mean([each.conj().swapaxes(1, 2) @ each for each in quiet], axis=0)
    load = 0.3 * np.trace(gram, axis1=1, axis2=2).real / len(found.inputs)
    matrix = gram + load[:, None, None] * np.eye(len(found.inputs))
    x = np.linalg.solve(matrix, row.conj()[..., None])[..., 0]
    np.testing.assert_allclose(found.used_drives, x / (row * x).sum(axis=1, keepdims=True))
    energy = [np.square(np.abs(np.einsum("foi,fi->fo", q, found.used_drives))) for q in quiet]
    np.testing.assert_allclose(found.mean_contrast_db, -10 * np.log10(np.mean(energy, axis=(0, 2))))


def test_unseen_contrast_is_that_on_people_whom_the_design_does_not_know(own):
    found = ss.people.focus(own, 9, others=NAMES, frequencies_hz=AT_HZ)
    energies, loudest = [], []
    for name in NAMES:
        known = [other for other in NAMES if other != name]
        drives = ss.people.focus(own, 9, others=known, frequencies_hz=AT_HZ).used_drives
        seen = np.einsum("foai,fi->fo", rows_of(name, found.inputs), drives)
        energies.append(np.square(np.abs(np.delete(seen, 8, axis=1))))
        loudest.append(energies[-1].max(axis=1))
    expected_db = -10 * np.log10(np.mean(energies, axis=(0, 2)))
    np.testing.assert_allclose(found.unseen_contrast_db, expected_db)
    np.testing.assert_allclose(found.loudest_other_db, -10 * np.log10(np.mean(loudest, axis=0)))


def test_what_one_other_person_cannot_tell_is_not_told(own):
    found = ss.people.focus(own, 9, others=NAMES[:1], frequencies_hz=AT_HZ)
    assert np.isnan(found.unseen_contrast_db).all()
    assert np.isnan(found.loudest_other_db).all()
    assert not found.loudest_other.any()


def test_a_gain_of_the_sensor_changes_no_direction(own):
    louder = replace(own, responses=3.0 * own.responses)
    usual, changed = (
        ss.people.focus(each, 9, axes="xyz", others=NAMES, frequencies_hz=AT_HZ)
        for each in (own, louder)
    )
    np.testing.assert_allclose(changed.drives, usual.drives / 3.0, atol=1e-12)


def test_a_target_that_was_not_measured_is_refused(own):
    with pytest.raises(InvalidInputError, match="output 10 of synthetic-4 was not measured"):
        ss.people.focus(own, 10, others=NAMES)


def test_inputs_that_were_not_measured_are_left_out_or_refused(own):
    some = replace(own, inputs=own.inputs[9:], responses=own.responses[9:])
    found = ss.people.focus(some, 9, others=NAMES, frequencies_hz=AT_HZ)
    assert found.inputs == tuple(range(10, 21))
    with pytest.raises(InvalidInputError, match="was measured from"):
        ss.people.focus(some, 9, inputs=[6, 10], others=NAMES)


def test_shorter_responses_are_compared_at_the_same_frequencies(own):
    short = replace(own, responses=own.responses[..., :200])
    found = ss.people.focus(short, 9, others=NAMES)
    assert found.frequencies_hz.size == 296


def test_the_first_place_to_measure_is_the_loudest_and_others_are_far_from_it():
    levels_db = np.mean([band_levels_db(ss.load_limb(n), range(1, 21)) for n in NAMES], axis=0)
    levels_db = levels_db[:, EVERY]
    chosen = [output - 1 for output in ss.people.suggested_places(NAMES, 5)]
    assert chosen[0] == (10.0 ** (levels_db / 10.0)).mean(axis=(0, 2)).argmax()
    for k in range(1, 5):
        apart = np.square(levels_db[:, chosen[:k], None] - levels_db[:, None]).sum(axis=(0, 3))
        assert chosen[k] == apart.min(axis=0).argmax()


@pytest.mark.parametrize("count", [0, 43, 2.5])
def test_so_many_places_cannot_be_suggested(count):
    with pytest.raises(InvalidInputError, match="count is"):
        ss.people.suggested_places(NAMES, count)


def test_a_person_like_the_others_is_carried_nowhere():
    theirs_db = np.stack([band_levels_db(ss.load_limb(n), range(1, 21))[1, EVERY] for n in NAMES])
    likeliest_db, remaining = carried(theirs_db, theirs_db.mean(axis=0)[[3, 7]], [3, 7], range(20))
    np.testing.assert_allclose(likeliest_db, theirs_db.mean(axis=0))
    assert (remaining > 0.0).all()
    assert (remaining <= 1.0).all()


def test_a_louder_person_is_louder_everywhere_and_most_where_it_is_alike():
    theirs_db = np.stack([band_levels_db(ss.load_limb(n), range(1, 21))[1, EVERY] for n in NAMES])
    mean_db = theirs_db.mean(axis=0)
    likeliest_db, remaining = carried(theirs_db, mean_db[[3, 7]] + 6.0, [3, 7], range(20))
    rise_db = likeliest_db - mean_db
    assert (rise_db > 0.0).all()
    assert rise_db[[3, 7]].mean() > rise_db.mean() > 1.0
    assert remaining[[3, 7]].max() < remaining.max()


@pytest.mark.parametrize("output", [21, 30])
def test_a_sensor_where_it_should_be_is_believed(own, output):
    assert ss.people.likeliest_place(own, output, NAMES) == output


def test_a_sensor_on_another_digit_is_found_nearby():
    said = replace(ss.people.partial("synthetic-4", [21]), outputs=(30,))
    found = ss.people.likeliest_place(said, 30, NAMES)
    places = ss.load_limb("synthetic-4").output_positions_mm
    assert np.hypot(*(places[found - 1] - places[20])) < 20.0


def test_a_sensor_of_one_axis_is_compared_along_it(own):
    along_z = own.responses * np.array([0.0, 0.0, 1.0])[:, None]
    single = replace(own, responses=along_z)
    assert (own.axes, single.axes) == ("xyz", "z")
    for output in own.outputs:
        assert ss.people.likeliest_place(single, output, NAMES) == output
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(7),))
    with pytest.raises(InvalidInputError, match="was measured along z alone"):
        ss.people.levels(design, limbs=NAMES, own=single)


def test_one_other_person_does_not_tell_where_a_sensor_was(own):
    with pytest.raises(InvalidInputError, match="expected 2 people or more"):
        ss.people.likeliest_place(own, 9, NAMES[:1])


def test_a_focus_from_one_row_plays_as_loud_on_the_person_as_asked(own):
    found = ss.people.focus(own, 9, others=NAMES)
    design = found.design(ss.waveforms.Tone(frequency_hz=100.0), level=0.1)
    view = ss.View(axes="z", span="loudest")
    levels_db = ss.evaluate(design, "output_levels_db", view=view)["output_levels_db"]
    assert design.limb == "synthetic-4"
    assert levels_db[8] == pytest.approx(-20.0, abs=0.1)
