"""The shipped scenes: texts, titles and designs, opened on the limbs that there are."""

import re
from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.conventions import LIMB_NAMES
from skinsource.base.errors import InvalidInputError
from skinsource.cli.command_line import main
from skinsource.design.design import shown_snapshot
from skinsource.design.design_file import open_design
from skinsource.design.panel_settings import stage_settings
from skinsource.studies.scenes.scenes import FINDINGS, _delay_and_loss, path_of, title_of
from tests.core.own_limbs.lab_bench import installed

MEASURED = tuple(name for name in LIMB_NAMES if name.startswith("measured"))
NAMES = ss.scenes.names()
every = pytest.mark.parametrize("name", NAMES)


def test_each_design_file_has_a_description():
    stored = {path.stem for path in ss.scenes.scenes_folder().glob("*.skinsource")}
    assert stored == set(NAMES)
    assert len(set(ss.scenes.all_scenes())) == len(NAMES)


def levels_of(opened):
    name = "output_levels_db"
    return [ss.evaluate(each.design, name, view=opened.view)[name] for each in opened.conditions]


@every
def test_each_says_what_it_is_where_it_is_from_and_what_is_inferred(name):
    known, content = ss.scenes.scene(name), open_design(path_of(name))
    assert known.sentence.endswith(".")
    assert len(known.title) <= 40
    assert content.design.notes == known.notes
    turned = stage_settings(content.view).control
    assert turned in {"frequency", "amplitude"}
    assert known.to_try.startswith("Try: ")
    # L shows motion where levels are shown.
    assert stage_settings(content.view).moves or "levels" not in known.to_try
    if turned == "frequency":
        (selected,) = content.view.selected_inputs
        assert hasattr(content.design.input(selected).clips[0].waveform, "frequency_hz")


@every
def test_each_opens_on_the_limbs_of_the_paper_where_they_are(name):
    known, opened = ss.scenes.scene(name), ss.scenes.open_scene(name, available=MEASURED)
    assert opened.note == ""
    assert not opened.synthetic
    assert all(condition.design.limb in MEASURED for condition in opened.conditions)
    assert opened.design in [condition.design for condition in opened.conditions]
    for condition in opened.conditions:
        label = f" · {condition.label}" if condition.label else ""
        assert condition.design.title == known.full_title + label
    # The window shows one of the designs that are compared, and the others as snapshots.
    extra = 1 if shown_snapshot(opened.view.snapshots, opened.design) is None else 0
    assert len(opened.view.snapshots) + extra == len(opened.conditions)


@every
def test_each_opens_on_the_synthetic_limb_of_its_number_elsewhere_and_moves_what_it_shows(name):
    opened = ss.scenes.open_scene(name, available=("synthetic-1",))
    there = ss.scenes.open_scene(name, available=MEASURED)
    assert "SYNTHETIC" in opened.note
    sides = zip(opened.conditions, there.conditions, levels_of(opened), strict=True)
    for here, condition, own_db in sides:
        assert here.label == condition.label
        assert here.design.limb == condition.design.limb.replace("measured", "synthetic")
        assert here.design.inputs == condition.design.inputs or not opened.scene.of_paper
        assert own_db[[output - 1 for output in opened.view.outputs]].max() > -60.0


def test_what_is_compared_differs_in_what_its_labels_say():
    def values(name, of):
        opened = ss.scenes.open_scene(name, available=MEASURED)
        return [of(condition.design) for condition in opened.conditions]

    places = values("2F", lambda design: [track.location for track in design.inputs])
    assert places == [[8], [13], [8, 13]]
    assert values("1G", lambda design: design.limb) == list(MEASURED)
    tones = values("2B", lambda design: design.clips[0].waveform.frequency_hz)
    assert tones == [50.0, 100.0, 200.0, 400.0]


def test_what_travels_is_shown_as_it_moves_and_slowed_down():
    views = {name: open_design(path_of(name)).view for name in NAMES}
    slow = {name for name, view in views.items() if view.slow_motion > 1.0}
    moving = {
        name
        for name, view in views.items()
        if ("quantity", "z") in dict(view.panels).get("skin", ())
    }
    assert slow == moving == {"1C", "2A", "4A"}
    # The time before the pulse is left out.
    assert all(view.delay_removed for view in views.values())
    for name in slow:
        first_s, last_s = views[name].time_range_s
        assert first_s < views[name].playhead_s < last_s
        # Seconds of the lecture.
        assert 3.0 < views[name].slow_motion * (last_s - first_s) < 15.0


