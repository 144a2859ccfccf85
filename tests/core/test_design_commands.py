"""``skinsource show`` and ``skinsource render``."""

import numpy as np
import pytest
from PIL import Image

import skinsource as ss
from skinsource.cli.command_line import main
from skinsource.export.tables import picture_of, write_png


@pytest.fixture
def saved(tmp_path):
    """Save a design; give its path."""
    tone = ss.track(location=7, waveform=ss.waveforms.Tone(frequency_hz=100.0), amplitude=0.5)
    tap = ss.track(location=13, waveform=ss.waveforms.Tap(), muted=True)
    design = ss.Design(
        limb="synthetic-1", inputs=(tone, tap), title="A \x1b[2J title", notes="one\ntwo"
    )
    path = tmp_path / "scene.skinsource"
    ss.save_design(path, design, ss.View(outputs=(29, 52)))
    return path


def read_png(path) -> tuple[np.ndarray, str]:
    """Pixels and text of a picture."""
    with Image.open(path) as image:
        return np.asarray(image), "".join(image.text.values())


def test_show_says_what_is_in_a_design_and_its_levels(saved, capsys):
    assert main(["show", str(saved)]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    assert "title     A \\x1b[2J title\n" in out
    assert "notes     one\nnotes     two\n" in out
    assert "limb      Synthetic 1 (175 mm)" in out
    assert "SYNTHETIC" in out
    # The conditions that are not kept, in short.
    assert out.count("\nCAUTION   ") == 1
    assert "inputs    2, 1 of them heard" in out
    assert "place 7, Digit II, pad: amplitude" in out
    assert "from 0 s: Tone(frequency_hz=100.0" in out
    assert ", muted\n" in out
    content = ss.open_design(saved)
    levels = ss.evaluate(content.design, "output_levels_db")["output_levels_db"]
    rows = [line.split() for line in out.splitlines()[-72:]]
    assert [int(row[0]) for row in rows] == list(range(1, 73))
    assert [float(row[1]) for row in rows] == [round(level, 1) + 0.0 for level in levels]


def test_render_writes_levels_traces_map_and_picture(saved, tmp_path, capsys):
    folder = tmp_path / "new" / "out"
    assert main(["render", str(saved), "--out", str(folder)]) == 0
    names = ["levels.csv", "map.csv", "map.png", "traces.csv"]
    assert sorted(path.name for path in folder.iterdir()) == names
    assert capsys.readouterr().out.split() == [str(folder / name) for name in names]
    content = ss.open_design(saved)
    values = ss.evaluate(content.design, "surface", "surface_levels_db", view=content.view)
    expected, surface = values["surface_levels_db"], values["surface"]
    table = np.loadtxt(folder / "map.csv", delimiter=",", comments=("#", "y"))
    np.testing.assert_array_equal(table[:, 0], surface.y_mm)
    np.testing.assert_array_equal(table[:, 1:], expected)
    pixels, text = read_png(folder / "map.png")
    top_db = np.nanmax(expected)
    np.testing.assert_array_equal(pixels, picture_of(expected, top_db))
    assert "SYNTHETIC LIMB" in text
    assert f"to {top_db:.1f} (lightest) dB" in text


def test_a_map_of_silence_has_no_levels_and_without_selected_outputs_there_are_no_traces(tmp_path):
    silent, folder = tmp_path / "silent.skinsource", tmp_path / "out"
    ss.save_design(silent, ss.Design(limb="synthetic-1"), ss.View(outputs=()))
    assert main(["render", str(silent), "--out", str(folder)]) == 0
    assert not (folder / "traces.csv").exists()
    table = np.loadtxt(folder / "map.csv", delimiter=",", comments=("#", "y"))
    assert np.isfinite(table[:, 0]).all()
    assert np.isnan(table[:, 1:]).all()


def test_a_picture_has_its_highest_row_first_and_white_where_there_is_no_skin(tmp_path):
    levels_db = np.array([[np.nan, -10.0], [-60.0, -200.0], [-9.9, -35.0]])
    pixels = picture_of(levels_db, -10.0)[::3, ::3].astype(int)
    assert pixels[2, 0].tolist() == [255, 255, 255]
    lightness = pixels.sum(axis=-1)
    assert lightness[2, 1] == lightness[0, 0]  # the top, and what is above it
    assert (pixels[1, 0] == pixels[1, 1]).all()  # the bottom, and what is below it
    assert lightness[1, 0] < lightness[0, 1] < lightness[2, 1]
    path = tmp_path / "map.png"
    with path.open("wb") as file:
        write_png(file, pixels.astype(np.uint8), {})
    np.testing.assert_array_equal(read_png(path)[0], pixels)


def test_silence_is_shown_as_silent(tmp_path, capsys):
    quiet = ss.Design(limb="synthetic-1", inputs=(ss.track(7, amplitude=0.0),))
    ss.save_design(tmp_path / "a.skinsource", quiet)
    assert main(["show", str(tmp_path / "a.skinsource")]) == 0
    said = capsys.readouterr().out
    assert said.count("silent") == 72
    assert "-200" not in said
