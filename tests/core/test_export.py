"""Tables and fields of designs: what was computed, how, how wrong, and whole or not at all."""

import hashlib
import os
import re
import shutil
import tracemalloc
from dataclasses import replace
from itertools import count
from zipfile import ZIP_STORED, ZipFile

import numpy as np
import pytest
import scipy

import skinsource as ss
from skinsource import Design, View, track
from skinsource.base.conventions import VOLAR_OUTPUTS
from skinsource.base.errors import Stopped, StorageError, TooInaccurateError
from skinsource.design.waveforms import Noise, Tap, Tone
from skinsource.engine import shared, trace_rules
from skinsource.engine.gains import TraceError
from skinsource.engine.streaming import StreamedVibration
from skinsource.engine.transforms import BLOCK_FFT
from skinsource.export import exported_design
from skinsource.export.tables import export_field, export_levels, export_traces, export_windows
from skinsource.limbs.locations import OUTPUTS
from tests.core.exporting.export_bench import commented

SHORT = Design(
    limb="synthetic-2",
    inputs=(
        track(location=7, waveform=Noise(seed=3, duration_s=0.1), amplitude=0.1),
        track(location=13, waveform=Tap(), amplitude=-1 / 3, onset_s=0.2),
        track(location=2, waveform=Tone(), muted=True),
    ),
)
# Silence lies between the inputs.
LONG = SHORT.with_clip(2, onset_s=16.0)
N_LONG = 16 * 1300 + 21 + 521
VIEW = View(axes="xz", method="pca", outputs=(72, 1, 30))
EXPORTS = {
    "traces.csv": export_traces,
    "levels.csv": export_levels,
    "windows.csv": export_windows,
    "field.npz": export_field,
}
DESIGNS = pytest.mark.parametrize("design", [SHORT, LONG], ids=["at once", "streamed"])
NAMES = pytest.mark.parametrize("name", EXPORTS)


def about(path) -> list[str]:
    """Lines about the content."""
    if path.suffix == ".npz":
        with np.load(path, allow_pickle=False) as archive:
            return str(archive["about"]).splitlines()
    return commented(path)[0]


def field_of(path) -> np.ndarray:
    with np.load(path, allow_pickle=False) as archive:
        assert archive["sample_rate_hz"] == 1300.0
        return archive["acceleration_m_per_s2"]


def figures(lines: list[str]) -> tuple[float, float]:
    """Estimate and bound of the error."""
    text = "\n".join(lines)
    match = re.search(r"error of .*: about (\S+) \(.*\), at most (\S+) \(theory\)", text)
    assert match, text
    return float(match[1]), float(match[2])


@DESIGNS
def test_tables_and_fields_read_back_as_what_is_computed(tmp_path, design):
    for name, export in EXPORTS.items():
        export(tmp_path / name, design, VIEW)
    names = ("selected_traces", "response_time_s", "output_rms", "rms_of_windows", "axis_traces")
    values = ss.evaluate(design, *names, "extents_of_windows", view=VIEW)
    _, columns, rows = commented(tmp_path / "traces.csv")
    assert columns == ["time_s", *(f"output_{number}_m_per_s2" for number in VIEW.outputs)]
    table = np.array(rows, float)
    np.testing.assert_array_equal(table[:, 0], values["response_time_s"])
    np.testing.assert_array_equal(table[:, 1:].T, values["selected_traces"])
    _, columns, rows = commented(tmp_path / "levels.csv")
    assert columns == ["output", "rms_m_per_s2", "level_db_re_1_m_per_s2", "side", "place"]
    table = np.array([row[:3] for row in rows], float)
    np.testing.assert_array_equal(table[:, 0], np.arange(1, 73))
    np.testing.assert_array_equal(table[:, 1], values["output_rms"])
    np.testing.assert_allclose(table[:, 2], 20 * np.log10(table[:, 1]), rtol=0, atol=1e-12)
    assert [row[4] for row in rows] == [place.name for place in OUTPUTS]
    assert [int(row[0]) for row in rows if row[3] == "palm"] == list(VOLAR_OUTPUTS)
    _, columns, rows = commented(tmp_path / "windows.csv")
    assert columns[:4] == ["from_s", "to_s", "mean_distance_mm", "d90_mm"]
    table = np.array(rows, float)
    np.testing.assert_array_equal(table[:, 7:], values["rms_of_windows"])
    distances = [extent and extent.mean_distance_mm for extent in values["extents_of_windows"]]
    np.testing.assert_array_equal(table[:, 2], np.array(distances, float))
    field, every = field_of(tmp_path / "field.npz"), tuple(range(1, 73))
    expected = ss.evaluate(design, "axis_traces", view=View(axes="xyz", outputs=every))
    np.testing.assert_array_equal(field, expected["axis_traces"])
    assert not field[..., 131 + 521 : 16 * 1300].any() or design is SHORT


