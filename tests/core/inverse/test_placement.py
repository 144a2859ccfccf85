"""Which few inputs to use: all sets are tried up to three, above it none that is worse is kept."""

from itertools import combinations

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import InvalidInputError, Stopped
from skinsource.inverse import placement
from skinsource.inverse.placement import FINGERTIPS, SAME_FINGERTIP

TIPS = list(FINGERTIPS)


def score(limb, inputs, targets=(30,), candidates=range(1, 21), axes="z", beta=0.3):
    """The score by its formula, with λ that of all candidates."""
    total = []
    for frequency in np.geomspace(50.0, 300.0, 12):
        phase = np.exp(-2j * np.pi * frequency / 1300.0 * np.arange(522))
        axis = slice(2, 3) if axes == "z" else slice(0, 3)
        every = np.moveaxis(limb.impulse_responses[:, :42, axis] @ phase, 0, 2)
        candidate = every[..., np.array(candidates) - 1].reshape(-1, len(candidates))
        load = beta * np.square(np.abs(candidate)).sum() / len(candidates)
        for target in targets:
            quiet = np.delete(every, target - 1, axis=0)[..., np.array(inputs) - 1]
            quiet = quiet.reshape(-1, len(inputs))
            rows = every[target - 1][:, np.array(inputs) - 1]
            inverse = np.linalg.inv(quiet.conj().T @ quiet + load * np.eye(len(inputs)))
            total.append(np.log10(41 * np.linalg.eigvalsh(rows @ inverse @ rows.conj().T)[-1]))
    return 10.0 * np.mean(total)


@pytest.mark.parametrize("axes", ["z", "xyz"])
def test_the_score_is_that_of_its_formula(limb, axes):
    found = ss.inverse.place(limb, [30, 9], 3, axes=axes)
    expected_db = score(limb, found.inputs, (30, 9), axes=axes)
    np.testing.assert_allclose(found.score_db, expected_db, rtol=1e-10)


def test_up_to_three_the_ranking_is_that_of_all_sets_however_many_are_judged_at_once(
    limb, monkeypatch
):
    monkeypatch.setattr(placement, "_AT_ONCE", 7)
    candidates = [6, 7, 8, 12, 13, 16]
    found = ss.inverse.place(limb, [30], 3, candidates=candidates)
    ranked = sorted(
        combinations(candidates, 3), key=lambda chosen: -score(limb, chosen, candidates=candidates)
    )
    assert found.exhaustive
    assert [each.inputs for each in found.ranked] == ranked[: len(found.ranked)]
    assert found.inputs == ranked[0]
    whole_db = score(limb, candidates, candidates=candidates)
    for each in found.ranked:
        expected_db = score(limb, each.inputs, candidates=candidates)
        np.testing.assert_allclose(each.score_db, expected_db, rtol=1e-10)
        np.testing.assert_allclose(each.loss_db, whole_db - expected_db, rtol=1e-8)


def test_above_three_the_others_are_one_exchange_away_and_no_better(limb):
    found = ss.inverse.place(limb, TIPS, 5)
    scores = [each.score_db for each in found.ranked]
    assert not found.exhaustive
    assert len(scores) > 3
    assert scores == sorted(scores, reverse=True)
    assert all(len(set(each.inputs) & set(found.inputs)) == 4 for each in found.ranked[1:])


def test_a_layout_is_judged_elsewhere_as_it_would_be_chosen_there(limb):
    for chosen in ss.inverse.place(limb, [30], 2).ranked:
        same = ss.inverse.layout(limb, [30], chosen.inputs)
        assert same.inputs == chosen.inputs
        np.testing.assert_allclose(same.score_db, chosen.score_db, rtol=1e-12)
        np.testing.assert_allclose(same.loss_db, chosen.loss_db, rtol=1e-9)
    there = ss.inverse.layout("synthetic-2", [30], (12, 7))
    expected_db = score(ss.load_limb("synthetic-2"), (7, 12))
    np.testing.assert_allclose(there.score_db, expected_db, rtol=1e-10)
    assert there.inputs == (7, 12)
    with pytest.raises(InvalidInputError, match="some of the candidates"):
        ss.inverse.layout(limb, [30], (7, 12), candidates=(7, 8))


def test_placing_stops_when_it_is_asked_to(limb):
    asked = []
    with pytest.raises(Stopped):
        ss.inverse.place(limb, TIPS, 3, stop=lambda: asked.append(0) or len(asked) > 3)
    assert len(asked) == 4


def test_above_three_inputs_are_exchanged_as_long_as_it_helps(limb):
    found = ss.inverse.place(limb, TIPS, 4, beta=0.03, keep_apart=False)
    assert not found.exhaustive
    for out in found.inputs:
        for new in set(range(1, 21)) - set(found.inputs):
            swapped = [new if place == out else place for place in found.inputs]
            assert score(limb, swapped, TIPS, beta=0.03) <= found.score_db + 1e-9


def test_the_score_never_falls_with_more_inputs(limb):
    scores = [ss.inverse.place(limb, TIPS, count, beta=0.03).score_db for count in range(1, 8)]
    assert (np.diff(scores) >= 0.0).all()


def test_no_fingertip_gets_two_inputs_unless_asked(limb):
    def both(inputs):
        return any(set(pair) <= set(inputs) for pair in SAME_FINGERTIP)

    assert not both(ss.inverse.place(limb, TIPS, 8).inputs)
    assert ss.inverse.place(limb, [1], 2, candidates=[5, 10], keep_apart=False).inputs == (5, 10)
    with pytest.raises(InvalidInputError, match="different fingertips"):
        ss.inverse.place(limb, [1], 2, candidates=[5, 10])


def test_several_limbs_are_judged_together(limb):
    other = ss.load_limb("synthetic-2")
    found = ss.inverse.place([limb, other], [30], 2)
    mean_db = np.mean([score(one, found.inputs) for one in (limb, other)])
    np.testing.assert_allclose(found.score_db, mean_db, rtol=1e-10)


@pytest.mark.parametrize(
    ("arguments", "match"),
    [
        (([], 2), "No limb or no target"),
        (([30], 21), "count is 21"),
        (([73], 2), "from 1 to 72"),
    ],
)
def test_what_cannot_be_placed_is_refused(limb, arguments, match):
    with pytest.raises(InvalidInputError, match=match):
        ss.inverse.place(limb, *arguments)
