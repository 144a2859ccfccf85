"""Presets as files: what a folder of them holds, and how they are named, renamed and deleted."""

import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings

from skinsource.base.errors import FileFormatError, InvalidInputError, SkinSourceError, StorageError
from skinsource.design.clips import Clip, Fragment, Lane
from skinsource.design.presets import presets
from skinsource.design.presets.presets import Entry, Preset, PresetFolder
from skinsource.design.waveforms.samples import Drawn
from tests.core.presets_bench import named, names, recipes


def names_on(folder) -> list[str]:
    return [entry.preset.name for entry in presets.read_preset_folder(folder).entries]


@settings(max_examples=15)
@given(recipe=recipes)
def test_a_preset_comes_back_from_its_file(tmp_path_factory, recipe):
    folder = tmp_path_factory.mktemp("shelf") / "not" / "there yet"
    path = presets.save_preset(folder, recipe)
    assert presets.read_preset_folder(folder) == PresetFolder(
        entries=(Entry(path=path, preset=recipe),)
    )


@settings(max_examples=20)
@given(name=names)
def test_files_are_called_so_that_every_system_can_have_them(tmp_path_factory, name):
    folder = tmp_path_factory.mktemp("shelf")
    first, other = (presets.save_preset(folder, named(name)) for _ in range(2))
    assert first != other
    for path in (first, other):
        assert re.fullmatch(r"[a-z0-9-]{1,66}\.skinpreset", path.name)
        assert path.name.split(".")[0] not in ("con", "nul", "aux", "prn", "com1")


def test_a_name_that_windows_keeps_for_itself_is_no_name_of_a_file(tmp_path):
    assert presets.save_preset(tmp_path, named("CON")).name == "preset-con.skinpreset"
    assert presets.save_preset(tmp_path, named("…")).name == "preset.skinpreset"


def test_any_changed_byte_is_found(tmp_path):
    path = presets.save_preset(tmp_path, named("Tap", "short"))
    whole = path.read_bytes()
    for k in range(0, len(whole) - 1, 23):
        path.write_bytes(whole[:k] + bytes([whole[k] ^ 1]) + whole[k + 1 :])
        shelf = presets.read_preset_folder(tmp_path)
        assert shelf.entries == ()
        assert path.name in shelf.faults[0].sentence


@pytest.mark.parametrize(
    "content", [b"", b"{}", b"\xff\xfe", b"[" * 5000, b'{"format": "skinsource clips"}']
)
def test_what_is_no_preset_is_named_and_left_out_and_the_others_are_there(tmp_path, content):
    presets.save_preset(tmp_path, named("Tap"))
    (tmp_path / "wrong.skinpreset").write_bytes(content)
    shelf = presets.read_preset_folder(tmp_path)
    assert [entry.preset.name for entry in shelf.entries] == ["Tap"]
    assert [fault.path.name for fault in shelf.faults] == ["wrong.skinpreset"]
    assert shelf.faults[0].sentence.startswith("wrong.skinpreset: ")


def test_a_folder_in_place_of_a_file_is_named_and_left_out(tmp_path):
    (tmp_path / "folder.skinpreset").mkdir()
    shelf = presets.read_preset_folder(tmp_path)
    assert "folder.skinpreset" in shelf.faults[0].sentence


def test_other_files_are_nobodys_business(tmp_path):
    (tmp_path / "notes.txt").write_text("hello")
    (tmp_path / ".half.skinpreset").write_text("{")
    assert presets.read_preset_folder(tmp_path) == PresetFolder()
    assert presets.read_preset_folder(tmp_path / "absent") == PresetFolder()
    assert presets.read_preset_folder(tmp_path / "notes.txt") == PresetFolder()


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


def test_files_of_other_things_raise_what_the_library_raises(tmp_path):
    with pytest.raises(StorageError):
        presets.read_preset(tmp_path / "absent.skinpreset")
    (tmp_path / "a.skinpreset").write_text("hello")
    with pytest.raises(FileFormatError, match=r"a\.skinpreset"):
        presets.read_preset(tmp_path / "a.skinpreset")
    assert issubclass(FileFormatError, SkinSourceError)
