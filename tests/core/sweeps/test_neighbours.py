"""Stimuli that are measured together have the numbers that each has alone."""

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.job import never
from skinsource.engine.shared import Shared
from skinsource.studies.sweeps import neighbours
from skinsource.studies.sweeps.measuring import Measurer
from skinsource.studies.sweeps.metrics import METRICS, Preparing, main_axes
from skinsource.studies.sweeps.neighbours import Batch
from skinsource.studies.sweeps.plan import BATCH_SIZE, Plan

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


def vibrations(plan):
    preparing = Preparing(Shared())
    stimuli = [preparing.of(plan.design_of(k), never) for k in range(1, len(plan) + 1)]
    return stimuli, Batch(preparing).of(stimuli, never, products=True)


@pytest.mark.parametrize("name", ["frequency_hz", "2.frequency_hz", "1.amplitude", "duration_s"])
@pytest.mark.parametrize("scaling", ["probe", "relative", "upstream"])
def test_metrics_are_those_of_each_stimulus_alone(name, scaling):
    values = FREQUENCIES if "freq" in name else (0.05, 0.11, 0.3, 0.2, 0.01)
    for axes, method in (("xyz", "pca"), ("xyz", "mag"), ("xz", "pca"), ("y", "rms")):
        changes = {"axes": axes, "method": method, "level_db": -6.0}
        plan = plan_of(four_inputs(scaling=scaling), name, values, **changes)
        assert vibrations(plan)[1] is not None
        together = Measurer(plan)
        for number in range(1, 6):
            alone = Plan(designs=(("one", plan.design_of(number)),), outputs=(19,), **changes)
            expected, row = Measurer(alone).measure(1), together.measure(number)
            assert list(row) == list(expected)
            for metric in METRICS:
                assert row[metric] == pytest.approx(expected[metric], rel=1e-10, nan_ok=True)


@pytest.mark.parametrize("name", ["frequency_hz", "2.frequency_hz"])
def test_moments_are_those_of_the_prediction(name):
    plan = plan_of(four_inputs(), name, FREQUENCIES)
    limb = ss.load_limb("synthetic-1")
    _, vibration = vibrations(plan)
    second = vibration.moments.second.reshape(5, 72, 3, 3)
    for k in range(5):
        design = plan.design_of(k + 1)
        rate_hz = limb.sample_rate_hz
        drives = np.zeros((4, 260))
        for drive, track in zip(drives, design.inputs, strict=True):
            start = round(track.clips[0].onset_s * rate_hz)
            samples = track.clips[0].waveform.samples(rate_hz)
            drive[start : start + samples.size] = track.amplitude * samples
        field = ss.predict(limb, drives, locations=PLACES, scaling="probe", amplitudes=[1.0] * 4)
        expected = np.einsum("oat,obt->oab", field, field)
        scale = np.einsum("oaa->o", expected)[:, None, None]
        np.testing.assert_allclose(second[k] / scale, expected / scale, atol=1e-11)


def test_what_the_next_neighbours_have_in_common_is_looked_at_anew():
    frequencies = tuple(np.linspace(40.0, 400.0, BATCH_SIZE).tolist())
    variables = (("1.amplitude", (1.0, -3.0)), ("2.frequency_hz", frequencies))
    together = Measurer(Plan(designs=(("one", four_inputs()),), variables=variables))
    for number in (1, BATCH_SIZE + 1):
        alone = Plan(designs=(("one", together.plan.design_of(number)),))
        expected, row = Measurer(alone).measure(1), together.measure(number)
        assert row["rms"] == pytest.approx(expected["rms"], rel=1e-10)


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
        limb="synthetic-1",
        inputs=(ss.track(7, tones[0]), ss.track(18, tones[1], amplitude=2.0)),
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


def test_one_that_cannot_be_measured_changes_no_other():
    bad = plan_of(four_inputs(), "frequency_hz", (*FREQUENCIES, 900.0))
    measurer = Measurer(bad)
    with pytest.raises(ss.SkinSourceError, match="650 Hz"):
        measurer.measure(6)
    good = Measurer(plan_of(four_inputs(), "frequency_hz", (*FREQUENCIES, 90.0)))
    assert [measurer.measure(k) for k in range(1, 6)] == [good.measure(k) for k in range(1, 6)]


def test_what_has_little_in_common_is_measured_one_by_one():
    for name, values in (
        ("2.location", (1, 2, 3, 4, 5)),
        ("limb", ("synthetic-1", "synthetic-2", "synthetic-1", "synthetic-2")),
        ("frequency_hz", (50.0, 60.0)),
        ("muted", (True,) * 4),
    ):
        assert vibrations(plan_of(four_inputs(), name, values))[1] is None


def test_products_in_parts_are_those_of_the_whole(monkeypatch):
    monkeypatch.setattr(neighbours, "_NUMBERS_AT_ONCE", 500)
    rng = np.random.default_rng(2)
    matrix, columns = rng.standard_normal((6, 11, 130)), rng.standard_normal((5, 130))
    expected = np.einsum("pon,cn->cpo", matrix, columns)
    np.testing.assert_allclose(neighbours.multiplied(matrix, columns), expected, atol=1e-12)


def test_main_axes_lie_along_the_largest_eigenvalue():
    rng = np.random.default_rng(1)
    data = rng.standard_normal((600, 3, 4))
    data[:100, 1] *= 1e-9
    data[100:200] = data[100:200, :, :1]
    data[200:300, :, 0] *= 1e6
    data[300:400] *= 1e-140
    matrices = data @ data.transpose(0, 2, 1)
    matrices[-1] = 0.0
    axes = main_axes(matrices)
    np.testing.assert_allclose(np.square(axes).sum(axis=1), 1.0, rtol=1e-14)
    along = np.einsum("na,nab,nb->n", axes, matrices, axes)
    np.testing.assert_allclose(along, np.linalg.eigvalsh(matrices)[:, -1], rtol=1e-13)
    # Of one that is nearly diagonal, too: an axis that is off by an angle shows in what is left
    # across it, not in the value along it.
    for size in (1e-2, 1e-4, 1e-5, 1e-6, 1e-7):
        matrix = np.diag([3.0, 2.0, 1.0]) + size * (1.0 - np.eye(3))
        (axis,) = main_axes(matrix[None])
        across = matrix @ axis - (axis @ matrix @ axis) * axis
        assert np.abs(across).max() < 4e-15
    assert axes[-1].tolist() == [1.0, 0.0, 0.0]