@DESIGNS
@pytest.mark.parametrize("scaling", ["upstream", "probe"])
@NAMES
def test_exports_say_what_was_computed_how_and_how_wrong_it_can_be(tmp_path, name, design, scaling):
    view = replace(VIEW, span="loudest")
    EXPORTS[name](tmp_path / name, replace(design, scaling=scaling), view)
    lines, digest = about(tmp_path / name), hashlib.sha256()
    for place in (7, 13):
        digest.update(ss.load_limb("synthetic-2").response_to(place).tobytes())
    method = "cached spectra" if design is SHORT else f"overlap-save {BLOCK_FFT}"
    for fact in (
        f"skinsource {ss.__version__}, numpy {np.__version__}, scipy {scipy.__version__}",
        f"precision and method: float64, {method}",
        "inputs heard: 2 of 3",
        "SYNTHETIC",
        "limb: Synthetic 2",
        f"({scaling})",
        f"responses to places 7, 13: SHA-256 {digest.hexdigest()}",
        f"input at place 13: amplitude {-1 / 3!r}",
        ", muted",
        "seed=3",
        *(() if name == "windows.csv" else ("levels: RMS over the loudest 100 ms (loudest)",)),
        *(() if name == "field.npz" else ("axes: x, z (xz); method: ",)),
    ):
        assert any(fact in line for line in lines), fact
    estimate, bound = figures(lines)
    assert 0.0 < estimate <= 1e-14
    assert estimate < bound < 1e-10
    if name == "levels.csv":
        loudest = np.argmax([float(row[1]) for row in commented(tmp_path / name)[2]]) + 1
        assert any(f"the traces of output {loudest}, the loudest" in line for line in lines)


def test_a_table_says_whether_the_delay_is_in_its_times_and_a_single_axis_has_no_method(tmp_path):
    path = tmp_path / "traces.csv"
    for removed, start in ((True, -0.052), (False, 0.0)):
        export_traces(path, SHORT, View(axes="z", method="pca", delay_removed=removed))
        words = f"52 ms: {'removed' if removed else 'contained'}"
        assert any(words in line for line in about(path))
        assert not any("pca" in line for line in about(path))
        assert float(commented(path)[2][0][0]) == start


def test_a_measured_limb_is_not_called_synthetic_and_its_note_stands_in_every_export(
    tmp_path, monkeypatch
):
    limb = ss.load_limb("synthetic-1")
    limb.synthetic, limb.note = False, "made from files that are not the published ones"
    monkeypatch.setattr(shared, "load_limb", lambda *_: limb)
    for name, export in EXPORTS.items():
        export(tmp_path / name, SHORT, VIEW)
        lines = about(tmp_path / name)
        assert not any("SYNTHETIC" in line for line in lines)
        assert any("NOTE on the limb: made from files" in line for line in lines)


def test_silence_has_an_rms_of_0_and_no_level_and_no_extent_in_a_table(tmp_path):
    for name, export in EXPORTS.items():
        export(tmp_path / name, Design(limb="synthetic-1"), View(outputs=()))
        assert any("there is nothing to check" in line for line in about(tmp_path / name))
    table = np.array([row[:3] for row in commented(tmp_path / "levels.csv")[2]], float)
    assert not table[:, 1].any()
    assert np.isnan(table[:, 2]).all()
    assert commented(tmp_path / "windows.csv")[2][0][2] == "nan"
    assert field_of(tmp_path / "field.npz").shape == (72, 3, 522)
    assert not field_of(tmp_path / "field.npz").any()
    # Without selected outputs there are the times alone.
    assert commented(tmp_path / "traces.csv")[1] == ["time_s"]
    assert len(commented(tmp_path / "traces.csv")[2]) == 522


@NAMES
def test_the_same_design_gives_the_same_bytes_that_tell_nothing_of_when(tmp_path, name):
    written = []
    for number in range(2):
        path = tmp_path / f"{number}{name}"
        EXPORTS[name](path, LONG, VIEW)
        written.append(path.read_bytes())
    assert written[0] == written[1]
    if name == "field.npz":
        with ZipFile(path) as archive:
            assert [member.compress_type for member in archive.infolist()] == [ZIP_STORED] * 3
            assert {member.date_time[0] for member in archive.infolist()} == {1980}
            assert archive.testzip() is None


@DESIGNS
@NAMES
def test_what_is_too_inaccurate_is_not_written(tmp_path, monkeypatch, name, design):
    path = tmp_path / name
    path.write_bytes(b"old")
    with pytest.raises(TooInaccurateError, match="Nothing was written"):
        EXPORTS[name](path, design, VIEW, largest_error=1e-18)
    EXPORTS[name](tmp_path / f"good-{name}", design, VIEW, largest_error=1e-3)
    nothing = TraceError(estimate=float("nan"), bound=float("nan"))
    monkeypatch.setattr(trace_rules, "trace_error_of", lambda *_: nothing)
    with pytest.raises(TooInaccurateError):
        EXPORTS[name](path, design, VIEW, largest_error=1e-3)
    assert sorted(os.listdir(tmp_path)) == sorted([name, f"good-{name}"])
    assert path.read_bytes() == b"old"


