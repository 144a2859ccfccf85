"""Shows: designs in their order in one file, of which one bad entry is one bad entry."""

from dataclasses import replace

import pytest

import skinsource as ss
from skinsource.base.errors import DesignFileError
from skinsource.design.design import Snapshot
from skinsource.design.panel_settings import stage_settings


@pytest.fixture
def entries():
    tone = ss.waveforms.Tone(frequency_hz=100.0)
    return tuple(
        ss.ShowEntry(
            design=ss.Design(limb="synthetic-1", inputs=(ss.track(place, tone),)),
            view=ss.View(outputs=(place,)),
            title=f"Place {place}",
            sentence=f"It is felt at {place}.",
            knob="amplitude",
            notes="Wait.\nThen turn.",
        )
        for place in (7, 8, 9)
    )


def test_a_show_is_read_as_it_was_written_and_the_same_show_gives_the_same_bytes(entries, tmp_path):
    first, second = tmp_path / "a.skinshow", tmp_path / "b.skinshow"
    ss.save_show(first, entries)
    ss.save_show(second, ss.open_show(first))
    assert ss.open_show(second) == entries
    assert first.read_bytes() == second.read_bytes()


@pytest.mark.parametrize("title", ["Four people", "Fig. 1G: Four people · Limb 1", "Us"])
def test_designs_that_are_compared_keep_what_tells_them_apart(title):
    opened = ss.scenes.open_scene("1G", available=tuple(f"synthetic-{k}" for k in range(1, 5)))
    entry = replace(ss.ShowEntry.of(opened.design, opened.view, title), notes="Mine.")
    design, view = entry.presented
    titles = [each.design.title for each in sorted(view.snapshots, key=lambda each: each.number)]
    words = title.removesuffix(" · Limb 1")
    assert titles == [f"{words} · Limb {k}" for k in range(1, 5)]
    # It is one of them still, also with what the speaker reads.
    assert design in [each.design for each in view.snapshots]
    assert design.title == titles[0]
    assert design.notes.endswith("Mine.")


def test_a_title_of_the_entry_is_that_of_all_that_are_compared_where_all_had_one():
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(7),))
    stored = tuple(
        Snapshot(number=k, design=replace(design, scaling=how))
        for k, how in enumerate(("probe", "relative"), 1)
    )
    entry = ss.ShowEntry.of(stored[1].design, ss.View(snapshots=stored), "Two tips")
    assert [each.design.title for each in entry.presented[1].snapshots] == ["Two tips"] * 2


def test_samples_of_recordings_are_kept(tmp_path):
    recording = ss.waveforms.Drawn()
    design = ss.Design(limb="synthetic-1", inputs=(ss.track(7, recording),))
    ss.save_show(tmp_path / "a.skinshow", [ss.ShowEntry(design=design)])
    (entry,) = ss.open_show(tmp_path / "a.skinshow")
    assert entry.design == design


@pytest.mark.parametrize("bad", [0, 1, 2])
def test_damage_of_one_entry_leaves_the_others_and_is_kept(entries, tmp_path, bad):
    path = tmp_path / "a.skinshow"
    ss.save_show(path, entries)
    content = bytearray(path.read_bytes())
    content[(2 * bad + 1) * len(content) // 6] ^= 0x10
    path.write_bytes(content)
    read = ss.open_show(path)
    assert [isinstance(entry, ss.UnreadEntry) for entry in read] == [k == bad for k in range(3)]
    assert "damaged" in read[bad].problem
    assert [entry for k, entry in enumerate(read) if k != bad] == [
        entry for k, entry in enumerate(entries) if k != bad
    ]
    ss.save_show(path, read)
    assert ss.open_show(path) == read


@pytest.mark.parametrize("content", [b"", b"PK", b"SkinSource design, version 3\n" * 40])
def test_what_is_no_show_is_refused(tmp_path, content):
    path = tmp_path / "a.skinshow"
    path.write_bytes(content)
    with pytest.raises(DesignFileError, match="not a SkinSource show"):
        ss.open_show(path)


def test_what_is_presented_has_the_words_and_the_knob_of_the_entry(entries):
    design, view = entries[0].presented
    assert design.title == "Place 7"
    assert design.notes == "It is felt at 7.\nWait.\nThen turn."
    assert stage_settings(view).control == "amplitude"
    assert replace(design, title="", notes="") == entries[0].design
    # And back.
    assert ss.ShowEntry.of(design, view) == replace(entries[0], design=design, view=view)
