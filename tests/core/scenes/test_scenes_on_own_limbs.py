"""Scenes on a limb of a lab: those that apply there, and why others do not."""

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import InvalidInputError
from skinsource.cli.command_line import main
from skinsource.design.design_file import open_design
from skinsource.limbs.own_limbs import facts_of
from skinsource.studies.figures.writing import draw_figure
from tests.core.own_limbs.lab_bench import N_INPUTS, installed

#: All of the paper but those that compare people.
APPLYING = [s.name for s in ss.scenes.all_scenes() if s.of_paper and s.name not in ("1G", "2E")]


def reasons(limb):
    return {name: ss.scenes.why_not_on(name, limb) for name in ss.scenes.names()}


def test_all_but_those_that_compare_people_apply_on_a_limb_of_7_by_31_by_2(user_data):
    installed()
    texts = reasons("lab-1")
    assert [name for name, reason in texts.items() if not reason] == APPLYING
    assert texts["1G"] == "It compares 4 people, and this is one limb."
    assert texts["2E"].startswith("It compares 3 people")
    assert texts["I1"] == "It is about outputs of the published limbs."
    with pytest.raises(InvalidInputError, match=r"1G does not apply on lab-1\. It compares 4"):
        ss.scenes.open_scene("1G", limb="lab-1")
    with pytest.raises(InvalidInputError, match="'lab-9' is not here"):
        ss.scenes.open_scene("2F", limb="lab-9")


@pytest.mark.parametrize("name", APPLYING)
def test_each_that_applies_plays_and_is_drawn_at_what_the_limb_has(user_data, name):
    installed()
    opened = ss.scenes.open_scene(name, limb="lab-1")
    assert "lab-1" not in opened.scene.title
    for condition in opened.conditions:
        design = condition.design
        assert (design.limb, design.limb_digest) == ("lab-1", facts_of("lab-1").digest)
        assert all(1 <= track.location <= N_INPUTS for track in design.inputs)
        levels = ss.evaluate(design, "output_levels_db", view=opened.view)["output_levels_db"]
        assert levels[np.array(opened.view.outputs) - 1].max() > -60.0
        assert "may not show what the sentence says" in design.notes
    assert opened.design in [condition.design for condition in opened.conditions]
    assert len(draw_figure(opened).tables) >= 1


def test_places_that_it_lacks_are_others_and_outputs_go_from_near_to_far(user_data):
    limb = installed()
    opened = ss.scenes.open_scene("2F", limb="lab-1")
    places = [[track.location for track in each.design.inputs] for each in opened.conditions]
    assert places == [[1], [2], [1, 2]]
    assert [condition.label for condition in opened.conditions] == ["Input 1", "Input 2", "Both"]
    assert opened.design.title == "Fig. 2F: Two inputs interfere · Both"
    assert "played at its places 1 in place of 8, 2 in place of 13" in opened.note
    away = np.linalg.norm(limb.output_positions - limb.input_positions[0], axis=1)
    assert np.all(np.diff(away[np.array(opened.view.outputs) - 1]) > 0.0)
    assert opened.view.outputs[0] == 1 + int(np.nanargmin(away))
    assert opened.view.axes == "x"
    # A place that the limb has too stays.
    there = ss.scenes.open_scene("2A", limb="lab-1")
    assert there.design.inputs[0].location == 7
    assert "played at its place 7;" in there.note
    # It answers 50 ms earlier than the published ones; times count from the pulse.
    assert there.view.time_range_s == ss.scenes.open_scene("2A").view.time_range_s
    assert ss.scenes.open_scene("5B-2", limb="lab-1").scene.title == "Five strengths of three tones"


def test_what_a_limb_lacks_is_said(user_data):
    rng = np.random.default_rng(1)
    inputs = rng.uniform(-30, 30, (7, 2))
    inputs[2:] = np.nan
    installed(axes="x", sample_rate_hz=1000.0, input_positions=inputs)
    texts = reasons("lab-1")
    assert texts["1C"] == "It is about motion along z, and this limb measures along x."
    assert texts["1E"].startswith("It is about motion along z")
    assert texts["1F"] == "It is played at 3 places, and this limb has 2 places on its map."
    assert texts["2F"] == ""
    installed(axes="z")
    assert reasons("lab-1")["1E"] == "It compares axes, and this limb measures along z alone."
    installed(sample_rate_hz=1000.0)
    assert reasons("lab-1")["2D"].endswith("1000 Hz, which is too slow for what it plays: noise.")


def test_the_commands_take_a_limb(user_data, tmp_path, capsys):
    installed()
    assert main(["scenes", "--limb", "lab-1"]) == 0
    assert "Not on lab-1: It compares 4 people" in capsys.readouterr().out
    path = tmp_path / "own.skinsource"
    assert main(["scenes", "2F", "--limb", "lab-1", "--out", str(path)]) == 0
    assert "1 in place of 8" in capsys.readouterr().out
    assert open_design(path).design == ss.scenes.open_scene("2F", limb="lab-1").design
    assert main(["scenes", "1G", "--limb", "lab-1"]) == 1
    assert "It compares 4 people" in capsys.readouterr().err
    arguments = ["figures", "--out", str(tmp_path), "--limb", "lab-1", "--only"]
    assert main([*arguments, "2B"]) == 0
    table = (tmp_path / "2B.csv").read_text()
    assert "may not show what the sentence says" in table
    assert "Lab 1 (lab-1)" in table
    capsys.readouterr()
    assert main([*arguments, "2E"]) == 1
    assert "2E does not apply on lab-1" in capsys.readouterr().err
