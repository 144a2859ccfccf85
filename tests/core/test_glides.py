"""Glides, and strokes that become samples: what lies between points, and how it is drawn."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skinsource import Design, View, edits, track
from skinsource.base.errors import InvalidInputError
from skinsource.design.edits.edit import Edit, Refusal, as_kind
from skinsource.design.waveforms import Chirp, Glide, Noise, Tap, Tone
from skinsource.signals.synthesis import Stroke, curve_of, drawn_over, with_curve, zeroed

RATE_HZ = 1300.0
POINTS = ((0.0, 60.0, 0.0), (0.1, 60.0, 1.0), (0.4, 240.0, 1.0), (0.5, 240.0, 0.0))
STEP = ((0.0, 80.0, 1.0), (0.1, 80.0, 1.0), (0.1, 200.0, 1.0), (0.2, 200.0, 1.0))
DESIGN = Design(limb="synthetic-1", inputs=(track(7, Glide(POINTS)), track(3, Tone())))
#: Times on a grid, so that rounding moves none of them.
TIMES = st.integers(0, 64).map(lambda k: k / 64)
curves = st.lists(st.tuples(TIMES, st.integers(1, 640).map(float)), min_size=2, max_size=8).map(
    lambda points: tuple(sorted(points, key=lambda point: point[0]))
)


RISING = tuple((0.01 * k, 50.0 + 3.0 * k, 1.0) for k in range(30))


@pytest.mark.parametrize(
    ("points", "frequency", "amplitude"),
    [
        (
            POINTS,
            ((0.0, 60.0), (0.1, 60.0), (0.4, 240.0), (0.5, 240.0)),
            ((0.0, 0.0), (0.1, 1.0), (0.4, 1.0), (0.5, 0.0)),
        ),
        (RISING, ((0.0, 50.0), (0.29, 137.0)), ((0.0, 1.0), (0.29, 1.0))),
        (STEP, ((0.0, 80.0), (0.1, 80.0), (0.1, 200.0), (0.2, 200.0)), ((0.0, 1.0), (0.2, 1.0))),
    ],
)
def test_a_curve_has_the_points_at_which_it_bends(points, frequency, amplitude):
    assert curve_of(points, "frequency") == frequency
    assert curve_of(points, "amplitude") == amplitude


def test_a_longer_curve_holds_the_other_one_and_one_without_points_is_refused():
    assert with_curve(POINTS, "amplitude", ((0.0, 1.0), (0.8, 1.0)))[-1] == (0.8, 240.0, 1.0)
    with pytest.raises(InvalidInputError, match="empty"):
        with_curve(POINTS, "frequency", ())


@given(curves, curves)
def test_each_curve_stays_what_it_was_when_the_other_is_drawn(frequency, amplitude):
    amplitude = tuple((time, value / 640) for time, value in amplitude)
    points = with_curve(((0.0, 1.0, 1.0), (1.0, 1.0, 1.0)), "frequency", frequency)
    points = with_curve(points, "amplitude", amplitude)
    # Where there is no step.
    known = {time for time, _ in (*frequency, *amplitude)}
    times_s = [t for t in np.linspace(0.0, amplitude[-1][0], 500)[1:-1] if t not in known]
    for column, curve in (("frequency", frequency), ("amplitude", amplitude)):
        values = np.interp(times_s, *np.array(curve_of(points, column)).T)
        np.testing.assert_allclose(values, np.interp(times_s, *np.array(curve).T), rtol=1e-9)
    assert [point[0] for point in points] == sorted(point[0] for point in points)


@given(curves)
def test_a_curve_that_is_put_back_changes_nothing_that_is_heard(frequency):
    knots = ((*knot, 1.0) for knot in frequency)
    points = ((0.0, *frequency[0][1:], 0.5), *knots, (2.0, 50.0, 0.0))
    glide = Glide(points)
    for column in ("frequency", "amplitude"):
        again = Glide(with_curve(points, column, curve_of(points, column)))
        np.testing.assert_allclose(again.samples(1300.0), glide.samples(1300.0), rtol=0, atol=1e-9)


def test_drawing_a_curve_is_an_edit():
    edit = edits.set_glide_curve(DESIGN, View(), 1, "frequency", ((0.0, 90.0), (0.5, 30.0)))
    assert isinstance(edit, Edit)
    assert edit.label == "Draw frequency of input at 7 (II pad)"
    points = edit.design.clip(1).waveform.points
    assert curve_of(points, "frequency") == ((0.0, 90.0), (0.5, 30.0))
    assert curve_of(points, "amplitude") == curve_of(POINTS, "amplitude")
    assert edit.design.inputs[1] is DESIGN.inputs[1]


@pytest.mark.parametrize(
    ("clip_id", "column", "curve", "message"),
    [
        (2, "frequency", ((0.0, 90.0), (0.5, 30.0)), "does not play a glide"),
        (9, "frequency", ((0.0, 90.0), (0.5, 30.0)), "no clip has the id 9"),
        (1, "frequency", ((0.0, -90.0), (0.5, 30.0)), "Glide.points"),
        (1, "phase", ((0.0, 1.0), (0.5, 1.0)), "does not play a glide"),
    ],
)
def test_a_curve_that_cannot_be_drawn_is_refused_in_words(clip_id, column, curve, message):
    outcome = edits.set_glide_curve(DESIGN, View(), clip_id, column, curve)
    assert isinstance(outcome, Refusal)
    assert message in outcome.sentence


def test_what_has_a_frequency_becomes_a_glide_of_it():
    tone, chirp = Tone(123.0, duration_s=0.4), Chirp(30.0, 500.0, 0.3)
    assert as_kind(tone, Glide, 1300.0).points == ((0.0, 123.0, 1.0), (0.4, 123.0, 1.0))
    assert as_kind(chirp, Glide, 1300.0).points == ((0.0, 30.0, 1.0), (0.3, 500.0, 1.0))
    assert as_kind(Noise(), Glide, 1300.0) == as_kind(Tap(), Glide, 1300.0) == Glide()


PLACES = st.tuples(st.floats(0, 2), st.floats(-1, 1))
PENS = st.lists(PLACES, min_size=1, max_size=30)


@pytest.mark.parametrize(
    ("pen", "points"),
    [
        ([(0.0, 0.0), (0.1, 1.0), (0.2, -1.0)], ((0.0, 0.0), (0.1, 1.0), (0.2, -1.0))),
        # Going back it replaces what it drew there.
        (
            [(0.0, 0.0), (0.1, 1.0), (0.2, 0.5), (0.3, 1.0), (0.15, -1.0)],
            ((0.0, 0.0), (0.1, 1.0), (0.15, -1.0), (0.3, 1.0)),
        ),
        # Of several values at one time the last one stays.
        ([(0.1, 0.0), (0.1, 0.5), (0.1, -0.2)], ((0.1, -0.2),)),
    ],
)
def test_a_pen_leaves_the_points_that_it_drew_last(pen, points):
    assert Stroke.through(pen).points == points


@given(PENS)
def test_a_stroke_rises_in_time_whatever_the_pen_does(pen):
    stroke = Stroke.through(pen)
    times = [time for time, _ in stroke.points]
    assert times == sorted(set(times))
    # The last place of the pen is always part of it.
    assert stroke.points[times.index(pen[-1][0])][1] == pytest.approx(pen[-1][1], abs=1e-12)


@given(PENS)
def test_samples_stay_within_what_was_drawn(pen):
    stroke = Stroke.through(pen)
    first, samples = stroke.samples(RATE_HZ)
    values = [value for _, value in stroke.points]
    assert first >= 0
    assert min(values) <= samples.min() <= samples.max() <= max(values)
    assert samples.size >= 1


@given(st.lists(st.integers(0, 600), min_size=2, max_size=12, unique=True).map(sorted))
def test_points_on_samples_are_met_exactly(numbers):
    values = np.cos(np.array(numbers) * 1.7)
    pen = [(k / RATE_HZ, float(v)) for k, v in zip(numbers, values, strict=True)]
    first, samples = Stroke.through(pen).samples(RATE_HZ)
    assert first == numbers[0]
    assert samples.size == numbers[-1] - numbers[0] + 1
    np.testing.assert_allclose(samples[np.array(numbers) - first], values, atol=1e-12)


def test_a_stroke_covers_its_own_time_and_nothing_else():
    before = np.full(100, 0.25)
    stroke = Stroke.through([(10 / RATE_HZ, 1.0), (19 / RATE_HZ, 1.0)])
    after = drawn_over(before, stroke, RATE_HZ)
    assert (after[10:20] == 1.0).all()
    assert (np.delete(after, slice(10, 20)) == 0.25).all()
    assert (before == 0.25).all()


def test_a_stroke_makes_the_signal_longer_and_moves_the_nearest_sample():
    beyond = Stroke.through([(8 / RATE_HZ, 0.5), (9 / RATE_HZ, 0.5)])
    after = drawn_over(np.ones(5), beyond, RATE_HZ)
    assert after.tolist() == [1, 1, 1, 1, 1, 0, 0, 0, 0.5, 0.5]
    between = Stroke.through([(10.3 / RATE_HZ, 0.5), (10.4 / RATE_HZ, 0.7)])
    after = drawn_over(np.zeros(20), between, RATE_HZ)
    assert np.flatnonzero(after).tolist() == [10]


def test_zero_is_drawn_from_end_to_end_in_either_direction():
    for ends in ((3, 6), (6, 3)):
        after = zeroed(np.ones(10), *(end / RATE_HZ for end in ends), RATE_HZ)
        assert np.flatnonzero(after == 0).tolist() == [3, 4, 5, 6]
