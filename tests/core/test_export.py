import csv
import io
from pathlib import Path

import numpy as np
import pytest

from skinsource.base.errors import StorageError
from skinsource.base.measurement_conditions import VOLAR_OUTPUTS
from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.engine import shared
from skinsource.engine.prediction import predict
from skinsource.engine.quantities import new_graph, sources
from skinsource.export.tables import export_field, export_levels, export_traces
from skinsource.limbs.limb import Limb, LimbMap
from skinsource.limbs.locations import OUTPUTS
from skinsource.signals.projection import project_axes
from skinsource.signals.spectra import rms

INPUTS = (
    track(location=7, waveform=Noise(seed=3, duration_s=0.1), amplitude=0.1),
    track(location=13, waveform=Tap(), amplitude=-1 / 3, muted=True),
)
MEASURED = Design(limb="measured-2", inputs=INPUTS, scaling="upstream")
VIEW = View(axes="xz", method="soc", outputs=(72, 1, 30))


TEXTS = ("side", "place")


def synthetic_response(place: int) -> np.ndarray:
    return np.random.default_rng(place).standard_normal((72, 3, 522))


@pytest.fixture(autouse=True)
def synthetic_limbs(monkeypatch):
    """Let every name stand for a made-up limb, measured ones included."""

    def load(name: str, digest: str = "") -> Limb:
        nowhere = LimbMap(
            outline=np.zeros((3, 2)),
            output_positions=np.zeros((72, 2)),
            input_positions=np.zeros((20, 2)),
            hand_length_px=1.0,
        )
        return Limb(
            name=name,
            hand_length_mm=175.0,
            synthetic=name.startswith("synthetic"),
            map=nowhere,
            read_response=synthetic_response,
        )

    monkeypatch.setattr(shared, "load_limb", load)
    return load


def read(path: Path) -> tuple[list[str], list[str], np.ndarray]:
    """Comment lines, names of the columns, and the numbers."""
    lines = path.read_text(encoding="utf-8").splitlines()
    about = [line for line in lines if line.startswith("#")]
    names, *rows = csv.reader(io.StringIO("\n".join(lines[len(about) :])))
    width = sum(name not in TEXTS for name in names)
    return about, names, np.array([[float(cell) for cell in row[:width]] for row in rows])


def signal(limb) -> np.ndarray:
    drive = INPUTS[0].clips[0].waveform.samples(1300.0)
    return project_axes(predict(limb, [drive], [7], [0.1]), "xz", "soc")


def test_traces_read_back_exactly(tmp_path, synthetic_limbs):
    path = tmp_path / "traces.csv"
    design = MEASURED
    export_traces(path, design, VIEW)
    _, names, table = read(path)
    assert names == ["time_s", "output_72_m_per_s2", "output_1_m_per_s2", "output_30_m_per_s2"]
    np.testing.assert_array_equal(table[:, 0], np.arange(130 + 521) / 1300.0)
    computed = new_graph().evaluate({"selected_traces"}, sources(design, VIEW))
    np.testing.assert_array_equal(table[:, 1:].T, computed["selected_traces"])
    expected = signal(synthetic_limbs("x"))[[71, 0, 29]]
    np.testing.assert_allclose(table[:, 1:].T, expected, atol=1e-14 * np.abs(expected).max())


def test_levels_read_back_exactly(tmp_path, synthetic_limbs):
    path = tmp_path / "levels.csv"
    export_levels(path, MEASURED, VIEW)
    _, names, table = read(path)
    assert names == ["output", "rms_m_per_s2", "level_db_re_1_m_per_s2", *TEXTS]
    expected = rms(signal(synthetic_limbs("x")))
    np.testing.assert_array_equal(table[:, 0], np.arange(1, 73))
    np.testing.assert_allclose(table[:, 1], expected, rtol=1e-12)
    np.testing.assert_allclose(table[:, 2], 20 * np.log10(expected), rtol=0, atol=1e-12)


def test_pandas_reads_the_tables_without_help(tmp_path):
    pandas = pytest.importorskip("pandas", reason="pandas is not installed")
    path = tmp_path / "levels.csv"
    export_levels(path, MEASURED, VIEW)
    table = pandas.read_csv(path, comment="#")
    np.testing.assert_array_equal(table["output"], np.arange(1, 73))
    np.testing.assert_allclose(table["rms_m_per_s2"], read(path)[2][:, 1], rtol=1e-14)


def test_levels_name_the_places_and_say_what_they_are_the_rms_over(tmp_path):
    path = tmp_path / "levels.csv"
    for span, text in (
        ("record", "whole record (record)"),
        ("loudest", "loudest 100 ms (loudest)"),
    ):
        export_levels(path, MEASURED, View(span=span))
        lines = path.read_text("utf-8").splitlines()
        assert f"# levels: RMS over the {text}" in lines
        rows = list(csv.reader(line for line in lines if not line.startswith("#")))[1:]
        assert [row[4] for row in rows] == [place.name for place in OUTPUTS]
        assert [int(row[0]) for row in rows if row[3] == "palm"] == list(VOLAR_OUTPUTS)
        assert {row[3] for row in rows} == {"back", "palm"}


