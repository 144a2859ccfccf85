"""Limbs of a lab's own, kept here: what they give, also to commands, and damaged ones."""

import json
import os
from dataclasses import replace

import numpy as np
import pytest

from skinsource import Design, View, edits, evaluate, export_stimulus, track
from skinsource.base.errors import FileFormatError, InvalidInputError, UnknownLimbError
from skinsource.cli.command_line import main
from skinsource.design.design_file import open_design, save_design
from skinsource.design.labels import limb_label
from skinsource.design.waveforms import Impulse, Tone
from skinsource.export.tables import export_field, export_levels, export_map, export_traces
from skinsource.limbs import own_limbs
from skinsource.limbs.catalog import available_limbs, load_limb
from skinsource.limbs.locations import input_name, output_name
from tests.core.exporting.export_bench import commented
from tests.core.own_limbs import lab_bench

PLAYED = Design(
    limb="lab-1", inputs=(track(7, Tone(frequency_hz=1500.0, duration_s=0.1)), track(2))
)
VIEW = View(axes="xz", method="mag", outputs=(31, 5))


def test_it_is_named_beside_the_others_and_removed(lab):
    assert available_limbs()[-1] == "lab-1"
    assert limb_label("lab-1").title == "Lab 1"
    assert "31 outputs along x and z, 4000 Hz" in limb_label("lab-1").sentence
    assert input_name(3, "lab-1").name == "site 3"
    assert output_name(3, "lab-1").name == "Output 3"
    assert input_name(8, "lab-1").short_name == "not on this hand"
    assert output_name(32, "lab-1").short_name == "not on this limb"
    assert edits.place_input(PLAYED, VIEW, 3).label == "Place input at 3 (site 3)"
    own_limbs.remove_limb("lab-1")
    assert own_limbs.own_limb_names() == ()
    with pytest.raises(UnknownLimbError, match="'lab-1' is not available here"):
        load_limb("lab-1")


def test_its_digest_says_which_numbers_it_holds(lab):
    digest = own_limbs.facts_of("lab-1").digest
    lab_bench.installed(title="Another name", note="A note", mirrored=True)
    assert own_limbs.facts_of("lab-1").digest == digest
    lab_bench.installed(hand_length_mm=181.0)
    assert own_limbs.facts_of("lab-1").digest != digest
    louder = (2 * lab_bench.response(place) for place in range(1, lab_bench.N_INPUTS + 1))
    own_limbs.install_limb(lab, louder)
    assert own_limbs.facts_of("lab-1").digest != digest


def test_a_design_names_the_limb_and_its_digest(lab, tmp_path):
    edit = edits.change_limb(replace(PLAYED, limb="synthetic-1"), View(), "lab-1")
    assert edit.design.limb_digest == own_limbs.facts_of("lab-1").digest
    assert edit.view.axes == "xz"
    save_design(tmp_path / "a.skinsource", edit.design, edit.view)
    content = open_design(tmp_path / "a.skinsource")
    assert content.design == edit.design
    assert own_limbs.missing_limb(content.design.limb, content.design.limb_digest) == ""
    levels = evaluate(content.design, "output_levels_db", view=content.view)["output_levels_db"]
    assert np.isfinite(levels).all()
    lab_bench.installed(hand_length_mm=181.0)
    assert "other numbers" in own_limbs.missing_limb("lab-1", content.design.limb_digest)
    with pytest.raises(InvalidInputError, match="'lab-1' here is not that"):
        load_limb("lab-1", content.design.limb_digest)
    back = edits.change_limb(content.design, content.view, "synthetic-1")
    assert (back.design.limb_digest, back.view.axes) == ("", "xyz")
    assert edits.change_limb(content.design, content.view, "lab-2").sentence.startswith("No limb")


