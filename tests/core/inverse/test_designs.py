"""What a focus plays: its waveform at the target, at a level, within a band and a peak."""

from dataclasses import replace

import numpy as np
import pytest
import scipy

import skinsource as ss
from skinsource.base.errors import InvalidInputError
from skinsource.inverse.designing import cost_of
from skinsource.inverse.responses import bins_of, loading
from skinsource.limbs.scaling import pulse_spectrum

TARGET = 30
TONE = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.2, window="hanning")
TAP = ss.waveforms.Tap()
LOUDEST = ss.View(axes="z", span="loudest")


@pytest.fixture(scope="module")
def focus(limb):
    return ss.inverse.focus(limb, TARGET)


def levels_db(design):
    return ss.evaluate(design, "output_levels_db", view=LOUDEST)["output_levels_db"]


def drives_of(design):
    return np.stack([track.clips[0].waveform.samples.values for track in design.inputs])


def target_of(limb, design):
    places = [track.location for track in design.inputs]
    return ss.predict(limb, drives_of(design), places)[TARGET - 1, 2]


def placed(focus, waveform, n_times):
    """The waveform after the delay of the design, which may lie between samples."""
    samples = waveform.samples(1300.0)
    n_fft = scipy.fft.next_fast_len(n_times + samples.size)
    turn = np.exp(-2j * np.pi * np.fft.rfftfreq(n_fft, 1 / 1300.0) * focus.delay_s)
    return scipy.fft.irfft(scipy.fft.rfft(samples, n_fft) * turn, n_fft)[:n_times]


@pytest.mark.parametrize("frequencies_hz", [None, np.arange(80.0, 121.0, 5.0)])
def test_the_target_does_what_the_waveform_says(limb, frequencies_hz):
    focus = ss.inverse.focus(limb, TARGET, frequencies_hz=frequencies_hz)
    seen = target_of(limb, focus.design(TONE))
    wanted = placed(focus, TONE, seen.size)
    assert np.square(seen - wanted).sum() < 0.01 * np.square(wanted).sum()


@pytest.mark.parametrize("spectrum", ["as drawn", "natural"])
def test_a_level_is_reached(focus, spectrum):
    design = focus.design(TAP, level=0.5, spectrum=spectrum)
    assert design.scaling == "probe"
    np.testing.assert_allclose(levels_db(design)[TARGET - 1], ss.decibels(0.5), atol=0.02)


def test_the_target_is_the_loudest_of_the_hand(focus):
    assert levels_db(focus.design(TONE))[:42].argmax() == TARGET - 1


def test_nothing_is_driven_outside_the_band_unless_asked(focus):
    def share_outside(low_hz, high_hz, **changes):
        drives = drives_of(focus.design(ss.waveforms.Impulse(), **changes))
        energy = np.square(np.abs(scipy.fft.rfft(drives, 2600))).sum(axis=0)
        at_hz = np.fft.rfftfreq(2600, 1 / 1300.0)
        outside = (at_hz < 0.75 * low_hz) | (at_hz > 1.15 * high_hz)
        return energy[outside].sum() / energy.sum()

    assert share_outside(50.0, 300.0) < 1e-3
    assert share_outside(100.0, 200.0, band_hz=(100.0, 200.0)) < 1e-3
    assert share_outside(50.0, 300.0, band_hz=(50.0, 400.0)) > 0.01


def test_a_natural_spectrum_needs_less_drive_for_the_same_level(focus):
    noise = ss.waveforms.Impulse()
    energies = [
        np.square(drives_of(focus.design(noise, level=0.5, spectrum=spectrum))).sum()
        for spectrum in ("as drawn", "natural")
    ]
    assert energies[1] < energies[0]


def test_a_peak_is_kept_and_better_than_less_level(limb, focus):
    free = focus.design(TONE, level=0.5)
    peak = 0.6 * np.abs(drives_of(free)).max()
    design = focus.design(TONE, level=0.5, peak=peak)
    assert np.abs(drives_of(design)).max() == peak
    scaled_db = ss.decibels(0.5) + ss.decibels(0.6)
    assert levels_db(design)[TARGET - 1] > scaled_db + 0.3


