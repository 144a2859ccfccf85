"""Which files an export writes is told before it is written."""

import pytest

import skinsource as ss
from skinsource.export.formats import format_named
from skinsource.export.stimulus_export.export import written_files
from skinsource.export.stimulus_export.preparing import prepare_stimulus

TONE = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.05)
DESIGN = ss.Design(limb="synthetic-1", inputs=(ss.track(8, TONE), ss.track(13, TONE)))


@pytest.mark.parametrize("several", [False, True])
@pytest.mark.parametrize("name", ss.export_formats())
def test_the_files_that_are_told_are_those_that_are_written(tmp_path, name, several):
    kind, options = format_named(name), ss.StimulusOptions(one_file_per_input=several)
    path = tmp_path / f"a.b{kind.suffix}"
    prepared = prepare_stimulus(DESIGN, kind, None, options)
    ss.export_stimulus(DESIGN, path, name, options=options, confirmed=True)
    promised = [file for files in written_files(prepared, path) for file in files]
    assert sorted(promised) == sorted(tmp_path.iterdir())
