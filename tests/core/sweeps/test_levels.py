"""How strong stimuli are: as drawn, as predicted, or as people matched them."""

from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource import Actuation, ActuatorAt, actuators
from skinsource.actuators.equalising import RegularisedInverse, equalised
from skinsource.actuators.prediction import Limits
from skinsource.base.errors import InvalidInputError
from skinsource.lab.matching import MatchingRun, Procedure
from skinsource.perception.thresholds import sensation_levels_db
from skinsource.studies.sweeps.measuring import ACTUATOR_METRICS
from skinsource.studies.sweeps.plan import Plan

TONE = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.3)
DESIGN = ss.Design(limb="synthetic-1", inputs=(ss.track(7, TONE), ss.track(3, TONE, amplitude=0.5)))
FREQUENCIES = (50.0, 80.0, 150.0, 250.0)


def design_at(design, frequency_hz, factor=1.0):
    tone = ss.waveforms.Tone(frequency_hz=frequency_hz, duration_s=0.3)
    tracks = (
        ss.track(each.location, tone, amplitude=each.amplitude * factor) for each in design.inputs
    )
    return replace(design, inputs=tuple(tracks))


def highest_above_threshold(design):
    view = ss.View(axes="xyz", outputs=tuple(range(1, 73)))
    field = ss.evaluate(design, "axis_traces", view=view)["axis_traces"]
    return max(of_channel.max() for of_channel in sensation_levels_db(field, 1300.0).values())


@pytest.mark.parametrize("values", [FREQUENCIES, FREQUENCIES[:2]])
def test_a_level_above_threshold_is_reached(values):
    # Four are measured together, two one by one.
    table = ss.sweep(DESIGN, {"frequency_hz": values}, level="above_threshold", level_db=20.0)
    assert not table.failed
    np.testing.assert_allclose(table.column("level_above_threshold_db"), 20.0, atol=1e-9)
    assert np.isnan(table.column("level_100ms_db")).all()
    assert len(set(table.column("factor").round(6))) == len(values)
    for frequency_hz, factor in zip(values, table.column("factor"), strict=True):
        made = design_at(DESIGN, frequency_hz, factor)
        assert highest_above_threshold(made) == pytest.approx(20.0, abs=1e-8)


def test_of_drives_without_a_unit_no_level_is_reached():
    upstream = ss.Design(limb="synthetic-1", inputs=DESIGN.inputs, scaling="upstream")
    table = ss.sweep(upstream, level="above_threshold", level_db=20.0)
    assert "Probe acceleration" in table.failed[1]


@pytest.fixture
def matches(tmp_path):
    """At place 7 tests were matched at -4 dB, at place 3 at 6 dB more for each of two people."""
    path = tmp_path / "matches.csv"
    for person, more_db in (("Anna", 1.0), ("Ben", -1.0)):
        procedure = Procedure(
            person=person, frequencies_hz=(50.0, 250.0), places=(3, 7), reference_hz=80.0
        )
        run = MatchingRun(procedure, path)
        while run.trial is not None:
            run.step((2.0 if run.trial.place == 3 else -4.0) + more_db - run.level_db)
            run.store()
    return path


def test_drives_are_as_people_matched_them(matches):
    for level in (matches, str(matches)):
        table = ss.sweep(DESIGN, {"frequency_hz": (50.0, 250.0, 300.0)}, level=level)
        assert list(table.failed) == [3]
        assert "300 Hz was not matched at place 7" in table.failed[3]
        assert (table.column("factor")[:2] == 1.0).all()
    plan = Plan(
        designs=(("one", DESIGN),),
        variables=(("frequency_hz", (50.0,)),),
        **ss.sweeps.running.level_of(matches),
    )
    first, second = plan.design_of(1).inputs
    assert first.amplitude == pytest.approx(10 ** (-4 / 20))
    assert second.amplitude == pytest.approx(0.5 * 10 ** (2 / 20))
    assert Plan(designs=plan.designs, variables=plan.variables).digest != plan.digest
    mixed = ss.Design(limb="synthetic-1", inputs=(ss.track(7, ss.waveforms.Noise(duration_s=0.1)),))
    assert "one frequency" in ss.sweep(mixed, level=matches).failed[1]


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"level": "loud"}, "one of drive"),
        ({"level": "above_threshold"}, "level_db"),
        ({"level": "drive", "level_db": 3.0}, "level_db"),
        ({"level": "matched"}, "table of matches"),
        ({"level": 3}, "level is 3"),
        ({"level_db": 1000.0}, "-100 to 100 dB"),
    ],
)
def test_a_level_that_cannot_be_is_refused(changes, message):
    with pytest.raises(InvalidInputError, match=message):
        ss.sweep(DESIGN, **changes)


