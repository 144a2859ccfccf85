"""What inverse design promises, on the measured limbs: medians over 42 targets and 4 people."""

import numpy as np
import pytest

import skinsource as ss
from skinsource.inverse.focusing import energy_of
from skinsource.inverse.responses import responses_of

HAND = range(1, 43)
#: All places: what was measured, and promised.
ALL = range(1, 21)
AT_HZ = [50.0, 100.0, 200.0, 300.0]
#: Outputs of the digits III and II that are beside a nail, and all of digit III.
TIP_II, DIGIT_III = 28, (19, 20, 21, 22, 24)
TIPS = (41, 28, 19, 10, 1)


@pytest.fixture(scope="module")
def limbs(installed_dataset):
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("SKINSOURCE_DATA", str(installed_dataset))
        opened = [ss.load_limb(f"measured-{number}") for number in range(1, 5)]
        for limb in opened:
            limb.impulse_responses  # noqa: B018  read while the folder is known
    return opened


def energies(limb, axes, at_hz):
    """Of all inputs at the outputs of the hand, (n_bins, 42, 20)."""
    responses = responses_of(limb, axes=axes, inputs=ALL, frequencies_hz=at_hz)
    return np.square(np.abs(responses.values[:, :42])).sum(axis=2)


def best_single_db(energy, target):
    """Contrast of the best single input, of energies (..., 42, 20)."""
    others = np.delete(energy, target - 1, axis=-2).mean(axis=-2)
    return 10 * np.log10((energy[..., target - 1, :] / others).max(axis=-1))


@pytest.mark.parametrize(("axes", "promise_db"), [("z", 4.5), ("xyz", 2.0)])
def test_with_3_db_of_effort_it_beats_the_best_single_input_at_the_sensors(limbs, axes, promise_db):
    gains = []
    for limb in limbs:
        energy = energies(limb, axes, AT_HZ)
        for target in HAND:
            focus = ss.inverse.focus(
                limb, target, axes=axes, inputs=ALL, effort_db=3.0, frequencies_hz=AT_HZ
            )
            gains.append(focus.mean_contrast_db - best_single_db(energy, target))
    assert (np.median(gains, axis=0) >= promise_db).all()
    assert (np.array(gains) < 0.0).mean() < 0.03


@pytest.mark.parametrize(("axes", "promise_db"), [("z", 2.0), ("xyz", 1.0)])
def test_of_natural_taps_it_beats_the_best_single_input_at_unseen_sensors(limbs, axes, promise_db):
    at_hz = np.arange(25.0, 301.0, 25.0)
    gains = []
    for limb in limbs:
        energy = energies(limb, axes, at_hz).sum(axis=0)
        for target in HAND:
            focus = ss.inverse.focus(limb, target, axes=axes, inputs=ALL, frequencies_hz=at_hz)
            natural = np.linalg.norm(focus.row, axis=1) ** 4
            unseen_db = over_bins_db(focus.unseen_contrast_db, natural)
            gains.append(unseen_db - best_single_db(energy, target))
    assert np.median(gains) >= promise_db


def over_bins_db(contrast_db, target_energy):
    return 10 * np.log10(target_energy.sum() / (target_energy * 10 ** (-contrast_db / 10)).sum())


def test_with_one_tip_on_the_next_digit_is_quiet(limbs):
    at_hz = [60.0, 100.0, 200.0]
    found = [
        ss.inverse.focus(limb, TIP_II, quiet=DIGIT_III, inputs=ALL, beta=0.1, frequencies_hz=at_hz)
        for limb in limbs
    ]
    assert np.median([each.mean_contrast_db for each in found]) >= 20.0
    assert np.median([each.unseen_contrast_db for each in found]) >= 10.0


def test_five_tips_have_five_tones_at_once(limbs):
    wanted = {
        output: ss.sinusoid(frequency_hz, 0.2, window_name="hanning")
        for output, frequency_hz in zip(TIPS, (60.0, 100.0, 150.0, 200.0, 300.0), strict=True)
    }
    for limb in limbs:
        found = ss.inverse.reproduce(limb, wanted, quiet=[], inputs=ALL, beta=0.01)
        assert max(found.nmse_db.values()) < -35.0


def test_least_of_the_loudest_beats_least_of_the_mean_in_the_loudest(limbs):
    gains = [
        ss.inverse.quietest(limb, target, inputs=ALL, frequencies_hz=[100.0]).loudest_other_db
        - ss.inverse.focus(
            limb, target, inputs=ALL, effort_db=3.0, frequencies_hz=[100.0]
        ).loudest_other_db
        for limb in limbs
        for target in HAND[::6]
    ]
    assert np.median(gains) > 2.0


@pytest.mark.parametrize("output", [67, 70, 72])
def test_outputs_of_noise_are_no_targets(limbs, output):
    with pytest.raises(ss.SkinSourceError, match="above its noise"):
        ss.inverse.focus(limbs[0], output)


def test_every_output_of_the_hand_is_a_target(limbs):
    for limb in limbs:
        responses = responses_of(limb)
        assert [responses.check_target(output) for output in HAND] == [*HAND]
        assert np.isfinite(energy_of(responses, np.ones((len(responses.values), 15)))).all()


def test_three_inputs_keep_most_of_what_all_give(limbs):
    def score_db(count):
        chosen = [ss.inverse.place(limb, [t], count).score_db for limb in limbs for t in HAND[::6]]
        return np.median(chosen)

    assert score_db(3) > score_db(14) - 2.0
