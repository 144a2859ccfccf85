"""Limbs and scenes for the tests of the benchmark."""

from dataclasses import replace

import numpy as np

from skinsource.method_comparison.compared_limb import limb_called, limb_of_size
from skinsource.method_comparison.scenes import Player, scene_of
from skinsource.own_limbs import install_limb
from tests.core.own_limbs.lab_bench import own_limb


def sized(n_inputs=7, n_outputs=31, n_taps=90, **changes):
    values = {"name": "x", "digest": "y", "axes": "xz", "sample_rate_hz": 4000.0, **changes}
    return limb_of_size(n_inputs=n_inputs, n_outputs=n_outputs, n_taps=n_taps, **values)


def tiny(limb):
    players = (
        Player(location=7, seed=1, n_times=500, amplitude=0.7),
        Player(location=3, seed=2, n_times=90, amplitude=-1.1, start=161),
    )
    return replace(scene_of("S2", limb), key="S1", reference="S1", players=players)


def keep(name, responses, **changes):
    """Import these responses, (n_inputs, n_outputs, n_axes, n_taps), as a limb."""
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
    return limb_called(name)
