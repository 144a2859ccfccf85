"""From a lab's files to a limb: the layout, plain arrays, places, outlines, the command."""

from pathlib import Path

import h5py
import numpy as np
import pytest
import scipy.io

from skinsource import SkinSourceError, load_limb
from skinsource.cli.command_line import main
from skinsource.limbs.limb_import import LimbSource, import_limb, prepare_limb
from skinsource.limbs.limb_layout import export_limb
from skinsource.limbs.own_limbs import facts_of, own_limb_names
from skinsource.limbs.svg_path import outline_of, path_lines
from tests.core.own_limbs.lab_bench import N_INPUTS, N_OUTPUTS, RATE_HZ, response
from tests.core.own_limbs.mutants import whole_file

OUTLINE = [[0, 0], [60, 0], [60, 100], [0, 100]]
ALL = np.stack([response(place) for place in range(1, N_INPUTS + 1)])
RNG = np.random.default_rng(8)
INPUTS = RNG.uniform(10, 50, (N_INPUTS, 2)).round(2)
OUTPUTS = RNG.uniform(10, 50, (N_OUTPUTS, 2)).round(2)
VALUES = {"name": "ours", "axes": "xz", "sample_rate_hz": RATE_HZ, "hand_length_mm": 180.0}


def layout_file(path: Path, **attributes) -> Path:
    return whole_file(path, ALL.astype("f4"), **attributes)


def table(path: Path, rows, header: str = "") -> Path:
    lines = [",".join(map(str, row)) for row in rows]
    path.write_text("\n".join(([header] if header else []) + lines) + "\n")
    return path


def test_a_file_in_the_layout_becomes_a_limb(user_data, tmp_path):
    facts = import_limb(LimbSource(responses=layout_file(tmp_path / "ours.h5", hand="left")))
    assert (facts.name, facts.axes, facts.n_inputs, facts.n_outputs) == ("ours", "xz", 7, 31)
    assert (facts.left, facts.mirrored, facts.pre_trigger_delay_s) == (True, False, 0.0)
    assert facts.input_names[1] == "site 2"
    limb = load_limb("ours")
    assert limb.per_unit_drive
    for place in range(1, N_INPUTS + 1):
        np.testing.assert_array_equal(
            limb.response_to(place), ALL[place - 1].astype("f4").astype(float)
        )
    np.testing.assert_array_equal(limb.map.outline, OUTLINE)
    assert limb.map.hand_length_px == 180.0


def test_what_is_exported_is_imported_again_with_the_same_digest(lab, tmp_path):
    before = facts_of("lab-1")
    export_limb("lab-1", tmp_path / "lab.h5")
    after = import_limb(LimbSource(responses=tmp_path / "lab.h5", values={"name": "copy"}))
    assert after.digest == before.digest
    assert after.input_names == before.input_names
    assert after.title == before.title


def saved_h5(path, array):
    with h5py.File(path, "w") as file:
        file["deep/ir"] = array


SAVED = {
    "npy": np.save,
    "npz": lambda path, array: np.savez(path, small=np.zeros((2, 2, 2)), ir=array),
    "mat": lambda path, array: scipy.io.savemat(path, {"ir": array}),
    "h5": saved_h5,
}


@pytest.mark.parametrize("ending", SAVED)
@pytest.mark.parametrize("order", ["ioat", "taoi"])
def test_any_array_becomes_a_limb_in_whatever_order(user_data, tmp_path, ending, order):
    path = tmp_path / f"a.{ending}"
    SAVED[ending](path, ALL.transpose(["ioat".index(letter) for letter in order]))
    source = LimbSource(
        responses=path,
        order=order,
        outline=table(tmp_path / "outline.csv", OUTLINE),
        inputs=table(tmp_path / "in.csv", INPUTS),
        outputs=OUTPUTS,
        values=VALUES,
    )
    import_limb(source)
    limb = load_limb("ours")
    np.testing.assert_array_equal(limb.response_to(5), ALL[4])
    np.testing.assert_array_equal(limb.map.input_positions, INPUTS)


def test_one_axis_needs_no_dimension_and_a_hull_is_drawn_where_no_outline_is(user_data, tmp_path):
    np.save(tmp_path / "a.npy", ALL[:, :, 1])
    places = OUTPUTS.copy()
    places[3] = np.nan
    rows = [(f"out {k}", y, "" if np.isnan(x) else x) for k, (x, y) in enumerate(places)]
    rows[3] = ("out 3", "nan", "")
    facts = import_limb(
        LimbSource(
            responses=tmp_path / "a.npy",
            inputs=table(tmp_path / "in.csv", INPUTS),
            outputs=table(tmp_path / "out.csv", rows, "name,Y,x"),
            values={**VALUES, "axes": "z"},
        )
    )
    assert facts.axes == "z"
    assert facts.output_names[5] == "out 5"
    limb = load_limb("ours")
    np.testing.assert_array_equal(limb.map.output_positions, places)
    assert "hull around the places" in limb.note
    low, high = limb.map.outline.min(axis=0), limb.map.outline.max(axis=0)
    every = np.vstack((INPUTS, places[np.isfinite(places[:, 0])]))
    assert (low < every.min(axis=0)).all()
    assert (high > every.max(axis=0)).all()


