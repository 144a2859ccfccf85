"""Drawings of long designs reach as far as the wave between samples."""

from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss

# A quarter of the rate of 1300 Hz: where the phase is 45°, all samples miss its peaks by 3 dB.
HZ = 325.0
# Outputs where the phase is such.
MISSED = (23, 35)
LONG = ss.Design(
    limb="synthetic-1",
    inputs=(ss.track(7, ss.waveforms.Tone(frequency_hz=HZ, duration_s=20.0)),),
    scaling="relative",
)
VIEW = ss.View(axes="z", outputs=MISSED)


def drawn(design, view=VIEW):
    """Each row as (times, values in parts of its own peak)."""
    ax = ss.plot.traces(design, view=view, normalised=True).axes[0]
    lines = [line for line in ax.lines if len(line.get_xdata()) > 2]
    bases = [-2.3 * rank for rank in range(len(lines))]
    return [
        (np.asarray(x.get_xdata()), x.get_ydata() - b) for x, b in zip(lines, bases, strict=True)
    ]


def tone_amplitudes(design, view):
    """Amplitude of the steady tone at each output, by least squares, and the largest sample."""
    values = ss.evaluate(design, "response_time_s", "selected_traces", view=view)
    time_s = values["response_time_s"]
    steady = (time_s > 5.0) & (time_s < 15.0)
    turns = 2.0 * np.pi * HZ * time_s[steady]
    basis = np.stack((np.cos(turns), np.sin(turns)), axis=1)
    parts = np.linalg.lstsq(basis, values["selected_traces"][:, steady].T, rcond=None)[0]
    return np.hypot(*parts), np.abs(values["selected_traces"][:, steady]).max(axis=1)


def test_columns_of_a_long_tone_reach_its_amplitude_where_samples_miss_it():
    amplitudes, of_samples = tone_amplitudes(LONG, VIEW)
    assert (of_samples < 0.72 * amplitudes).all()
    for time_ms, values in drawn(LONG):
        inside = (time_ms > 5e3) & (time_ms < 15e3)
        low, high = values[inside][::2], values[inside][1::2]
        peak = np.abs(values).max()
        assert peak == pytest.approx(1.0)
        # Steady: all columns reach alike, on both sides.
        np.testing.assert_allclose(high, high.mean(), rtol=0.02)
        np.testing.assert_allclose(low, -high.mean(), rtol=0.02)


def test_columns_are_in_the_unit_of_the_scale():
    figure = ss.plot.traces(LONG, view=replace(VIEW, outputs=MISSED[:1]))
    ax = figure.axes[0]
    [line] = [line for line in ax.lines if len(line.get_xdata()) > 2]
    texts = [text.get_text() for text in ax.texts]
    size = float(next(text for text in texts if "a row is" in text).split()[-3])
    time_ms, values = np.asarray(line.get_xdata()), line.get_ydata() * size
    amplitudes, _ = tone_amplitudes(LONG, replace(VIEW, outputs=MISSED[:1]))
    inside = (time_ms > 5e3) & (time_ms < 15e3)
    np.testing.assert_allclose(values[inside].max(), amplitudes[0], rtol=0.03)
    assert time_ms[-1] == pytest.approx(20.4e3, rel=0.01)


def test_columns_of_a_magnitude_are_lengths_and_never_negative():
    for _, values in drawn(LONG, replace(VIEW, axes="xyz", method="mag")):
        assert values.min() >= 0.0
        assert values.max() == pytest.approx(1.0)


def test_a_range_of_times_of_a_long_design_is_drawn_alone():
    shown = replace(VIEW, time_range_s=(2.0, 18.5))
    for time_ms, _ in drawn(LONG, shown):
        assert time_ms[0] == pytest.approx(2000.0, abs=1.0)
        assert time_ms[-1] == pytest.approx(18500.0, abs=5.0)
