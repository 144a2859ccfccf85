"""The shipped scenes: made by the script beside them, opened on the limbs that there are."""

import pytest

import skinsource as ss
from skinsource.base.errors import InvalidInputError
from skinsource.base.measurement_conditions import LIMB_NAMES
from skinsource.cli.command_line import main
from skinsource.design.comparing import shown_snapshot
from skinsource.design.design_file import open_design
from skinsource.studies.scenes.catalog import path_of
from skinsource.studies.scenes.shipped import SHIPPED
from tests.core.scenes.scenes_bench import PANELS

MEASURED = tuple(name for name in LIMB_NAMES if name.startswith("measured"))
every = pytest.mark.parametrize("name", PANELS)


def test_every_panel_that_can_be_computed_is_a_scene():
    assert list(ss.scenes.names()) == PANELS


def test_the_files_are_what_the_script_makes():
    stored = {path.stem: open_design(path) for path in ss.scenes.scenes_folder().iterdir()}
    made = {scene.scene.name: scene.content for scene in SHIPPED}
    assert stored == made, (
        "data/scenes is out of date; write it anew with 'python -m skinsource.studies.scenes'"
    )


@every
def test_each_says_what_it_is_where_it_is_from_and_what_is_inferred(name):
    known = ss.scenes.scene(name)
    assert known.sentence.endswith(".")
    assert len(known.title) <= 40
    assert known.source.endswith(f"Fig. {name}")
    notes = open_design(path_of(name)).design.notes
    assert known.sentence in notes
    assert f"Fig. {name}." in notes
    assert all(phrase in notes for phrase in known.inferred)


@every
def test_each_opens_on_the_limbs_of_the_paper_where_they_are(name):
    opened = ss.scenes.open_scene(name, available=MEASURED)
    assert opened.note == ""
    assert not opened.synthetic
    assert all(condition.design.limb in MEASURED for condition in opened.conditions)
    assert opened.design in [condition.design for condition in opened.conditions]


@every
def test_each_opens_on_the_synthetic_limb_of_its_number_elsewhere_and_says_so(name):
    opened = ss.scenes.open_scene(name, available=("synthetic-1",))
    there = ss.scenes.open_scene(name, available=MEASURED)
    assert "SYNTHETIC" in opened.note
    for here, condition in zip(opened.conditions, there.conditions, strict=True):
        assert here.label == condition.label
        assert here.design.limb == condition.design.limb.replace("measured", "synthetic")
        assert here.design.inputs == condition.design.inputs


@every
def test_each_plays_and_moves_the_outputs_that_it_shows(name):
    opened = ss.scenes.open_scene(name, available=())
    for condition in opened.conditions:
        levels = ss.evaluate(condition.design, "output_levels_db", view=opened.view)
        shown_db = levels["output_levels_db"][[output - 1 for output in opened.view.outputs]]
        assert shown_db.max() > -60.0


def test_the_window_shows_one_of_the_designs_that_are_compared_and_the_others_as_snapshots():
    for name in PANELS:
        opened = ss.scenes.open_scene(name, available=MEASURED)
        stored = [snapshot.design for snapshot in opened.view.snapshots]
        extra = 1 if shown_snapshot(opened.view.snapshots, opened.design) is None else 0
        assert len(stored) + extra == len(opened.conditions), name
        assert not opened.view.levels_matched, name


def test_what_is_compared_differs_in_what_its_labels_say():
    opened = ss.scenes.open_scene("2F", available=MEASURED)
    places = [[track.location for track in each.design.inputs] for each in opened.conditions]
    assert places == [[8], [13], [8, 13]]
    limbs = [
        condition.design.limb
        for condition in ss.scenes.open_scene("1G", available=MEASURED).conditions
    ]
    assert limbs == list(MEASURED)
    tones = [
        condition.design.clips[0].waveform.frequency_hz
        for condition in ss.scenes.open_scene("2B", available=MEASURED).conditions
    ]
    assert tones == [50.0, 100.0, 200.0, 400.0]
    amplitudes = [
        condition.design.inputs[0].amplitude
        for condition in ss.scenes.open_scene("5A", available=MEASURED).conditions
    ]
    assert [a / amplitudes[0] for a in amplitudes] == pytest.approx([1, 2, 4, 8, 16])


def test_names_may_be_written_small_and_others_are_refused():
    assert ss.scenes.scene("2f").name == "2F"
    for other in ("2G", "", None, "../2F"):
        with pytest.raises(InvalidInputError, match="does not exist; there are 1C, 1D"):
            ss.scenes.open_scene(other)


def test_the_command_lists_scenes_and_writes_one_as_a_design(tmp_path, capsys):
    assert main(["scenes"]) == 0
    listed = capsys.readouterr().out
    assert all(f"{name} " in listed for name in PANELS)
    path = tmp_path / "own.skinsource"
    assert main(["scenes", "2b", "--out", str(path)]) == 0
    printed = capsys.readouterr().out
    assert "2B · Low frequencies reach farther" in printed
    assert "SYNTHETIC" in printed
    opened = ss.scenes.open_scene("2B")
    assert open_design(path).design == opened.design
    assert open_design(path).view == opened.view


def test_the_command_refuses_what_it_cannot_do(capsys):
    assert main(["scenes", "9Z"]) == 1
    assert "does not exist" in capsys.readouterr().err
    with pytest.raises(SystemExit):
        main(["scenes", "--out", "x.skinsource"])


@every
def test_each_says_which_number_it_is_about_and_its_design_has_that(name):
    content = open_design(path_of(name))
    (turned,) = dict(dict(content.view.panels)["frequency_and_amplitude"]).values()
    assert turned in {"frequency", "amplitude", "onset"}
    if turned == "frequency":
        (selected,) = content.view.selected_inputs
        assert hasattr(content.design.input(selected).clips[0].waveform, "frequency_hz")


def test_what_travels_is_shown_as_it_moves_and_slowed_down():
    views = {name: open_design(path_of(name)).view for name in PANELS}
    slow = {name for name, view in views.items() if view.slow_motion > 1.0}
    moving = {name for name, view in views.items() if ("quantity", "z") in _skin(view)}
    assert slow == moving == {"1C", "2A", "4A"}
    for name in slow:
        first_s, last_s = views[name].time_range_s
        assert first_s < views[name].playhead_s < last_s
        # Seconds of the lecture.
        assert 3.0 < views[name].slow_motion * (last_s - first_s) < 15.0


def _skin(view):
    return dict(view.panels).get("skin", ())