def test_y_of_svg_points_down_and_so_does_that_of_the_places_beside_it(user_data, tmp_path):
    svg = tmp_path / "o.svg"
    svg.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg"><g transform="translate(5 -7)">'
        '<path d="M0,0 h60 v100 h-60 z m5 5 h1 v1 h-1 z"/></g></svg>'
    )
    np.save(tmp_path / "a.npy", ALL)
    import_limb(
        LimbSource(
            responses=tmp_path / "a.npy", outline=svg, inputs=INPUTS, outputs=OUTPUTS, values=VALUES
        )
    )
    limb = load_limb("ours")
    np.testing.assert_array_equal(limb.map.outline, [[5, 7], [65, 7], [65, -93], [5, -93]])
    np.testing.assert_array_equal(limb.map.input_positions, INPUTS * (1, -1))


def refused(user_data, source: LimbSource) -> str:
    with pytest.raises(SkinSourceError) as caught:
        import_limb(source)
    assert own_limb_names() == ()
    return str(caught.value)


def test_what_does_not_fit_together_is_refused_in_one_sentence(tmp_path, process):
    np.save(tmp_path / "a.npy", ALL)
    whole = {"responses": tmp_path / "a.npy", "inputs": INPUTS, "outputs": OUTPUTS}
    for changes, message_part in (
        ({"inputs": INPUTS[:5]}, "input_positions has shape (5, 2), expected (7, 2)"),
        ({"outputs": None}, "output_positions are not known, expected 31 places"),
        ({"outputs": np.full((31, 2), np.nan)}, "no output has a place on the map"),
        ({"outputs": np.full((31, 2), (3.0, np.nan))}, "no output has a place on the map"),
        ({"values": {**VALUES, "axes": "z"}}, "axes is 'z', expected 2 of x, y and z"),
        ({"values": {**VALUES, "name": ""}}, "the name of the limb is '', expected small letters"),
        ({"values": {**VALUES, "sample_rate_hz": None}}, "sample_rate_hz is not known"),
        ({"values": {**VALUES, "colour": 1}}, "colour says nothing about a limb; remove it"),
        ({"order": "ioax"}, "'ioax', expected i, o, a and t"),
        ({"array": "other"}, "it has no array 'other'"),
        ({"order": "oiat"}, "input_positions has shape (7, 2), expected (31, 2)"),
        ({"inputs": tmp_path / "nothing.csv"}, "nothing.csv"),
    ):
        source = LimbSource(**{**whole, "values": VALUES, **changes})
        with pytest.raises(SkinSourceError) as caught:
            prepare_limb(source, process)
        assert message_part in str(caught.value)
        assert "\n" not in str(caught.value)


def test_a_file_of_another_kind_or_with_holes_is_refused_by_name(user_data, tmp_path):
    (tmp_path / "a.txt").write_text("hello")
    assert "a.txt: it is a text file, expected NPY" in refused(
        user_data, LimbSource(responses=tmp_path / "a.txt", values=VALUES)
    )
    np.save(tmp_path / "flat.npy", np.zeros((5, 5)))
    assert "no array of 3 or 4 dimensions" in refused(
        user_data, LimbSource(responses=tmp_path / "flat.npy", values=VALUES)
    )
    holes = ALL.copy()
    holes[2, 5, 1, 7] = np.inf
    np.save(tmp_path / "b.npy", holes)
    message = refused(
        user_data,
        LimbSource(responses=tmp_path / "b.npy", inputs=INPUTS, outputs=OUTPUTS, values=VALUES),
    )
    assert "b.npy: in the response to input 3, output 6, axis z, tap 7 is inf" in message


def test_the_command_imports_lists_mirrors_exports_and_removes(user_data, tmp_path, capsys):
    path = layout_file(tmp_path / "ours.h5")
    assert main(["limb", "list"]) == 0
    assert "No limb was imported" in capsys.readouterr().out
    assert main(["limb", "import", str(path), "--title", "Our arm", "--left", "--synthetic"]) == 0
    assert "Our arm" in capsys.readouterr().out
    assert load_limb("ours").synthetic
    assert main(["limb", "mirror", "ours"]) == 0
    assert "Left hand, shown mirrored" in capsys.readouterr().out
    assert main(["limb", "export", "ours", "--out", str(tmp_path / "again.h5")]) == 0
    assert main(["limbs"]) == 0
    assert "Our arm" in capsys.readouterr().out
    assert main(["limb", "remove", "ours"]) == 0
    assert own_limb_names() == ()
    assert main(["limb", "remove", "ours"]) == 1
    assert "no own limb is called 'ours'; there are none" in capsys.readouterr().err


