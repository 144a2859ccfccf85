"""How large a file will be is told before it is written."""

import pytest

import skinsource as ss
from skinsource.export.formats import arrays, format_named
from skinsource.export.stimulus_export.preparing import prepare_stimulus

DESIGN = ss.Design(
    limb="synthetic-1",
    inputs=(ss.track(7, ss.waveforms.Tone(frequency_hz=101.0, duration_s=0.4)),),
)


@pytest.mark.parametrize("layout", ["table", "plain", "keysight", "pwl"])
@pytest.mark.parametrize("rate_hz", [1300, 8000])
def test_a_table_is_about_as_large_as_told_in_each_layout(tmp_path, layout, rate_hz):
    options = ss.StimulusOptions(choices={"layout": layout})
    path = tmp_path / "drive.csv"
    predicted_bytes = prepare_stimulus(DESIGN, format_named("csv"), rate_hz, options).n_bytes
    ss.export_stimulus(DESIGN, path, "csv", rate_hz, options=options)
    assert predicted_bytes == pytest.approx(path.stat().st_size, rel=0.15)


def test_what_is_predicted_does_not_count_where_it_is_too_much_to_be_written(tmp_path, monkeypatch):
    monkeypatch.setattr(arrays, "_MOST_RESPONSE_BYTES", 1e5)
    path = tmp_path / "drive.h5"
    hdf5 = format_named("hdf5")
    predicted_bytes = prepare_stimulus(DESIGN, hdf5, None, ss.StimulusOptions()).n_bytes
    ss.export_stimulus(DESIGN, path)
    assert predicted_bytes < 20_000
    assert path.stat().st_size < 20_000


def test_what_is_predicted_counts_where_it_is_written_too(tmp_path):
    path = tmp_path / "drive.h5"
    hdf5 = format_named("hdf5")
    predicted_bytes = prepare_stimulus(DESIGN, hdf5, None, ss.StimulusOptions()).n_bytes
    ss.export_stimulus(DESIGN, path)
    assert predicted_bytes == pytest.approx(path.stat().st_size, rel=0.05)