@pytest.mark.parametrize(("span", "text"), [("record", "whole record"), ("loudest", "100 ms")])
def test_files_without_levels_name_what_levels_are_the_rms_over_too(tmp_path, span, text):
    design, view = Design(limb="synthetic-1", inputs=INPUTS, scaling="upstream"), View(span=span)
    export_traces(tmp_path / "traces.csv", design, view)
    export_field(tmp_path / "field.npz", design, view)
    with np.load(tmp_path / "field.npz") as field:
        of_the_field = str(field["about"]).splitlines()
    of_traces = [line.removeprefix("# ") for line in read(tmp_path / "traces.csv")[0]]
    for about in (of_traces, of_the_field):
        (line,) = [line for line in about if line.startswith("levels: RMS over the ")]
        assert text in line
        assert line.endswith(f"({span})")


def test_silence_has_an_rms_of_0_and_no_level_in_a_table(tmp_path):
    path = tmp_path / "levels.csv"
    export_levels(path, Design(limb="synthetic-1"), View())
    _, _, table = read(path)
    assert not table[:, 1].any()
    assert np.isnan(table[:, 2]).all()
    assert "-200" not in path.read_text("utf-8")
    assert "-inf" not in path.read_text("utf-8")


@pytest.mark.parametrize("export", [export_traces, export_levels])
def test_a_synthetic_limb_is_called_synthetic_in_capitals_and_a_measured_one_is_not(
    tmp_path, export
):
    for limb in ("synthetic-1", "synthetic-4", "measured-1"):
        export(tmp_path / "table.csv", Design(limb=limb, inputs=INPUTS, scaling="upstream"), VIEW)
        about, _, _ = read(tmp_path / "table.csv")
        assert any(limb in line for line in about)
        assert any("SYNTHETIC" in line for line in about) == limb.startswith("synthetic")


def test_the_table_says_how_it_was_made(tmp_path):
    path = tmp_path / "traces.csv"
    export_traces(path, Design(limb="measured-2", inputs=INPUTS, scaling="relative"), VIEW)
    about = "\n".join(read(path)[0])
    for fact in (
        "limb: Measured 2 (165 mm), measured-2",
        "scaling: Equal drives (relative)",
        "axes: x, z (xz); method: Sum of components (soc)",
        "place 7",
        "seed=3",
    ):
        assert fact in about
    assert "place 13" in about
    assert "muted" in about
    assert f"amplitude {-1 / 3!r}" in about


@pytest.mark.parametrize(("removed", "start"), [(True, -0.052), (False, 0.0)])
def test_the_table_says_whether_the_delay_is_in_its_times(tmp_path, removed, start):
    path = tmp_path / "traces.csv"
    view = View(outputs=(1,), delay_removed=removed)
    export_traces(path, MEASURED, view)
    about, _, table = read(path)
    assert any(f"52 ms: {'removed' if removed else 'contained'}" in line for line in about)
    assert table[0, 0] == start


def test_a_single_axis_has_no_method(tmp_path):
    path = tmp_path / "traces.csv"
    export_traces(
        path,
        MEASURED,
        View(axes="z", method="pca"),
    )
    assert not any("pca" in line for line in read(path)[0])


def test_no_outputs_give_the_times_alone(tmp_path):
    path = tmp_path / "traces.csv"
    export_traces(path, Design(limb="measured-2"), View(outputs=()))
    _, names, table = read(path)
    assert names == ["time_s"]
    assert table.shape == (522, 1)


def test_a_failing_export_leaves_the_old_table(tmp_path):
    path = tmp_path / "table.csv"
    path.write_text("old")
    with pytest.raises(StorageError):
        export_levels(tmp_path / "nowhere" / "table.csv", Design(limb="measured-1"), View())
    assert path.read_text() == "old"


@pytest.mark.parametrize("place", [7, 2])
def test_the_table_of_levels_names_the_loudest_output_that_was_checked(tmp_path, place):
    path, tap = tmp_path / "levels.csv", track(location=place, waveform=Tap())
    export_levels(path, Design(limb="synthetic-1", inputs=(tap,)), VIEW)
    about, _, numbers = read(path)
    loudest = numbers[np.argmax(numbers[:, 1]), 0]
    checked = [line for line in about if "the loudest" in line]
    assert len(checked) == 1
    assert f"the traces of output {loudest:.0f}, the loudest" in checked[0]


def test_what_is_noted_of_a_limb_stands_in_every_export(tmp_path, monkeypatch, synthetic_limbs):
    def load(name: str, digest: str = "") -> Limb:
        limb = synthetic_limbs(name)
        limb.note = "made from files that are not the published ones: impulseResponses.mat"
        return limb

    monkeypatch.setattr(shared, "load_limb", load)
    for export in (export_levels, export_traces):
        export(
            tmp_path / "table.csv",
            Design(limb="measured-1", inputs=INPUTS, scaling="upstream"),
            VIEW,
        )
        about, _, _ = read(tmp_path / "table.csv")
        assert any("not the published ones: impulseResponses.mat" in line for line in about)
