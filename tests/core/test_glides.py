"""Glides: what lies between their points, and frequency and amplitude as curves of their own."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skinsource import Design, View, edits, track
from skinsource.base.errors import InvalidInputError
from skinsource.design.edits.edit import Edit, Refusal, as_kind
from skinsource.design.waveforms import Chirp, Glide, Noise, Tap, Tone
from skinsource.signals.synthesis import curve_of, with_curve

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