def test_a_loose_peak_changes_nothing(focus):
    free = drives_of(focus.design(TONE))
    loose = drives_of(focus.design(TONE, peak=2.0 * np.abs(free).max()))
    np.testing.assert_array_equal(loose, free)


def test_the_free_drives_are_the_least_of_the_cost_within_a_peak(focus):
    free = drives_of(focus.design(TONE))
    tight = drives_of(focus.design(TONE, peak=0.999 * np.abs(free).max()))
    np.testing.assert_allclose(tight, free, atol=0.02 * np.abs(free).max())


def test_the_cost_within_a_peak_is_energy_at_target_and_quiet_outputs_and_of_drives(limb, focus):
    rng = np.random.default_rng(3)
    tone = ss.sinusoid(100.0, 0.5, window_name="hanning")
    drives = rng.normal(size=(15, 1)) * tone
    at_hz = bins_of(1024, 1300.0)
    pulse = pulse_spectrum(at_hz, 1300.0)
    cost = cost_of(focus, pulse, np.ones(513), tone.size)
    seen = ss.predict(limb, drives, range(6, 21))[:42, 2]
    energy = np.square(seen).sum(axis=1)
    at = np.abs(focus.frequencies_hz - 100.0).argmin()
    unit = loading(focus.gram)[at]
    quiet = np.delete(energy, TARGET - 1).sum()
    target = 15.0 * unit / np.linalg.norm(focus.row[at]) ** 2 * energy[TARGET - 1]
    own = 0.3 * unit * np.square(drives).sum() / pulse_spectrum(np.array(100.0), 1300.0) ** 2
    reached = np.vdot(drives, cost.applied(drives))
    np.testing.assert_allclose(reached, quiet + target + own, rtol=0.02)
    assert min(quiet, target, own) > 0.05 * reached


@pytest.mark.parametrize("way", [ss.inverse.time_reversal, ss.inverse.best_single])
def test_baselines_have_designs_within_a_peak_too(limb, way):
    found = way(limb, TARGET)
    peak = 0.5 * np.abs(drives_of(found.design(TONE))).max()
    assert np.abs(drives_of(found.design(TONE, peak=peak))).max() == peak


def test_it_goes_through_an_actuator_and_its_equaliser(focus):
    design = focus.design(TONE, level=0.5)
    coil = ss.actuators.load("example-voice-coil")
    actuation = ss.Actuation(
        actuators=[ss.ActuatorAt(model=coil)], equaliser=ss.equalising.RegularisedInverse()
    )
    through = levels_db(replace(design, actuation=actuation))
    np.testing.assert_allclose(through[TARGET - 1], ss.decibels(0.5), atol=0.5)


def test_inputs_that_are_not_in_use_have_no_track(limb):
    found = ss.inverse.focus(limb, TARGET, inputs=[7, 12])
    assert [track.location for track in found.design(TONE).inputs] == [7, 12]


@pytest.mark.parametrize(
    ("changes", "match"),
    [
        ({"level": 0.0}, "level is 0"),
        ({"peak": -1.0}, "peak is -1"),
        ({"spectrum": "flat"}, "spectrum 'flat' is not known"),
        ({"band_hz": (300.0, 50.0)}, "two rising frequencies"),
        ({"waveform": ss.waveforms.Formula(text="0 * t"), "level": 1.0}, "nothing within 50 to"),
        ({"waveform": replace(TONE, frequency_hz=500.0), "level": 1.0}, "nothing within 50 to"),
    ],
)
def test_what_cannot_be_designed_is_refused(focus, changes, match):
    with pytest.raises(InvalidInputError, match=match):
        focus.design(**{"waveform": TONE, **changes})


def test_an_own_limb_is_driven_in_its_own_unit(limb, limb_of):
    own = limb_of(limb.response_to, name="of-a-lab", per_unit_drive=True, synthetic=True)
    found = ss.inverse.focus(own, TARGET, inputs=range(6, 21))
    assert np.isnan(found.contact_db).all()
    design = found.design(TONE)
    assert design.inputs[0].clips[0].waveform.samples.unit == ""
    drives = drives_of(design)
    seen = ss.predict(own, drives, [t.location for t in design.inputs], scaling="relative")
    wanted = placed(found, TONE, seen.shape[-1])
    assert np.square(seen[TARGET - 1, 2] - wanted).sum() < 0.01 * np.square(wanted).sum()
