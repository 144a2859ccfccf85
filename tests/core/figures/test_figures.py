"""The figures of the scenes as files, on limbs of a lab too: what is in them, and their scales."""

import re

import numpy as np
import pytest
from scipy import signal

import skinsource as ss
from skinsource.base.errors import InvalidInputError
from skinsource.cli.command_line import main
from skinsource.engine import evaluation
from skinsource.studies.figures import writing
from skinsource.studies.figures.figures import FIGURES, swept_hz
from skinsource.studies.figures.writing import draw_figure, write_figures
from tests.core.exporting.export_bench import commented
from tests.core.own_limbs.lab_bench import N_OUTPUTS, installed, keep

#: Scenes that leave the condition on the spacing of outputs, and whether their figures show maps.
SPACED = {"1C": True, "2B": True, "1D": False, "2D": False, "5F": False}


def table(path):
    """Lines about the content, names of the columns, and rows of numbers."""
    about, names, rows = commented(path)
    return about, names, np.array(rows, float)


def test_every_scene_has_a_figure():
    assert tuple(FIGURES) == ss.scenes.names()


@pytest.mark.parametrize("name", list(FIGURES))
def test_each_figure_is_written_as_picture_and_numbers(name, tmp_path, monkeypatch):
    monkeypatch.setattr(writing, "METADATA", {"svg": writing.METADATA["svg"]})
    written = write_figures(tmp_path, [name])
    assert {path.suffix for path in written} == {".svg", ".csv"}
    assert sorted(tmp_path.iterdir()) == sorted(written)
    known = ss.scenes.scene(name)
    drawing = (tmp_path / f"{name}.svg").read_text("utf-8")
    text = " ".join(re.findall(r"<text[^>]*>(.*?)</text>", drawing))
    assert known.heading in text
    assert "SYNTHETIC LIMB" in text
    assert f"After {known.source}." in text
    assert ("Inferred: " in text) == bool(known.inferred)
    # What lies between outputs is told below maps and nowhere else.
    if name in SPACED:
        assert ("spacing" in text) == SPACED[name]
    for path in written:
        if path.suffix == ".csv":
            about, header, rows = table(path)
            assert rows.shape[1] == len(header)
            assert np.isfinite(rows).all()
            assert any("SYNTHETIC" in line for line in about)
            assert sum(line.startswith("inferred:") for line in about) == len(known.inferred)
            if name in SPACED:
                assert any("spacing of the outputs" in line for line in about) == SPACED[name]


def test_the_same_data_give_the_same_files(tmp_path):
    for folder in ("a", "b"):
        (tmp_path / folder).mkdir()
        write_figures(tmp_path / folder, ["2F"])
    assert (tmp_path / "a" / "2F.png").read_bytes().startswith(b"\x89PNG")
    assert (tmp_path / "a" / "2F.pdf").read_bytes().startswith(b"%PDF")
    for path in (tmp_path / "a").iterdir():
        assert path.read_bytes() == (tmp_path / "b" / path.name).read_bytes(), path.name


def test_the_sum_that_figure_5f_shows_is_of_what_each_input_causes_alone():
    table = draw_figure(ss.scenes.open_scene("5F", available=())).tables
    columns = table[""]
    for output in (20, 26):
        separate = columns[f"output_{output}_z_separate_m_per_s2"]
        joint = columns[f"output_{output}_z_joint_m_per_s2"]
        assert np.abs(joint).max() > 0.1
        np.testing.assert_allclose(separate, joint, rtol=0, atol=1e-12 * np.abs(joint).max())
    assert table["-correlation"]["pearson_r"].min() > 1.0 - 1e-9


def test_frames_of_figure_4a_are_a_quarter_of_a_cycle_apart():
    opened = ss.scenes.open_scene("4A", available=())
    shown = draw_figure(opened).tables[""]
    at_ms = [float(name.split()[2]) for name in list(shown)[1:]]
    quarters = 100.0 + np.arange(5) * 1e3 / (4 * 104.0)
    np.testing.assert_allclose(at_ms, quarters, atol=1e-3)
    view = ss.View(axes="z", outputs=tuple(range(1, 73)))
    values = ss.evaluate(opened.design, "response_time_s", "selected_traces", view=view)
    time_s = values["response_time_s"]
    finer, finer_s = signal.resample(values["selected_traces"], 100 * time_s.size, time_s, axis=1)
    at = np.searchsorted(finer_s, 1e-3 * quarters[2])
    np.testing.assert_allclose(list(shown.values())[3], finer[:, at], rtol=0, atol=0.002)


def test_figures_say_on_which_limb_and_which_conditions_are_not_kept(measured, tmp_path):
    write_figures(tmp_path, ["2B"])
    about, _, _ = table(tmp_path / "2B.csv")
    drawing = (tmp_path / "2B.svg").read_text("utf-8")
    assert "Limb: Measured 1 (175 mm). Scaling: Peak of each input." in drawing
    assert "not met (see the table): noise, scaling, spacing." in drawing
    assert "Hatched: less than 6 dB above the noise of the measurement." in drawing
    of_noise = [line for line in about if "validity, noise: CAUTION" in line]
    assert [line.split(":")[0] for line in of_noise] == [
        f"{frequency} Hz" for frequency in (50, 100, 200, 400)
    ]
    # What holds of all designs is said once.
    assert sum("validity, scaling: CAUTION" in line for line in about) == 1


