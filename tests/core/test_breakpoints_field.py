"""A field of breakpoints checks each point once, and keeps what is as it was."""

from dataclasses import replace

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.specs.breakpoints import BreakpointsSpec
from skinsource.specs.numbers import NumberSpec
from skinsource.specs.spec import ValidationError

UNIT = NumberSpec(label="Part", minimum=0.0, maximum=1.0)


def test_points_that_were_checked_before_are_not_checked_again(monkeypatch):
    asked, check = [], BreakpointsSpec._is_normal
    monkeypatch.setattr(
        BreakpointsSpec, "_is_normal", lambda spec, point: asked.append(point) or check(spec, point)
    )
    spec = BreakpointsSpec(label="Dragged", x=UNIT, y=UNIT)
    points = tuple((k / 200, 0.5, "straight") for k in range(150))
    assert spec.checked(points) is points
    assert asked == list(points)
    asked.clear()
    dragged = (*points[:70], (0.351, 0.7, "held"), *points[71:])
    assert spec.checked(dragged) is dragged
    assert asked == [(0.351, 0.7, "held")]
    # What is known of a point holds where it stands, and among others in order.
    for wrong in (
        (*points[:70], (0.9, 0.7, "held"), *points[71:]),
        (*dragged[:70], (0.351, 0.7, "bent"), *dragged[71:]),
        (dragged[1], dragged[0], *dragged[2:]),
    ):
        with pytest.raises(InvalidInputError):
            spec.checked(wrong)
    # Another specification knows nothing of it.
    strict = BreakpointsSpec(label="Dragged", x=UNIT, y=replace(UNIT, maximum=0.6))
    with pytest.raises(InvalidInputError):
        strict.checked(dragged)


def test_points_that_are_kept_as_they_are_stay_the_very_same():
    spec = BreakpointsSpec(label="Drawn", x=UNIT, y=UNIT, most=3)
    points = ((0.0, 0.5, "smooth"), (0.5, 1.0, "held"))
    assert spec.checked(points) is points
    others = ((np.float64(0.25), 0, "held"), points[1])
    checked = spec.checked(others)
    assert checked == ((0.25, 0.0, "held"), points[1])
    assert [type(value) for value in checked[0]] == [float, float, str]
    assert checked[1] is points[1]
    assert spec.checked(((0.0, 0.5),)) == ((0.0, 0.5, "straight"),)


@pytest.mark.parametrize(
    "point",
    [
        (0.0, np.nan, "held"),
        (np.inf, 0.0, "held"),
        (-0.1, 0.0, "held"),
        (0.0, 0.0, "bent"),
        (0.0,),
        None,
    ],
)
def test_a_point_outside_what_is_allowed_is_refused_among_good_ones(point):
    spec = BreakpointsSpec(label="Among good ones", x=UNIT, y=UNIT, most=3)
    # Whether others were checked before, as many or not.
    for before in (((0.0, 0.5, "smooth"),), ((0.0, 0.5, "smooth"), (0.5, 1.0, "held"))):
        assert spec.checked(before) is before
        with pytest.raises(ValidationError, match="1 to 3 points"):
            spec.checked(((0.0, 0.5, "smooth"), point))
