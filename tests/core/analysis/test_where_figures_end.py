"""Where figures of analysis begin and end: bands, thresholds, shares, and what counts."""

from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource import View
from skinsource.base.job import never
from skinsource.engine.analysis_rules import line_wave, output_noise_rms
from skinsource.engine.moments import Projection
from skinsource.perception.validity import drive_findings
from skinsource.signals.analysis.wave_speed import travelling_wave

RATE = 1300.0
LINE = (20, 22, 24, 26)


def tone(frequency_hz, amplitude=1.0, place=8, duration_s=1.0, **changes):
    waveform = ss.waveforms.Tone(frequency_hz=frequency_hz, duration_s=duration_s)
    return ss.track(place, waveform, amplitude=amplitude, **changes)


def sine(frequency_hz, amplitude=1.0):
    """A second of it: its spectrum lies within some hertz around its frequency."""
    wave = np.sin(2 * np.pi * frequency_hz * np.arange(1300) / RATE)
    return amplitude * wave * np.hanning(1300)


def lamp(name, *drives):
    findings = drive_findings(list(enumerate(drives, start=6)), RATE, "upstream")
    return next(finding for finding in findings if finding.name == name)


def test_a_point_of_another_shape_has_a_level_and_no_delay_that_counts():
    rng = np.random.default_rng(11)
    first = rng.normal(size=1300)
    later = [np.roll(first, 5 * k) for k in range(3)]
    signals = np.stack([*later, rng.normal(size=1300)])
    wave = travelling_wave(signals, np.array([0.0, 50.0, 100.0, 150.0]), RATE)
    assert wave.similarity[-1] < 0.5
    assert list(wave.timed) == [True, True, True, False]
    assert wave.counted.all()
    assert wave.speed_m_per_s == pytest.approx(0.05 / (5 / RATE), rel=0.02)


def test_points_of_a_line_count_from_six_decibels_above_the_noise():
    design = ss.Design(limb="synthetic-1", inputs=(tone(100.0, duration_s=0.1),))
    values = ss.evaluate(design, "vibration", "limb_data", "record_samples")
    above_db = np.full(72, 40.0)
    above_db[21], above_db[23] = 5.99, 6.0
    known = values["limb_data"], above_db, RATE, values["record_samples"]
    line = line_wave(values["vibration"], LINE, *known, never)
    assert list(line.wave.counted) == [True, False, True, True]


def test_a_wave_is_followed_along_z_whatever_axes_are_chosen():
    design = ss.Design(limb="synthetic-1", inputs=(tone(100.0, duration_s=0.1),))
    line_wave = ss.evaluate(design, "line_wave", view=View(outputs=LINE, axes="x"))["line_wave"]
    traces = ss.evaluate(design, "axis_traces", view=View(outputs=LINE, axes="xyz"))["axis_traces"]
    levels_db = 10.0 * np.log10(np.mean(traces[:, 2] ** 2, axis=-1))
    assert line_wave.axis == "z"
    assert line_wave.wave.level_db == pytest.approx(levels_db, abs=1e-9)


def test_delays_count_from_the_first_input_that_is_heard():
    audible, view = tone(120.0, duration_s=0.1, onset_s=0.3), View(outputs=(20,))
    muted, still = replace(tone(60.0, place=3), muted=True), tone(60.0, 0.0, place=4)
    alone, beside = (
        ss.evaluate(ss.Design(limb="synthetic-1", inputs=inputs), "output_statistics", view=view)
        for inputs in ((audible,), (muted, still, audible))
    )
    assert 0.04 < alone["output_statistics"].delay_s[0] < 0.08
    assert beside["output_statistics"].delay_s == pytest.approx(
        alone["output_statistics"].delay_s, abs=1e-6
    )


def test_noise_along_a_direction_is_that_of_independent_axes():
    direction = np.array([[0.6, 0.8, 0.0], [1.0, 0.0, 0.0]])
    energy = np.array([[4.0, 9.0, 16.0], [4.0, 9.0, 16.0]])
    noise_rms = output_noise_rms(energy, Projection((0, 1, 2), direction), 10)
    rng = np.random.default_rng(12)
    axes = rng.normal(size=(2, 3, 200_000)) * np.sqrt(energy / 10)[..., None]
    drawn = np.einsum("oa,oat->ot", direction, axes)
    assert noise_rms == pytest.approx(drawn.std(axis=-1), rel=0.01)


@pytest.mark.parametrize(("share", "state"), [(0.04, "kept"), (0.06, "left"), (0.15, "left")])
def test_a_twentieth_of_the_energy_may_lie_where_it_should_not(share, state):
    weights = np.sqrt(1.0 - share), np.sqrt(share)
    assert lamp("band", sine(100.0, weights[0]) + sine(10.0, weights[1])).state == state
    assert lamp("spacing", sine(100.0, weights[0]) + sine(400.0, weights[1])).state == state


def test_shares_of_several_drives_are_weighed_by_their_energy():
    loud, soft = sine(100.0, 10.0), sine(10.0, 1.0)
    assert lamp("band", loud, soft).state == "kept"
    assert lamp("band", sine(100.0, 1.0), sine(10.0, 10.0)).sentence.startswith("99%")
