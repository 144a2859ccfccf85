"""Figures of scenes on a limb of a lab: all that a limb has is asked of it."""

import pytest

import skinsource as ss
from skinsource.base.errors import InvalidInputError
from skinsource.studies.figures.figures import swept_hz
from skinsource.studies.figures.writing import draw_figure
from tests.core.own_limbs.lab_bench import N_OUTPUTS, installed

BAND = (40.0, 1500.0)


def on_lab(name):
    """A scene on the limb of the lab."""
    return ss.scenes.open_scene(name, limb="lab-1")


def test_a_pulse_is_shown_as_late_as_the_limb_answers_along_the_axes_that_it_has(user_data):
    installed(band_hz=BAND)
    drawn = draw_figure(on_lab("1C"))
    at_ms = [float(name.split("_")[0]) for name in list(drawn.tables["-frames"])[1:]]
    # Not 52 ms and later, and at 4 kHz.
    assert at_ms == pytest.approx([2.0, 2.75, 3.5, 4.25, 5.0], abs=0.251)
    assert {name.split("_")[2] for name in list(drawn.tables[""])[1:]} == {"x", "z"}
    assert drawn.tables["-frames"]["output"].size == N_OUTPUTS
    titles = list(draw_figure(on_lab("1E")).tables[""])[1:]
    assert [title.partition(" (")[0] for title in titles] == ["Along x", "Along z"]
    frames = list(draw_figure(on_lab("4A")).tables[""])[1:]
    assert float(frames[0].split()[2]) == pytest.approx(50.0, abs=0.13)


def test_spectra_go_over_the_band_of_the_limb(user_data):
    installed(band_hz=BAND)
    hz = draw_figure(on_lab("1D")).tables[""]["frequency_hz"]
    assert hz.min() == pytest.approx(40.0, abs=25.0)
    assert hz.min() >= 40.0
    assert 1450.0 < hz.max() <= 1500.0
    installed()
    hz = draw_figure(on_lab("1D")).tables[""]["frequency_hz"]
    assert (hz.min(), hz.max()) == (0.0, pytest.approx(2000.0, abs=25.0))


def test_lines_are_fitted_where_the_sweep_goes_and_the_limb_was_measured(user_data):
    installed(band_hz=BAND)
    assert swept_hz(on_lab("5E")) == (40.0, 600.0)
    fits = draw_figure(on_lab("5E")).tables[""]
    hz = fits.pop("frequency_hz")
    assert (hz.min(), hz.max()) == (41.0, 599.0)
    assert len(fits) == N_OUTPUTS
    assert min(fit.min() for fit in fits.values()) > 1.0 - 1e-9
    installed()
    assert swept_hz(on_lab("5E")) == (25.0, 600.0)
    installed(band_hz=(599.0, 1500.0))
    with pytest.raises(InvalidInputError, match=r"25 to 600 Hz, and the limb 'lab-1' was measured"):
        draw_figure(on_lab("5D"))