def test_a_limb_that_is_imported_anew_is_computed_anew(lab):
    before = evaluate(PLAYED, "output_levels_db", view=VIEW)["output_levels_db"]
    own_limbs.install_limb(
        lab, (2 * lab_bench.response(place) for place in range(1, lab_bench.N_INPUTS + 1))
    )
    after = evaluate(PLAYED, "output_levels_db", view=VIEW)["output_levels_db"]
    np.testing.assert_allclose(after - before, 20 * np.log10(2))
    # Also by a file of the same size and time: clocks of file systems tick, and copies keep it.
    path = own_limbs.own_limb_path("lab-1")
    about = path.stat()
    own_limbs.install_limb(
        lab, (4 * lab_bench.response(place) for place in range(1, lab_bench.N_INPUTS + 1))
    )
    os.utime(path, ns=(about.st_atime_ns, about.st_mtime_ns))
    assert path.stat().st_size == about.st_size
    again = evaluate(PLAYED, "output_levels_db", view=VIEW)["output_levels_db"]
    np.testing.assert_allclose(again - before, 20 * np.log10(4))


def test_every_export_works_on_it_and_says_its_axes(lab, tmp_path):
    export_levels(tmp_path / "levels.csv", PLAYED, VIEW)
    text = (tmp_path / "levels.csv").read_text()
    assert "axes: x, z (xz)" in text
    assert text.count("\n") - text.count("\n#") >= lab_bench.N_OUTPUTS
    export_traces(tmp_path / "traces.csv", PLAYED, VIEW)
    assert "pre-trigger delay of 2 ms" in (tmp_path / "traces.csv").read_text()
    export_map(tmp_path / "map.csv", PLAYED, VIEW)
    export_field(tmp_path / "field.npz", PLAYED, VIEW)
    with np.load(tmp_path / "field.npz") as held:
        assert held["acceleration_m_per_s2"].shape[:2] == (lab_bench.N_OUTPUTS, 2)
        assert held["sample_rate_hz"] == lab_bench.RATE_HZ
        assert "2 axes (x, z)" in str(held["about"])
    for name, suffix in (("wav", ".wav"), ("hdf5", ".h5"), ("csv", ".csv")):
        export_stimulus(PLAYED, tmp_path / f"drive{suffix}", format=name, rate_hz=8000.0)
    sidecar = json.loads((tmp_path / "drive.wav.json").read_text())
    assert "site 7" in json.dumps(sidecar)


def test_it_is_shown_mirrored_on_request_and_computes_the_same(lab):
    before = evaluate(PLAYED, "output_levels_db", view=VIEW)["output_levels_db"]
    own_limbs.mirror_limb("lab-1", True)
    limb = load_limb("lab-1")
    both = lab.outline[:, 0].min() + lab.outline[:, 0].max()
    np.testing.assert_allclose(limb.map.output_positions[:, 0], both - lab.output_positions[:, 0])
    np.testing.assert_array_equal(limb.map.output_positions[:, 1], lab.output_positions[:, 1])
    np.testing.assert_allclose(limb.map.outline[:, 0], both - lab.outline[:, 0])
    np.testing.assert_array_equal(limb.response_to(3), lab_bench.response(3))
    assert "shown mirrored" in own_limbs.facts_of("lab-1").sentence
    after = evaluate(PLAYED, "output_levels_db", view=VIEW)["output_levels_db"]
    np.testing.assert_array_equal(after, before)
    shown = evaluate(PLAYED, "limb_map")["limb_map"]
    np.testing.assert_array_equal(shown.outline, limb.map.outline)
    own_limbs.mirror_limb("lab-1", False)
    np.testing.assert_array_equal(load_limb("lab-1").map.outline, lab.outline)


def test_a_damaged_limb_is_not_known_and_can_be_removed(lab):
    own_limbs.own_limb_path("lab-1").write_bytes(b"nothing")
    assert not own_limbs.facts_of("lab-1").known
    assert "is not here" in own_limbs.missing_limb("lab-1", "")
    own_limbs.remove_limb("lab-1")
    assert not own_limbs.own_limb_path("lab-1").exists()


