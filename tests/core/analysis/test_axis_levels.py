"""Levels along each axis are those that the map shows when that axis alone is chosen."""

from dataclasses import replace

import numpy as np

from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.evaluation import evaluate
from tests.core.own_limbs.lab_bench import installed

PLAYED = Design(
    limb="synthetic-2",
    scaling="relative",
    inputs=(
        track(8, Tone(frequency_hz=150.0, duration_s=0.2)),
        track(3, Noise(seed=2), amplitude=-0.5, onset_s=0.05),
        track(8, Tap(), amplitude=2.0, onset_s=0.1),
    ),
)
PAIRS = (
    ("axis_levels_db", "output_levels_db"),
    ("axis_surface_levels_db", "surface_levels_db"),
    ("axis_above_noise_db", "above_noise_db"),
)


def levels_of(design, view, of_axes):
    return evaluate(design, *(pair[not of_axes] for pair in PAIRS), view=view)


def same_for_each_axis(design, view, axes):
    levels = levels_of(design, view, True)
    assert len(levels["axis_levels_db"]) == len(axes)
    for k, axis in enumerate(axes):
        alone = levels_of(design, replace(view, axes=axis), False)
        for of_axes, name in PAIRS:
            if alone[name] is None:
                assert levels[of_axes][k] is None
            else:
                np.testing.assert_allclose(levels[of_axes][k], alone[name], rtol=0, atol=1e-9)
    return levels


def test_a_limb_of_a_lab_has_the_axes_it_was_measured_along_and_their_noise(user_data):
    installed(pre_trigger_delay_s=0.005)
    on_lab = Design(limb="lab-1", inputs=(track(3, Tap()), track(6, Tone(frequency_hz=300.0))))
    levels = same_for_each_axis(on_lab, View(axes="xyz", method="mag"), "xz")
    along_x, along_z = levels["axis_above_noise_db"]
    assert not np.allclose(along_x, along_z)


def test_one_axis_alone_has_one_map_and_silence_is_silent(user_data):
    installed(axes="z")
    on_lab = Design(limb="lab-1", inputs=(track(3, Tap()),))
    same_for_each_axis(on_lab, View(axes="z"), "z")
    nothing = Design(limb="synthetic-1", inputs=())
    values = same_for_each_axis(nothing, View(), "xyz")
    assert all((levels <= -200.0).all() for levels in values["axis_levels_db"])
