"""Spectra along each axis that a limb has, whichever are chosen."""

import numpy as np

import skinsource as ss
from skinsource.design.view import View
from skinsource.signals.spectra import magnitude_spectrum, peak_hold_spectrum
from tests.core.own_limbs.lab_bench import RATE_HZ


def test_spectra_of_axes_are_those_of_the_traces_along_all_that_the_limb_has(lab):
    inputs = (ss.track(3, ss.waveforms.Tone(frequency_hz=200.0, duration_s=0.1)),)
    design, outputs = ss.Design(limb="lab-1", inputs=inputs), (2, 17, 30)
    whole = ss.evaluate(design, "axis_traces", view=View(outputs=outputs, axes="xyz"))
    quantities = "selected_axis_spectra", "selected_axis_peak_spectra"
    values = ss.evaluate(design, *quantities, view=View(outputs=outputs, axes="z"))
    assert whole["axis_traces"].shape[:2] == (3, 2)
    for name, spectrum in zip(quantities, (magnitude_spectrum, peak_hold_spectrum), strict=True):
        frequency_hz, magnitude = values[name]
        expected_hz, expected = spectrum(whole["axis_traces"], RATE_HZ)
        np.testing.assert_allclose(frequency_hz, expected_hz)
        np.testing.assert_allclose(magnitude, expected, rtol=0, atol=1e-12 * expected.max())
