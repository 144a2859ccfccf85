"""Motions of actuators, also at the ends of all numbers."""

from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import InvalidInputError
from skinsource.specs.models import specs_of

#: An actuator of each kind, with parameters of ordinary ones.
COIL = ss.actuators.VoiceCoil(8.0, 8e-4, 0.8, 1e-3, 0.07, 1209.0)
RECOIL = ss.actuators.RecoilVoiceCoil(4.0, 5e-4, 1.5, 4e-3, 0.5, 1280.0, 1.1e-2, 700.0, 1.0)
PIEZO = ss.actuators.Piezo(1e-7, 1e-2, 1e-3, 0.1, 2000.0)
PARAMETERS = [(kind, name) for kind in (COIL, RECOIL, PIEZO) for name in specs_of(kind)]


@pytest.mark.parametrize(
    ("voltage", "rate_hz", "hold", "word"),
    [
        ([0.0, np.nan], 1300.0, "zero", "voltage"),
        ([[0.0]], 1300.0, "zero", "voltage"),
        ([1j], 1300.0, "zero", "voltage"),
        ([0.0], 0.0, "zero", "sample_rate_hz"),
        ([0.0], np.inf, "zero", "sample_rate_hz"),
        ([0.0], 1300.0, "second", "hold"),
        ([1e308] * 90, 1300.0, "zero", "voltage"),
    ],
)
def test_what_cannot_be_simulated_is_refused(voltage, rate_hz, hold, word):
    with pytest.raises(InvalidInputError, match=word):
        COIL.simulate(voltage, rate_hz, hold)


@pytest.mark.parametrize("value", [5e-324, 1e-150, 1e150, 1.7e308])
@pytest.mark.parametrize(("actuator", "name"), PARAMETERS)
def test_a_parameter_at_the_end_of_all_numbers_moves_it_or_is_refused(actuator, name, value):
    extreme = replace(actuator, **{name: value})
    for act in (
        lambda: extreme.simulate(np.sin(np.arange(70.0)), 1300.0).acceleration,
        lambda: extreme.response(100.0),
        lambda: extreme.admittance(100.0),
        lambda: ss.equalising.resonance_of(extreme),
    ):
        try:
            result = act()
        except InvalidInputError:
            continue
        assert np.isfinite(result).all()


@pytest.mark.parametrize("actuator", [COIL, RECOIL, PIEZO])
def test_a_long_tone_moves_it_as_its_response_says(actuator):
    rate_hz, n = 96_000.0, 4 * 96_000
    turn = np.exp(2j * np.pi * 150.0 * np.arange(n) / rate_hz)
    motion = actuator.simulate(turn.real, rate_hz, "first")
    last = slice(n - 9600, n)
    shown = 2.0 * np.mean(motion.acceleration[last] * turn[last].conj())
    assert shown == pytest.approx(actuator.response(150.0), rel=1e-4)
    flowing = 2.0 * np.mean(motion.current[last] * turn[last].conj())
    assert flowing == pytest.approx(actuator.admittance(150.0), rel=1e-3)


def test_a_recoiling_casing_keeps_the_momentum_where_it_hangs_free():
    free = ss.actuators.RecoilVoiceCoil(4.0, 5e-4, 1.5, 4e-3, 0.5, 1280.0, 1.1e-2)
    fixed = ss.actuators.VoiceCoil(4.0, 5e-4, 1.5, 4e-3 * 1.1e-2 / 1.5e-2, 0.5, 1280.0)
    frequency_hz = np.array([20.0, 90.0, 600.0])
    # Both masses swing about their common centre, as one reduced mass does about a wall.
    share = -4e-3 / 1.5e-2
    assert free.response(frequency_hz) == pytest.approx(share * fixed.response(frequency_hz))


def test_a_response_is_zero_where_nothing_oscillates_and_mirrored_below():
    for actuator in (COIL, RECOIL, PIEZO, ss.actuators.VoiceCoil(8.0, 8e-4, 0.0, 1e-3, 0.0, 0.0)):
        assert actuator.response(0.0) == 0.0
        assert actuator.response([[-50.0, 50.0]]).shape == (1, 2)
        assert actuator.response(-50.0) == actuator.response(50.0).conjugate()
