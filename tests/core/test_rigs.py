"""Rig files, what they say about volts, and limits that nothing loosens."""

from dataclasses import fields, replace

import numpy as np
import pytest

import skinsource as ss
from skinsource.actuators import Limits, MeasuredResponse, Thermal
from skinsource.actuators.rigs import Rig, RigChannel
from skinsource.base.errors import FileFormatError, InvalidInputError

MEASURED = MeasuredResponse(((20.0, 10.0, 0.1), (1000.0, 30.0, -1.0)))
COIL = ss.actuators.load("example-voice-coil")
WHOLE = RigChannel(
    place=7,
    actuator="example-voice-coil",
    model=COIL,
    device="USB interface",
    output=3,
    full_scale_v=1.4,
    amplifier_gain=2.0,
    measured=MEASURED,
    polarity="inverted",
    delay_s=0.004,
    measured_on="2026-11-20",
    limits=Limits(peak_voltage_v=2.0, rms_current_a=0.25),
    thermal=Thermal(resistance_k_per_w=60.0, time_constant_s=20.0),
)
BARE = RigChannel(place=8)
RIG = Rig(title="Left bench", note="Fourth drawer", channels=(WHOLE, BARE))


def test_a_rig_comes_back_from_its_file_as_it_was(tmp_path):
    ss.save_rig(tmp_path / "bench.skinrig", RIG)
    assert ss.open_rig(tmp_path / "bench.skinrig") == RIG