def test_samples_that_are_wrong_show_in_the_figures_of_a_long_field(tmp_path, monkeypatch):
    right = StreamedVibration.blocks_of

    def a_little_late(self, *asked):
        for first, block in right(self, *asked):
            yield first, np.roll(block, 1, axis=-1)

    monkeypatch.setattr(StreamedVibration, "blocks_of", a_little_late)
    export_field(tmp_path / "field.npz", LONG, VIEW)
    assert figures(about(tmp_path / "field.npz"))[0] > 1e-2


@pytest.mark.parametrize("method", ["pca", "soc", "mag", "rms"])
def test_traces_that_are_too_many_to_be_held_are_the_same(tmp_path, monkeypatch, method):
    view, tables = replace(VIEW, method=method), []
    for name in ("held.csv", "traces.csv"):
        export_traces(tmp_path / name, LONG, view)
        tables.append(np.array(commented(tmp_path / name)[2], float))
        monkeypatch.setattr(exported_design, "_MOST_HELD_BYTES", 500_000)
    peak = np.abs(tables[0][:, 1:]).max()
    np.testing.assert_allclose(tables[1], tables[0], rtol=0, atol=1e-14 * peak)
    lines = about(tmp_path / "traces.csv")
    assert any("error of the traces of outputs 72, rel" in line for line in lines)


def test_memory_does_not_grow_with_the_field(tmp_path):
    peaks_bytes, sizes_bytes = [], []
    for duration_s in (20.0, 20.0, 60.0):
        tone = Tone(frequency_hz=80.0, duration_s=duration_s)
        design = Design(limb="synthetic-1", inputs=(track(location=7, waveform=tone),))
        tracemalloc.start()
        try:
            export_field(tmp_path / "field.npz", design, View())
            peaks_bytes.append(tracemalloc.get_traced_memory()[1])
        finally:
            tracemalloc.stop()
        sizes_bytes.append((tmp_path / "field.npz").stat().st_size)
    # The first one warms up.
    assert sizes_bytes[2] - sizes_bytes[1] > 89e6
    assert peaks_bytes[2] - peaks_bytes[1] < 10e6


@NAMES
def test_an_export_stops_at_any_moment_and_leaves_what_was_there(tmp_path, name):
    asked = count()
    EXPORTS[name](tmp_path / name, LONG, VIEW, stop=lambda: next(asked) < 0)
    total = next(asked)
    (tmp_path / name).write_bytes(b"old")
    for last in np.linspace(0, total - 1, 6).astype(int):
        asked = count()
        with pytest.raises(Stopped):
            EXPORTS[name](tmp_path / name, LONG, VIEW, stop=lambda a=asked, n=last: next(a) >= n)
        assert os.listdir(tmp_path) == [name], f"stopped at question {last} of {total}"
        assert (tmp_path / name).read_bytes() == b"old"


@pytest.mark.parametrize("name", ["traces.csv", "field.npz"])
def test_progress_only_grows_in_small_pieces_and_ends_at_the_end(tmp_path, name):
    progress = []
    EXPORTS[name](tmp_path / name, LONG, VIEW, progress=lambda *now: progress.append(now))
    assert progress[0] == (0, 0, "Computing")
    steps = np.diff([done for done, total, _ in progress if total])
    assert (steps > 0).all()
    assert name != "traces.csv" or steps.max() < 2100
    assert progress[-1][:2] == (N_LONG, N_LONG)


@pytest.mark.parametrize("name", ["traces.csv", "field.npz"])
def test_a_disk_that_is_full_is_one_sentence_and_leaves_what_was_there(tmp_path, name):
    resource = pytest.importorskip("resource", reason="files cannot be limited here")
    (tmp_path / name).write_bytes(b"old")
    usual = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (300_000, usual[1]))
    try:
        with pytest.raises(StorageError, match=r"cannot be written .* Free some space"):
            EXPORTS[name](tmp_path / name, LONG, VIEW)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, usual)
    assert os.listdir(tmp_path) == [name]
    assert (tmp_path / name).read_bytes() == b"old"


def test_a_place_without_room_is_one_sentence_before_anything_is_written(tmp_path, monkeypatch):
    for name, export in EXPORTS.items():
        with pytest.raises(StorageError, match="cannot be written"):
            export(tmp_path / "nowhere" / name, SHORT, VIEW)
    usage = shutil.disk_usage(tmp_path)._replace(free=10**6)
    monkeypatch.setattr(shutil, "disk_usage", lambda _: usage)
    with pytest.raises(StorageError, match=r"field.npz: the whole field takes 0\.0. GB, and 0\.00"):
        export_field(tmp_path / "field.npz", LONG, View())
    assert os.listdir(tmp_path) == []
