"""Scenes of inverse design: drives that are found on the open limb, and sentences on them."""

import re
from dataclasses import replace

import numpy as np
import pytest

import skinsource as ss
from skinsource.design.design_file import open_design
from skinsource.design.target import is_unsolved, target_in
from skinsource.studies.scenes.scenes import compared, path_of, title_of

NAMES = [scene.name for scene in ss.scenes.all_scenes() if not scene.of_paper]
QUIET = [18, 19, 20, 21, 23]


def opened(name, limb=""):
    return ss.scenes.open_scene(name, available=(), limb=limb)


def energy_of(design):
    rms = ss.evaluate(design, "output_rms", view=ss.View(axes="z"))["output_rms"]
    return np.square(rms)


def over_the_loudest_other_db(design, output=33):
    hand = energy_of(design)[:42]
    return 10 * np.log10(hand[output - 1] / np.delete(hand, output - 1).max())


def numbers_in(text):
    return [float(number.replace("−", "-")) for number in re.findall(r"−?\d+\.\d", text)]


@pytest.mark.parametrize("name", NAMES)
def test_files_hold_no_drives_and_what_is_opened_plays_some(name):
    for design in compared(open_design(path_of(name))):
        found = target_in(design)
        assert not design.inputs
        assert found is None or not found[1].drives
    for condition in opened(name).conditions:
        assert condition.design.inputs
        assert not is_unsolved(condition.design)


def test_the_next_digit_is_as_quiet_as_the_sentence_says(measured):
    scene = ss.scenes.open_scene("I1")
    one, every = (energy_of(condition.design) for condition in scene.conditions)
    levels_db = [10 * np.log10(e[QUIET].mean() / e[[27, 28]].mean()) for e in (one, every)]
    said = numbers_in(scene.scene.sentence)
    assert said == pytest.approx(2 * [levels_db[0]], abs=0.5)
    assert levels_db[1] < -20.0
    assert "below −20 dB with 15;" in scene.scene.sentence


def test_each_tip_plays_its_own_tone():
    design = opened("I2").design
    results = ss.evaluate(design, "selected_traces", "sample_rate_hz", view=opened("I2").view)
    time_s = np.arange(results["selected_traces"].shape[1]) / results["sample_rate_hz"]
    tones_hz = np.array([60.0, 90.0, 120.0, 160.0, 210.0])
    amounts = np.abs(results["selected_traces"] @ np.exp(-2j * np.pi * np.outer(time_s, tones_hz)))
    assert (20 * np.log10(amounts / amounts.max(axis=1, keepdims=True)) < -30.0).sum() == 20


def test_a_vibration_runs_to_the_wrist_or_to_the_tip():
    scene = opened("I3")
    for condition, order in zip(scene.conditions, (1, -1), strict=True):
        traces = ss.evaluate(condition.design, "selected_traces", view=scene.view)
        energy = np.square(traces["selected_traces"])
        middles = energy @ np.arange(energy.shape[1]) / energy.sum(axis=1)
        assert np.all(np.diff(middles[::order]) > 0.0)


def test_one_gain_of_ten_makes_the_next_digit_louder_and_not_as_loud_as_the_tip():
    scene = opened("I1")
    design, view = scene.conditions[-1].design, ss.View(axes="z")
    assert "one gain to 10: digit III gets louder, but not as loud" in scene.scene.to_try

    def below_the_tip_db(each):
        levels_db = ss.evaluate(each, "output_levels_db", view=view)["output_levels_db"]
        return levels_db[[27, 28]].max() - levels_db[QUIET].max()

    before_db = below_the_tip_db(design)
    for k in range(len(design.inputs)):
        assert 0.0 < below_the_tip_db(design.with_input(k, amplitude=10.0)) < before_db


def test_on_the_back_of_the_hand_tones_of_several_tips_meet():
    scene = opened("I2")
    assert "back of the hand, where tones of several tips meet" in scene.scene.to_try
    view = ss.View(outputs=(5, 14, 16, 23, 25, 32), axes="z")
    results = ss.evaluate(scene.design, "selected_traces", "sample_rate_hz", view=view)
    time_s = np.arange(results["selected_traces"].shape[1]) / results["sample_rate_hz"]
    tones_hz = np.array([60.0, 90.0, 120.0, 160.0, 210.0])
    amounts = np.abs(results["selected_traces"] @ np.exp(-2j * np.pi * np.outer(time_s, tones_hz)))
    levels_db = 20 * np.log10(amounts / amounts.max(axis=1, keepdims=True))
    assert (levels_db > -12.0).sum(axis=1).min() >= 2


def test_what_shows_all_snapshots_side_by_side_asks_for_no_other_one():
    for scene in ss.scenes.all_scenes():
        compare = dict(dict(ss.scenes.open_scene(scene.name).view.panels).get("compare", ()))
        assert compare.get("of") == "windows" or "press X" not in scene.to_try


def test_contrast_control_is_compared_with_the_least_drive():
    scene = opened("I4")
    before, after = (each.design for each in scene.conditions)
    gained_db = over_the_loudest_other_db(after, 26) - over_the_loudest_other_db(before, 26)
    loudest = numbers_in(scene.scene.sentence)[:2]
    assert gained_db == pytest.approx(loudest[1] - loudest[0], abs=0.3)


def test_drives_of_one_person_are_played_on_another_and_fall_short_of_own_ones(measured):
    scene = ss.scenes.open_scene("I5")
    first, carried, own = (each.design for each in scene.conditions)
    played = [[clip.waveform for clip in design.clips] for design in (first, carried)]
    assert played[0] == played[1]
    places = {tuple(track.location for track in design.inputs) for design in (first, carried, own)}
    assert places == {(7, 12, 13, 16, 17, 18)}
    said = numbers_in(scene.scene.sentence)
    predicted = [over_the_loudest_other_db(design) for design in (first, carried, own)]
    assert predicted == pytest.approx([said[0], said[1], said[4]], abs=0.5)
    assert np.all(np.array(said[1:4]) < said[4:7])


def test_a_target_on_another_limb_is_that_scene_and_drives_of_another_limb_are_not():
    aimed, driven = (opened(name).conditions[0].design for name in ("I4", "I2"))
    assert title_of(replace(aimed, limb="synthetic-3")) == aimed.title
    assert title_of(replace(driven, limb="synthetic-3")).endswith(" · edited")
    assert title_of(opened("I2", "synthetic-3").design) == driven.title
