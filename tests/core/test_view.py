import math
from dataclasses import FrozenInstanceError, replace

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.base.measurement_conditions import AXES
from skinsource.design.view import View
from skinsource.signals.loudest_window import SPANS
from skinsource.signals.projection import METHODS

RANGES = ("time_range_s",)


@pytest.mark.parametrize(
    ("name", "allowed"),
    [
        ("axes", AXES),
        ("method", METHODS),
        ("span", SPANS),
    ],
)
def test_only_known_names_are_taken(name, allowed):
    for value in allowed:
        assert getattr(replace(View(), **{name: value}), name) == value
    for value in ("", "XYZ", None, 1, (allowed[0],)):
        with pytest.raises(InvalidInputError, match=f"{name} is .*expected one of {allowed[0]}"):
            replace(View(), **{name: value})


@pytest.mark.parametrize("outputs", [(), (1,), (72, 1), tuple(range(1, 73)), (10_000,)])
def test_any_different_outputs_can_be_selected_in_any_order(outputs):
    assert View(outputs=outputs).outputs == outputs


@pytest.mark.parametrize(
    "outputs", [(0,), (10_001,), (1, 1), (1.5,), ("1",), [1], None, 1, "1", (None,), ((1, 2),)]
)
def test_impossible_outputs_are_refused(outputs):
    with pytest.raises(InvalidInputError, match=r"View\.outputs is"):
        View(outputs=outputs)


@pytest.mark.parametrize("name", RANGES)
@pytest.mark.parametrize("ends", [(-50, 0), (0.0, 1e-9), (np.float64(1), 2), (-1e200, 1e200)])
def test_a_range_is_two_numbers_stored_as_plain_floats(name, ends):
    stored = getattr(replace(View(), **{name: ends}), name)
    assert stored == ends
    assert [type(end) for end in stored] == [float, float]


@pytest.mark.parametrize("name", RANGES)
@pytest.mark.parametrize(
    "ends",
    [
        (0.0, 0.0),
        (1.0, 0.0),
        (0.0, math.nan),
        (-math.inf, 0.0),
        (0.0, 10**400),
        (2**60, 2**60 + 1),
        (0.0,),
        (0.0, 1.0, 2.0),
        [0.0, 1.0],
        5,
        "ab",
        ("a", "b"),
        (None, 1.0),
        (0j, 1j),
    ],
)
def test_an_impossible_range_is_refused(name, ends):
    with pytest.raises(InvalidInputError, match=f"{name} is"):
        replace(View(), **{name: ends})


@pytest.mark.parametrize("name", RANGES)
def test_no_range_means_everything(name):
    assert getattr(replace(View(), **{name: None}), name) is None


@pytest.mark.parametrize(
    "ids", [(-1,), (0,), (1.5,), ("1",), (2**31,), (True,), (1, 1), [1], None, 1]
)
def test_impossible_selected_inputs_are_refused(ids):
    with pytest.raises(InvalidInputError, match=r"View\.selected_inputs is"):
        View(selected_inputs=ids)


@pytest.mark.parametrize(("ids", "last"), [((), None), ((3,), 3), ((3, 1), 1)])
def test_the_input_that_was_selected_last_stands_apart(ids, last):
    assert View(selected_inputs=ids).selected_input == last


def test_a_switch_is_true_or_false():
    for value in (True, False):
        assert View(delay_removed=value).delay_removed is value
    for value in (0, 1, None, "yes"):
        with pytest.raises(InvalidInputError, match=r"delay_removed is .*True or False"):
            View(delay_removed=value)


def test_settings_of_panels_are_held_by_name():
    view = View(panels=(("skin", (("b", 1.5), ("a", None))), ("map", (("c", (1.0, 2.0)),))))
    other = View(panels=(("map", (("c", (1.0, 2.0)),)), ("skin", (("a", None), ("b", 1.5)))))
    assert view == other
    assert hash(view) == hash(other)


@pytest.mark.parametrize(
    "panels",
    [
        None,
        {},
        [("skin", ())],
        ("skin",),
        (("skin",),),
        ((1, ()),),
        (("", ()),),
        (("skin", ()), ("skin", ())),
        (("skin", (("a", 1), ("a", 2))),),
        (("skin", (("a", [1]),)),),
        (("skin", (("a", math.nan),)),),
        (("skin", (("a", object()),)),),
        (("skin", (("a", "b" * 20_000),)),),
        tuple((f"panel {k}", ()) for k in range(10_000)),
    ],
)
def test_settings_that_are_not_plain_are_refused(panels):
    with pytest.raises(InvalidInputError, match=r"View\.panels is"):
        View(panels=panels)


def test_views_are_values():
    assert View() == View()
    assert hash(View(outputs=(3,))) == hash(View(outputs=(3,)))
    with pytest.raises(FrozenInstanceError):
        View().axes = "x"
