"""Tables in text, as programs and people write them, and the rates that they state."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from skinsource.base.errors import RecordingError
from skinsource.readers import text as text_table
from skinsource.readers.timestamps import stated_rate_hz

NUMBERS = [[0.0, 1.5], [0.001, -2.25], [0.002, 1e-3]]

TABLES = {
    "commas": "0,1.5\n0.001,-2.25\n0.002,1e-3\n",
    "no end of line": "0,1.5\n0.001,-2.25\n0.002,1e-3",
    "tabs": "0\t1.5\n0.001\t-2.25\n0.002\t1e-3\n",
    "blanks": "  0   1.5\n 0.001  -2.25\n 0.002 1e-3\n",
    "decimal commas": "0;1,5\n0,001;-2,25\n0,002;1e-3\n",
    "decimal commas and tabs": "0\t1,5\n0,001\t-2,25\n0,002\t1e-3\n",
    "Windows": "0,1.5\r\n0.001,-2.25\r\n0.002,1e-3\r\n",
    "a comma at each end": "0,1.5,\n0.001,-2.25,\n0.002,1e-3,\n",
    "quotation marks": '"0","1.5"\n"0.001","-2.25"\n"0.002","1e-3"\n',
    "empty lines and comments": "# made by hand\n\n0,1.5\n\n0.001,-2.25\n# half\n0.002,1e-3\n\n",
    "Fortran": "0 1.5D0\n0.001 -2.25D0\n0.002 1D-3\n",
    "bars": "0|1.5\n0.001|-2.25\n0.002|1e-3\n",
}


@pytest.fixture
def path(tmp_path):
    """A name for a table."""
    return tmp_path / "a.csv"


def numbers_of(path):
    recording = text_table.look(path)
    keys = [series.key for series in recording.series]
    n = recording.series[0].n_samples
    return np.concatenate(list(text_table.blocks(path, keys, 0, n)), axis=1).T


@pytest.mark.parametrize("name", TABLES)
@pytest.mark.parametrize("heading", ["", "time [s]{0}acc [g]\n", "made today\nt{0}x\ns{0}m/s^2\n"])
def test_tables_are_understood_however_they_are_written(name, heading, path):
    separator = {"tabs": "\t", "blanks": "  ", "bars": "|", "Fortran": " "}.get(name, ",")
    separator = ";" if name == "decimal commas" else separator
    separator = "\t" if "and tabs" in name else separator
    end = "," if name == "a comma at each end" else ""
    text = heading.format(separator).replace("\n", f"{end}\n") if heading else ""
    if name == "blanks" or name == "Fortran":
        text = text.replace(" [", "[")
    path.write_text(text + TABLES[name], newline="")
    np.testing.assert_array_equal(numbers_of(path), NUMBERS)
    first, second = text_table.look(path).series
    if heading:
        assert first.is_time
        assert second.unit == ("g" if "[g]" in heading else "m/s²")
    else:
        assert (first.name, second.name) == ("column 1", "column 2")


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "cp1252"])
def test_names_in_any_encoding(encoding, path):
    path.write_text("Zeit [ms];Größe [µm]\n1,5;2\n2,5;3\n", encoding=encoding)
    time, size = text_table.look(path).series
    assert (time.is_time, time.time_unit_s) == (True, 1e-3)
    assert (size.name, size.unit) == ("Größe", "µm")


def test_empty_cells_are_missing_numbers(path):
    path.write_text("t,x\n0,1\n1,\n2,NaN\n3,4\n")
    np.testing.assert_array_equal(numbers_of(path)[:, 1], [1.0, np.nan, np.nan, 4.0])


def test_a_line_that_is_wrong_is_named(path):
    path.write_text("x,y\n" + "1,2\n" * 100_000 + "3,oops\n" + "1,2\n" * 100)
    with pytest.raises(RecordingError, match=r"line 100002 holds 'oops'.*expected 2 numbers"):
        numbers_of(path)
    path.write_text("x,y\n" + "1,2\n" * 100_000 + "3\n" + "1,2\n" * 100)
    with pytest.raises(RecordingError, match="line 100002 holds 1 cell,"):
        numbers_of(path)


def test_a_last_line_that_is_cut_off_is_left_out_with_a_note(path):
    path.write_text("x,y\n1,2\n3,4\n5")
    recording = text_table.look(path)
    assert recording.series[0].n_samples == 2
    assert "cut off" in recording.notes[0]
    np.testing.assert_array_equal(numbers_of(path), [[1, 2], [3, 4]])


def test_parts_are_those_of_the_whole(tmp_path, monkeypatch):
    monkeypatch.setattr("skinsource.readers.limits.BLOCK", 16)
    values = np.random.default_rng(0).standard_normal((100, 3))
    path = tmp_path / "a.txt"
    np.savetxt(path, values)
    for start, stop in ((0, 100), (17, 64), (99, 100), (40, 1000)):
        blocks = list(text_table.blocks(path, ["2", "0"], start, stop))
        table = np.concatenate(blocks, axis=1)
        np.testing.assert_array_equal(table, values[start:stop, [2, 0]].T)


def test_a_line_without_end_is_refused(path):
    path.write_text("1,2\n" * 20_000 + "7" * 2_000_000)
    with pytest.raises(RecordingError, match="characters"):
        text_table.look(path)


@given(
    values=st.lists(
        st.tuples(*[st.floats(allow_nan=False, allow_infinity=False)] * 2), min_size=1, max_size=20
    ),
    separator=st.sampled_from(["\t", ";", ",", "|", " "]),
    comma=st.booleans(),
)
@settings(max_examples=60, deadline=None)
def test_what_is_written_with_all_digits_is_read_to_the_last_bit(
    values, separator, comma, tmp_path_factory
):
    path = tmp_path_factory.mktemp("table") / "a.csv"
    text = "\n".join(f"{a!r}{separator}{b!r}" for a, b in values) + "\n"
    if comma and separator != ",":
        text = text.replace(".", ",")
    path.write_text(text)
    np.testing.assert_array_equal(numbers_of(path), values)


@pytest.mark.parametrize("missing", ["NaN,NaN", "NA,na", ","])
@pytest.mark.parametrize("heading", ["", "time [s],acc [g]\n"])
def test_missing_numbers_before_the_first_are_samples(missing, heading, path):
    path.write_text(heading + 50 * f"{missing}\n" + TABLES["commas"])
    values = numbers_of(path)
    assert np.isnan(values[:50]).all()
    np.testing.assert_array_equal(values[50:], NUMBERS)


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
def test_what_ends_lines_elsewhere_hides_no_row(odd, path):
    path.write_text(f"# made{odd}by{odd}hand\n1\n2\n3\n", encoding="utf-8")
    np.testing.assert_array_equal(numbers_of(path), [[1.0], [2.0], [3.0]])
