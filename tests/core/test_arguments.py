"""Whatever scripts hand to the public functions, only `InvalidInputError` may come."""

import math
from contextlib import suppress
from decimal import Decimal
from fractions import Fraction
from functools import cache

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import skinsource as ss
from skinsource.base.arguments import finite_array, integer, real_array, real_number
from skinsource.base.errors import InvalidInputError

MASKED = np.ma.masked_array([1.0, 2.0, 3.0], [False, True, False])
NASTY = (
    None,
    True,
    "5",
    "",
    b"7",
    "x" * 100_000,
    1j,
    0,
    -1,
    7,
    2.5,
    1e200,
    -1e200,
    1e-200,
    5e-324,
    1.7e308,
    math.nan,
    math.inf,
    -math.inf,
    10**400,
    -(10**400),
    1e10,
    Decimal("1.5"),
    Decimal("NaN"),
    Fraction(10**500, 3),
    np.timedelta64(3, "s"),
    [],
    [[]],
    [1.0, 2.0],
    [[1.0, 2.0], [3.0]],
    [[0.5, -0.25, 1.0]],
    [1 + 2j, 3.0],
    [10**400],
    ["1", "2"],
    [None, 1.0],
    [math.nan, 1.0],
    [[math.inf], [1.0]],
    [1.7e308, 1.7e308],
    {},
    {"a": 1},
    set(),
    object(),
    print,
    MASKED,
    np.ma.masked,
    np.array(["a", "b"]),
    np.array([1, 2], "datetime64[s]"),
    np.array(5.0),
    np.zeros((0, 3, 4)),
    np.ones((2, 3, 4)),
    np.full((2, 3, 4), 1e300),
    np.full((2, 3, 4), 1.7e308),
    np.ones((2, 3, 4), complex),
    np.ones(72),
    np.full(72, -np.inf),
    np.ones(72) * 1j,
    np.ones((72, 2), np.float16),
    np.longdouble("1e4000"),
    np.array([np.longdouble("1e4000")]),
    np.array([object()]),
    np.float32(3.0),
    np.int8(3),
    np.zeros((1, 2, 3, 4, 5)),
)
values = st.one_of(
    st.sampled_from(NASTY),
    st.floats(),
    st.integers(),
    st.text(max_size=5),
    st.lists(st.floats(), max_size=4),
    st.lists(st.lists(st.floats(), min_size=2, max_size=2), max_size=3),
)


@cache
def limb() -> ss.Limb:
    return ss.load_limb("synthetic-1")


@cache
def surface() -> ss.SurfaceOperator:
    return ss.surface_operator(limb(), 10.0)


#: The public functions, and what they take that is right.
FUNCTIONS = {
    "predict": (
        ss.predict,
        {"limb": limb, "drives": lambda: [[1.0, 0.5]], "locations": lambda: [7]},
    ),
    "predict with all": (
        ss.predict,
        {
            "limb": limb,
            "drives": lambda: [[1.0, 0.5]],
            "locations": lambda: [7],
            "amplitudes": lambda: [1.0],
            "scaling": lambda: "relative",
        },
    ),
    "project_axes": (
        ss.project_axes,
        {
            "acceleration": lambda: np.ones((2, 3, 4)),
            "axes": lambda: "xyz",
            "method": lambda: "pca",
        },
    ),
    "magnitude_spectrum": (
        ss.magnitude_spectrum,
        {"x": lambda: [1.0, 2.0], "sample_rate_hz": lambda: 1300.0},
    ),
    "rms": (
        ss.rms,
        {"x": lambda: [1.0, 2.0], "span": lambda: "loudest", "sample_rate_hz": lambda: 1300.0},
    ),
    "decibels": (ss.decibels, {"x": lambda: [1.0, 2.0], "reference": lambda: 1.0}),
    "interpolate": (
        lambda **options: surface().interpolate(**options),
        {"values": lambda: np.ones(72)},
    ),
    "surface_operator": (ss.surface_operator, {"limb": limb, "spacing_mm": lambda: 20.0}),
    "sinusoid": (
        ss.sinusoid,
        {
            "frequency_hz": lambda: 100.0,
            "duration_s": lambda: 0.01,
            "phase_rad": lambda: 0.0,
            "window_name": lambda: "none",
            "sample_rate_hz": lambda: 1300.0,
        },
    ),
    "tap": (ss.tap, {"time_s": lambda: 0.0, "sample_rate_hz": lambda: 1300.0}),
    "impulse": (
        ss.impulse,
        {"time_s": lambda: 0.0, "duration_s": lambda: 0.1, "sample_rate_hz": lambda: 1300.0},
    ),
    "white_noise": (
        ss.white_noise,
        {
            "duration_s": lambda: 0.1,
            "seed": lambda: 0,
            "band_hz": lambda: (25.0, 600.0),
            "window_name": lambda: "none",
            "sample_rate_hz": lambda: 1300.0,
        },
    ),
    "window": (ss.window, {"name": lambda: "hanning", "n": lambda: 5}),
    "load_limb": (ss.load_limb, {"name": lambda: "synthetic-2"}),
    "response_to": (
        lambda **options: limb().response_to(**options),
        {"location": lambda: 3},
    ),
}
ARGUMENTS = [(name, word) for name, (_, arguments) in FUNCTIONS.items() for word in arguments]
# A fine map and a long signal are right, and take a while.
COSTLY = {("surface_operator", "spacing_mm")}


