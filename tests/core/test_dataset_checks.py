"""Downloads are checked and installed: whole or not at all, and what is damaged is named."""

import re
import shutil
import struct
import sys

import h5py
import numpy as np
import pytest

from skinsource.base.errors import DatasetError, MissingExtraError, Stopped, StorageError
from skinsource.base.extras import extra_line
from skinsource.limbs.dataset.install import check_contiguous, install
from skinsource.limbs.dataset.published import ARRAYS, find_downloaded
from skinsource.limbs.dataset.store import describe, is_installed, load_measured_limb
from tests.conftest import synthetic_response


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


def _everything(path):
    """Give all arrays of a store, by name."""
    with np.load(path) as store:
        return {name: store[name] for name in store.files if name in ARRAYS}


def test_installing_keeps_every_response_with_time_last(synthetic_installed):
    for limb in (1, 4):
        opened = load_measured_limb(limb)
        for place in (1, 13, 20):
            expected = synthetic_response(limb, place).transpose(1, 2, 0)
            np.testing.assert_array_equal(opened.response_to(place), expected)
    assert opened.response_to(20)[5, 1, 3] == 4.2 + 0.25


def test_both_matlab_encodings_give_the_same_bits(
    synthetic_download, synthetic_store, write_table, complete_rows, tmp_path
):
    folder = tmp_path / "v7"
    shutil.copytree(synthetic_download, folder)
    write_table(folder / "impulseResponses.mat", complete_rows, "v7")
    store = install(folder, unpublished=True).path
    first, second = _everything(store), _everything(synthetic_store)
    assert list(first) == list(second)
    assert all(first[name].tobytes() == second[name].tobytes() for name in first)


@pytest.mark.parametrize(
    ("responses", "maps", "given"),
    [
        ("impulseResponses.mat", "visualization", ""),
        ("impulseResponses.mat", "visualization", "impulseResponses.mat"),
        ("renamed.mat", "visualization", "renamed.mat"),
        ("impulseResponses.mat", "source/visualization", ""),
        ("impulseResponses.mat", "", ""),
        ("impulseResponses.mat", "skinsource-main/source/visualization", ""),
        ("skinsource-main/source/impulseResponses.mat", "skinsource-main/source/visualization", ""),
    ],
)
def test_the_files_are_found_where_a_download_puts_them(
    synthetic_download, tmp_path, responses, maps, given
):
    shutil.copytree(synthetic_download / "visualization", tmp_path / maps, dirs_exist_ok=True)
    (tmp_path / responses).parent.mkdir(parents=True, exist_ok=True)
    (tmp_path / responses).write_bytes(b"responses")
    downloaded = find_downloaded(tmp_path / given)
    assert (downloaded.responses, downloaded.map_folder) == (tmp_path / responses, tmp_path / maps)


@pytest.mark.parametrize("asked", [0, 40, 81, 90])
def test_a_cancel_at_any_moment_leaves_nothing(synthetic_download, user_data, asked):
    answers = iter([False] * asked)
    with pytest.raises(Stopped, match="nothing was changed"):
        install(synthetic_download, unpublished=True, stop=lambda: next(answers, True))
    assert next(answers, None) is None
    assert list(user_data.iterdir()) == []


def test_a_failure_keeps_the_old_store(synthetic_download, synthetic_installed, tmp_path):
    before = synthetic_installed.read_bytes()
    broken = tmp_path / "broken"
    shutil.copytree(synthetic_download, broken)
    (broken / "impulseResponses.mat").write_bytes(b"nonsense")
    with pytest.raises(DatasetError):
        install(broken, unpublished=True)
    answers = iter([False] * 85)
    with pytest.raises(Stopped):
        install(synthetic_download, unpublished=True, stop=lambda: next(answers, True))
    assert synthetic_installed.read_bytes() == before
    assert [path.name for path in synthetic_installed.parent.iterdir()] == ["measured.npz"]


def test_a_second_installation_replaces_the_first(
    synthetic_download, synthetic_installed, write_table, complete_rows, tmp_path
):
    folder = tmp_path / "newer"
    shutil.copytree(synthetic_download, folder)
    rows = [(data + 1, limb, place) for data, limb, place in complete_rows]
    write_table(folder / "impulseResponses.mat", rows)
    install(folder, unpublished=True)
    assert load_measured_limb(1).response_to(1)[0, 0, 0] == 2.01
    assert [path.name for path in synthetic_installed.parent.iterdir()] == ["measured.npz"]


def test_map_files_that_are_not_the_published_ones_are_refused_unless_meant(
    synthetic_download, user_data
):
    with pytest.raises(DatasetError, match=r"not the published content: .*mask2.*--unpublished"):
        install(synthetic_download)
    assert list(user_data.iterdir()) == []


