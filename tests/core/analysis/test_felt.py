"""Levels above threshold and the hand-arm weighting, against tables and other ways to them."""

from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import FileFormatError
from skinsource.design.design import View
from skinsource.design.panel_settings import with_settings
from skinsource.engine.analysis_rules import SILENT_DB
from skinsource.engine.quantities import new_graph, sources
from skinsource.perception.thresholds import (
    PerceptionSettings,
    hand_arm_weighting,
    read_threshold_table,
    settings_table,
    table_threshold,
)


def tone(frequency_hz, duration_s=0.3, **changes):
    return ss.track(
        8, ss.waveforms.Tone(frequency_hz=frequency_hz, duration_s=duration_s), **changes
    )


def sensation_of(*inputs, view=None, **changes):
    design = ss.Design(limb="synthetic-1", inputs=inputs, **changes)
    return new_graph().evaluate({"sensation"}, sources(design, view or View()))["sensation"]


@pytest.mark.parametrize(
    ("frequency_hz", "gain"),
    [
        (10.0, 0.954),
        (16.0, 0.893),
        (31.5, 0.521),
        (50.0, 0.325),
        (100.0, 0.160),
        (200.0, 0.0797),
        (315.0, 0.0505),
        (500.0, 0.0315),
    ],
)
def test_the_hand_arm_weighting_is_that_of_the_table(frequency_hz, gain):
    assert np.abs(hand_arm_weighting(frequency_hz)) == pytest.approx(gain, rel=0.006)


@pytest.mark.parametrize(
    ("waveform", "density", "duration_s"),
    [
        # Spectral densities, and how long each moves.
        (ss.waveforms.Impulse(), lambda f: np.ones_like(f) / 1300.0, 1 / 1300.0),
        (
            ss.waveforms.Formula(text="1", duration_s=0.3),
            lambda f: np.sin(np.pi * f * 0.3) / np.sin(np.pi * f / 1300.0) / 1300.0,
            0.3,
        ),
    ],
)
def test_what_a_short_contact_leaves_in_the_weighting_is_counted(waveform, density, duration_s):
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(8, waveform),))
    [(_, weighted)] = ss.evaluate(design, "contact_weighted_rms")["contact_weighted_rms"]
    frequency_hz = np.linspace(1e-3, 650.0, 650_001)
    power = np.square(density(frequency_hz) * np.abs(hand_arm_weighting(frequency_hz)))
    energy = 2.0 * np.trapezoid(power, frequency_hz)
    assert weighted == pytest.approx(np.sqrt(energy / duration_s), rel=1e-4)


def test_the_contact_alone_is_weighted_in_probe_scaling_and_behind_no_actuator():
    design = ss.Design(limb="synthetic-1", inputs=(tone(100.0, amplitude=3.0, onset_s=0.5),))
    [(place, weighted)] = ss.evaluate(design, "contact_weighted_rms")["contact_weighted_rms"]
    assert place == 8
    # The tone's ends are faded: a little below that of a steady one.
    steady = 3.0 / np.sqrt(2) * np.abs(hand_arm_weighting(100.0))
    assert 0.8 * steady < weighted < steady
    coil = ss.ActuatorAt(model=ss.actuators.load("example-voice-coil"))
    for changes in ({"scaling": "relative"}, {"actuation": ss.Actuation(actuators=(coil,))}):
        other = ss.evaluate(replace(design, **changes), "contact_weighted_rms")
        assert other["contact_weighted_rms"] is None


def test_what_lies_outside_the_measured_band_counts_for_nothing():
    slow, low, high, fast = (
        sensation_of(tone(frequency_hz, 2.0, amplitude=50.0)).level_db.max()
        for frequency_hz in (8.0, 40.0, 590.0, 630.0)
    )
    assert slow < low - 30.0
    assert fast < high - 20.0


def test_streamed_designs_are_felt_as_short_ones():
    short = sensation_of(tone(120.0, onset_s=1.0)).level_db
    silent = ss.track(9, ss.waveforms.Tone(duration_s=0.05), amplitude=1e-9, onset_s=400.0)
    long = sensation_of(tone(120.0, onset_s=1.0), silent).level_db
    assert long == pytest.approx(short, abs=0.01)


def test_small_contacts_raise_the_threshold_of_p_only():
    view = with_settings(View(), "perception", PerceptionSettings(area_cm2=1.45))
    usual, small = sensation_of(tone(200.0)), sensation_of(tone(200.0), view=view)
    assert usual.by_channel["P"] - small.by_channel["P"] == pytest.approx(
        np.where(usual.by_channel["P"] > SILENT_DB, 3.01, 0.0), abs=0.01
    )
    assert small.by_channel["NP I"] == pytest.approx(usual.by_channel["NP I"])
    assert usual.level_db == pytest.approx(np.maximum(*usual.by_channel.values()))


def test_own_thresholds_come_from_a_table_in_either_unit(tmp_path):
    path = tmp_path / "own.csv"
    path.write_text("# mine\nfrequency_hz,threshold_m_per_s2\n500,2\n50,0.2\n")
    table = read_threshold_table(path)
    assert table == ((50.0, 0.2), (500.0, 2.0))
    # Straight in the logarithms: ten times the frequency, ten times the threshold.
    assert table_threshold(table, [50.0, 100.0, 501.0]) == pytest.approx([0.2, 0.4, np.inf])
    path.write_text("frequency_hz, threshold_dB_re_1e-6_m_per_s2\n50,120\n100,100\n")
    assert read_threshold_table(path) == ((50.0, pytest.approx(1.0)), (100.0, pytest.approx(0.1)))
    view = with_settings(View(), "perception", PerceptionSettings(table=settings_table(table)))
    sensation = sensation_of(tone(100.0, 1.0), view=view)
    design = ss.Design(limb="synthetic-1", inputs=(tone(100.0, 1.0),))
    rms = ss.evaluate(design, "output_rms", view=View(method="mag", span="loudest"))["output_rms"]
    assert set(sensation.by_channel) == {"own"}
    assert sensation.level_db[:42] == pytest.approx(20 * np.log10(rms[:42] / 0.4), abs=0.3)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "is empty"),
        ("hz,m\n1,2\n", "line 1"),
        ("frequency_hz,threshold_m_per_s2\n50,1\n60,x\n", "line 3"),
        ("frequency_hz,threshold_m_per_s2\n50,1\n60,-1\n", "line 3"),
        ("frequency_hz,threshold_m_per_s2\n50,1\n", "1 rows"),
        ("frequency_hz,threshold_m_per_s2\n50,1\n50,2\n", "two rows"),
    ],
)
def test_what_is_no_table_of_thresholds_is_refused(tmp_path, text, message):
    path = tmp_path / "own.csv"
    path.write_text(text)
    with pytest.raises(FileFormatError, match=message):
        read_threshold_table(path)
