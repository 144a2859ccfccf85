"""Stimuli that are measured one after another have the numbers that each has alone."""

from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.conventions import BAND_HZ
from skinsource.studies.sweeps.measuring import METRICS, Measurer
from skinsource.studies.sweeps.plan import Plan
from tests.core.own_limbs.lab_bench import installed

PLACES = (3, 7, 7, 18)
FREQUENCIES = (40.0, 75.0, 110.0, 240.0, 390.0)


def four_inputs(**changes):
    inputs = tuple(
        ss.track(
            place,
            ss.waveforms.Tone(frequency_hz=60.0 + 35.0 * k, duration_s=0.1 + 0.02 * k),
            amplitude=(-1.0) ** k * (0.5 + k),
            onset_s=0.01 * k,
        )
        for k, place in enumerate(PLACES)
    )
    return ss.Design(limb="synthetic-1", inputs=inputs, **changes)


def plan_of(design, name, values, **changes):
    return Plan(designs=(("one", design),), variables=((name, values),), outputs=(19,), **changes)


@pytest.mark.parametrize(
    "name", ["frequency_hz", "2.frequency_hz", "1.amplitude", "1.location", "duration_s"]
)
@pytest.mark.parametrize("scaling", ["probe", "relative", "upstream"])
def test_metrics_are_those_of_each_stimulus_alone(name, scaling):
    values = FREQUENCIES if "freq" in name else (0.05, 0.11, 0.3, 0.2, 0.01)
    values = (12, 7, 20, 3, 5) if "location" in name else values
    for axes, method in (("xyz", "mag"), ("xz", "pca")):
        changes = {"axes": axes, "method": method, "level_db": -6.0}
        plan = plan_of(four_inputs(scaling=scaling), name, values, **changes)
        together = Measurer(plan)
        for number in range(1, 6):
            alone = Plan(designs=(("one", plan.design_of(number)),), outputs=(19,), **changes)
            expected, row = Measurer(alone).measure(1), together.measure(number)
            assert list(row) == list(expected)
            for metric in METRICS:
                assert row[metric] == pytest.approx(expected[metric], rel=1e-10, nan_ok=True)


def test_where_inputs_cancel_no_digits_are_lost():
    tone = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.1)
    design = ss.Design(
        limb="synthetic-1",
        inputs=(ss.track(7, tone), ss.track(7, tone, amplitude=-1.0), ss.track(3, tone)),
    )
    left = (-1.0, -1.0 + 1e-9, -1.0 + 1e-4, -0.5, 1.0)
    plan = plan_of(design.with_input(2, amplitude=1e-7), "2.amplitude", left)
    together = Measurer(plan)
    for number in range(1, 6):
        expected = Measurer(Plan(designs=(("one", plan.design_of(number)),))).measure(1)
        # A ratio: the numbers themselves are far below what pytest takes for zero.
        ratio = together.measure(number)["rms"] / expected["rms"]
        assert ratio == pytest.approx(1.0, abs=1e-10)


def test_the_loudest_window_may_be_where_less_is_felt_in_all():
    tones = [
        ss.waveforms.Tone(frequency_hz=100.0, duration_s=duration_s) for duration_s in (1.0, 0.1)
    ]
    design = ss.Design(
        limb="synthetic-1", inputs=(ss.track(7, tones[0]), ss.track(18, tones[1], amplitude=2.0))
    )
    amplitudes = (1.0, 1.5, 2.0, 3.0, 4.0)
    for count in (5, 2):
        table = ss.sweep(design, {"2.amplitude": amplitudes[:count]}, level_db=0.0)
        for row, amplitude in enumerate(amplitudes[:count]):
            levels_db = ss.evaluate(
                design.with_input(1, amplitude=amplitude),
                "output_levels_db",
                view=ss.View(method="pca", span="loudest"),
            )["output_levels_db"]
            factor_db = 20.0 * np.log10(table.column("factor")[row])
            assert factor_db == pytest.approx(-levels_db.max(), abs=1e-9)


# 10.5 turns of 20 Hz: 16 ms of velocity are left, as much as a tone of 10 Hz has.
HALF_A_TURN = ss.waveforms.Tone(frequency_hz=20.0, duration_s=0.525, window="none")


def test_it_is_played_anew_at_another_rate_through_other_actuators_and_in_another_band(user_data):
    installed(band_hz=(5.0, 1500.0))
    installed(name="lab-2", band_hz=(50.0, 1500.0))
    installed(name="lab-3", band_hz=BAND_HZ)
    coil = ss.ActuatorAt(actuator="coil", model=ss.actuators.load("example-voice-coil"))
    through = ss.Actuation(actuators=(coil,), equaliser=ss.equalising.RegularisedInverse())
    slow = ss.Design(
        limb="synthetic-1", scaling="probe", inputs=(ss.track(7, HALF_A_TURN, amplitude=0.1),)
    )
    quick = replace(slow, limb="lab-3")
    driven = replace(slow, limb="lab-1", actuation=through)
    # What is followed down to 5 Hz, or without an equaliser, need not be here.
    refused = replace(driven, limb="lab-2")
    designs = [slow, quick, driven, refused, replace(slow, limb="lab-2"), refused, slow]
    table = ss.sweep(designs)
    assert list(table.failed) == [4, 6]
    assert all("leaves a velocity" in reason for reason in table.failed.values())
    for row, design in enumerate(designs):
        if row + 1 not in table.failed:
            alone = ss.sweep(design)
            for name in ("rms", "peak", "drive_rms", "share_outside_band", "duration_s"):
                assert table.column(name)[row] == alone.column(name)[0]