def test_actuators_are_varied_and_say_what_they_have_to_do():
    names = ("example-voice-coil", "example-resonant")
    table = ss.sweep(DESIGN, {"actuator": names}, outputs=(19,), limits=Limits(peak_voltage_v=1e-3))
    assert not table.failed
    assert table.columns[-9:-1] == ACTUATOR_METRICS
    assert table.column("rms")[0] != table.column("rms")[1]
    for row, name in enumerate(names):
        model = actuators.load(name)
        drives = np.array([track.amplitude * TONE.samples(1300.0) for track in DESIGN.inputs])
        volts = equalised(drives, 1300.0, model, RegularisedInverse(), lead_s=0.1, tail_s=0.1)
        loads = actuators.predicted(volts, 1300, model)
        for metric in ACTUATOR_METRICS[:-1]:
            expected = max(getattr(extent, metric) for extent in loads)
            assert table.column(metric)[row] == pytest.approx(expected, rel=1e-9, nan_ok=True)
    assert table.column("peak_voltage_v")[0] != table.column("peak_voltage_v")[1]
    assert table.column("limits_passed").tolist() == [1.0, 1.0]
    louder = ss.sweep(DESIGN, {"actuator": names[:1], "amplitude": (1.0, 2.0)})
    ratio = louder.column("peak_voltage_v")[1] / louder.column("peak_voltage_v")[0]
    # The second input has half the amplitude until both get the same.
    assert ratio == pytest.approx(2.0, rel=1e-6)
    assert np.isnan(louder.column("limits_passed")).all()


def actuation(name):
    at = ActuatorAt(actuator=name, model=actuators.load(name))
    return Actuation(actuators=(at,), equaliser=RegularisedInverse())


def test_predictions_go_through_the_actuator_that_is_varied():
    names = ("example-voice-coil", "example-resonant", "example-piezo", "example-recoil")
    # Four actuators are four limbs; one of them with four frequencies is measured together.
    by_actuator = ss.sweep(DESIGN, {"actuator": names}).column("rms")
    by_frequency = ss.sweep(DESIGN, {"actuator": names[:1], "frequency_hz": FREQUENCIES})
    for name, rms in zip(names, by_actuator, strict=True):
        design = replace(DESIGN, actuation=actuation(name))
        output_rms = ss.evaluate(design, "output_rms", view=ss.View(method="pca"))["output_rms"]
        assert rms == pytest.approx(output_rms.max(), rel=1e-9)
    for frequency_hz, rms in zip(FREQUENCIES, by_frequency.column("rms"), strict=True):
        design = replace(design_at(DESIGN, frequency_hz), actuation=actuation(names[0]))
        output_rms = ss.evaluate(design, "output_rms", view=ss.View(method="pca"))["output_rms"]
        assert rms == pytest.approx(output_rms.max(), rel=1e-9)


def test_an_actuator_that_cannot_be_is_a_row_that_says_why():
    tap = ss.Design(limb="synthetic-1", inputs=(ss.track(7, ss.waveforms.Tap()),))
    names = ("no-such-one", "example-voice-coil")
    table = ss.sweep(tap, {"actuator": names})
    assert "no-such-one" in table.failed[1]
    assert "velocity" in table.failed[2]
    # What the contactor does, no actuator does: the same input is refused behind one alone.
    through = ss.sweep([tap, replace(tap, actuation=actuation(names[1]))])
    assert list(through.failed) == [2]
    # By name of its place: it is refused when it is prepared, not when an actuator is driven.
    assert through.failed[2].startswith("Input at place 7 cannot be played through")
    assert "expected a name" in ss.sweep(tap, {"actuator": [3]}).failed[1]
    upstream = ss.Design(limb="synthetic-1", inputs=DESIGN.inputs, scaling="relative")
    assert "Probe acceleration" in ss.sweep(upstream, {"actuator": names[1:]}).failed[1]
