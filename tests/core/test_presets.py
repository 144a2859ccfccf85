"""Presets, those that are shipped too: texts and files, searching, making, and what they play."""

import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import skinsource as ss
from skinsource import Design, Input, View, track
from skinsource.base.conventions import BAND_HZ
from skinsource.base.errors import FileFormatError, InvalidInputError, StorageError
from skinsource.design.clips import MAX_EFFECTS, Clip, Fragment, Lane
from skinsource.design.effects import Reverse, SoftClip, Trim
from skinsource.design.presets import presets
from skinsource.design.presets.presets import Entry, Preset, PresetFolder
from skinsource.design.waveforms import Drawn, Noise, Tap, Tone
from skinsource.signals.spectra import share_outside_band
from tests.core.design_files.any_recipe import recipes

TONE = Fragment(lanes=(Lane(location=3, clips=(Clip(waveform=Tone()),)),))
text = st.text(st.characters(exclude_categories=("Cs", "Cc", "Zl", "Zp")), max_size=30)
slow = [HealthCheck.too_slow, HealthCheck.filter_too_much]


def named(name: str, *tags: str, **more) -> Preset:
    return Preset(name=name, tags=tags, fragment=TONE, **more)


def names_in(folder) -> list[str]:
    return [entry.preset.name for entry in presets.read_preset_folder(folder).entries]


@settings(max_examples=25, suppress_health_check=slow)
@given(preset=recipes(Preset))
def test_a_preset_comes_back_from_its_text_and_file_bit_by_bit(tmp_path_factory, preset):
    text = presets.preset_text(preset)
    assert presets.preset_from(text) == preset
    assert presets.preset_text(presets.preset_from(text)) == text
    folder = tmp_path_factory.mktemp("shelf") / "not" / "there yet"
    entry = Entry(path=presets.save_preset(folder, preset), preset=preset)
    assert presets.read_preset_folder(folder) == PresetFolder(entries=(entry,))


@pytest.mark.parametrize("name", ["", "  ", "two\nlines", "x" * 101, None])
def test_a_preset_has_a_name_of_one_line(name):
    with pytest.raises(InvalidInputError, match="name"):
        named(name)


@settings(max_examples=20)
@given(name=text.filter(str.strip) | st.sampled_from(["CON", "…"]))
def test_files_are_called_so_that_every_system_can_have_them(tmp_path_factory, name):
    folder = tmp_path_factory.mktemp("shelf")
    first, other = (presets.save_preset(folder, named(name)) for _ in range(2))
    assert first != other
    for path in (first, other):
        assert re.fullmatch(r"[a-z0-9-]{1,66}\.skinpreset", path.name)
        assert path.name.split(".")[0] not in ("con", "nul", "aux", "prn", "com1")


@pytest.mark.parametrize(
    "content", [b"", b"\xff\xfe", b"[" * 5000, b'{"format": "skinsource clips"}', None]
)
def test_what_is_no_preset_is_named_and_left_out_and_the_others_are_there(tmp_path, content):
    presets.save_preset(tmp_path, named("Tap"))
    wrong = tmp_path / "wrong.skinpreset"
    if content is None:
        wrong.mkdir()
        refused = StorageError
    else:
        wrong.write_bytes(content)
        refused = FileFormatError
    shelf = presets.read_preset_folder(tmp_path)
    assert [entry.preset.name for entry in shelf.entries] == ["Tap"]
    assert [fault.path.name for fault in shelf.faults] == ["wrong.skinpreset"]
    assert "wrong.skinpreset: " in shelf.faults[0].sentence
    with pytest.raises(refused):
        presets.read_preset(wrong)


def test_other_files_are_nobodys_business(tmp_path):
    (tmp_path / "notes.txt").write_text("hello")
    (tmp_path / ".half.skinpreset").write_text("{")
    for folder in (tmp_path, tmp_path / "absent", tmp_path / "notes.txt"):
        assert presets.read_preset_folder(folder) == PresetFolder()


def test_more_files_than_one_reads_are_said(tmp_path, monkeypatch):
    monkeypatch.setattr("skinsource.design.presets.presets.MOST_FILES", 2)
    for name in "abc":
        presets.save_preset(tmp_path, named(name))
    shelf = presets.read_preset_folder(tmp_path)
    assert len(shelf.entries) == 2
    assert "holds 3 presets, the first 2" in shelf.faults[0].sentence


def test_numbers_in_names_count(tmp_path):
    for name in ("Tone 100 Hz", "Tone 50 Hz", "7", "tap", "Ramp"):
        presets.save_preset(tmp_path, named(name))
    assert names_in(tmp_path) == ["7", "Ramp", "tap", "Tone 50 Hz", "Tone 100 Hz"]


def test_a_preset_is_renamed_with_its_file_keeps_the_rest_and_is_deleted(tmp_path):
    before = named("Tap", "short", source="us", description="words")
    old = presets.save_preset(tmp_path, before)
    new = presets.rename_preset(tmp_path, old, "  Double   tap ")
    assert new.name == "double-tap.skinpreset"
    assert presets.read_preset(new) == replace(before, name="Double tap")
    assert presets.rename_preset(tmp_path, new, "Double tap") == new
    with pytest.raises(InvalidInputError):
        presets.rename_preset(tmp_path, new, " ")
    assert names_in(tmp_path) == ["Double tap"]
    for _ in range(2):  # the second time it is gone
        presets.delete_preset(tmp_path, new)
        assert names_in(tmp_path) == []


