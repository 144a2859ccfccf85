"""Whatever scripts hand to a public function, only errors of the library come of it."""

import inspect
import math
from decimal import Decimal
from fractions import Fraction
from functools import cache

import numpy as np
import pytest

import skinsource as ss
from skinsource.actuators.prediction import Limits
from skinsource.base.arguments import finite_array, integer, real_array, real_number
from skinsource.base.errors import InvalidInputError
from skinsource.perception.validity import Finding
from tests.core.frozen.read_frozen import public

#: They play on sound cards.
LEFT_OUT = {"rig_measuring.measure", "rig_measuring.input_devices"}
#: They take a second each time; of these the first argument is enough.
SLOW = {
    *("export_stimulus", "plot.map", "plot.spectra", "plot.strip", "plot.traces"),
    *("recordings.take", "sweeps.sweep", "sweep"),
}


#: Each once, where several packages have it.
NAMES = {function: name for name, function in public().items() if inspect.isfunction(function)}
FUNCTIONS = {name: function for function, name in NAMES.items() if name not in LEFT_OUT}


class Endless:
    """Numbers without end; whoever asks for a million would ask for ever."""

    def __iter__(self):
        for k in range(1_000_000):
            yield 10**6 + k
        pytest.fail("an argument without end is read to its end")


WRONG = [
    *(None, -3, 10**400, float("nan"), "x", b"x", object(), (object(),), [[1.0]], {"a": 1}),
    np.array([None]),
]

MASKED = np.ma.masked_array([1.0, 2.0, 3.0], [False, True, False])
NASTY = (
    *(True, "5", "", "x" * 100_000, 1j, {}, set(), print, [], [[]], [None, 1.0], ["1", "2"]),
    *(0, -1, 7, 2.5, 1e10, 1e200, -1e200, 1e-200, 5e-324, 1.7e308, math.inf, -math.inf),
    *(-(10**400), Decimal("1.5"), Decimal("NaN"), Fraction(10**500, 3), np.longdouble("1e4000")),
    *([1.0, 2.0], [[1.0, 2.0], [3.0]], [[0.5, -0.25, 1.0]], [1 + 2j, 3.0], [10**400]),
    *([math.nan, 1.0], [[math.inf], [1.0]], [1.7e308, 1.7e308], MASKED, np.ma.masked),
    *(np.timedelta64(3, "s"), np.array([1, 2], "datetime64[s]"), np.array(["a", "b"])),
    *(np.array(5.0), np.float32(3.0), np.int8(3), np.array([object()]), np.ones(72) * 1j),
    *(np.ones(72), np.full(72, -np.inf), np.ones((72, 2), np.float16), np.zeros((0, 3, 4))),
    *(np.ones((2, 3, 4)), np.full((2, 3, 4), 1e300), np.full((2, 3, 4), 1.7e308)),
    *(np.ones((2, 3, 4), complex), np.zeros((1, 2, 3, 4, 5)), np.array([np.longdouble("1e4000")])),
)
#: Functions of plain numbers, which are handed all of these.
NUMERIC = {
    *("decibels", "impulse", "magnitude_spectrum", "predict", "project_axes"),
    *("rms", "sinusoid", "tap", "white_noise", "window", "surface_operator"),
}


