import math
from dataclasses import FrozenInstanceError, replace

import numpy as np
import pytest

from skinsource.errors import InvalidInputError
from skinsource.projection import AXES, METHODS
from skinsource.view import LAYOUTS, MAP_STYLES, View

RANGES = ("map_range_db", "time_range_s", "frequency_range_hz")


@pytest.mark.parametrize(
    ("name", "allowed"),
    [
        ("axes", AXES),
        ("method", METHODS),
        ("map_style", MAP_STYLES),
        ("traces_layout", LAYOUTS),
        ("spectra_layout", LAYOUTS),
    ],
)
def test_only_known_names_are_taken(name, allowed):
    for value in allowed:
        assert getattr(replace(View(), **{name: value}), name) == value
    for value in ("", "XYZ", None, 1, (allowed[0],)):
        with pytest.raises(InvalidInputError, match=f"{name} is .*expected one of {allowed[0]}"):
            replace(View(), **{name: value})


@pytest.mark.parametrize("outputs", [(), (1,), (72, 1), tuple(range(1, 73))])
def test_any_different_outputs_can_be_selected_in_any_order(outputs):
    assert View(outputs=outputs).outputs == outputs


@pytest.mark.parametrize(
    "outputs", [(0,), (73,), (1, 1), (1.0,), ("1",), [1], None, 1, "1", (None,), ((1, 2),)]
)
def test_impossible_outputs_are_refused(outputs):
    with pytest.raises(InvalidInputError, match="outputs are"):
        View(outputs=outputs)


@pytest.mark.parametrize("name", RANGES)
@pytest.mark.parametrize("ends", [(-50, 0), (0.0, 1e-9), (np.float64(1), 2), (-1e200, 1e200)])
def test_a_range_is_two_numbers_stored_as_plain_floats(name, ends):
    found = getattr(replace(View(), **{name: ends}), name)
    assert found == ends
    assert [type(end) for end in found] == [float, float]


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


@pytest.mark.parametrize("index", [-1, 0.0, "0", 2**31, ()])
def test_an_impossible_selected_input_is_refused(index):
    with pytest.raises(InvalidInputError, match="selected_input"):
        View(selected_input=index)
    assert View(selected_input=None).selected_input is None


@pytest.mark.parametrize(
    "name", ["sensors_shown", "log_frequency", "log_magnitude", "delay_removed"]
)
def test_switches_are_true_or_false(name):
    for value in (True, False):
        assert getattr(replace(View(), **{name: value}), name) is value
    for value in (0, 1, None, "yes"):
        with pytest.raises(InvalidInputError, match=f"{name} is .*True or False"):
            replace(View(), **{name: value})


def test_views_are_values():
    assert View() == View()
    assert hash(View(outputs=(3,))) == hash(View(outputs=(3,)))
    with pytest.raises(FrozenInstanceError):
        View().axes = "x"
