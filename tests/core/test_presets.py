"""Presets: their text, searching them, making them of designs, and what they play."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import skinsource as ss
from skinsource.base.errors import InvalidInputError
from skinsource.design.clips import Clip, Fragment, Lane
from skinsource.design.design import Design, Input, track
from skinsource.design.effects.time import Reverse
from skinsource.design.presets import presets
from skinsource.design.presets.presets import Entry, Preset
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Tone
from tests.core.presets_bench import named, recipes, text


@settings(max_examples=40)
@given(preset=recipes)
def test_a_preset_comes_back_from_its_text_bit_by_bit(preset):
    text = presets.preset_text(preset)
    assert presets.preset_from(text) == preset
    assert presets.preset_text(presets.preset_from(text)) == text


@pytest.mark.parametrize("name", ["", "  ", "two\nlines", "x" * 101, None])
def test_a_preset_has_a_name_of_one_line(name):
    with pytest.raises(InvalidInputError, match="name"):
        named(name)


def entries_of(*all_of_them: Preset) -> tuple[Entry, ...]:
    folder = presets.users_folder()
    return tuple(Entry(path=folder / f"{k}", preset=preset) for k, preset in enumerate(all_of_them))


def test_every_word_must_be_found_and_names_come_first():
    entries = entries_of(
        named("Heartbeat", "tap", description="Two thuds."),
        named("Double TAP", "signal"),
        named("Noise", source="Tap, 1968"),
        named("Tone"),
    )

    def names_of_matches(text, tag=""):
        return [entry.preset.name for entry in presets.matching(entries, text, tag)]

    assert names_of_matches("") == ["Heartbeat", "Double TAP", "Noise", "Tone"]
    assert names_of_matches("tap") == ["Double TAP", "Heartbeat", "Noise"]
    assert names_of_matches("Tap SIGNAL") == ["Double TAP"]
    assert names_of_matches("tap thuds") == ["Heartbeat"]
    assert names_of_matches("tap", "signal") == ["Double TAP"]
    assert names_of_matches("", "tap") == ["Heartbeat"]
    assert names_of_matches("absent") == []


@settings(max_examples=40)
@given(tags=st.lists(recipes, max_size=4), query=text, more=text)
def test_another_word_never_finds_more(tags, query, more):
    entries = entries_of(*tags)
    matches = presets.matching(entries, query)
    assert set(map(id, presets.matching(entries, f"{query} {more}"))) <= set(map(id, matches))
    assert len(presets.matching(entries, "")) == len(entries)
    for entry in entries:
        assert entry in presets.matching(entries, entry.preset.name)


@given(typed=st.text(max_size=40))
def test_typed_tags_are_a_presets_tags(typed):
    tags = presets.tags_of(typed)
    assert presets.tags_of(", ".join(tags)) == tags
    assert all(tag and tag.strip() == tag and "," not in tag for tag in tags)


def levels(design: Design) -> np.ndarray:
    return ss.evaluate(design, "output_levels_db")["output_levels_db"]


TRACKS = Design(
    limb="synthetic-1",
    scaling="relative",
    inputs=(
        Input(
            location=7,
            amplitude=0.5,
            gain_curve=((0.1, 0.2), (0.25, 1.5), (0.25, 0.4), (0.6, 0.9)),
            clips=(
                Clip(waveform=Tone(80.0), onset_s=0.2),
                Clip(waveform=Noise(2), onset_s=0.05, effects=(Reverse(),)),
                Clip(waveform=Tap(), onset_s=0.0, muted=True),
            ),
        ),
        track(2, Tone(150.0), muted=True, amplitude=3.0),
        Input(location=9),
        track(12, Tone(220.0), onset_s=0.1, amplitude=-0.3),
    ),
)


@pytest.mark.parametrize("solo", [None, 0, 3])
def test_a_whole_design_that_is_placed_again_is_felt_the_same(solo):
    design = TRACKS if solo is None else TRACKS.with_input(solo, solo=True)
    fragment = presets.whole_design(design)
    empty = Design(limb="synthetic-1", scaling="relative")
    placed = ss.edits.place_fragment(empty, View(), fragment, "All", 0.0).design
    assert levels(placed) == pytest.approx(levels(design), abs=1e-9)


def test_a_design_without_clips_makes_no_preset():
    assert presets.whole_design(Design(limb="synthetic-1", inputs=(Input(location=3),))) is None


def test_what_a_preset_plays_is_the_sum_of_its_clips():
    clip = Clip(waveform=Tone(100.0, duration_s=0.1), onset_s=0.1, gain=0.5)
    late = Clip(waveform=Tap(), onset_s=0.15, gain=2.0)
    fragment = Fragment(
        lanes=(
            Lane(location=1, amplitude=-2.0, clips=(clip, replace(clip, muted=True))),
            Lane(location=2, clips=(late,), offset=1),
        )
    )
    expected = np.zeros(260)
    expected[130:260] -= Tone(100.0, duration_s=0.1).samples(1300.0)
    expected[195:216] += 2.0 * Tap().samples(1300.0)
    assert presets.mixed(fragment, 1300.0) == pytest.approx(expected, abs=1e-12)


def test_what_is_too_long_for_a_picture_says_so():
    long = Fragment(lanes=(Lane(location=1, clips=(Clip(onset_s=60.0),)),))
    with pytest.raises(InvalidInputError, match="too long"):
        presets.mixed(long, 1300.0)
