"""Designs that are held against each other: strengths in proportion, and inputs that add up."""

import math
from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource.design.clips import Marker
from skinsource.studies.checking import joint_of, proportion, strengths_of, superposition

TONE = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.1)
RATE_HZ = 1300.0


def played(*places, amplitude=1.0, **others):
    tracks = tuple(ss.track(place, TONE, amplitude=amplitude) for place in places)
    return ss.Design(limb="synthetic-1", inputs=tracks, scaling="probe", **others)


def test_designs_that_differ_in_strength_and_words_alone_have_strengths():
    designs = [played(8, amplitude=k, title=f"At {k}", notes="As loud") for k in (1.0, 4.0, 2.0)]
    assert strengths_of(designs) == (1.0, 4.0, 2.0)
    assert joint_of(designs) is None


@pytest.mark.parametrize(
    "about",
    [
        {"author": "Somebody"},
        {"licence": "CC BY"},
        {"loop_s": (0.0, 0.1)},
        {"markers": (Marker(time_s=0.1),)},
    ],
)
def test_what_is_not_heard_keeps_neither_strengths_nor_a_joint_design(about):
    louder = [played(8), played(8, amplitude=2.0, **about), played(8, amplitude=3.0)]
    assert strengths_of(louder) == (1.0, 2.0, 3.0)
    assert joint_of([played(8), played(13, **about), played(8, 13)]) == 2


@pytest.mark.parametrize(
    "designs",
    [
        [],
        [played(8), played(8, amplitude=2.0)],
        [played(8), played(8, amplitude=2.0), played(8, amplitude=2.0)],
        [played(8), played(8, amplitude=2.0), played(9, amplitude=3.0)],
        [
            played(8),
            played(8, amplitude=2.0),
            replace(played(8, amplitude=3.0), limb="synthetic-2"),
        ],
        [played(8, amplitude=0.0), played(8, amplitude=2.0), played(8, amplitude=3.0)],
        [played(8, amplitude=-k) for k in (1.0, 2.0, 3.0)],
        [played(8), played(), played(8, amplitude=3.0)],
        [played(8, 13), played(8, amplitude=2.0), played(8, amplitude=3.0)],
        [played(8), played(8, 13, amplitude=2.0), played(8, amplitude=3.0)],
    ],
)
def test_others_have_none(designs):
    assert strengths_of(designs) == ()


def test_what_is_heard_counts_whether_others_are_muted_or_it_alone_is_solo():
    both = played(8, 13)
    solo, muted = both.with_input(0, solo=True), both.with_input(1, muted=True)
    assert joint_of([solo, played(13), both]) == joint_of([muted, played(13), both]) == 2
    louder = [solo.with_input(0, amplitude=k) for k in (1.0, 2.0)]
    assert strengths_of([*louder, played(8, amplitude=3.0)]) == (1.0, 2.0, 3.0)


@pytest.mark.parametrize("order", [(0, 1, 2), (2, 0, 1), (1, 2, 0)])
def test_the_joint_design_is_found_among_its_parts(order):
    designs = [played(8), played(13), played(8, 13, title="Both")]
    assert joint_of([designs[k] for k in order]) == order.index(2)


@pytest.mark.parametrize(
    "designs",
    [
        [played(8), played(8)],
        [played(8), played(13), played(8, 14)],
        [played(8), played(13, amplitude=2.0), played(8, 13)],
        [played(8), replace(played(13), limb="synthetic-2"), played(8, 13)],
        [played(), played(8), played(8)],
        [played(8), played(13), played(8, 8)],
        [played(8), played(8), played(8, 13)],
    ],
)
def test_others_have_no_joint_one(designs):
    assert joint_of(designs) is None


def test_a_linear_response_is_the_same_once_divided_and_a_line_through_zero():
    rng = np.random.default_rng(1)
    unit = rng.normal(size=(2, 400))
    x = np.array([2.0, 1.0, 5.0])
    result = proportion(x, x[:, None, None] * unit, RATE_HZ, None)
    assert result.strengths.tolist() == [1.0, 2.0, 5.0]
    assert result.largest_difference < 1e-14
    assert np.allclose(result.divided, unit)
    rms = np.sqrt(np.mean(unit**2, axis=-1))
    assert np.allclose(result.rms, result.strengths[:, None] * rms)
    assert np.allclose(result.line, result.rms)
    shorter = proportion(x, x[:, None, None] * unit, RATE_HZ, None, 100)
    for name in ("rms", "line", "band_rms", "band_line"):
        assert np.allclose(getattr(shorter, name), 2.0 * getattr(result, name))
    assert np.nanmin(result.adjusted_r2) > 1.0 - 1e-12


def test_a_response_that_saturates_is_told():
    rng = np.random.default_rng(2)
    unit = rng.normal(size=(1, 400))
    x = np.array([1.0, 2.0, 3.0, 4.0])
    result = proportion(x, np.tanh(x[:, None, None] * unit), RATE_HZ, None)
    assert result.largest_difference > 0.3
    assert np.nanmin(result.adjusted_r2) < 0.9
    assert np.abs(result.line - result.rms).max() > 0.005
    through = np.polynomial.Polynomial.fit(x, result.rms[:, 0], 1)
    np.testing.assert_allclose(result.line[:, 0], through(x))
    band = result.band_rms[:, 0, 40]
    through = np.polynomial.Polynomial.fit(x, band, 1)
    np.testing.assert_allclose(result.band_line[:, 0, 40], through(x))
    assert abs(through(0.0)) > 0.05 * band.max()


def test_what_inputs_cause_together_is_held_against_their_sum():
    rng = np.random.default_rng(3)
    first, second = rng.normal(size=(2, 300)), rng.normal(size=(2, 200))
    joint = first.copy()
    joint[:, :200] += second
    result = superposition([first, second], joint)
    assert np.array_equal(result.separate, joint)
    assert result.largest_difference == 0.0
    assert np.allclose(result.correlation, 1.0)
    bent = superposition([first, second], np.tanh(joint))
    assert bent.largest_difference > 0.1
    assert (bent.correlation < 0.99).all()


def test_differences_are_a_part_of_the_peak_of_either_sign():
    down = np.array([[0.0, -4.0, 1.0]])
    other = np.array([[0.0, -4.0, 1.5]])
    assert superposition([down], other).largest_difference == pytest.approx(0.5 / 4.0)
    result = proportion([1.0, 2.0, 4.0], down * [[[1.0]], [[2.0]], [[4.2]]], RATE_HZ, None)
    assert result.largest_difference == pytest.approx(0.05 * 4.0 / (1.05 * 4.0))
    assert math.isnan(superposition([0.0 * down], 0.0 * down).largest_difference)