def test_names_may_be_written_small_and_others_are_refused(capsys):
    assert ss.scenes.scene("2f").name == "2F"
    for other in ("2G", "", None, "../2F"):
        with pytest.raises(InvalidInputError, match="does not exist; choose one of 1C, 1D"):
            ss.scenes.open_scene(other)
    with pytest.raises(SystemExit):
        main(["scenes", "--out", "x.skinsource"])


def test_the_command_lists_scenes_and_writes_one_as_a_design(tmp_path, capsys):
    assert main(["scenes"]) == 0
    listed = capsys.readouterr().out
    assert all(f"{name} " in listed for name in NAMES)
    path = tmp_path / "own.skinsource"
    assert main(["scenes", "2b", "--out", str(path)]) == 0
    printed = capsys.readouterr().out
    assert "2B · Low frequencies reach farther" in printed
    assert "SYNTHETIC" in printed
    opened, written = ss.scenes.open_scene("2B"), open_design(path)
    assert (written.design, written.view) == (opened.design, opened.view)


def test_the_missing_panels_of_the_paper_are_listed_with_the_reason():
    missing = dict(ss.scenes.missing_panels())
    assert {"1A", "1B", "2G", "3", "4C", "4D", "4E", "5A", "5C"} == missing.keys()
    assert all(reason.endswith(".") for reason in missing.values())
    assert not missing.keys() & set(NAMES)


def test_the_numbers_of_a_sentence_are_those_of_the_limb_that_is_open():
    opened = ss.scenes.open_scene("2F", available=("synthetic-3",))
    levels = [each[18] for each in levels_of(opened)]
    gain_db = levels[2] - max(levels[:2])
    words = f"{abs(gain_db):.0f} dB {'louder' if gain_db > 0 else 'softer'} at output 19"
    assert words in opened.design.notes
    assert opened.design in [each.design for each in opened.conditions]
    other = ss.scenes.open_scene("2F", limb="synthetic-1")
    assert other.scene.sentence != opened.scene.sentence


def test_a_sentence_on_travel_tells_the_group_delay_and_not_where_a_tone_is_largest():
    times_s = np.arange(2000) / 1e4
    tone = np.sin(2 * np.pi * 200.0 * times_s) * (times_s < 0.1)
    # The later one comes after 8 ms, and goes on growing.
    traces = np.stack([tone, np.roll(tone * (0.5 + 0.1 * times_s), 80)])
    text = _delay_and_loss(0.0, traces[:, None], 1e4, [3, 5])
    assert "8 ms later (group delay)" in text
    # Of another shape there is no delay.
    traces[1] = np.random.default_rng(1).standard_normal(2000)
    assert "later" not in _delay_and_loss(0.0, traces[:, None], 1e4, [3, 5])


@pytest.mark.parametrize("name", ["5D", "5E", "5F"])
def test_scenes_of_linearity_tell_what_is_computed_beside_what_the_paper_measured(name):
    opened = ss.scenes.open_scene(name, available=())
    assert f"at least 0.9999. {opened.scene.measured}" in opened.design.notes
    first, *others = opened.conditions
    clip = replace(first.design.clips[0], gain=4.0)
    bent = replace(first, design=first.design.with_input(0, clips=(clip,)))
    assert "1.000000" not in FINDINGS[name](replace(opened, conditions=(bent, *others)))


def test_people_are_told_apart_by_how_far_each_carries_the_pulse():
    opened = ss.scenes.open_scene("1G", available=())
    found = opened.scene.sentence.removeprefix(ss.scenes.scene("1G").sentence)
    for condition, own_db in zip(opened.conditions, levels_of(opened), strict=True):
        assert f"{condition.label.lower()} {own_db.max() - own_db[51]:.0f} dB" in found


@pytest.mark.parametrize("name", ["1D", "2A", "2C"])
def test_sentences_name_outputs_of_the_view_that_are_above_the_noise(name):
    opened = ss.scenes.open_scene(name, available=("synthetic-1",))
    before = ss.scenes.scene(name).sentence
    found = opened.scene.sentence.removeprefix(before)
    numbers = {int(number) for number in re.findall(r"output (\d+)", found)}
    assert len(numbers) == 2
    assert numbers <= set(opened.view.outputs)