def test_options_of_the_command_go_before_what_the_file_says(user_data, tmp_path):
    path = layout_file(tmp_path / "ours.h5")
    options = "--hand-length 181 --hand-length-units 90 --delay 0.01 --band 20 300 --pulse"
    assert main(["limb", "import", str(path), "--mirrored", *options.split()]) == 0
    limb, facts = load_limb("ours"), facts_of("ours")
    lengths = limb.hand_length_mm, limb.map.hand_length_px, limb.pre_trigger_delay_s
    assert lengths == (181, 90, 0.01)
    assert (limb.band_hz, limb.per_unit_drive, facts.mirrored) == ((20, 300), False, True)


def test_an_own_limb_is_replaced_only_where_that_is_asked_for(user_data, tmp_path, capsys):
    path = layout_file(tmp_path / "ours.h5")
    assert main(["limb", "import", str(path)]) == 0
    before = facts_of("ours").digest
    with h5py.File(path, "r+") as file:
        file["responses"][0, 0, 0, 0] += 1.0
    capsys.readouterr()
    assert main(["limb", "import", str(path)]) == 1
    error_output = capsys.readouterr().err
    assert "an own limb is called 'ours' already, and would be lost" in error_output
    assert "--replace" in error_output
    assert facts_of("ours").digest == before
    assert main(["limb", "import", str(path), "--name", "another"]) == 0
    assert main(["limb", "import", str(path), "--replace"]) == 0
    assert facts_of("ours").digest == facts_of("another").digest != before


def test_the_largest_limb_is_computed_as_a_job(user_data, tmp_path):
    from skinsource.design.design import Design, View, track
    from skinsource.export.tables import export_levels

    array = RNG.standard_normal((256, 512, 1, 40)).astype("f4")
    np.save(tmp_path / "large.npy", array)
    facts = import_limb(
        LimbSource(
            responses=tmp_path / "large.npy",
            inputs=RNG.uniform(0, 100, (256, 2)),
            outputs=RNG.uniform(0, 100, (512, 2)),
            values={**VALUES, "axes": "z"},
        )
    )
    assert not facts.live
    design = Design(limb="ours", inputs=(track(256), track(3, onset_s=0.1)))
    export_levels(tmp_path / "levels.csv", design, View(axes="z", outputs=()))
    assert "\n512," in (tmp_path / "levels.csv").read_text()


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("M1 2L3 4 5 6Z", [[1, 2], [3, 4], [5, 6]]),
        ("m1,2 3,4 v-1 H0", [[1, 2], [4, 6], [4, 5], [0, 5]]),
        ("M0-1.5.5-2e1", [[0, -1.5], [0.5, -20]]),
    ],
)
def test_straight_paths_are_read_point_by_point(text, expected):
    (line,) = path_lines(text)
    np.testing.assert_allclose(line, expected)


def test_curves_and_arcs_lie_where_they_should():
    (quarter,) = path_lines("M1 0A1 1 0 0 1 0 1")
    np.testing.assert_allclose(np.hypot(*quarter.T), 1.0)
    (large,) = path_lines("M1 0a1 1 0 1 1-1-1")  # the long way round, with flags apart
    np.testing.assert_allclose(np.hypot(*(large - (0, 0)).T), 1.0, atol=1e-12)
    assert large[:, 0].min() < -0.99
    (joined,) = path_lines("M1 0a1 1 0 11-1-1")
    np.testing.assert_array_equal(joined, large)
    (cubic,) = path_lines("M0 0C0 4 4 4 4 0S8-4 8 0")
    t = np.linspace(0, 1, 25)[12]
    np.testing.assert_allclose(cubic[12], [3 * t**2 * (1 - t) * 4 + t**3 * 4, 3 * t * (1 - t) * 4])
    np.testing.assert_allclose(cubic[36], [6, -3])
    (smooth,) = path_lines("M0 0Q1 2 2 0T4 0")
    np.testing.assert_allclose(smooth[[12, 36]], [[1, 1], [3, -1]])


@pytest.mark.parametrize("bad", ["", "L1 2", "M1", "M1 2 3", "M1 2 L x y", "M1 2 z 5"])
def test_what_is_no_outline_is_refused(bad):
    with pytest.raises(ValueError, match="path"):
        outline_of(f'<svg><path d="{bad}"/></svg>'.encode())
