"""What the lines before a table say about its rate, and where its numbers begin."""

import numpy as np
import pytest

from skinsource.readers import text
from skinsource.readers.timestamps import stated_rate_hz


@pytest.mark.parametrize(
    ("line", "rate_hz"),
    [
        ("# sampling rate: 48,000 Hz", 48_000.0),
        ("# sampling rate: 48,000.5 Hz", 48_000.5),
        ("# sampling rate: 1,300,000", 1_300_000.0),
        ("# sample rate 44,1 kHz", 44_100.0),
        ("# samplerate=1e3", 1000.0),
        ("fs=1300, 3 channels", 1300.0),
        ("#rate=500", 500.0),
        ("Rate (Hz): 500", 500.0),
        ("Sampling: 1000 Hz", 1000.0),
        ("# Samples: 5000", None),
        ("# Number of samples = 1024", None),
        ("# refs: 12", None),
        ("# heart rate: 70", None),
        ("# frame rate: 30", None),
        ("# generate: 8", None),
        ("# sample rate: 1.300,5", None),
    ],
)
def test_a_number_is_a_rate_where_the_line_says_so(line, rate_hz):
    expected = None if rate_hz is None or rate_hz > 768_000 else rate_hz
    assert stated_rate_hz([line], ".") == expected


def test_where_decimals_have_a_comma_a_point_parts_thousands():
    assert stated_rate_hz(["fs: 48.000 Hz"], ",") == 48_000.0
    assert stated_rate_hz(["fs: 1.300,5 Hz"], ",") == 1300.5
    assert stated_rate_hz(["fs: 48,000 Hz"], ",") == 48.0


@pytest.mark.parametrize("odd", ["\x0b", "\x0c", "\x1c", "\x85", "\u2028"])
def test_what_ends_lines_elsewhere_hides_no_row(odd, tmp_path):
    path = tmp_path / "table.csv"
    path.write_text(f"# made{odd}by{odd}hand\n1\n2\n3\n", encoding="utf-8")
    recording = text.look(path)
    assert recording.series[0].n_samples == 3
    [block] = text.blocks(path, ["0"], 0, 3)
    assert np.array_equal(block[0], [1.0, 2.0, 3.0])
