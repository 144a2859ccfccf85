"""Presets: round trips, files, folders, searching, and making them of designs."""

import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import skinsource as ss
from skinsource import presets
from skinsource.clips import Clip, Fragment, Lane
from skinsource.design import Design, Input, track
from skinsource.effects import Fade, Reverse
from skinsource.errors import (
    FileFormatError,
    InvalidInputError,
    SkinSourceError,
    StorageError,
)
from skinsource.presets import Entry, Preset, Shelf
from skinsource.view import View
from skinsource.waveforms import Drawn, Noise, Tap, Tone

TONE = Fragment(lanes=(Lane(location=3, clips=(Clip(waveform=Tone()),)),))
text = st.text(st.characters(exclude_categories=("Cs", "Cc", "Zl", "Zp")), max_size=30)
names = text.filter(str.strip)
waveforms = st.sampled_from(
    [Tone(), Tap(), Noise(3), Drawn((0.0, 0.3, -0.7)), Tone(61.25, duration_s=0.03)]
)
clips = st.builds(
    Clip,
    onset_s=st.floats(0.0, 2.0),
    gain=st.floats(-2.0, 2.0),
    waveform=waveforms,
    effects=st.sampled_from([(), (Fade(),), (Reverse(), Fade(0.01, 0.0))]),
    muted=st.booleans(),
    label=text,
)
lanes = st.builds(
    Lane,
    location=st.integers(1, 20),
    amplitude=st.floats(-5.0, 5.0),
    offset=st.integers(0, 3),
    clips=st.lists(clips, min_size=1, max_size=3).map(tuple),
)
recipes = st.builds(
    Preset,
    name=names,
    tags=st.lists(text, max_size=3, unique=True).map(tuple),
    source=text,
    description=text,
    fragment=st.builds(Fragment, lanes=st.lists(lanes, min_size=1, max_size=3).map(tuple)),
)


def named(name, *tags, **more) -> Preset:
    return Preset(name=name, tags=tags, fragment=TONE, **more)


def names_on(folder) -> list[str]:
    return [entry.preset.name for entry in presets.read_shelf(folder).entries]


@settings(max_examples=40)
@given(preset=recipes)
def test_a_preset_comes_back_from_its_text_bit_by_bit(preset):
    words = presets.preset_text(preset)
    assert presets.preset_from(words) == preset
    assert presets.preset_text(presets.preset_from(words)) == words


@settings(max_examples=15)
@given(recipe=recipes)
def test_a_preset_comes_back_from_its_file(tmp_path_factory, recipe):
    folder = tmp_path_factory.mktemp("shelf") / "not" / "there yet"
    path = presets.save_preset(folder, recipe)
    assert presets.read_shelf(folder) == Shelf(entries=(Entry(path=path, preset=recipe),))


@settings(max_examples=20)
@given(name=names)
def test_files_are_called_so_that_every_system_can_have_them(tmp_path_factory, name):
    folder = tmp_path_factory.mktemp("shelf")
    one, other = (presets.save_preset(folder, named(name)) for _ in range(2))
    assert one != other
    for path in (one, other):
        assert re.fullmatch(r"[a-z0-9-]{1,66}\.skinpreset", path.name)
        assert path.name.split(".")[0] not in ("con", "nul", "aux", "prn", "com1")


def test_a_name_that_windows_keeps_for_itself_is_no_name_of_a_file(tmp_path):
    assert presets.save_preset(tmp_path, named("CON")).name == "preset-con.skinpreset"
    assert presets.save_preset(tmp_path, named("…")).name == "preset.skinpreset"


@pytest.mark.parametrize("name", ["", "  ", "two\nlines", "x" * 101, None])
def test_a_preset_has_a_name_of_one_line(name):
    with pytest.raises(InvalidInputError, match="name"):
        named(name)


def test_any_changed_byte_is_found(tmp_path):
    path = presets.save_preset(tmp_path, named("Tap", "short"))
    whole = path.read_bytes()
    for k in range(0, len(whole) - 1, 23):
        path.write_bytes(whole[:k] + bytes([whole[k] ^ 1]) + whole[k + 1 :])
        shelf = presets.read_shelf(tmp_path)
        assert shelf.entries == ()
        assert path.name in shelf.faults[0].sentence


@pytest.mark.parametrize(
    "content", [b"", b"{}", b"\xff\xfe", b"[" * 5000, b'{"format": "skinsource clips"}']
)
def test_what_is_no_preset_is_named_and_left_out_and_the_others_are_there(tmp_path, content):
    presets.save_preset(tmp_path, named("Tap"))
    (tmp_path / "wrong.skinpreset").write_bytes(content)
    shelf = presets.read_shelf(tmp_path)
    assert [entry.preset.name for entry in shelf.entries] == ["Tap"]
    assert [fault.path.name for fault in shelf.faults] == ["wrong.skinpreset"]
    assert shelf.faults[0].sentence.startswith("wrong.skinpreset: ")


def test_a_folder_in_place_of_a_file_is_named_and_left_out(tmp_path):
    (tmp_path / "folder.skinpreset").mkdir()
    shelf = presets.read_shelf(tmp_path)
    assert "folder.skinpreset" in shelf.faults[0].sentence


def test_other_files_are_nobodys_business(tmp_path):
    (tmp_path / "notes.txt").write_text("hello")
    (tmp_path / ".half.skinpreset").write_text("{")
    assert presets.read_shelf(tmp_path) == Shelf()
    assert presets.read_shelf(tmp_path / "absent") == Shelf()
    assert presets.read_shelf(tmp_path / "notes.txt") == Shelf()


