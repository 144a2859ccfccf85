"""Installing: the same store from either encoding; whole or not at all."""

import shutil

import numpy as np
import pytest

from skinsource.base.errors import DatasetError, Stopped
from skinsource.limbs.dataset.install import install
from skinsource.limbs.dataset.published import ARRAYS, find_downloaded
from skinsource.limbs.dataset.store import describe, is_installed, load_measured_limb
from tests.conftest import synthetic_response


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
