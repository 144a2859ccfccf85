import os
import shutil
import tracemalloc
from pathlib import Path
from zipfile import ZIP_STORED, ZipFile

import numpy as np
import pytest

from skinsource.base.errors import StorageError
from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource.design.waveforms.pulses import Noise, Tap
from skinsource.design.waveforms.tones import Tone
from skinsource.engine.prediction import predict
from skinsource.engine.quantities import new_graph, sources
from skinsource.export.tables import export_field
from skinsource.limbs.catalog import load_limb

SHORT = Design(
    scaling="upstream",
    limb="synthetic-1",
    inputs=(
        track(location=7, waveform=Noise(seed=3, duration_s=0.1), amplitude=0.1),
        track(location=13, waveform=Tap(), amplitude=-1 / 3, muted=True),
    ),
)
# Two taps with sixteen seconds of silence between them.
LONG = Design(
    scaling="upstream",
    limb="synthetic-1",
    inputs=(
        track(location=7, waveform=Tap(), amplitude=0.1),
        track(location=13, waveform=Tap(), amplitude=-2.0, onset_s=16.0),
    ),
)


def read(path: Path) -> dict[str, np.ndarray]:
    with np.load(path, allow_pickle=False) as archive:
        return dict(archive)


def test_the_field_of_a_short_design_is_what_the_library_predicts(tmp_path):
    export_field(tmp_path / "field.npz", SHORT, View(axes="z", outputs=()))
    arrays = read(tmp_path / "field.npz")
    drive = SHORT.inputs[0].clips[0].waveform.samples(1300.0)
    expected = predict(load_limb("synthetic-1"), [drive], [7], [0.1])
    assert arrays["acceleration_m_per_s2"].dtype == np.float64
    assert arrays["sample_rate_hz"] == 1300.0
    np.testing.assert_allclose(
        arrays["acceleration_m_per_s2"], expected, rtol=0, atol=1e-14 * np.abs(expected).max()
    )


def test_the_field_of_a_long_design_is_the_streamed_one_and_silence_is_zero(tmp_path):
    export_field(tmp_path / "field.npz", LONG, View())
    field = read(tmp_path / "field.npz")["acceleration_m_per_s2"]
    streamed = new_graph().evaluate({"streamed_vibration"}, sources(LONG, View()))[
        "streamed_vibration"
    ]
    np.testing.assert_array_equal(field, streamed.everything())
    silent = slice(21 + 521, 16 * 1300)
    assert not field[..., silent].any()
    assert field[..., :542].any()
    assert field[..., 16 * 1300 :].any()


def test_a_design_without_inputs_is_silent(tmp_path):
    export_field(tmp_path / "field.npz", Design(limb="synthetic-1"), View())
    arrays = read(tmp_path / "field.npz")
    assert arrays["acceleration_m_per_s2"].shape == (72, 3, 522)
    assert not arrays["acceleration_m_per_s2"].any()
    assert "nothing to check" in str(arrays["about"])


def test_the_archive_is_not_packed_and_tells_nothing_of_when_it_was_made(tmp_path):
    for name in ("one.npz", "two.npz"):
        export_field(tmp_path / name, SHORT, View())
    assert (tmp_path / "one.npz").read_bytes() == (tmp_path / "two.npz").read_bytes()
    with ZipFile(tmp_path / "one.npz") as archive:
        assert [member.compress_type for member in archive.infolist()] == [ZIP_STORED] * 3
        assert {member.date_time[0] for member in archive.infolist()} == {1980}
        assert archive.testzip() is None


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


def test_a_disk_with_too_little_room_is_one_clear_sentence_before_anything_is_written(
    tmp_path, monkeypatch
):
    path = tmp_path / "field.npz"
    path.write_bytes(b"old")
    usage = shutil.disk_usage(tmp_path)._replace(free=10**6)
    monkeypatch.setattr(shutil, "disk_usage", lambda _: usage)
    with pytest.raises(StorageError, match=r"field.npz: the whole field takes 0\.0. GB, and 0\.00"):
        export_field(path, LONG, View())
    assert os.listdir(tmp_path) == ["field.npz"]
    assert path.read_bytes() == b"old"


def test_progress_only_grows_and_ends_at_the_end(tmp_path):
    progress = []
    export_field(tmp_path / "field.npz", LONG, View(), progress=lambda *now: progress.append(now))
    done = [done for done, _, _ in progress]
    assert progress[0] == (0, 0, "Computing")
    assert done == sorted(done)
    assert progress[-1][0] == progress[-1][1] == 16 * 1300 + 21 + 521