@cache
def good_arguments() -> dict:
    """A valid argument for parameters of this name; of others None is handed over."""
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(7), ss.track(2)))
    channel = ss.rigs.RigChannel(place=7, full_scale_v=2.0)
    coil = ss.actuators.load("example-voice-coil")
    tone = np.sin(np.arange(0.0, 100.0))
    glide = ((0.0, 1.0), (0.1, 0.5))
    return {
        **dict.fromkeys(
            ("design", "before", "after", "designs", "shown", "start", "other"), design
        ),
        **dict.fromkeys(("acceleration", "response", "voltage", "volts", "samples", "x"), tone),
        **dict.fromkeys(("drive", "signals", "values"), tone),
        **dict.fromkeys(("sample_rate_hz", "from_hz", "to_hz"), 2600),
        **dict.fromkeys(("id", "input_id", "clip_id", "number", "lead", "location", "n"), 1),
        **dict.fromkeys(("at_s", "by_s", "in_s", "out_s", "start_s", "onset_s", "time_s"), 0.01),
        **dict.fromkeys(("length_s", "end_s", "duration_s", "value"), 0.02),
        **dict.fromkeys(("index", "to", "shift_s"), 0),
        **dict.fromkeys(("curve", "points"), glide),
        **dict.fromkeys(("actuator", "actuators"), coil),
        "actuation": None,
        "axes": "xyz",
        "band_hz": (25.0, 600.0),
        "changes": {},
        "channel": channel,
        "column": "frequency",
        "count": 3,
        "drives": [tone],
        "effects": (ss.effects.Fade(),),
        "equaliser": ss.equalising.RegularisedInverse(),
        "finding": Finding(name="band", state="left", sentence="", repair="quieter", factor=0.5),
        "fragment": ss.edits.fragment_of(design, (1,)),
        "frequency_hz": np.linspace(30.0, 300.0, 100),
        "high_hz": 300.0,
        "ids": (1,),
        "kind": "Tone",
        "levels_db": (1.0, 2.0),
        "limb": ss.load_limb("synthetic-1"),
        "limits": Limits(),
        "locations": (7,),
        "low_hz": 30.0,
        "measure": "levels",
        "method": "mag",
        "motion": ss.motions.Alternation(),
        "name": "frequency_hz",
        "one": design.inputs[0],
        "order": ss.sweeps.Order(),
        "outputs": (1,),
        "path": "file.wav",
        "places": (7,),
        "quantities": "output_levels_db",
        "rig": ss.rigs.Rig(channels=(channel,)),
        "rms": np.ones(72),
        "setup": ss.rig_measuring.MeasuringSetup(),
        "several": Limits(),
        "stimuli": (1, 2),
        "times": 2,
        "view": ss.View(),
        "waveform": ss.waveforms.Tone(),
        "window_samples": 5,
        "words": "{}",
    }


#: Where a name stands for something else.
SPECIAL = {
    "decibels": {"x": [1.0, 2.0]},
    "project_axes": {"acceleration": np.ones((2, 3, 4))},
    "actuators.load": {"name": "example-voice-coil"},
    "edits.change_limb": {"limb": "synthetic-1"},
    "edits.select_through": {"start": 1, "end": 2},
    "perception.threshold_rms": {"channel": "P"},
    "rigs.rig_breaches": {"samples": [[0.1, 0.2]]},
    "scenes.why_not_on": {"limb": "synthetic-1"},
    "window": {"name": "hanning"},
}


def outcome_of(function, parameters, arguments):
    named = {
        name: arguments[name]
        for name, parameter in parameters.items()
        if parameter.kind is parameter.KEYWORD_ONLY
    }
    return function(*(arguments[name] for name in parameters if name not in named), **named)


@pytest.mark.parametrize("name", FUNCTIONS)
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_wrong_types_are_refused(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    function = FUNCTIONS[name]
    parameters = {
        part: parameter
        for part, parameter in inspect.signature(function).parameters.items()
        if parameter.kind is not parameter.VAR_KEYWORD and part != "ax"
    }
    good = good_arguments() | SPECIAL.get(name, {})
    fitting = {}
    for part, parameter in parameters.items():
        is_required = parameter.default is parameter.empty
        fitting[part] = good.get(part) if is_required else parameter.default
    escaped = []
    for part in list(parameters)[: 1 if name in SLOW else None]:
        more = NASTY if name in NUMERIC else ()
        more = (*more, Endless()) if more or name.startswith("edits") else ()
        for wrong in (*WRONG, *more):
            try:
                outcome_of(function, parameters, fitting | {part: wrong})
            except ss.SkinSourceError:
                continue
            except (TypeError, AttributeError, ValueError, LookupError, ArithmeticError) as error:
                escaped.append(f"{part}={wrong!r}: {type(error).__name__}: {error}")
    assert not escaped, f"{len(escaped)}\n" + "\n".join(escaped[:20])


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
    array = spoil(np.ones((2, 3, 4)) if name == "project_axes" else np.ones((1, 2)))
    more = {"magnitude_spectrum": (1300.0,), "predict": ([7],)}.get(name, ())
    first = (ss.load_limb("synthetic-1"),) if name == "predict" else ()
    with pytest.raises(InvalidInputError, match=message):
        getattr(ss, name)(*first, array, *more)


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
