"""Each sidecar is as ``docs/sidecar.schema.json`` says."""

import json
from dataclasses import replace
from functools import cache
from pathlib import Path

import jsonschema
import pytest

import skinsource as ss
from skinsource.actuators.measured_response import MeasuredResponse
from skinsource.actuators.rigs import Rig, RigChannel
from skinsource.base.errors import InvalidInputError
from skinsource.export.formats import format_named
from skinsource.export.stimulus_export import sidecar
from tests.core.exporting.export_bench import actuation

SCHEMA = json.loads(
    (Path(__file__).parents[3] / "docs" / "sidecar.schema.json").read_text(encoding="utf-8")
)
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)
BURST = ss.waveforms.Gabor(frequency_hz=150.0, cycles=8.0)
DESIGN = ss.Design(
    limb="synthetic-1",
    title="Two places",
    inputs=(
        ss.track(7, BURST, onset_s=0.1, amplitude=2.0),
        replace(ss.track(12, BURST, onset_s=0.15), gain_curve=((0.0, 0.5), (0.3, 1.0))),
    ),
)
COIL, PIEZO = ss.actuators.load("example-voice-coil"), ss.actuators.load("example-piezo")
FLAT = MeasuredResponse(((1.0, 50.0, 0.0), (2000.0, 50.0, 0.0)))
INVERSE = ss.equalising.RegularisedInverse(boost_db=12.0)
REPLACED = ss.equalising.PolePairReplacement(*ss.equalising.resonance_of(COIL))
RIG = Rig(
    title="Bench",
    channels=(
        RigChannel(place=7, full_scale_v=1.0, measured=FLAT, delay_s=0.001),
        RigChannel(
            place=12, output=2, full_scale_v=2.0, actuator="example-piezo", polarity="inverted"
        ),
    ),
)


THROUGH = replace(DESIGN, actuation=actuation(COIL, INVERSE))
VOLTS = replace(DESIGN, actuation=actuation(COIL))
CASES = {
    "bare": (DESIGN, {}),
    "upstream": (replace(DESIGN, scaling="upstream"), {}),
    "relative": (replace(DESIGN, scaling="relative"), {}),
    "named": (DESIGN, {"actuation": actuation(COIL)}),
    "equalised": (DESIGN, {"actuation": actuation(COIL), "equaliser": INVERSE}),
    "replaced": (DESIGN, {"actuation": actuation(COIL), "equaliser": REPLACED}),
    "piezo": (DESIGN, {"actuation": actuation(PIEZO), "equaliser": INVERSE}),
    "as predicted": (THROUGH, {"equaliser": INVERSE}),
    "predicted, not equalised": (THROUGH, {"equaliser": "none"}),
    "volts": (VOLTS, {}),
    "volts through a rig": (VOLTS, {"rig": RIG}),
    "rig": (DESIGN, {"rig": RIG}),
    "rig, equalised": (DESIGN, {"rig": RIG, "equaliser": INVERSE}),
    "channels": (
        DESIGN,
        {"options": ss.StimulusOptions(per="input", sync=True, channel_map=(2, 0, 1, 3))},
    ),
    "files": (
        DESIGN,
        {"options": ss.StimulusOptions(one_file_per_input=True, dither_seed=2, from_s=0.05)},
    ),
    "people": (DESIGN, {"options": ss.StimulusOptions(one_file_per_input=True, people=True)}),
    "clipped": (DESIGN, {"options": ss.StimulusOptions(full_scale=0.5)}),
}


@pytest.fixture(scope="module", autouse=True)
def _predicted_once():
    """Conditions of a design are predicted for its first sidecar, and known from then on."""
    with pytest.MonkeyPatch.context() as patch:
        for name in ("about_validity", "about_range"):
            patch.setattr(sidecar, name, cache(getattr(sidecar, name)))
        yield


def test_the_schema_is_one():
    jsonschema.Draft202012Validator.check_schema(SCHEMA)


@pytest.mark.parametrize("name", ss.export_formats())
def test_each_sidecar_of_each_format_is_as_the_schema_says(tmp_path, name):
    kind, n_written = format_named(name), 0
    for case, (design, call) in CASES.items():
        folder = tmp_path / case
        folder.mkdir()
        path = folder / f"a{kind.suffix}"
        equaliser = None if call.get("equaliser") == "none" else call.get("equaliser")
        try:
            done = ss.export_stimulus(design, path, name, confirmed=True, **call)
        except InvalidInputError:
            # A chip refuses an equaliser, or one that is made for an actuator of another kind.
            assert equaliser is not None, case
            assert not (kind.plays_waveform and kind.drives(COIL)), case
            continue
        for path in done.files:
            about = json.loads((path.parent / f"{path.name}.json").read_text(encoding="utf-8"))
            VALIDATOR.validate(about)
            for each in about["inputs"]:
                assert each["gain_curve"] == {7: [], 12: [[0.0, 0.5], [0.3, 1.0]]}[each["place"]]
            assert about["equalised"] == done.equalised
            assert (about["equaliser"] is None) == (equaliser is None)
            assert done.equalised.startswith("Not equalised" if equaliser is None else "Equalised")
            assert ("range_between_people" in about) == (case == "people")
            n_written += 1
    assert n_written >= 10


@pytest.mark.parametrize(
    ("case", "means"),
    [
        ("bare", "Amplitudes are accelerations of the probe in m/s², within about 3 dB."),
        ("volts", "An amplitude is voltage at the actuator, in V."),
        ("as predicted", "An amplitude is acceleration at the contactor, in m/s²."),
    ],
)
def test_amplitudes_through_an_actuator_are_said_to_be_its_own(tmp_path, case, means):
    design, call = CASES[case]
    ss.export_stimulus(design, tmp_path / "a.wav", **call)
    about = json.loads((tmp_path / "a.wav.json").read_text(encoding="utf-8"))
    assert about["scaling_means"] == means


def test_an_actuator_is_said_once_with_all_its_parameters(tmp_path):
    def about(case):
        design, call = CASES[case]
        ss.export_stimulus(design, tmp_path / "a.wav", confirmed=True, **call)
        return json.loads((tmp_path / "a.wav.json").read_text(encoding="utf-8"))

    equalised = about("equalised")
    (actuator,) = equalised["actuator"]
    said = [actuator.pop(name) for name in ("name", "kind", "places")]
    assert said == ["mine", "VoiceCoil", [7, 12]]
    assert type(COIL)(**actuator) == COIL
    assert equalised["predicted_through"] is None
    assert about("as predicted")["predicted_through"] == "the same"
    differs = about("predicted, not equalised")
    assert differs["equaliser"] is None
    assert differs["predicted_through"]["equaliser"]["boost_db"] == 12.0
    wired = about("rig, equalised")["actuator"]
    assert [(one["places"], one["kind"]) for one in wired] == [
        ([7], "MeasuredResponse"),
        ([12], "Piezo"),
    ]
    assert about("bare")["actuator"] is None
