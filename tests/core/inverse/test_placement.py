"""Which few inputs to use: all sets are tried up to three, above it none that is worse is kept."""

from itertools import combinations

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import InvalidInputError
from skinsource.inverse.placement import SAME_FINGERTIP

TIPS = [1, 10, 19, 28, 41]


@pytest.fixture(scope="module")
def limb():
    return ss.load_limb("synthetic-1")


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


def test_up_to_three_no_set_is_better(limb):
    candidates = [6, 7, 8, 12, 13, 16]
    found = ss.inverse.place(limb, [30], 3, candidates=candidates)
    best = max(
        combinations(candidates, 3), key=lambda chosen: score(limb, chosen, candidates=candidates)
    )
    assert found.exhaustive
    assert found.inputs == best


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
