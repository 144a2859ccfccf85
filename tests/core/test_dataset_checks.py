"""What the checker says of a download that is not what it should be."""

import re
import shutil
import sys

import numpy as np
import pytest

from skinsource.base.errors import DatasetError, MissingExtraError, StorageError
from skinsource.base.extras import extra_line
from skinsource.limbs.dataset.install import install


@pytest.fixture
def download(synthetic_download, tmp_path):
    folder = tmp_path / "download"
    shutil.copytree(synthetic_download, folder)
    return folder


@pytest.fixture
def refused(download, user_data):
    """Install what is in ``download``; give the message; see that nothing was left behind."""

    def attempt(error=DatasetError):
        with pytest.raises(error) as caught:
            install(download, unpublished=True)
        assert list(user_data.iterdir()) == []
        return str(caught.value)

    return attempt


@pytest.fixture
def refused_rows(download, refused, write_table):
    def attempt(rows, version="v7.3"):
        write_table(download / "impulseResponses.mat", rows, version)
        return refused()

    return attempt


def _with_nan(data, *place):
    changed = data.copy()
    changed[11, 2, 0] = np.nan
    return changed, *place


ROWS = {
    "shape": (lambda data, *place: (data[:500], *place), r"has shape \(500, 72, 3\), expected"),
    "finite": (_with_nan, "1 value not finite, the first at tap 12, output 3, axis 1"),
    "kind": (lambda data, *place: (data.astype(np.int32), *place), "values of type int32"),
    "repeated": (lambda data, *_: (data, 1.0, 1.0), r"\(model 1, location 1\) repeats an earlier"),
    "model": (lambda data, _, place: (data, 5.0, place), "Model 5.0, expected a whole number 1 to"),
    "half": (lambda data, _, place: (data, 1.5, place), "has Model 1.5"),
    "place": (lambda data, limb, _: (data, limb, 0.0), "has Location 0.0, expected a whole number"),
    "no place": (lambda data, limb, _: (data, limb, np.nan), "has Location nan"),
}


@pytest.mark.parametrize("case", ROWS)
def test_a_row_that_is_not_what_it_should_be_is_named(refused_rows, complete_rows, case):
    change, message = ROWS[case]
    rows = complete_rows[:3]
    rows[1] = change(*rows[1])
    assert re.search(f"^impulseResponses.mat: row 2 .*{message}", refused_rows(rows))


def test_a_row_with_the_values_of_another_is_refused(refused_rows, complete_rows):
    rows = complete_rows[:3]
    rows[2] = (rows[1][0], *rows[2][1:])
    assert (
        "row 3 (model 1, location 3) holds the values of row 2 (model 1, location 2), expected "
        "its own"
    ) in refused_rows(rows)


def test_a_missing_row_is_named(refused_rows, complete_rows):
    rows = complete_rows[:64] + complete_rows[65:]
    message = refused_rows(rows)
    assert "has 79 of 80 rows, the first missing one is model 4, location 5" in message


def test_a_variable_that_is_no_table_with_the_columns_is_refused(download, refused):
    matio = pytest.importorskip("matio")
    pandas = pytest.importorskip("pandas")
    table = pandas.DataFrame({"Model": [1.0], "Other": [2.0]})
    for variable, message in (
        (table, "dataTable has no column Data, Location"),
        (np.eye(3), "expected a table with the columns Data, Model, Location"),
    ):
        matio.save_to_mat(str(download / "impulseResponses.mat"), {"dataTable": variable})
        assert message in refused()


def test_a_matlab_file_with_something_else_in_it_is_refused(download, refused):
    shutil.copy(download / "visualization" / "mask1.mat", download / "impulseResponses.mat")
    assert "holds mask, expected a variable 'dataTable' (is this the right file?)" in refused()


@pytest.mark.parametrize(
    "content", [b"", b"<html>not found</html>\n" * 50, b"\0" * 5000, b"\x89HDF\r\n\x1a\n" * 99]
)
def test_a_file_that_is_no_matlab_file_is_refused(download, refused, content):
    (download / "impulseResponses.mat").write_bytes(content)
    assert refused().startswith("impulseResponses.mat: ")


@pytest.mark.parametrize(
    ("name", "variable", "value", "text"),
    [
        ("outputLocations", "outputLocations", np.zeros((71, 2)), r"shape \(71, 2\)"),
        ("outputLocations", "outputLocations", np.zeros((72, 2)), "expected NaN"),
        ("outputLocations", "outputLocations", np.full((72, 2), np.nan), "expected finite"),
        ("inputLocations", "inputLocations", np.full((20, 2), np.nan), "expected finite"),
        ("inputLocations", "inputLocations", np.zeros((2, 20)), r"expected \(20, 2\)"),
        ("adjacencyMatrix", "adjacencyMatrix", np.zeros((5, 72)), r"expected \(1505, 72\)"),
        ("adjacencyMatrix", "adjacencyMatrix", -np.ones((1505, 72)), "expected distances"),
        ("adjacencyMatrix", "adjacencyMatrix", np.full((1505, 72), np.nan), "at least one"),
        ("surface", "surface", np.zeros((1505, 2)), "no polyshape with Vertices"),
        ("surface", "other", np.zeros((1505, 2)), "expected a variable 'surface'"),
        ("mask2", "mask", np.zeros((464, 174)), r"expected \(437, 164\)"),
        ("mask3", "mask", np.full((490, 184), 0.5), "zeros and ones"),
    ],
)
def test_a_map_file_with_other_content_is_refused(download, refused, name, variable, value, text):
    matio = pytest.importorskip("matio")
    path = download / "visualization" / f"{name}.mat"
    matio.save_to_mat(str(path), {variable: value}, version="v7")
    message = refused()
    assert message.startswith(f"{name}.mat: ")
    assert re.search(text, message)


def test_missing_map_files_are_named(download, refused):
    (download / "visualization" / "surface.mat").unlink()
    (download / "visualization" / "mask3.mat").unlink()
    assert "missing mask3.mat, surface.mat" in refused()


def test_a_folder_without_the_responses_is_refused(download, refused):
    (download / "impulseResponses.mat").unlink()
    assert "holds no impulseResponses.mat" in refused()


def test_a_path_that_does_not_exist_is_refused(download, refused):
    shutil.rmtree(download)
    assert "no such file or folder" in refused(StorageError)


def test_without_mat_io_the_message_holds_the_line_to_type(download, refused, monkeypatch):
    monkeypatch.setitem(sys.modules, "matio", None)
    assert extra_line("dataset") in refused(MissingExtraError)
