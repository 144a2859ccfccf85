"""A limb of a lab: 7 places, 31 outputs along x and z, 4 kHz."""

import numpy as np

from skinsource.engine import evaluation
from skinsource.limbs.own_limbs import OwnLimb, install_limb

N_INPUTS, N_OUTPUTS, N_TAPS, RATE_HZ = 7, 31, 90, 4000.0


def response(place: int, axes: str = "xz") -> np.ndarray:
    """(31, n_axes, 90), dying away."""
    noise = np.random.default_rng(place).standard_normal((N_OUTPUTS, len(axes), N_TAPS))
    return noise * np.exp(-np.arange(N_TAPS) / 30)


def own_limb(**changes) -> OwnLimb:
    rng = np.random.default_rng(4)
    around = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    outputs = rng.uniform(-30, 30, (N_OUTPUTS, 2))
    outputs[4] = np.nan
    values = {
        "name": "lab-1",
        "title": "Lab 1",
        "n_taps": N_TAPS,
        "axes": "xz",
        "sample_rate_hz": RATE_HZ,
        "pre_trigger_delay_s": 0.002,
        "hand_length_mm": 180.0,
        "hand_length_px": 100.0,
        "outline": 50.0 * np.column_stack((np.cos(around), 1.4 * np.sin(around))),
        "input_positions": rng.uniform(-30, 30, (N_INPUTS, 2)),
        "output_positions": outputs,
        "input_names": tuple(f"site {k}" for k in range(1, N_INPUTS + 1)),
    }
    return OwnLimb(**{**values, **changes})


def installed(**changes) -> OwnLimb:
    # What an earlier test evaluated was read from a folder that is gone.
    evaluation._evaluator.cache_clear()
    limb = own_limb(**changes)
    install_limb(limb, (response(place, limb.axes) for place in range(1, N_INPUTS + 1)))
    return limb


def keep(name: str, responses: np.ndarray, **changes) -> None:
    """Install these responses, (n_inputs, n_outputs, n_axes, n_taps), as a limb."""
    n_inputs, n_outputs, n_axes, n_taps = responses.shape
    positions = np.random.default_rng(4).uniform(-30, 30, (n_inputs + n_outputs, 2))
    sizes = {
        "input_positions": positions[:n_inputs],
        "output_positions": positions[n_inputs:],
        "input_names": (),
        "n_taps": n_taps,
        "axes": "xyz"[:n_axes],
    }
    install_limb(own_limb(name=name, **sizes, **changes), iter(responses))
