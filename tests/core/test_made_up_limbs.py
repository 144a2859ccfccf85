"""Limbs of 7 places, 31 outputs and one to three axes at 4 kHz: what is computed, and why not."""

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.prediction import predict
from skinsource.engine.quantities import new_graph, sources
from skinsource.limbs.extent import extent
from skinsource.limbs.limb import Limb, LimbMap
from skinsource.limbs.scaling import per_probe_acceleration
from skinsource.limbs.surface.surface import surface_operator
from skinsource.signals.projection import project_axes

N_INPUTS, N_OUTPUTS, N_TAPS, RATE_HZ = 7, 31, 180, 4000.0
OUTPUTS = (31, 2, 5)
PLAYED = Design(
    limb="made-up",
    scaling="relative",
    inputs=(
        track(7, Tone(frequency_hz=1500.0, duration_s=0.1)),
        track(3, Noise(seed=2), amplitude=-0.5, onset_s=0.05),
        track(7, Tap(), amplitude=2.0, onset_s=0.1),
    ),
)


def limb_along(axes: str, **more) -> Limb:
    rng = np.random.default_rng(4)
    around = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    places = rng.uniform(-30, 30, (N_OUTPUTS, 2))
    places[4] = np.nan
    return Limb(
        name="made-up",
        hand_length_mm=100.0,
        synthetic=True,
        map=LimbMap(
            outline=50.0 * np.column_stack((np.cos(around), np.sin(around))),
            output_positions=places,
            input_positions=rng.uniform(-30, 30, (N_INPUTS, 2)),
            hand_length_px=100.0,
        ),
        read_response=lambda place: np.random.default_rng(place).standard_normal(
            (N_OUTPUTS, len(axes), N_TAPS)
        ),
        sample_rate_hz=RATE_HZ,
        axes=axes,
        shape=(N_INPUTS, N_OUTPUTS, len(axes), N_TAPS),
        **more,
    )


def shown(limb: Limb, design: Design, view: View, *quantities: str) -> dict:
    given = sources(design, view) | {"limb_data": limb}
    return new_graph().evaluate(quantities, given)


@pytest.mark.parametrize(("measured", "axes"), [("xz", "y"), ("xz", "xy"), ("z", "x")])
def test_an_axis_that_was_not_measured_is_refused_by_name(measured, axes):
    limb = limb_along(measured)
    message = f"measures along {' and '.join(measured)} only. Choose '{measured}'"
    with pytest.raises(InvalidInputError, match=message):
        shown(limb, PLAYED, View(axes=axes, outputs=OUTPUTS), "output_rms")
    with pytest.raises(InvalidInputError, match=message):
        project_axes(np.zeros((2, len(measured), 9)), axes, "mag", measured)


@pytest.mark.parametrize("axes", ["", "zx", "xx", "q", "xyz", None])
def test_a_limb_whose_axes_are_not_those_of_its_responses_is_refused(axes):
    with pytest.raises(InvalidInputError, match="expected 2 of x, y and z"):
        Limb(
            name="odd",
            hand_length_mm=100.0,
            synthetic=True,
            map=limb_along("xz").map,
            read_response=lambda _: np.zeros((N_OUTPUTS, 2, 9)),
            axes=axes,
            shape=(N_INPUTS, N_OUTPUTS, 2, 9),
        )


def test_probe_scaling_divides_by_the_pulse_only_where_a_pulse_was_played():
    drive = Tone(frequency_hz=200.0, duration_s=0.1).samples(RATE_HZ)
    plain, pulsed = limb_along("xz", per_unit_drive=True), limb_along("xz")
    relative = predict(plain, [drive], [3], scaling="relative")
    np.testing.assert_array_equal(predict(plain, [drive], [3], scaling="probe"), relative)
    taps = per_probe_acceleration(pulsed.response_to(3), RATE_HZ)
    expected = np.convolve(drive, taps[7, 1])
    response = predict(pulsed, [drive], [3], scaling="probe")[7, 1]
    np.testing.assert_allclose(response, expected, atol=1e-12 * np.abs(expected).max())
    assert not np.allclose(response, relative[7, 1], atol=1e-3 * np.abs(expected).max())


def test_the_map_shows_the_outputs_that_have_a_place():
    limb = limb_along("xz")
    operator = surface_operator(limb)
    assert operator.weights.shape[1] == N_OUTPUTS
    assert not operator.weights[:, [4]].nnz
    values = shown(limb, PLAYED, View(axes="xz", outputs=()), "output_levels_db")
    levels = operator.interpolate(values["output_levels_db"])
    inside = levels[np.isfinite(levels)]
    placed = np.delete(values["output_levels_db"], 4)
    assert inside.size
    assert placed.min() - 1e-9 <= inside.min() <= inside.max() <= placed.max() + 1e-9
    energy = 10 ** (values["output_levels_db"] / 20)
    assert 0.0 < extent(energy, limb, (7,)).mean_distance_mm < 100.0
