"""The figures of the scenes as files, and what is in them."""

import csv
import re

import numpy as np
import pytest

import skinsource as ss
from skinsource.commands.command_line import main
from skinsource.errors import InvalidInputError, StorageError
from skinsource.figures import FIGURES, write_figures
from skinsource.figures.check_figures import banded, correlation, lines_of
from skinsource.limb import BAND_HZ


def table(path):
    """Comment lines, names of the columns, and rows of numbers."""
    lines = path.read_text("utf-8").splitlines()
    about = [line for line in lines if line.startswith("#")]
    rows = list(csv.reader(line for line in lines if not line.startswith("#")))
    return about, rows[0], np.array(rows[1:], float)


def test_every_scene_has_a_figure():
    assert tuple(FIGURES) == ss.scenes.names()


@pytest.mark.parametrize("name", list(FIGURES))
def test_each_figure_is_written_as_picture_pages_and_numbers(name, tmp_path):
    written = write_figures(tmp_path, [name])
    assert {path.suffix for path in written} == {".png", ".svg", ".pdf", ".csv"}
    assert sorted(tmp_path.iterdir()) == sorted(written)
    known = ss.scenes.scene(name)
    drawing = (tmp_path / f"{name}.svg").read_text("utf-8")
    words = " ".join(re.findall(r"<text[^>]*>(.*?)</text>", drawing))
    assert known.heading in words
    assert "SYNTHETIC LIMB" in words
    assert f"Fig. {name}." in words
    assert ("Inferred: " in words) == bool(known.inferred)
    for path in written:
        if path.suffix == ".csv":
            about, header, rows = table(path)
            assert rows.shape[1] == len(header)
            assert np.isfinite(rows).all()
            assert any("SYNTHETIC" in line for line in about)
            assert sum(line.startswith("# inferred:") for line in about) == len(known.inferred)
    assert (tmp_path / f"{name}.png").read_bytes().startswith(b"\x89PNG")
    assert (tmp_path / f"{name}.pdf").read_bytes().startswith(b"%PDF")


def test_the_same_data_give_the_same_files(tmp_path):
    for folder in ("a", "b"):
        (tmp_path / folder).mkdir()
        write_figures(tmp_path / folder, ["2F"])
    for path in (tmp_path / "a").iterdir():
        assert path.read_bytes() == (tmp_path / "b" / path.name).read_bytes(), path.name


def test_figure_2f_on_the_measured_limbs_holds_the_known_numbers(measured, tmp_path):
    write_figures(tmp_path, ["2F"])
    about, header, rows = table(tmp_path / "2F.csv")
    assert not any("SYNTHETIC" in line for line in about)
    assert "# limb: Measured 3 (185 mm) (measured-3)" in about
    # The table holds a part of the record: the energy outside it is next to nothing.
    n_times = 65 + 521
    for output, known in ((19, 0.0240), (21, 0.3570)):
        both = rows[:, header.index(f"output_{output}_Both_m_per_s2")]
        assert np.sqrt(np.sum(both**2) / n_times) == pytest.approx(known, abs=2e-3)


def test_figure_2h_on_the_measured_limb_holds_the_known_extents(measured, tmp_path):
    write_figures(tmp_path, ["2h"])
    _, header, rows = table(tmp_path / "2H.csv")
    known = [31.9, 27.9, 23.4, 18.8, 17.0]
    np.testing.assert_allclose(rows[:, header.index("mean_distance_mm")], known, atol=0.5)


def test_figure_2b_on_the_measured_limb_holds_the_known_levels(measured, tmp_path):
    write_figures(tmp_path, ["2B"])
    _, header, rows = table(tmp_path / "2B.csv")
    assert header[0] == "output"
    np.testing.assert_allclose(rows[:, 1:].max(axis=0), [-7.3, -6.2, -6.2, -6.2], atol=0.0501)
    medians = np.median(rows[:42, 1:], axis=0)
    np.testing.assert_allclose(medians, [-20.5, -26.1, -36.1, -46.4], atol=0.0501)


def test_a_band_holds_the_rms_of_its_bins():
    rate_hz, n = 1300.0, 2600
    time_s = np.arange(n) / rate_hz
    tone = np.sin(2 * np.pi * 100.0 * time_s)
    frequency, magnitude = banded(tone[None], n, rate_hz, BAND_HZ)
    # Bins lie at 0, 0.5, 1, … Hz; the band from 99 to 101 Hz holds four of them, one of them 1/2.
    assert frequency[np.argmax(magnitude[0])] == pytest.approx(100.0)
    assert magnitude[0].max() == pytest.approx(np.sqrt(0.5**2 / 4))
    assert np.sort(magnitude[0])[-2] < 1e-10


def test_lines_are_those_of_least_squares():
    opened = ss.scenes.open_scene("5D", available=())
    fits = lines_of(opened)
    x, y = fits.played[:, 37], fits.felt[:, 19, 37]
    slope, offset = np.polyfit(x, y, 1)
    assert fits.slope[19, 37] == pytest.approx(slope)
    assert fits.offset[19, 37] == pytest.approx(offset, abs=1e-12)
    assert fits.adjusted_r2.min() > 1.0 - 1e-9
    assert fits.slope[:, 10].std() > 0.0


def test_the_correlation_is_that_of_pearson():
    random = np.random.default_rng(5)
    a, b = random.standard_normal((2, 4, 50))
    b += 0.7 * a + 3.0
    found = correlation(a, b)
    expected = [np.corrcoef(one, other)[0, 1] for one, other in zip(a, b, strict=True)]
    np.testing.assert_allclose(found, expected, rtol=1e-12)


def test_a_folder_that_is_not_there_is_no_place_for_figures(tmp_path):
    with pytest.raises(StorageError, match="is no folder"):
        write_figures(tmp_path / "nowhere", ["2F"])
    with pytest.raises(InvalidInputError, match="does not exist"):
        write_figures(tmp_path, ["3A"])
    assert list(tmp_path.iterdir()) == []


def test_the_command_writes_what_is_named_and_says_where(tmp_path, capsys):
    assert main(["figures", "--out", str(tmp_path), "--only", "1E"]) == 0
    told = capsys.readouterr()
    assert told.out.split() == [
        str(tmp_path / f"1E.{kind}") for kind in ("png", "svg", "pdf", "csv")
    ]
    assert "SYNTHETIC" in told.err
    assert main(["figures", "--out", str(tmp_path / "no"), "--only", "1E"]) == 1
    assert "is no folder" in capsys.readouterr().err