def test_the_command_writes_what_is_named_and_says_where(tmp_path, capsys):
    assert main(["figures", "--out", str(tmp_path / "new"), "--only", "1E"]) == 0
    printed = capsys.readouterr()
    assert printed.out.split() == [
        str(tmp_path / "new" / f"1E.{kind}") for kind in ("png", "svg", "pdf", "csv")
    ]
    assert "SYNTHETIC" in printed.err


def table_of(name):
    opened = ss.scenes.open_scene(name, available=())
    return opened, draw_figure(opened).tables[""]


def test_maps_of_axes_are_relative_to_the_loudest_of_all_of_them():
    _, columns = table_of("1E")
    loudest = sorted(levels.max() for name, levels in columns.items() if name != "output")
    assert loudest[-1] == 0.0
    assert loudest[0] < -0.1


def test_maps_of_places_are_relative_to_the_loudest_of_each():
    _, columns = table_of("1F")
    assert [levels.max() for name, levels in columns.items() if name != "output"] == [0.0] * 3


def test_an_output_that_is_silent_has_no_level_in_the_table_of_a_figure(user_data):
    responses = np.random.default_rng(2).normal(size=(7, 5, 3, 60))
    responses[:, 1] = 0.0
    keep("deaf", responses)
    # What an earlier test evaluated was read from a folder that is gone.
    evaluation._evaluator.cache_clear()
    for name in ("1F", "2B"):
        table = draw_figure(ss.scenes.open_scene(name, limb="deaf")).tables[""]
        levels = np.column_stack(list(table.values()))[:, 1:]
        assert np.isnan(levels[1]).all()
        assert np.isfinite(np.delete(levels, 1, axis=0)).all()


def test_spectra_of_noise_are_means_over_ten_bins():
    opened, columns = table_of("2D")
    raw_hz, raw = ss.evaluate(opened.design, "selected_spectra", view=opened.view)[
        "selected_spectra"
    ]
    smooth = columns["output_1_x_m_per_s2"]
    at = int(np.searchsorted(raw_hz, columns["frequency_hz"][200]))
    means = [raw[0, at + shift - 5 : at + shift + 5].mean() for shift in (0, 1)]
    assert np.isclose(smooth[200], means, rtol=1e-9).any()


BAND = (40.0, 1500.0)


def on_lab(name):
    """A scene on the limb of the lab."""
    return ss.scenes.open_scene(name, limb="lab-1")


def test_a_pulse_is_shown_as_late_as_the_limb_answers_along_the_axes_that_it_has(user_data):
    installed(band_hz=BAND)
    drawn = draw_figure(on_lab("1C"))
    at_ms = [float(name.split("_")[0]) for name in list(drawn.tables["-frames"])[1:]]
    # Not 52 ms and later, and at 4 kHz.
    assert at_ms == pytest.approx([2.0, 2.75, 3.5, 4.25, 5.0], abs=0.251)
    assert {name.split("_")[2] for name in list(drawn.tables[""])[1:]} == {"x", "z"}
    assert drawn.tables["-frames"]["output"].size == N_OUTPUTS
    titles = list(draw_figure(on_lab("1E")).tables[""])[1:]
    assert [title.partition(" (")[0] for title in titles] == ["Along x", "Along z"]
    frames = list(draw_figure(on_lab("4A")).tables[""])[1:]
    assert float(frames[0].split()[2]) == pytest.approx(50.0, abs=0.13)


def test_spectra_go_over_the_band_of_the_limb(user_data):
    installed(band_hz=BAND)
    hz = draw_figure(on_lab("1D")).tables[""]["frequency_hz"]
    assert hz.min() == pytest.approx(40.0, abs=25.0)
    assert hz.min() >= 40.0
    assert 1450.0 < hz.max() <= 1500.0
    installed()
    hz = draw_figure(on_lab("1D")).tables[""]["frequency_hz"]
    assert (hz.min(), hz.max()) == (0.0, pytest.approx(2000.0, abs=25.0))


def test_lines_are_fitted_where_the_sweep_goes_and_the_limb_was_measured(user_data):
    installed(band_hz=BAND)
    assert swept_hz(on_lab("5E")) == (40.0, 600.0)
    fits = draw_figure(on_lab("5E")).tables[""]
    hz = fits.pop("frequency_hz")
    assert (hz.min(), hz.max()) == (41.0, 599.0)
    assert len(fits) == N_OUTPUTS
    assert min(fit.min() for fit in fits.values()) > 1.0 - 1e-9
    installed()
    assert swept_hz(on_lab("5E")) == (25.0, 600.0)
    installed(band_hz=(599.0, 1500.0))
    with pytest.raises(InvalidInputError, match=r"25 to 600 Hz, and the limb 'lab-1' was measured"):
        draw_figure(on_lab("5D"))