def test_only_presets_of_the_folder_are_renamed_and_deleted(tmp_path):
    shipped = presets.save_preset(tmp_path / "elsewhere", named("Tap"))
    other = tmp_path / "notes.txt"
    other.write_text("mine")
    for path in (shipped, other):
        with pytest.raises(InvalidInputError, match="one of your own"):
            presets.delete_preset(tmp_path, path)
        with pytest.raises(InvalidInputError, match="one of your own"):
            presets.rename_preset(tmp_path, path, "Mine")
        assert path.exists()


def test_what_could_not_be_read_again_or_has_no_folder_is_not_written(tmp_path):
    clips = (Clip(waveform=Drawn(np.ones(900_000) / 3)),)
    long = Fragment(lanes=(Lane(location=1, clips=clips),))
    with pytest.raises(InvalidInputError, match="too many"):
        presets.save_preset(tmp_path, Preset(name="Long", fragment=long))
    assert list(tmp_path.iterdir()) == []
    (tmp_path / "presets").write_text("in the way")
    with pytest.raises(StorageError, match="cannot be written"):
        presets.save_preset(tmp_path / "presets", named("Tap"))


def entries_of(*all_of_them: Preset) -> tuple[Entry, ...]:
    folder = presets.users_folder()
    return tuple(Entry(path=folder / f"{k}", preset=preset) for k, preset in enumerate(all_of_them))


@pytest.mark.parametrize(
    ("query", "tag", "expected"),
    [
        ("", "", ["Heartbeat", "Double TAP", "Noise", "Tone"]),
        ("tap", "", ["Double TAP", "Heartbeat", "Noise"]),
        ("Tap SIGNAL", "", ["Double TAP"]),
        ("tap thuds", "", ["Heartbeat"]),
        ("tap", "signal", ["Double TAP"]),
        ("", "tap", ["Heartbeat"]),
        ("absent", "", []),
    ],
)
def test_every_word_must_be_found_and_names_come_first(query, tag, expected):
    entries = entries_of(
        named("Heartbeat", "tap", description="Two thuds."),
        named("Double TAP", "signal"),
        named("Noise", source="Tap, 1968"),
        named("Tone"),
    )
    matches = presets.matching(entries, query, tag)
    assert [entry.preset.name for entry in matches] == expected


@given(typed=st.text(max_size=40))
def test_typed_tags_are_a_presets_tags(typed):
    tags = presets.tags_of(typed)
    assert presets.tags_of(", ".join(tags)) == tags
    assert all(tag and tag.strip() == tag and "," not in tag for tag in tags)


def levels(design: Design) -> np.ndarray:
    return ss.evaluate(design, "output_levels_db")["output_levels_db"]


def chained(count: int) -> Clip:
    """A clip of so many effects, as in a chain that is full or almost."""
    effects = (*(SoftClip(drive=1.1, level=2.0),) * (count - 1), Trim(0.0, 0.25))
    return Clip(waveform=Tone(97.0, duration_s=0.3), onset_s=0.0337, gain=-0.7, effects=effects)


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
        Input(
            location=9,
            gain_curve=((0.05, 0.2), (0.3, 1.0)),
            clips=(chained(MAX_EFFECTS - 1), chained(MAX_EFFECTS)),
        ),
        track(12, Tone(220.0), onset_s=0.1, amplitude=-0.3),
    ),
)


@pytest.mark.parametrize("solo", [None, 0, 2])
def test_a_whole_design_that_is_placed_again_is_felt_the_same(solo):
    design = TRACKS if solo is None else TRACKS.with_input(solo, solo=True)
    fragment = presets.whole_design(design)
    empty = Design(limb="synthetic-1", scaling="relative")
    placed = ss.edits.place_fragment(empty, View(), fragment, "All", 0.0).design
    assert levels(placed) == pytest.approx(levels(design), abs=1e-9)
    without_clips = Design(limb="synthetic-1", inputs=(Input(location=3),))
    assert presets.whole_design(without_clips) is None


def test_clips_of_several_places_are_placed_there_whatever_track_is_selected():
    design = Design(limb="synthetic-1", inputs=(track(8), track(20)))
    lanes = tuple(Lane(location=at, clips=(Clip(waveform=Tap()),), offset=at - 2) for at in (2, 3))
    view = View(selected_inputs=(design.ids[0],))
    placed = ss.edits.place_fragment(design, view, Fragment(lanes=lanes), "Stroke").design
    assert [(each.location, len(each.clips)) for each in placed.inputs] == [
        (8, 1),
        (20, 1),
        (2, 1),
        (3, 1),
    ]


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
    long = Fragment(lanes=(Lane(location=1, clips=(Clip(onset_s=60.0),)),))
    with pytest.raises(InvalidInputError, match="too long"):
        presets.mixed(long, 1300.0)


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
