"""Baselines, several strong outputs, and the loudest quiet output."""

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import InvalidInputError
from skinsource.inverse.focusing import energy_of
from skinsource.inverse.responses import responses_of

AT_HZ = [60.0, 100.0, 250.0]
TARGET = 30


def test_time_reversal_needs_the_least_effort_and_knows_no_quiet_output(limb):
    found = ss.inverse.time_reversal(limb, TARGET, frequencies_hz=AT_HZ)
    np.testing.assert_allclose(found.effort_db, 0.0, atol=1e-12)
    np.testing.assert_allclose(
        found.used_drives, found.row.conj() / np.linalg.norm(found.row, axis=1)[:, None] ** 2
    )
    np.testing.assert_allclose(found.unseen_contrast_db, found.mean_contrast_db)
    assert not found.gram.any()


def test_a_dead_input_is_never_the_best(limb, limb_of):
    deaf = limb_of(
        lambda place: limb.response_to(place) * (place > 3), name="of-a-lab", synthetic=True
    )
    places = [1, 2, 3, 7]
    found = ss.inverse.best_single(deaf, TARGET, inputs=places, frequencies_hz=AT_HZ)
    assert found.inputs == (7,)


def test_the_best_single_input_is_the_one_of_most_contrast(limb):
    found = ss.inverse.best_single(limb, TARGET, frequencies_hz=[100.0])
    singles = [
        ss.inverse.focus(limb, TARGET, inputs=[place], frequencies_hz=[100.0])
        for place in range(6, 21)
    ]
    assert found.mean_contrast_db == max(each.mean_contrast_db for each in singles)
    np.testing.assert_allclose(found.unseen_contrast_db, found.mean_contrast_db)
    assert np.count_nonzero(found.drives) == 1


STRONG = {28: 1.0, 29: 1.0, 19: 1.0, 20: 1.0}
QUIET = {output: 1.0 for output in range(1, 43) if output not in STRONG}


def test_several_outputs_are_about_equally_strong_and_the_first_is_1(limb):
    painted = ss.inverse.paint(limb, STRONG, QUIET, frequencies_hz=AT_HZ)
    energy = energy_of(responses_of(limb, frequencies_hz=AT_HZ), painted.used_drives)
    strong = energy[:, np.array([*STRONG]) - 1]
    np.testing.assert_allclose(strong[:, 0], 1.0, rtol=1e-12)
    spread_db = 10 * np.log10(strong.max(axis=1) / strong.min(axis=1))
    np.testing.assert_allclose(painted.spread_db, spread_db)
    assert (painted.spread_db < 0.3).all()
    quiet = energy[:, np.array([*QUIET]) - 1]
    np.testing.assert_allclose(
        painted.mean_contrast_db, 10 * np.log10(strong.mean(1) / quiet.mean(1))
    )


def test_painting_one_output_is_a_focus(limb):
    quiet = {output: 1.0 for output in range(1, 43) if output != TARGET}
    painted = ss.inverse.paint(limb, {TARGET: 1.0}, quiet, beta=0.3, frequencies_hz=AT_HZ)
    focus = ss.inverse.focus(limb, TARGET, frequencies_hz=AT_HZ)
    np.testing.assert_allclose(painted.drives, focus.drives, atol=1e-9)


def test_a_heavy_quiet_output_is_quieter(limb):
    def at_9(weight):
        painted = ss.inverse.paint(limb, STRONG, QUIET | {9: weight}, frequencies_hz=AT_HZ)
        energy = energy_of(responses_of(limb, frequencies_hz=AT_HZ), painted.used_drives)
        return energy[:, 8] / energy[:, np.array([*STRONG]) - 1].mean(axis=1)

    assert (at_9(30.0) < at_9(1.0)).all()


@pytest.mark.parametrize(
    ("strong", "quiet", "match"),
    [
        ({}, {9: 1.0}, "No output is to be strong"),
        ({9: 1.0}, {}, "No output is to be quiet"),
        ({9: 1.0}, {9: 1.0}, "strong and quiet"),
        ({9: 0.0}, {8: 1.0}, "weight is 0"),
        ({73: 1.0}, {8: 1.0}, "from 1 to 72"),
    ],
)
def test_what_cannot_be_painted_is_refused(limb, strong, quiet, match):
    with pytest.raises(InvalidInputError, match=match):
        ss.inverse.paint(limb, strong, quiet)