RIG_TEXT = '{"format": "skinsource rig", "version": 1, "content": %s}'
WRONG = {
    "no JSON": ("{", "not the text"),
    "another format": ('{"format": "skinsource actuator"}', "skinsource actuator"),
    "a newer version": (RIG_TEXT.replace("1", "2") % "{}", "newer"),
    "another kind": (RIG_TEXT % '{"kind": "Design"}', "Rig"),
    "an unknown field": (RIG_TEXT % '{"kind": "Rig", "limit": 1}', "limit"),
    "no number": (
        RIG_TEXT % '{"kind": "Rig", "channels": [{"kind": "RigChannel", "place": "much"}]}',
        "channels/0",
    ),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_is_no_rig_is_refused_with_the_name_of_the_file(tmp_path, name):
    text, word = WRONG[name]
    path = tmp_path / "odd.skinrig"
    path.write_text(text)
    with pytest.raises(FileFormatError, match=word) as caught:
        ss.open_rig(path)
    assert "odd.skinrig" in str(caught.value)


@pytest.mark.parametrize("date", ["yesterday", "2026-13-1"])
def test_a_channel_was_measured_on_a_day_that_there_is(date):
    with pytest.raises(InvalidInputError, match="measured_on"):
        replace(WHOLE, measured_on=date)


def test_no_place_and_no_output_is_there_twice():
    with pytest.raises(InvalidInputError, match="place 7"):
        Rig(channels=(WHOLE, replace(WHOLE, output=4)))
    with pytest.raises(InvalidInputError, match="output 3"):
        Rig(channels=(WHOLE, replace(WHOLE, place=9)))


def test_volts_carry_gain_and_polarity_both_ways():
    samples = np.array([[0.5, -1.0]])
    volts = ss.rigs.volts_of(WHOLE, samples)
    assert volts == pytest.approx(-2.8 * samples)
    assert ss.rigs.samples_for(WHOLE, volts) == pytest.approx(samples)
    with pytest.raises(InvalidInputError, match=r"at most 2\.8 V"):
        ss.rigs.samples_for(WHOLE, [2.9])
    with pytest.raises(InvalidInputError, match="voltmeter"):
        ss.rigs.volts_of(BARE, samples)


def test_what_is_not_calibrated_says_so():
    text_of = ss.rigs.calibration_words
    assert text_of(None, [7]).startswith("uncalibrated")
    assert text_of(RIG, [7]) == "calibrated, measured on 2026-11-20"
    assert text_of(RIG, [7, 8]) == "uncalibrated: place 8 has no volts at full scale"
    assert text_of(RIG, [5]) == "uncalibrated: place 5 is not wired"
    unmeasured = Rig(channels=(replace(WHOLE, measured=None),))
    assert text_of(unmeasured, [7]) == "uncalibrated: place 7 has no measured response"


TONE = np.sin(2.0 * np.pi * 100.0 * np.arange(1300) / 1300.0)[None]


def test_limits_of_the_rig_hold_at_the_actuator():
    breaches = ss.rigs.rig_breaches(RIG, [7], TONE, 1300)
    # 2.8 V through 4 ohms at most: both the peak and the current are beyond.
    assert [(rig_breach.place, rig_breach.breach.name) for rig_breach in breaches] == [
        (7, "peak_voltage_v"),
        (7, "rms_current_a"),
    ]
    assert breaches[0].breach.found == pytest.approx(2.8, rel=0.1)
    assert "place 7" in str(breaches[0])
    assert ss.rigs.rig_breaches(RIG, [7], 0.2 * TONE, 1300) == ()


def test_each_kind_of_limit_is_looked_at():
    tight = {
        "peak_voltage_v": 0.1,
        "rms_voltage_v": 0.1,
        "slew_v_per_s": 10.0,
        "duration_s": 0.5,
        "displacement_m": 1e-9,
        "peak_current_a": 1e-3,
        "rms_current_a": 1e-3,
        "duty": 0.5,
    }
    assert set(tight) == {field.name for field in fields(Limits)}
    for name, value in tight.items():
        rig = Rig(channels=(replace(WHOLE, limits=Limits(**{name: value})),))
        assert [
            rig_breach.breach.name for rig_breach in ss.rigs.rig_breaches(rig, [7], TONE, 1300)
        ] == [name]


def test_what_is_not_known_of_a_channel_is_not_claimed():
    limits = Limits(peak_voltage_v=1e-6, displacement_m=1e-12, duration_s=0.5)
    rig = Rig(channels=(replace(BARE, limits=limits),))
    assert [
        rig_breach.breach.name for rig_breach in ss.rigs.rig_breaches(rig, [8], TONE, 1300)
    ] == ["duration_s"]
    unmoved = replace(BARE, limits=limits, full_scale_v=1.0)
    breaches = ss.rigs.rig_breaches(Rig(channels=(unmoved,)), [8], TONE, 1300)
    assert [rig_breach.breach.name for rig_breach in breaches] == ["peak_voltage_v", "duration_s"]


def test_the_displacement_is_that_of_the_measured_response():
    limits = Limits(displacement_m=1e-4)
    strong = MeasuredResponse(((20.0, 1e4, 0.0), (1000.0, 1e4, 0.0)))
    weak = MeasuredResponse(((20.0, 1e-4, 0.0), (1000.0, 1e-4, 0.0)))
    for measured, count in ((strong, 1), (weak, 0)):
        rig = Rig(channels=(replace(WHOLE, measured=measured, limits=limits),))
        assert len(ss.rigs.rig_breaches(rig, [7], TONE, 1300)) == count


def test_the_strictest_limit_counts():
    limits = ss.rigs.strictest(
        Limits(peak_voltage_v=2.0, duty=0.5), Limits(peak_voltage_v=1.0), Limits()
    )
    assert limits == Limits(peak_voltage_v=1.0, duty=0.5)
    # A channel that names an actuator of the library cannot loosen what its maker allows.
    loose = Limits(peak_current_a=5.0, duty=0.05)
    rig = Rig(channels=(replace(WHOLE, actuator="eai-c-mf", limits=loose),))
    passed = {
        rig_breach.breach.name: rig_breach.breach
        for rig_breach in ss.rigs.rig_breaches(rig, [7], TONE, 1300)
    }
    assert passed["peak_current_a"].limit == 0.5
    assert passed["duty"].limit == 0.05
