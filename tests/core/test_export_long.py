"""Exports of long designs: written piece by piece, stopped at any moment, on disks that fill up."""

import os
from itertools import count

import numpy as np
import pytest

from skinsource.base.errors import Stopped, StorageError
from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.engine.quantities import new_graph, sources
from skinsource.export import exported_design
from skinsource.export.tables import export_field, export_levels, export_traces

DESIGN = Design(
    limb="synthetic-1",
    inputs=(
        track(location=7, waveform=Noise(seed=3, duration_s=8.0), amplitude=0.1),
        track(location=13, waveform=Tap(), amplitude=-2.0, onset_s=16.0),
    ),
)
VIEW = View(outputs=(29, 1, 72), axes="xz", method="pca")
EXPORTS = {"traces.csv": export_traces, "levels.csv": export_levels, "field.npz": export_field}


def read(path) -> np.ndarray:
    lines = path.read_text(encoding="utf-8").splitlines()
    rows = [line for line in lines if not line.startswith("#")][1:]
    return np.array([[float(cell) for cell in row.split(",")] for row in rows])


def test_traces_of_a_long_design_are_those_on_screen(tmp_path):
    export_traces(tmp_path / "traces.csv", DESIGN, VIEW)
    table = read(tmp_path / "traces.csv")
    shown = new_graph().evaluate({"selected_traces", "response_time_s"}, sources(DESIGN, VIEW))
    np.testing.assert_array_equal(table[:, 0], shown["response_time_s"])
    np.testing.assert_array_equal(table[:, 1:].T, shown["selected_traces"])


@pytest.mark.parametrize("method", ["pca", "soc", "mag", "rms"])
def test_traces_that_are_too_many_to_be_held_are_the_same(tmp_path, monkeypatch, method):
    view = View(outputs=VIEW.outputs, axes=VIEW.axes, method=method)
    export_traces(tmp_path / "held.csv", DESIGN, view)
    monkeypatch.setattr(exported_design, "_MOST_HELD_BYTES", 500_000)
    export_traces(tmp_path / "traces.csv", DESIGN, view)
    held, written = read(tmp_path / "held.csv"), read(tmp_path / "traces.csv")
    assert written.shape == held.shape
    np.testing.assert_allclose(written, held, rtol=0, atol=1e-14 * np.abs(held[:, 1:]).max())
    assert "error of the traces of outputs 29, rel" in (tmp_path / "traces.csv").read_text()


@pytest.mark.parametrize("name", EXPORTS)
def test_an_export_stops_at_any_moment_and_leaves_what_was_there(tmp_path, name):
    asked = count()
    EXPORTS[name](tmp_path / name, DESIGN, VIEW, stop=lambda: next(asked) < 0)
    total = next(asked)
    (tmp_path / name).write_bytes(b"old")
    for last in np.linspace(0, total - 1, 12).astype(int):
        asked = count()
        with pytest.raises(Stopped):
            EXPORTS[name](tmp_path / name, DESIGN, VIEW, stop=lambda a=asked, n=last: next(a) >= n)
        assert os.listdir(tmp_path) == [name], f"stopped at question {last} of {total}"
        assert (tmp_path / name).read_bytes() == b"old"


@pytest.mark.parametrize("name", ["traces.csv", "field.npz"])
def test_a_disk_that_is_full_is_one_sentence_and_leaves_what_was_there(tmp_path, name):
    resource = pytest.importorskip("resource", reason="files cannot be limited here")
    (tmp_path / name).write_bytes(b"old")
    usual = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (300_000, usual[1]))
    try:
        with pytest.raises(StorageError, match=r"cannot be written .* Free some space"):
            EXPORTS[name](tmp_path / name, DESIGN, VIEW)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, usual)
    assert os.listdir(tmp_path) == [name]
    assert (tmp_path / name).read_bytes() == b"old"


@pytest.mark.parametrize("name", EXPORTS)
def test_a_folder_that_is_not_there_is_one_sentence(tmp_path, name):
    with pytest.raises(StorageError, match="cannot be written"):
        EXPORTS[name](tmp_path / "nowhere" / name, DESIGN, VIEW)


def test_a_table_is_written_in_small_pieces(tmp_path):
    progress = []
    export_traces(tmp_path / "t.csv", DESIGN, VIEW, progress=lambda *now: progress.append(now))
    steps = np.diff([done for done, total, _ in progress if total])
    assert (steps > 0).all()
    assert steps.max() < 2100
    assert progress[-1][:2] == (16 * 1300 + 21 + 521,) * 2