def test_the_store_tells_what_it_was_made_from(synthetic_download, user_data):
    info = install(synthetic_download, unpublished=True)
    assert info == describe()
    assert is_installed()
    assert info.limbs == (1, 2, 3, 4)
    assert info.source_name == "impulseResponses.mat"
    assert info.source_bytes == (synthetic_download / "impulseResponses.mat").stat().st_size
    assert len(info.source_sha256) == 64
    assert info.installed_at.endswith("+00:00")
    assert info.size_bytes == info.path.stat().st_size


def test_the_measured_values_are_those_of_the_published_dataset(measured):
    # minimum, maximum, RMS of each limb's responses, rounded
    known = {
        1: (-24.22, 26.26, 0.216),
        2: (-26.91, 25.92, 0.233),
        3: (-29.96, 26.93, 0.242),
        4: (-26.97, 25.75, 0.257),
    }
    for number, (lowest, highest, rms) in known.items():
        responses = load_measured_limb(number).impulse_responses
        assert responses.shape == (20, 72, 3, 522)
        assert round(responses.min(), 2) == lowest
        assert round(responses.max(), 2) == highest
        assert round(float(np.sqrt(np.mean(responses**2))), 3) == rms


#: A node of an index, and that it is one of pieces, not of names.
NODE = b"TREE\x01"


def test_a_misplaced_piece_is_refused_by_the_installation(synthetic_download, tmp_path):
    folder = tmp_path / "download"
    shutil.copytree(synthetic_download, folder)
    path = folder / "visualization" / "adjacencyMatrix.mat"
    matio = pytest.importorskip("matio")
    values = matio.load_from_mat(str(path))["adjacencyMatrix"]
    matio.save_to_mat(str(path), {"adjacencyMatrix": values}, version="v7.3")
    with h5py.File(path, "r+", libver="earliest") as file:
        attributes = dict(file["adjacencyMatrix"].attrs)
        del file["adjacencyMatrix"]
        pieces = file.create_dataset(
            "adjacencyMatrix", data=values.T, chunks=(8, 500), compression="gzip"
        )
        pieces.attrs.update(attributes)
    install(folder, unpublished=True)

    content = bytearray(path.read_bytes())
    place = content.index(NODE) + 24 + 8 + 7  # the highest byte of the first piece's row
    content[place] ^= 2
    path.write_bytes(content)
    with h5py.File(path) as file:
        assert (file["adjacencyMatrix"][:8, :500] == 0).all()  # not a word from HDF5
    with pytest.raises(DatasetError, match=r"adjacencyMatrix\.mat: is damaged: .* piece"):
        install(folder, unpublished=True)


def test_two_arrays_in_one_place_are_refused(tmp_path):
    path = tmp_path / "twice.mat"
    with h5py.File(path, "w", libver="earliest") as file:
        for name in ("one", "other"):
            file[name] = np.arange(1000.0)
        places = [file[name].id.get_offset() for name in ("one", "other")]
    check_contiguous(path)
    first, second = (struct.pack("<Q", place) for place in places)
    content = path.read_bytes()
    assert content.count(second) == 1
    path.write_bytes(content.replace(second, first))
    with h5py.File(path) as file:
        assert file["other"].id.get_offset() == places[0]
    with pytest.raises(DatasetError, match="/one and /other lie in the same place"):
        check_contiguous(path)


def written_in_part(file):
    file.create_dataset("mask", (4, 4), "<f8", chunks=(2, 4))[:2] = 1.0


def of_an_odd_kind(file):
    odd = h5py.h5t.IEEE_F64LE.copy()
    odd.set_ebias(1022)
    space = h5py.h5s.create_simple((4,))
    h5py.h5d.create(file.id, b"mask", odd, space).write(h5py.h5s.ALL, h5py.h5s.ALL, np.ones(4))


ODD = {
    "mask is not there": lambda file: file.create_dataset("mask", (3, 4), "<f8"),
    "mask has 1 pieces, expected 2": written_in_part,
    "mask lies in other files": lambda file: file.create_dataset(
        "mask", (3, 4), "<f8", external=[("raw", 0, 96)]
    ),
    "mask holds numbers of an unknown kind": of_an_odd_kind,
}


@pytest.mark.parametrize("message", ODD)
def test_an_array_that_is_not_all_there_or_of_another_kind_is_refused(tmp_path, message):
    path = tmp_path / "odd.mat"
    with h5py.File(path, "w", libver="earliest") as file:
        ODD[message](file)
    with pytest.raises(DatasetError, match=message):
        check_contiguous(path)
