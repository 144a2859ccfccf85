"""Focus: least quiet energy and effort, special cases, baselines, and the loudest quiet output."""

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import InvalidInputError
from skinsource.inverse.focusing import energy_of, loaded, target_row
from skinsource.inverse.responses import gram_of, loading, responses_of

AT_HZ = [60.0, 100.0, 250.0]
TARGET = 30


@pytest.fixture(scope="module")
def responses(limb):
    return responses_of(limb, frequencies_hz=AT_HZ)


@pytest.fixture(scope="module")
def rows(responses):
    """Of the target and of the other outputs of the hand, (n_bins, …, n_used)."""
    quiet = [output for output in range(1, 43) if output != TARGET]
    return responses.rows([TARGET])[:, 0], responses.rows(quiet)


def parallel(a, b):
    """1 - |cos| of the angle between drives, the largest of all bins."""
    cosine = np.abs(np.vecdot(a, b)) / np.linalg.norm(a, axis=1) / np.linalg.norm(b, axis=1)
    return np.abs(1.0 - cosine).max()


@pytest.mark.parametrize("axes", ["z", "xyz"])
def test_the_response_of_the_target_is_1_and_unused_inputs_are_silent(limb, axes):
    focus = ss.inverse.focus(limb, TARGET, axes=axes, frequencies_hz=AT_HZ)
    assert focus.drives.shape == (3, 20)
    assert (focus.drives[:, :5] == 0.0).all()
    of_target = np.einsum("fai,fi->fa", focus_rows(limb, axes, TARGET), focus.drives[:, 5:])
    along = np.einsum("fi,fi->f", focus.row, focus.drives[:, 5:])
    np.testing.assert_allclose(along, 1.0, atol=1e-12)
    assert (np.linalg.norm(of_target, axis=1) > 1.0 - 1e-12).all()


def focus_rows(limb, axes, output):
    return responses_of(limb, axes=axes, frequencies_hz=AT_HZ).rows([output])


def test_the_direction_of_several_axes_is_the_strongest_with_z_real_and_positive(limb):
    rows = focus_rows(limb, "xyz", TARGET)
    row = target_row(responses_of(limb, axes="xyz", frequencies_hz=AT_HZ), TARGET)
    strongest = np.linalg.svd(rows).S[:, 0]
    np.testing.assert_allclose(np.linalg.norm(row, axis=1), strongest, rtol=1e-12)
    direction = np.einsum("fai,fi->fa", rows, row.conj())[:, 2]
    np.testing.assert_allclose(direction.imag, 0.0, atol=1e-12 * strongest.max() ** 2)
    assert (direction.real > 0.0).all()


def test_much_beta_is_time_reversal(limb, rows):
    focus = ss.inverse.focus(limb, TARGET, beta=1e6, frequencies_hz=AT_HZ)
    assert parallel(focus.drives[:, 5:], rows[0].conj()) < 1e-11
    np.testing.assert_allclose(focus.effort_db, 0.0, atol=1e-10)


def test_it_is_pressure_matching_and_loaded_contrast_control(limb, rows):
    row, quiet = rows
    gram = gram_of(quiet)
    load = 0.3 * loading(gram)[:, None, None] * np.eye(15)
    drives = ss.inverse.focus(limb, TARGET, frequencies_hz=AT_HZ).drives[:, 5:]
    bright = gram_of(row[:, None])
    matched = np.linalg.solve(gram + bright + load, row.conj()[..., None])[..., 0]
    assert parallel(drives, matched) < 1e-14
    values, vectors = np.linalg.eig(np.linalg.solve(gram + load, bright))
    best = np.take_along_axis(vectors, np.abs(values).argmax(1)[:, None, None], 2)[..., 0]
    assert parallel(drives, best) < 1e-12


def test_more_beta_needs_less_effort_and_gives_less_contrast(limb):
    found = [
        ss.inverse.focus(limb, TARGET, beta=beta, frequencies_hz=AT_HZ)
        for beta in np.geomspace(1e-6, 1e3, 10)
    ]
    assert (np.diff([each.effort_db for each in found], axis=0) <= 1e-9).all()
    assert (np.diff([each.mean_contrast_db for each in found], axis=0) <= 1e-9).all()


def test_a_bound_that_nothing_reaches_leaves_the_least_beta(limb):
    focus = ss.inverse.focus(limb, TARGET, effort_db=100.0, frequencies_hz=AT_HZ)
    assert focus.beta == pytest.approx(1e-6, rel=1e-12)


def test_contrasts_are_those_of_the_field(limb, responses):
    focus = ss.inverse.focus(limb, TARGET, frequencies_hz=AT_HZ)
    energy = energy_of(responses, focus.drives[:, 5:])
    quiet = np.delete(energy[:, :42], TARGET - 1, axis=1)
    target = energy[:, TARGET - 1]
    np.testing.assert_allclose(focus.mean_contrast_db, 10 * np.log10(target / quiet.mean(1)))
    np.testing.assert_allclose(focus.loudest_other_db, 10 * np.log10(target / quiet.max(1)))
    loudest = np.take_along_axis(energy, focus.loudest_other[:, None] - 1, 1)[:, 0]
    np.testing.assert_array_equal(loudest, quiet.max(axis=1))