def test_noise_is_said_to_be_lowest_where_it_is(measured):
    opened = ss.scenes.open_scene("2C")
    names = "axis_traces", "sample_rate_hz"
    found = ss.evaluate(opened.design, *names, view=opened.view)
    traces, rate_hz = (found[name] for name in names)
    power = np.square(np.abs(np.fft.rfft(traces))).sum(axis=1)
    means_hz = power @ np.fft.rfftfreq(traces.shape[-1], 1.0 / rate_hz) / power.sum(axis=1)
    row = opened.view.outputs.index(48)
    # Output 49 is above the noise, too.
    assert means_hz[row] < means_hz[row + 1]
    assert f"lowest at output 48, {means_hz[row]:.0f} Hz." in opened.scene.sentence


def test_the_train_of_the_other_order_expands():
    contracts, expands = (each.design for each in ss.scenes.open_scene("2H").conditions)
    rising, falling = (each.clips[0].waveform.frequencies_hz for each in (contracts, expands))
    assert falling == rising[::-1]


opened = ss.scenes.open_scene


@pytest.mark.parametrize("available", [(), MEASURED], ids=["synthetic", "measured"])
@pytest.mark.parametrize("name", ss.scenes.names())
def test_each_scene_is_called_by_its_title_as_long_as_it_is_that_scene(name, available):
    scene = ss.scenes.scene(name)
    for condition in opened(name, available=available).conditions:
        design = condition.design
        assert title_of(design) == design.title
        # Drives of inverse design are found on limbs that are here.
        for track in design.inputs[:1]:
            louder = design.with_input(0, amplitude=3.25 * track.amplitude)
            assert title_of(louder) == f"{scene.full_title} · edited"


def test_a_scene_on_another_limb_is_no_longer_called_by_the_limb_of_its_title():
    known = next(scene for scene in ss.scenes.all_scenes() if scene.title.endswith(", limb 1"))
    design = opened(known.name, available=()).design
    for limb in ("synthetic-3", "our-arm-1", "arm-1"):
        moved = title_of(replace(design, limb=limb))
        assert moved == f"Fig. {known.name}: {known.title.removesuffix(', limb 1')} · edited"
    chosen = opened(known.name, limb="synthetic-3").design
    assert title_of(chosen) == chosen.title


def test_a_scene_at_another_place_is_edited_and_at_the_places_of_a_lab_it_is_that_scene(user_data):
    design = opened("2B", available=()).design
    moved = design.with_input(0, location=9)
    assert title_of(moved) == f"{design.title.partition(' · ')[0]} · edited"
    installed()
    at_the_lab = opened("1C", limb="lab-1").design
    assert at_the_lab.inputs[0].location != opened("1C", available=()).design.inputs[0].location
    assert title_of(at_the_lab) == at_the_lab.title
    louder = at_the_lab.with_input(0, amplitude=3.25)
    assert title_of(louder).endswith(" · edited")


def test_another_limb_or_colour_leaves_the_title_of_a_scene_that_names_none():
    design = opened("2B", available=()).design
    assert title_of(replace(design, limb="synthetic-3")) == design.title
    assert title_of(design.with_input(0, colour=7)) == design.title


def test_no_title_tells_a_strength_in_a_unit_that_the_drive_of_another_limb_does_not_have(
    user_data,
):
    installed()
    paper, lab = (opened("5D", limb=limb).design for limb in ("synthetic-1", "lab-1"))
    assert (title_of(paper)[-6:], title_of(lab)[-6:]) == ("6 m/s²", "6 a.u.")
    elsewhere = paper.inputs[0].location, lab.inputs[0].location
    assert elsewhere[0] != elsewhere[1]
    moved = replace(paper, limb="lab-1").with_input(0, location=elsewhere[1])
    back = replace(lab, limb="synthetic-1").with_input(0, location=elsewhere[0])
    edited = "Fig. 5D: Output against input · edited"
    assert title_of(moved) == title_of(back) == edited
    velocities = opened("5B", limb="synthetic-1").conditions[0].design
    assert title_of(velocities).endswith(" mm/s")
    assert title_of(replace(velocities, limb="lab-1")).endswith(" · edited")


def test_words_of_the_user_stay_whatever_numbers_they_hold():
    for title in ("", "My 50 Hz", "Fig. 2B: mine · 50 Hz", "Fig. 99: A", "Fig. 3 of my thesis"):
        inputs = (ss.track(7, ss.waveforms.Tone()),)
        design = ss.Design(limb="synthetic-1", title=title, inputs=inputs)
        assert title_of(design) == title
