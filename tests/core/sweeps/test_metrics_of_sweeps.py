"""Metrics of a sweep, against predictions made with other means."""

import math
from unittest.mock import patch

import numpy as np
import pytest

import skinsource as ss
from skinsource.design.comparing import NO_RANGE
from skinsource.design.design import louder
from skinsource.signals.spectra import share_outside_band
from skinsource.studies.sweeps import measuring
from skinsource.studies.sweeps.measuring import Measurer
from skinsource.studies.sweeps.plan import Plan
from tests.core.own_limbs.lab_bench import installed

RATE_HZ = 1300.0


def two_inputs(**changes):
    track = ss.track(7, ss.waveforms.Tone(frequency_hz=90.0, duration_s=0.25), amplitude=0.5)
    other = ss.track(3, ss.waveforms.Gabor(frequency_hz=200.0), onset_s=0.0, amplitude=-2.0)
    return ss.Design(limb="synthetic-1", inputs=(track, other), **changes)


def drives_of(design):
    """Samples that each input plays, at the limb's rate, (n_times,)."""
    return [track.amplitude * track.clips[0].waveform.samples(RATE_HZ) for track in design.inputs]


def field_of(design):
    """Acceleration, (72, 3, n_times), relative scaling."""
    n_times = max(map(len, drives_of(design)))
    drives = [np.pad(drive, (0, n_times - drive.size)) for drive in drives_of(design)]
    places = [track.location for track in design.inputs]
    return ss.predict(ss.load_limb(design.limb), drives, places, scaling="relative")


def measured(design, **changes):
    return Measurer(Plan(designs=(("one", design),), **changes)).measure(1)


@pytest.mark.parametrize(("axes", "method"), [("xyz", "pca"), ("xyz", "mag"), ("z", "pca")])
def test_levels_and_peaks_are_those_of_a_prediction(axes, method):
    design = two_inputs(scaling="relative")
    metrics = measured(design, outputs=(19, 40), axes=axes, method=method)
    signals = ss.project_axes(field_of(design), axes, method)
    rms = np.sqrt(np.mean(signals**2, axis=-1))
    loudest = int(np.argmax(rms))
    assert metrics["loudest_output"] == loudest + 1
    for name, which in (("", loudest), ("output_19_", 18), ("output_40_", 39)):
        window_means = np.convolve(signals[which] ** 2, np.ones(130) / 130, mode="valid")
        assert metrics[f"{name}rms"] == pytest.approx(rms[which], rel=1e-10)
        assert metrics[f"{name}peak"] == pytest.approx(np.abs(signals[which]).max(), rel=1e-10)
        assert metrics[f"{name}rms_100ms"] == pytest.approx(np.sqrt(window_means.max()), rel=1e-9)


def test_the_extent_is_that_of_the_rms_of_the_record():
    design = two_inputs(scaling="relative")
    metrics = measured(design)
    signals = ss.project_axes(field_of(design), "xyz", "pca")
    rms = np.sqrt(np.mean(signals**2, axis=-1))
    expected = ss.extent(rms, ss.load_limb("synthetic-1"), (7, 3))
    for name in ("mean_distance_mm", "d90_mm", "share_above_12_db", "participation"):
        assert metrics[name] == pytest.approx(getattr(expected, name), rel=1e-9)


def test_the_drive_is_what_actuators_get():
    design = two_inputs()
    metrics = measured(design)
    drives = drives_of(design)
    n_times = max(map(len, drives))
    channels = np.array([np.pad(drive, (0, n_times - len(drive))) for drive in drives])
    assert metrics["duration_s"] == n_times / RATE_HZ
    assert metrics["drive_peak"] == pytest.approx(np.abs(channels).max(), rel=1e-12)
    assert metrics["drive_rms"] == pytest.approx(np.sqrt(np.mean(channels**2)), rel=1e-12)
    energies = [np.sum(drive**2) for drive in drives]
    shares = [share_outside_band(drive, RATE_HZ) for drive in drives]
    assert metrics["share_outside_band"] == pytest.approx(np.average(shares, weights=energies))


