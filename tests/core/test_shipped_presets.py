"""The presets that are shipped: described, placed and played."""

import numpy as np
import pytest

from skinsource import Design, View, edits
from skinsource.base.measurement_conditions import BAND_HZ
from skinsource.design.presets import presets
from skinsource.signals.spectra import share_outside_band

RATE_HZ = 1300.0
SHELF = presets.read_preset_folder(presets.shipped_folder())
SHIPPED = [entry.preset for entry in SHELF.entries]
every = pytest.mark.parametrize("preset", SHIPPED, ids=lambda preset: preset.name)


def test_no_two_are_called_alike_and_none_is_left_out():
    assert SHELF.faults == ()
    assert len({preset.name for preset in SHIPPED}) == len(SHIPPED) >= 40


@every
def test_each_says_what_it_is_and_where_its_numbers_come_from(preset):
    assert preset.tags
    assert preset.description.endswith(".")
    assert preset.source.endswith(".")
    assert all(tag == tag.strip() != "" for tag in preset.tags)


@every
def test_each_plays_with_a_peak_about_1_and_within_3_seconds(preset):
    played = presets.mixed(preset.fragment, RATE_HZ)
    assert 0.5 < np.abs(played).max() < 2.0
    assert played.size < 3 * RATE_HZ


def test_all_but_those_that_say_so_lie_within_the_measured_band():
    outside = {
        preset.name: share_outside_band(presets.mixed(preset.fragment, RATE_HZ), RATE_HZ, BAND_HZ)
        for preset in SHIPPED
    }
    assert {name for name, share in outside.items() if share > 0.2} == {"Tap", "Tick train"}


@every
def test_each_is_placed_at_once(preset):
    empty = Design(limb="synthetic-1")
    outcome = edits.place_fragment(empty, View(), preset.fragment, preset.name, 0.5)
    assert outcome.label == f"Place {preset.name}"
    placed = outcome.design
    assert len(placed.clips) == sum(len(lane.clips) for lane in preset.fragment.lanes)
    assert min(clip.onset_s for clip in placed.clips) == 0.5
    assert set(outcome.view.selected_clips) == {clip.id for clip in placed.clips}
