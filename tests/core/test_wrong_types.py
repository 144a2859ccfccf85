"""Wrong types, handed to any public function, are refused: by an error of the library, or so."""

import inspect
from functools import cache
from types import ModuleType

import numpy as np
import pytest

import skinsource as ss
from skinsource.actuators.prediction import Limits
from skinsource.perception.validity import Finding

#: They play on sound cards.
LEFT_OUT = {"ss.rig_measuring.measure", "ss.rig_measuring.input_devices"}
#: They take a second each time; of these the first argument is enough.
SLOW = {
    *("ss.export_stimulus", "ss.plot.map", "ss.plot.spectra", "ss.plot.strip", "ss.plot.traces"),
    *("ss.recordings.take", "ss.sweeps.sweep", "ss.sweep"),
}


def public_functions(module: ModuleType, name: str) -> dict:
    functions = {}
    for part in module.__all__:
        value = getattr(module, part)
        if isinstance(value, ModuleType):
            functions |= public_functions(value, f"{name}.{part}")
        elif inspect.isfunction(value) and f"{name}.{part}" not in LEFT_OUT:
            functions[f"{name}.{part}"] = value
    return functions


#: Each once, where several packages have it.
FUNCTIONS = {function: name for name, function in public_functions(ss, "ss").items()}
FUNCTIONS = {name: function for function, name in FUNCTIONS.items()}


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
    "ss.actuators.load": {"name": "example-voice-coil"},
    "ss.edits.change_limb": {"limb": "synthetic-1"},
    "ss.edits.select_through": {"start": 1, "end": 2},
    "ss.perception.threshold_rms": {"channel": "P"},
    "ss.rigs.rig_breaches": {"samples": [[0.1, 0.2]]},
    "ss.scenes.why_not_on": {"limb": "synthetic-1"},
    "ss.window": {"name": "hanning"},
}


def outcome_of(function, parameters, arguments):
    positional = [
        arguments[name]
        for name, parameter in parameters.items()
        if name in arguments and parameter.kind is not parameter.KEYWORD_ONLY
    ]
    named = {
        name: arguments[name]
        for name, parameter in parameters.items()
        if name in arguments and parameter.kind is parameter.KEYWORD_ONLY
    }
    return function(*positional, **named)


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
        for wrong in (*WRONG, *([Endless()] if name.startswith("ss.edits") else [])):
            try:
                outcome_of(function, parameters, fitting | {part: wrong})
            except ss.SkinSourceError:
                continue
            except (TypeError, AttributeError, ValueError, LookupError, ArithmeticError) as error:
                escaped.append(f"{part}={wrong!r}: {type(error).__name__}: {error}")
    assert not escaped, f"{len(escaped)}\n" + "\n".join(escaped[:20])
