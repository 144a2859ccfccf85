"""Maps of differences, films, and tables for pandas."""

import subprocess
import sys

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import InvalidInputError, MissingExtraError
from skinsource.cli.command_line import main
from skinsource.export import plot

TONE = ss.waveforms.Tone(frequency_hz=150.0, duration_s=0.03)
DESIGN = ss.Design(limb="synthetic-1", inputs=(ss.track(7, TONE),))
OTHER = DESIGN.with_input(0, location=8)
SHORT = ss.View(delay_removed=True, time_range_s=(0.0, 0.01))


def levels_of(design):
    return ss.evaluate(design, "output_levels_db")["output_levels_db"]


def image_and_label(figure):
    ax, bar = figure.axes
    return ax.images[0], bar.get_ylabel()


def test_differences_diverge_by_themselves():
    difference = levels_of(DESIGN) - levels_of(OTHER)
    image, label = image_and_label(ss.plot.map(difference, limb="synthetic-1"))
    largest = np.abs(difference).max()
    assert image.get_clim() == (-largest, largest)
    assert image.get_cmap().name == "RdBu_r"
    assert label == "difference (dB)"


def test_levels_do_not_diverge():
    # Levels of a finger above 1 m/s², as they come from `predict`.
    levels_db = levels_of(DESIGN) + 20.0
    assert levels_db.max() > 0.0
    image, label = image_and_label(ss.plot.map(levels_db, limb="synthetic-1"))
    assert image.get_cmap().name == "viridis"
    assert label == "dB re 1 m/s²"


def test_range_label_and_colours_are_those_that_are_asked_for():
    values = np.linspace(0.0, 3.0, 72)
    figure = ss.plot.map(
        values, limb="synthetic-1", range_db=(-4.0, 4.0), label="gain (dB)", colours="diverging"
    )
    image, label = image_and_label(figure)
    assert (image.get_clim(), image.get_cmap().name, label) == ((-4.0, 4.0), "RdBu_r", "gain (dB)")
    difference = levels_of(DESIGN) - levels_of(OTHER)
    figure = ss.plot.map(difference, limb="synthetic-1", colours="sequential", outputs=[19])
    assert image_and_label(figure)[0].get_cmap().name == "viridis"
    with pytest.raises(InvalidInputError, match="choose from sequential, diverging"):
        ss.plot.map(DESIGN, colours="rainbow")


def frames_of(path):
    """Frames of a film in grey, (n_frames, height, width), 64 by 64 each."""
    encoder = pytest.importorskip("imageio_ffmpeg").get_ffmpeg_exe()
    grey = ("-vf", "scale=64:64", "-f", "rawvideo", "-pix_fmt", "gray", "-")
    words = [encoder, "-v", "error", "-i", str(path), *grey]
    decoded = subprocess.run(words, capture_output=True, check=True, timeout=60).stdout
    return np.frombuffer(decoded, np.uint8).reshape(-1, 64, 64)


def test_a_film_begins_before_the_stimulus_where_the_view_does(tmp_path):
    view = ss.View(delay_removed=True, time_range_s=(-0.0005, 0.001))
    frames = frames_of(ss.plot.film(DESIGN, tmp_path / "wave.mp4", view=view))
    assert len(frames) == 2


def test_a_film_shows_each_instant_with_rings_at_the_inputs(tmp_path, monkeypatch):
    shots = []
    shot_class = plot._Shot
    monkeypatch.setattr(plot, "_Shot", lambda *args: shots.append(shot_class(*args)) or shots[0])
    path = ss.plot.film(DESIGN, tmp_path / "wave.mp4", view=SHORT)
    frames = frames_of(path)
    assert len(frames) == 13  # 10 ms, 20 times slower, 60 frames a second
    assert not np.array_equal(frames[2], frames[-1])
    (shot,) = shots
    limb = ss.load_limb("synthetic-1")
    rings = [(line.get_xdata()[0], line.get_ydata()[0]) for line in shot._ax.lines]
    assert any(np.allclose(point, limb.input_positions_mm[6]) for point in rings)
    # Sample 80 of the response lies on the time axis at this instant.
    shot.frame(80 / 1300.0 - limb.pre_trigger_delay_s)
    view = ss.View(axes="z", outputs=tuple(range(1, 73)))
    traces = ss.evaluate(DESIGN, "selected_traces", view=view)["selected_traces"]
    surface = ss.surface_operator(limb)
    drawn, inside = shot._image.get_array()[surface.mask], surface.interpolate(traces[:, 80])
    np.testing.assert_allclose(drawn, inside[surface.mask], atol=1e-9)
    moving = shot._moving(0.0)
    assert shot._image.get_clim() == (-moving.largest / 4, moving.largest / 4)


@pytest.mark.parametrize(
    ("name", "arguments", "message"),
    [
        ("wave.avi", {}, r"expected a name that ends in \.mp4, \.webm, \.gif"),
        ("wave.mp4", {"slow_motion": 5.0}, "expected at least 20"),
        ("wave.mp4", {"slow_motion": 2000.0, "view": ss.View()}, "expected at most 36000"),
        ("wave.mp4", {"quantity": "x"}, "choose from z, magnitude"),
        ("wave.mp4", {"limit": -1.0}, "expected a positive number"),
        ("wave.mp4", {"view": ss.View(time_range_s=(5.0, 5.01))}, "expected times between 0 and"),
        ("wave.mp4", {"view": ss.View(time_range_s=(-2.0, -1.0))}, "expected times between 0 and"),
    ],
)
def test_a_film_that_cannot_be_is_refused(tmp_path, name, arguments, message):
    with pytest.raises(InvalidInputError, match=message):
        ss.plot.film(DESIGN, tmp_path / name, **arguments)
    assert not list(tmp_path.iterdir())


def test_the_command_films_a_design(tmp_path, capsys):
    ss.save_design(tmp_path / "a.skinsource", DESIGN, SHORT)
    out = tmp_path / "new" / "wave.gif"
    words = ("--quantity", "magnitude", "--slow-motion", "50")
    assert main(["film", str(tmp_path / "a.skinsource"), "--out", str(out), *words]) == 0
    assert capsys.readouterr().out == f"{out}\n"
    assert len(frames_of(out)) == 26


def test_a_sweep_is_a_table_of_pandas(monkeypatch):
    table = ss.sweep(DESIGN, {"location": [7, 8]})
    frame = table.to_dataframe()
    assert list(frame.index) == [1, 2]
    assert list(frame["location"]) == [7, 8]
    np.testing.assert_array_equal(frame["rms"], table.column("rms"))
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(MissingExtraError, match=r"pip install .*\[pandas\]"):
        table.to_dataframe()


def test_a_sweep_says_how_many_outputs_are_mostly_noise(synthetic_installed):
    table = ss.sweep(ss.Design(limb="measured-1", inputs=DESIGN.inputs), {"location": [7, 17]})
    expected = []
    for location in (7, 17):
        design = ss.Design(limb="measured-1", inputs=(ss.track(location, TONE),))
        (noise,) = (
            finding
            for finding in ss.evaluate(design, "validity")["validity"]
            if finding.name == "noise"
        )
        expected.append(len(noise.outputs))
    assert table.column("outputs_in_noise").tolist() == expected
    assert np.isnan(ss.sweep(DESIGN).column("outputs_in_noise")).all()
