"""A whole design as a preset, where a chain has no room for the gain curve of its track."""

import numpy as np
import pytest

import skinsource as ss
from skinsource.design import edits
from skinsource.design.clips import MAX_EFFECTS, Clip
from skinsource.design.design import Design, Input
from skinsource.design.effects.level import SoftClip
from skinsource.design.effects.time import Trim
from skinsource.design.presets.presets import whole_design
from skinsource.design.view import View
from skinsource.design.waveforms.tones import Tone

CURVE = ((0.05, 0.2), (0.3, 1.0))


@pytest.mark.parametrize("count", [MAX_EFFECTS - 1, MAX_EFFECTS])
def test_a_full_chain_plays_what_it_played_below_its_gain_curve(count):
    effects = (*(SoftClip(drive=1.1, level=2.0),) * (count - 1), Trim(0.0, 0.25))
    clip = Clip(waveform=Tone(97.0, duration_s=0.3), onset_s=0.0337, gain=-0.7, effects=effects)
    design = Design(
        limb="synthetic-1", inputs=(Input(location=7, clips=(clip,), gain_curve=CURVE),)
    )
    preset = whole_design(design)
    [lane] = preset.lanes
    assert len(lane.clips[0].effects) <= MAX_EFFECTS
    outcome = edits.place_fragment(
        Design(limb="synthetic-1"), View(), preset, "all", clip.onset_s, location=7
    )
    before, after = (
        ss.evaluate(either, "output_levels_db")["output_levels_db"]
        for either in (design, outcome.design)
    )
    assert np.allclose(before, after, rtol=0.0, atol=1e-9)