def test_contact_is_that_of_the_probe_that_the_drives_move(limb):
    focus = ss.inverse.focus(limb, TARGET, frequencies_hz=AT_HZ)
    # 1 ms of 22.9 m/s² at 1300 Hz.
    pulse = 22.9e-3 * 1300.0 * np.sinc(1e-3 * np.array(AT_HZ))
    contact = pulse * np.abs(focus.drives).max(axis=1)
    np.testing.assert_allclose(focus.contact_db, -20 * np.log10(contact), atol=1e-9)


def test_the_phase_of_the_target_is_that_of_the_drives(rows):
    row, gram = rows[0], gram_of(rows[1])
    drives, _ = loaded(row, gram)
    turned, _ = loaded(1j * row, gram)
    np.testing.assert_allclose(1j * turned, drives, rtol=1e-10)


def test_gains_of_inputs_leave_the_field_only_where_drives_cost_nothing(rows):
    gains = np.linspace(0.3, 3.0, 15)

    def change(beta):
        row, gram = rows[0], gram_of(rows[1])
        drives, _ = loaded(row, gram, beta=beta)
        other, _ = loaded(row * gains, gram * gains * gains[:, None], beta=beta)
        return np.abs(gains * other - drives).max() / np.abs(drives).max()

    assert change(1e-6) < 0.05
    assert change(0.3) > 0.2


def test_inputs_in_another_order_get_the_same_drives(limb):
    places = [9, 17, 6, 20]
    one = ss.inverse.focus(limb, TARGET, inputs=places, frequencies_hz=AT_HZ)
    other = ss.inverse.focus(limb, TARGET, inputs=sorted(places), frequencies_hz=AT_HZ)
    np.testing.assert_allclose(one.drives, other.drives, rtol=1e-9)


def test_a_single_input_has_only_its_level_free(limb, responses):
    focus = ss.inverse.focus(limb, TARGET, inputs=[7], frequencies_hz=AT_HZ)
    np.testing.assert_allclose(focus.drives[:, 6] * focus.row[:, 0], 1.0, rtol=1e-12)
    np.testing.assert_allclose(focus.effort_db, 0.0, atol=1e-12)


def test_one_quiet_place_costs_almost_nothing(limb):
    focus = ss.inverse.focus(limb, TARGET, quiet=[9], beta=1e-4, frequencies_hz=AT_HZ)
    assert (focus.mean_contrast_db > 50.0).all()
    assert (focus.effort_db < 3.0).all()


def test_nothing_quiet_is_time_reversal(rows):
    drives, _ = loaded(rows[0], np.zeros((3, 15, 15)))
    assert parallel(drives, rows[0].conj()) < 1e-14


def noisy_limb(limb_of, gain):
    """A limb whose output 1 is ``gain`` times as strong as its noise, the others much stronger."""
    rng = np.random.default_rng(3)
    taps = rng.normal(size=(20, 72, 3, 522))
    taps[:, 1:, :, 68:] *= 100.0
    taps[:, :1, :, 68:] *= gain
    return limb_of(lambda place: taps[place - 1], name="of-a-lab", synthetic=False)


def test_an_output_that_is_mostly_noise_is_no_target(limb_of):
    with pytest.raises(InvalidInputError, match="above its noise, expected at least 6 dB"):
        ss.inverse.focus(noisy_limb(limb_of, 1.5), 1)
    assert ss.inverse.focus(noisy_limb(limb_of, 3.0), 1).target == 1


def test_noisy_outputs_of_own_limbs_need_not_be_quiet(limb_of):
    limb = noisy_limb(limb_of, 1.0)
    one = ss.inverse.focus(limb, 2, frequencies_hz=AT_HZ)
    without = ss.inverse.focus(limb, 2, quiet=range(3, 73), frequencies_hz=AT_HZ)
    np.testing.assert_array_equal(one.drives, without.drives)


@pytest.mark.parametrize(
    ("changes", "match"),
    [
        ({"target": 73}, "whole number from 1 to 72"),
        ({"inputs": [21]}, "places 1 to 20"),
        ({"inputs": []}, "one place or more"),
        ({"inputs": [7, 7]}, "each once"),
        ({"quiet": [TARGET]}, "strong and quiet"),
        ({"quiet": []}, "No output is to be quiet"),
        ({"beta": 0.0}, "beta is 0"),
        ({"effort_db": -1.0}, "effort_db is -1"),
        ({"frequencies_hz": [10.0]}, "measured from 25 to 600 Hz"),
        ({"frequencies_hz": [100.0, 50.0]}, "does not rise"),
    ],
)
def test_what_cannot_be_asked_is_refused(limb, changes, match):
    with pytest.raises(InvalidInputError, match=match):
        ss.inverse.focus(limb, **{"target": TARGET, **changes})


def test_what_is_asked_of_nobody_is_asked_of_all_bins_from_25_to_400_hz(limb):
    focus = ss.inverse.focus(limb.name, TARGET)
    assert focus.frequencies_hz[0] == 20 * 1300 / 1024
    assert focus.frequencies_hz[-1] == 315 * 1300 / 1024
    assert repr(focus) == "<Focus on output 30 of synthetic-1, 25.39 to 399.9 Hz>"


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