def test_inputs_at_one_place_are_one_channel():
    tone = ss.waveforms.Tone(frequency_hz=90.0)
    separate = ss.Design(
        limb="synthetic-1",
        inputs=(ss.track(7, tone), ss.track(7, tone, amplitude=-1.0), ss.track(8, tone)),
    )
    metrics = measured(separate)
    samples = tone.samples(RATE_HZ)
    assert metrics["drive_peak"] == pytest.approx(np.abs(samples).max())
    assert metrics["drive_rms"] == pytest.approx(np.sqrt(np.mean(samples**2) / 2))


def test_a_level_is_reached_exactly_and_all_else_follows():
    design = two_inputs()
    plain = measured(design, outputs=(19,))
    brought = measured(design, outputs=(19,), level_db=-12.0)
    factor = brought["factor"]
    assert brought["level_100ms_db"] == pytest.approx(-12.0, abs=1e-9)
    assert factor != pytest.approx(1.0, abs=0.05)
    for name in ("drive_peak", "drive_rms", "rms", "rms_100ms", "peak", "output_19_rms"):
        assert brought[name] == pytest.approx(factor * plain[name], rel=1e-12)
    for name in ("share_outside_band", "mean_distance_mm", "d90_mm", "participation"):
        assert brought[name] == pytest.approx(plain[name], rel=1e-12)
    view = ss.View(span="loudest")
    levels = ss.evaluate(louder(design, factor), "output_levels_db", view=view)["output_levels_db"]
    assert levels.max() == pytest.approx(-12.0, abs=1e-9)


def test_the_range_between_people_is_that_of_the_rms_there_and_only_where_asked_for():
    design, changes = two_inputs(), {"axes": "z", "method": "mag", "level_db": -12.0}
    plain, metrics = measured(design, **changes), measured(design, **changes, people=True)
    assert metrics.keys() - plain.keys() == {"range_low_db", "range_high_db"}
    assert {name: metrics[name] for name in plain} == pytest.approx(plain, nan_ok=True)
    played, output = louder(design, metrics["factor"]), int(metrics["loudest_output"])
    limbs = [f"synthetic-{k}" for k in (1, 2, 3, 4)]
    found = ss.people.levels(played, ss.View(axes="z", method="mag"), limbs=limbs)
    for name, ends_db in (("range_low_db", found.low_db), ("range_high_db", found.high_db)):
        assert metrics[name] == pytest.approx(ends_db[output - 1], abs=1e-9)


def test_people_are_played_once_where_only_a_design_changes():
    variables = (("limb", ("synthetic-1", "synthetic-2")), ("amplitude", (1.0, 2.0)))
    plan = Plan(designs=(("one", two_inputs()),), variables=variables, people=True)
    with patch.object(measuring, "people_of", wraps=measuring.people_of) as loaded:
        in_turn = Measurer(plan)
        rows = [in_turn.measure(number) for number in range(1, 5)]
    assert loaded.call_count == 1
    alone = [Measurer(plan).measure(number) for number in range(1, 5)]
    for name in ("range_low_db", "range_high_db"):
        assert [row[name] for row in rows] == [row[name] for row in alone]


def test_of_an_own_limb_there_is_no_range_and_its_row_says_so(user_data):
    limb = installed().name
    design = ss.Design(limb=limb, inputs=(ss.track(1),))
    (said,) = ss.sweep(design, axes="z", people=True).failed.values()
    assert said == f"{NO_RANGE} Leave it out, or choose another than {limb!r}."
    assert not ss.sweep(design, axes="z").failed


def test_of_silence_nothing_is_said():
    silent = ss.Design(limb="synthetic-1", inputs=(ss.track(7, muted=True),))
    metrics = measured(silent, people=True)
    assert metrics["rms"] == 0.0
    assert metrics["drive_peak"] == 0.0
    for name in (
        "share_outside_band",
        "loudest_output",
        "mean_distance_mm",
        "participation",
        "range_low_db",
        "range_high_db",
    ):
        assert math.isnan(metrics[name])
    for level in ("loudest_100ms", "above_threshold"):
        metrics = measured(silent, level=level, level_db=20.0)
        assert metrics["factor"] == 1.0
        assert math.isnan(metrics["level_100ms_db"])
        assert math.isnan(metrics["level_above_threshold_db"])
