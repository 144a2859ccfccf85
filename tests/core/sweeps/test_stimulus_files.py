"""Exported stimuli of a sweep: one full scale for all, and nothing is written twice."""

import json

import numpy as np
import pytest
import soundfile

import skinsource as ss
from skinsource.base.errors import Stopped
from skinsource.studies.sweeps.table import StimulusFiles

TONE = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.05)
DESIGN = ss.Design(limb="synthetic-1", inputs=(ss.track(7, TONE), ss.track(3, TONE)))
AMPLITUDES = (0.5, 2.0, -1.0)


def test_the_largest_drive_of_all_is_full_scale_in_every_file(tmp_path):
    ss.sweep(DESIGN, {"1.amplitude": AMPLITUDES}, out=tmp_path, files=StimulusFiles())
    names = sorted(file.name for file in (tmp_path / "stimuli").iterdir())
    assert names == [f"{k}.wav{end}" for k in (1, 2, 3) for end in ("", ".json")]
    stimuli = [soundfile.read(tmp_path / "stimuli" / f"{k}.wav")[0].T for k in (1, 2, 3)]
    assert max(np.abs(stimulus).max() for stimulus in stimuli) == pytest.approx(1.0, abs=1e-6)
    for amplitude, channels in zip(AMPLITUDES, stimuli, strict=True):
        np.testing.assert_allclose(channels[0], amplitude * channels[1], atol=1e-6)
        np.testing.assert_allclose(channels[1], stimuli[0][1], atol=1e-7)
    scales = {
        json.loads((tmp_path / "stimuli" / f"{k}.wav.json").read_text())["full_scale"]
        for k in (1, 2, 3)
    }
    assert len(scales) == 1


def test_stopped_the_export_goes_on_with_what_is_missing(tmp_path):
    progress = []
    vary = {"1.amplitude": AMPLITUDES}
    with pytest.raises(Stopped):
        ss.sweep(
            DESIGN,
            vary,
            out=tmp_path,
            files=StimulusFiles(),
            progress=lambda done, total, text: progress.append(text),
            stop=lambda: progress[-1:] == ["Exporting 2.wav"],
        )
    first = tmp_path / "stimuli" / "1.wav"
    before = first.stat().st_mtime_ns
    assert not (tmp_path / "stimuli" / "2.wav").exists()
    ss.sweep(DESIGN, vary, out=tmp_path, files=StimulusFiles())
    assert first.stat().st_mtime_ns == before
    assert (tmp_path / "stimuli" / "3.wav").exists()


def test_asked_for_at_another_rate_no_file_of_the_old_one_stays(tmp_path):
    vary = {"1.amplitude": AMPLITUDES}
    for rate_hz in (8000, 4000):
        ss.sweep(DESIGN, vary, out=tmp_path, files=StimulusFiles(rate_hz=rate_hz))
        files = sorted((tmp_path / "stimuli").glob("*.wav"))
        assert [soundfile.info(file).samplerate for file in files] == [rate_hz] * 3
    before = [file.stat().st_mtime_ns for file in files]
    ss.sweep(DESIGN, vary, out=tmp_path, files=StimulusFiles(rate_hz=4000))
    assert [file.stat().st_mtime_ns for file in files] == before