def test_responses_replaced_while_the_limb_is_open_are_noticed(lab):
    limb = load_limb("lab-1")
    limb.response_to(1)
    lab_bench.installed(note="changed")
    with pytest.raises(FileFormatError, match=r"was replaced by other data .* Open the limb again"):
        limb.response_to(2)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"name": "Lab 1"}, "small letters, digits"),
        ({"name": "measured-1"}, "not beginning with measured-"),
        ({"name": "../a"}, "small letters"),
        ({"axes": "zx"}, "axes 'zx' is not known"),
        ({"sample_rate_hz": float("nan")}, "100 to 768000 Hz"),
        ({"n_taps": 0}, "whole number from 1"),
        ({"hand_length_mm": -1.0}, "20 to 2000 mm"),
        ({"title": "two\nlines"}, "one line"),
        ({"outline": np.zeros((5, 2))}, "encloses no area"),
        ({"outline": [[0, 0], [1, float("nan")], [2, 2]]}, "row 2: y is nan"),
        ({"input_positions": np.zeros((257, 2))}, "1 to 256 rows"),
        ({"output_positions": np.zeros((513, 2))}, "1 to 512 rows"),
        ({"input_positions": np.zeros((3, 3))}, r"expected \(n, 2\)"),
        ({"output_names": ("a",)}, "output_names are 1, expected 31"),
        (
            {"n_taps": 2**20, "input_positions": np.zeros((60, 2)), "input_names": ()},
            "would take 31.2 GB",
        ),
    ],
)
def test_what_is_no_limb_is_refused_in_one_sentence(changes, message):
    with pytest.raises(InvalidInputError, match=message):
        lab_bench.own_limb(**changes)


def test_responses_that_are_no_numbers_leave_nothing_behind(user_data):
    limb = lab_bench.own_limb()
    bad = lab_bench.response(2)
    bad[3, 1, 7] = np.nan
    with pytest.raises(InvalidInputError, match=r"input 2, output 4, axis z, tap 7 is nan"):
        own_limbs.install_limb(limb, [lab_bench.response(1), bad])
    with pytest.raises(InvalidInputError, match="to 1 input, expected 7"):
        own_limbs.install_limb(limb, [lab_bench.response(1)])
    with pytest.raises(InvalidInputError, match=r"shape \(31, 1, 90\), expected \(31, 2, 90\)"):
        own_limbs.install_limb(limb, [lab_bench.response(1, "z")])
    assert own_limbs.own_limb_names() == ()
    assert list(own_limbs.own_limb_path("lab-1").parent.iterdir()) == []


def test_a_design_is_rendered_and_packed_that_was_saved_without_a_view(user_data, tmp_path, capsys):
    lab_bench.installed()
    path = tmp_path / "lab.skinsource"
    save_design(path, Design(limb="lab-1", inputs=(track(2, Tone(duration_s=0.02)),)))
    assert View().outputs == (29, 52)
    assert main(["render", str(path), "--out", str(tmp_path)]) == 0
    assert commented(tmp_path / "traces.csv")[1] == ["time_s", "output_29_m_per_s2"]
    assert main(["pack", str(path), "--out", str(tmp_path / "lab.zip")]) == 0
    assert capsys.readouterr().err == ""


def test_a_response_without_a_frequency_in_the_band_is_checked_and_no_line_is_told(
    user_data, tmp_path, capsys
):
    responses = np.random.default_rng(5).normal(size=(2, 3, 1, 6))
    rate = {"sample_rate_hz": 48_000.0, "pre_trigger_delay_s": 0.0, "band_hz": (25.0, 600.0)}
    lab_bench.keep("lab-short", responses, **rate)
    path = tmp_path / "short.skinsource"
    inputs = tuple(track(place, Impulse()) for place in (1, 2))
    save_design(path, Design(limb="lab-short", inputs=inputs))
    assert main(["check", str(path)]) == 0
    assert "adjusted R² –; superposition: r 1" in capsys.readouterr().out