@pytest.mark.parametrize(("name", "word"), ARGUMENTS)
def test_whatever_is_handed_in_only_the_error_for_that_comes(name, word):
    function, right = FUNCTIONS[name]
    for value in NASTY:
        arguments = {other: make() for other, make in right.items()} | {word: value}
        with suppress(InvalidInputError):
            function(**arguments)


@pytest.mark.parametrize(
    ("name", "word"), [pair for pair in ARGUMENTS if pair not in COSTLY and pair[1] != "limb"]
)
@settings(max_examples=25, deadline=None, suppress_health_check=list(HealthCheck))
@given(value=values)
def test_whatever_is_drawn_only_the_error_for_that_comes(name, word, value):
    function, right = FUNCTIONS[name]
    arguments = {other: make() for other, make in right.items()} | {word: value}
    with suppress(InvalidInputError):
        function(**arguments)


@pytest.mark.parametrize(
    "name", ["predict", "project_axes", "magnitude_spectrum", "rms", "decibels"]
)
@pytest.mark.parametrize(
    ("spoil", "message"),
    [
        (lambda array: array * 1j, "complex"),
        (lambda array: np.ma.masked_array(array, array == array.flat[0]), "masked"),
        (lambda array: array.astype(str), "cannot be read"),
        (lambda array: np.full_like(array, np.nan), "nan"),
        (lambda array: np.full_like(array, np.inf), "inf"),
        (lambda array: np.full(array.shape, 10**400, object), "cannot be read"),
    ],
)
def test_what_would_lose_or_pass_on_something_is_refused(name, spoil, message):
    function, right = FUNCTIONS[name]
    arguments = {word: make() for word, make in right.items()}
    arrays = {"predict": "drives", "project_axes": "acceleration"}
    word = arrays.get(name, "x")
    arguments[word] = spoil(np.asarray(arguments[word], float))
    with pytest.raises(InvalidInputError, match=message):
        function(**arguments)


@pytest.mark.parametrize(
    "spoil", [lambda array: array * 1j, lambda array: np.ma.masked_array(array, array > 0), str]
)
def test_the_map_refuses_complex_and_masked_values_and_texts(spoil):
    with pytest.raises(InvalidInputError, match="values"):
        surface().interpolate(spoil(np.ones(72)))


def test_a_masked_array_without_a_masked_value_is_an_array():
    whole = np.ma.masked_array([3.0, 4.0], [False, False])
    assert ss.rms(whole) == ss.rms([3.0, 4.0])


@pytest.mark.parametrize("size", [1e200, 1e-200, 1.7e308, 5e-324, 1.0])
def test_the_rms_of_one_value_is_that_value(size):
    assert ss.rms([size]) == size
    assert ss.rms([-size, size]) == size


def test_the_rms_of_a_faint_signal_beside_a_strong_one_is_right():
    assert ss.rms([[1e200, 1e200], [1e-200, 1e-200], [0.0, 0.0]]).tolist() == [1e200, 1e-200, 0.0]


def test_a_faint_spectrum_beside_a_strong_one_is_right():
    _, magnitude = ss.magnitude_spectrum([[1e200], [1e-200]], 1300.0)
    assert magnitude.ravel().tolist() == [1e200, 1e-200]


@pytest.mark.parametrize(
    "call",
    [
        lambda: ss.sinusoid(100, 1e10),
        lambda: ss.white_noise(1e10),
        lambda: ss.tap(1e10),
        lambda: ss.impulse(1e10),
        lambda: ss.impulse(0.0, 1e10),
        lambda: ss.sinusoid(100, 1.0, sample_rate_hz=1e12),
    ],
)
def test_what_is_too_long_is_refused_before_it_is_begun(call):
    with pytest.raises(InvalidInputError, match="expected at most 120000000 samples"):
        call()


def test_drives_for_what_is_no_limb_and_locations_without_end_are_refused():
    with pytest.raises(InvalidInputError, match="limb is 'x', expected a Limb"):
        ss.predict("x", [[0.0]], [7])
    with pytest.raises(InvalidInputError, match="locations"):
        ss.predict(limb(), [[1.0]], iter(lambda: 7, 8))


def test_an_array_of_floats_is_handed_on_uncopied():
    array = np.ones(3)
    assert real_array("x", array) is array
    assert finite_array("x", array) is array


def test_numbers_are_named_with_what_was_found_and_expected():
    with pytest.raises(InvalidInputError, match="gap_s is 'wide', expected a finite number"):
        real_number("gap_s", "wide")
    with pytest.raises(InvalidInputError, match=r"k is 3\.5, expected a whole number from 0 to 9"):
        integer("k", 3.5, 0, 9)
    assert integer("k", np.float32(3.0), 0, 9) == 3
    assert integer("k", 10**30, 0, 10**31) == 10**30