def test_more_files_than_one_reads_are_said(tmp_path, monkeypatch):
    monkeypatch.setattr("skinsource.presets.shelf.MOST_FILES", 2)
    for name in "abc":
        presets.save_preset(tmp_path, named(name))
    shelf = presets.read_shelf(tmp_path)
    assert len(shelf.entries) == 2
    assert "holds 3 presets, the first 2" in shelf.faults[0].sentence


def test_numbers_in_names_count(tmp_path):
    for name in ("Tone 100 Hz", "Tone 50 Hz", "7", "tap", "Ramp"):
        presets.save_preset(tmp_path, named(name))
    assert names_on(tmp_path) == ["7", "Ramp", "tap", "Tone 50 Hz", "Tone 100 Hz"]


def test_a_preset_is_renamed_with_its_file_and_keeps_the_rest(tmp_path):
    before = named("Tap", "short", source="us", description="words")
    old = presets.save_preset(tmp_path, before)
    new = presets.rename_preset(tmp_path, old, "  Double   tap ")
    assert new.name == "double-tap.skinpreset"
    assert not old.exists()
    assert presets.read_preset(new) == replace(before, name="Double tap")
    assert presets.rename_preset(tmp_path, new, "Double tap") == new
    assert names_on(tmp_path) == ["Double tap"]


def test_a_preset_without_a_name_stays_as_it_was(tmp_path):
    path = presets.save_preset(tmp_path, named("Tap"))
    with pytest.raises(InvalidInputError):
        presets.rename_preset(tmp_path, path, " ")
    assert names_on(tmp_path) == ["Tap"]


def test_only_presets_of_the_folder_are_renamed_and_deleted(tmp_path):
    shipped = presets.save_preset(tmp_path / "elsewhere", named("Tap"))
    other = tmp_path / "notes.txt"
    other.write_text("mine")
    for path in (shipped, other):
        for act in (
            lambda path: presets.delete_preset(tmp_path, path),
            lambda path: presets.rename_preset(tmp_path, path, "Mine"),
        ):
            with pytest.raises(InvalidInputError, match="only your own"):
                act(path)
        assert path.exists()


def test_deleting_what_is_gone_is_no_fault(tmp_path):
    path = presets.save_preset(tmp_path, named("Tap"))
    presets.delete_preset(tmp_path, path)
    presets.delete_preset(tmp_path, path)
    assert names_on(tmp_path) == []


def test_a_file_in_place_of_the_folder_says_so(tmp_path):
    (tmp_path / "presets").write_text("in the way")
    with pytest.raises(StorageError, match="cannot be written"):
        presets.save_preset(tmp_path / "presets", named("Tap"))


def test_what_could_not_be_read_again_is_not_written(tmp_path):
    long = Fragment(lanes=(Lane(location=1, clips=(Clip(waveform=Drawn(np.ones(900_000) / 3)),)),))
    with pytest.raises(InvalidInputError, match="too many"):
        presets.save_preset(tmp_path, Preset(name="Long", fragment=long))
    assert list(tmp_path.iterdir()) == []


def entries_of(*all_of_them: Preset) -> tuple[Entry, ...]:
    folder = presets.users_folder()
    return tuple(Entry(path=folder / f"{k}", preset=one) for k, one in enumerate(all_of_them))


def test_every_word_must_be_found_and_names_come_first():
    entries = entries_of(
        named("Heartbeat", "tap", description="Two thuds."),
        named("Double TAP", "signal"),
        named("Noise", source="Tap, 1968"),
        named("Tone"),
    )

    def found(words, tag=""):
        return [one.preset.name for one in presets.matching(entries, words, tag)]

    assert found("") == ["Heartbeat", "Double TAP", "Noise", "Tone"]
    assert found("tap") == ["Double TAP", "Heartbeat", "Noise"]
    assert found("Tap SIGNAL") == ["Double TAP"]
    assert found("tap thuds") == ["Heartbeat"]
    assert found("tap", "signal") == ["Double TAP"]
    assert found("", "tap") == ["Heartbeat"]
    assert found("absent") == []


@settings(max_examples=40)
@given(kept=st.lists(recipes, max_size=4), words=text, more=text)
def test_another_word_never_finds_more(kept, words, more):
    entries = entries_of(*kept)
    found = presets.matching(entries, words)
    assert set(map(id, presets.matching(entries, f"{words} {more}"))) <= set(map(id, found))
    assert len(presets.matching(entries, "")) == len(entries)
    for entry in entries:
        assert entry in presets.matching(entries, entry.preset.name)


@given(words=st.text(max_size=40))
def test_typed_tags_are_a_presets_tags(words):
    tags = presets.tags_of(words)
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
    one = Clip(waveform=Tone(100.0, duration_s=0.1), onset_s=0.1, gain=0.5)
    late = Clip(waveform=Tap(), onset_s=0.15, gain=2.0)
    fragment = Fragment(
        lanes=(
            Lane(location=1, amplitude=-2.0, clips=(one, replace(one, muted=True))),
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


def test_files_of_other_things_raise_what_the_library_raises(tmp_path):
    with pytest.raises(StorageError):
        presets.read_preset(tmp_path / "absent.skinpreset")
    (tmp_path / "a.skinpreset").write_text("hello")
    with pytest.raises(FileFormatError, match=r"a\.skinpreset"):
        presets.read_preset(tmp_path / "a.skinpreset")
    assert issubclass(FileFormatError, SkinSourceError)
